"""How the simulation runs pipelines: what it tells ParaView's loader, and what it asks of scripts. Not for scripts.

ParaView imports a script as a module named after its file, so that a script random.py would be taken for Python's own
module and never run; gives no arguments to the scripts of a simulation that talks to it through vtkCPProcessor; and
ends the program where a script calls sys.exit. Each of that is mended here, by wrapping four functions of
paraview.catalyst.v2_internals (the same ones in ParaView 5.11 to 6.0).
"""
import functools
import os
import sys

from paraview import servermanager
from paraview.catalyst import importers, v2_internals

arguments = []  # of the pipeline that is being run
_count = 0


def _register(path):
    """Makes a script importable under a name that nobody else has, and the modules beside it under their own names."""
    global _count
    _count += 1
    importers.install_pathfinder()
    folder = os.path.dirname(path)
    if folder not in sys.path:
        sys.path.append(folder)  # at the end: no script may stand in for a module of Python or ParaView
    stem = os.path.splitext(os.path.basename(path))[0]
    return importers.add_file(path, f"pipeline_{_count}_{stem}")


def _without_exit(function):
    """A script that asks Python to exit has failed; the simulation goes on."""
    @functools.wraps(function)
    def wrapped(*args):
        try:
            return function(*args)
        except SystemExit as request:
            raise RuntimeError(f"the script asked Python to exit, with {request.code!r}") from request
    return wrapped


def install():
    v2_internals.register_module = _register
    v2_internals._get_active_arguments = lambda: list(arguments)
    for name in ("import_and_validate", "do_catalyst_initialize", "do_catalyst_execute", "do_catalyst_finalize",
                 "do_request_data_description"):
        setattr(v2_internals, name, _without_exit(getattr(v2_internals, name)))


def defines(path, function):
    """Names of the modules made of the script that have the function."""
    return [name for name, module in list(sys.modules.items())
            if getattr(module, "__file__", None) == path and hasattr(module, function)]


def _proxies(group):
    manager = servermanager.ProxyManager()
    return [(name, servermanager._getPyProxy(proxy)) for (name, _), proxy in manager.GetProxiesInGroup(group).items()]


def unknown_channels(channels):
    """What scripts take for channels and is none: sources without input that the simulation has not replaced."""
    problems = []
    for name, proxy in _proxies("sources"):
        xml_name = proxy.SMProxy.GetXMLName()
        reads = xml_name.startswith("PVTrivialProducer") or proxy.SMProxy.GetProperty("FileName") \
            or proxy.SMProxy.GetProperty("FileNames")
        if reads and proxy.SMProxy.GetProperty("Input") is None and name not in channels:
            problems.append(f"channel '{name}' unknown; this run has {', '.join(channels)}")
    return problems


def unknown_fields():
    """Arrays that filters, displays and extracts name and their input does not have."""
    problems = []
    for group in ("sources", "representations"):
        for _, proxy in _proxies(group):
            problems += [text for text in _fields_of(proxy) if text not in problems]
    return problems


def _fields_of(proxy):
    source = getattr(proxy, "Input", None)
    if source is None or not hasattr(source, "PointData"):
        return
    source.UpdatePipeline()
    for name in proxy.ListProperties():
        prop = proxy.SMProxy.GetProperty(name)
        domain = prop.FindDomain("vtkSMArrayListDomain") if prop is not None else None
        if domain is None or not prop.IsA("vtkSMStringVectorProperty") or prop.GetNumberOfElements() < 2:
            continue
        field = prop.GetElement(prop.GetNumberOfElements() - 1)
        known = [*source.PointData.keys(), *source.CellData.keys()]
        if not field or field in known or not known or field in ("None", "vtkBlockColors", "vtkCompositeIndex"):
            continue
        yield f"field '{field}' unknown; {_channel_of(source)} has {', '.join(sorted(known))}"


def _channel_of(source):
    """The name of the channel that a source goes back to."""
    while getattr(source, "Input", None) is not None:
        source = source.Input
    names = [name for name, proxy in _proxies("sources") if proxy == source]
    return f"channel '{names[0]}'" if names else "its input"


def fire_always():
    """Extracts of all scripts are made at every call, whatever their triggers say."""
    for _, extractor in _proxies("extractors"):
        trigger = extractor.Trigger
        for name, value in (("UseStartTimeStep", 0), ("UseEndTimeStep", 0), ("Frequency", 1),
                            ("UseStartTimeValue", 0), ("UseEndTimeValue", 0), ("Length", 0.0)):
            if trigger.SMProxy.GetProperty(name):
                setattr(trigger, name, value)
