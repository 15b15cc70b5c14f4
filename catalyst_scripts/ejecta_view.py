"""What the pipelines of a run share: settings, units, fixed colour maps, and a view that fills its frame.

A pipeline makes one View, shows sources in it with the representations it likes, and calls View.save(info) in
catalyst_execute. Everything that could flicker (camera, colour ranges, units, image size) comes from the run's settings.
Lengths are metres, all numbers SI; only what is written on an image is scaled to a readable unit.
"""
import functools
import json
import math
import os

import numpy
from paraview.simple import (CreateRenderView, GetColorTransferFunction, GetScalarBar, Line, ProgrammableFilter,
                             PVTrivialProducer, Show, Text, _DisableFirstRenderCameraReset)
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkIOImage import vtkPNGWriter

INK = [0.13, 0.13, 0.15]
PAPER = [1.0, 1.0, 1.0]
EMPTY = [0.955, 0.958, 0.963]
FONT = "/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf"

# Light enough at both ends for dark lines on it: x, red, green, blue.
UNDER_INK = [0.0, 0.66, 0.73, 0.84, 0.3, 1.0, 0.86, 0.55, 0.65, 0.97, 0.52, 0.25, 1.0, 0.84, 0.14, 0.16]
NUMBER = "fragment_number"  # 0 is dust
PALETTE = 120               # colours of fragments; numbers that differ by it look alike
largest_fragment = 1        # its number, drawn in a colour of its own

_read = functools.lru_cache(1)(json.loads)
_ranges = {}


def settings():
    """The run's settings and, from the first frame on, how its fields are shown, as the simulation publishes them."""
    return _read(os.environ["EJECTA_FRAME"])


def channel(name):
    """The source of a channel: particles, slice, ellipsoids, fragments, or another of settings()["channels"].

    To be called where the script begins: only channels that have a source by then are made for the first frame.
    """
    known = settings()["channels"]
    if name not in known:
        raise ValueError(f"channel '{name}' unknown; this run has {', '.join(known)}")
    return PVTrivialProducer(registrationName=name)


def data_of(source):
    """The channel's VTK data set itself: asking ParaView about it would compute the range of every array each time."""
    data = source.GetClientSideObject().GetOutputDataObject(0)
    return data.GetPartition(0) if data is not None and data.IsA("vtkPartitionedDataSet") else data


def has_data(source):
    data = data_of(source)
    return data is not None and data.GetNumberOfPoints() > 0


def fields(source):
    """Names of the point arrays of a channel."""
    arrays = data_of(source).GetPointData()
    return [arrays.GetArrayName(i) for i in range(arrays.GetNumberOfArrays())]


# ---- units ----------------------------------------------------------------------------------------------------------

def readable_unit(unit, largest):
    """The unit to print numbers up to `largest` [unit] in, and what to multiply them by."""
    if unit in ("", "1"):
        return "", 1.0
    if unit.startswith("kg") or largest <= 0 or not math.isfinite(largest):
        return unit, 1.0
    if unit == "m" and 0.01 <= largest < 1:
        return "cm", 100.0
    for size, prefix in settings()["prefixes"]:
        if largest >= size * 0.9999:
            return prefix + unit, 1.0 / size
    return unit, 1.0


def set_font(target, prefix=""):
    """ParaView's built-in font where the system has no DejaVu."""
    if os.path.exists(FONT):
        setattr(target, prefix + "FontFamily", "File")
        setattr(target, prefix + "FontFile", FONT)


def style(field):
    """How the run shows a field: unit, label, range [SI] or None, colours (x, red, green, blue, ... over the range)."""
    known = settings()["fields"]
    if field not in known:
        raise ValueError(f"field '{field}' unknown; this run has {', '.join(known)}")
    return known[field]


def label(field):
    return style(field)["label"]


# ---- colour ---------------------------------------------------------------------------------------------------------

def colour_range(field, source):
    """The run's fixed range. Where nothing is known of it: that of the first frame, kept from then on."""
    if field not in _ranges:
        given = style(field)["range"]
        if given is None:
            array = data_of(source).GetPointData().GetArray(field)
            low, high = array.GetFiniteRange(-1 if array.GetNumberOfComponents() > 1 else 0)
            given = (low, high) if high > low else (low, low + max(abs(low), 1.0))
        _ranges[field] = tuple(given)
    return _ranges[field]


def colour_map(field, source, name=None, scale=1.0, under_ink=False):
    """The lookup table of a field over its fixed range, times `scale`. Where there is no matter (NaN) it is pale.

    `under_ink`: a map on which dark lines stand out, instead of the field's own.
    """
    low, high = colour_range(field, source)
    colours = UNDER_INK if under_ink else style(field)["colours"]
    if under_ink or style(field)["range"] is None:  # colours over [0, 1]
        places = [low + x * (high - low) for x in colours[::4]]
    else:
        places = colours[::4]
    table = GetColorTransferFunction(name or (field + " under ink" if under_ink else field))
    table.AutomaticRescaleRangeMode = "Never"
    table.ColorSpace = "RGB"
    table.RGBPoints = [value for i, x in enumerate(places) for value in (scale * x, *colours[4 * i + 1:4 * i + 4])]
    table.NanColor = EMPTY
    table.ScalarRangeInitialized = 1
    table.VectorMode = "Magnitude"
    return table


# ---- particles ------------------------------------------------------------------------------------------------------

def pick(data, output, field, behind):
    """Copies what drawing spheres takes (places, radii, one field, in single precision) of the particles wanted.

    Fragment numbers become places in the palette: 0 for dust, 1 for the largest, 2... for others. Dust is drawn small,
    and in 3D only behind the middle, or it would hide everything.
    """
    s, arrays = settings(), data.GetPointData()

    def column(name):
        return vtk_to_numpy(arrays.GetArray(name))

    places = [column("position_" + axis) for axis in "xyz"]
    keep = slice(None) if behind is None else places[1] >= behind
    if field == NUMBER and s["dimension"] == 3:
        keep = (column(field) != 0) | (places[1] >= s["view_center"][1])
    values = column(field)[keep]
    points = numpy.empty((len(values), 3), numpy.float32)
    for axis, place in enumerate(places):
        points[:, axis] = place[keep]
    if arrays.HasArray("smoothing_length"):
        radius = (s["radius_per_smoothing_length"] * column("smoothing_length")[keep]).astype(numpy.float32)
    else:
        radius = numpy.full(len(values), s["particle_radius"], numpy.float32)
    if field == NUMBER:
        radius[values == 0] *= 0.25
        values = numpy.where(values == largest_fragment, 1, numpy.where(values == 0, 0, 2 + values % PALETTE))

    output.Initialize()  # it comes with the cells of the input
    output.SetPoints(vtkPoints())
    output.GetPoints().SetData(numpy_to_vtk(points, deep=True))
    for name, values in (("radius", radius), (field, values.astype(numpy.float32))):
        array = numpy_to_vtk(values, deep=True)
        array.SetName(name)
        output.GetPointData().AddArray(array)


# ---- geometry -------------------------------------------------------------------------------------------------------

def _cross(a, b):
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


def _unit(a):
    length = math.hypot(*a)
    return [x / length for x in a]


def round_ticks(low, high, count=4):
    """About `count` round numbers in [low, high]."""
    step = 10.0 ** math.floor(math.log10((high - low) / count))
    step *= next(f for f in (1, 2, 2.5, 5, 10) if (high - low) / (f * step) <= count + 0.5)
    first = math.ceil(low / step - 1e-9)
    return [i * step for i in range(first, math.floor(high / step + 1e-9) + 1)]


# ---- views ----------------------------------------------------------------------------------------------------------

class View:
    """An off-screen view of fixed size, light background and parallel projection, with title and time stamp."""

    def __init__(self, name, title):
        _DisableFirstRenderCameraReset()
        s = settings()
        self.name = name
        self.size = s["image_size"]
        self.view = CreateRenderView()
        v = self.view
        v.ViewSize = self.size
        v.UseColorPaletteForBackground = 0
        v.BackgroundColorMode = "Single Color"
        v.Background = PAPER
        v.OrientationAxesVisibility = 0
        v.CenterAxesVisibility = 0
        v.CameraParallelProjection = 1
        v.LODThreshold = 1e9
        self.title = self.text(s["scene_title"], 0.02, 0.945, 22, bold=True)
        self.subtitle = self.text(title, 0.02, 0.905, 16)
        self.stamp = self.text("", 0.80, 0.945, 19)
        self.time_unit, self.time_scale = readable_unit("s", s["time_end"] or 0)

    @property
    def aspect(self):
        return self.size[0] / self.size[1]

    def text(self, words, x, y, points, bold=False):
        """Words at a fraction (x, y) of the frame; returns the source, whose Text may change."""
        source = Text()
        source.Text = words
        display = Show(source, self.view)
        display.WindowLocation = "Any Location"
        display.Position = [x, y]
        display.FontSize = max(6, round(points * self.size[1] / 720))
        display.Color = INK
        display.BackgroundColor = [*PAPER, 0.8]  # ejecta that fly behind the words must not make them hard to read
        display.Padding = max(2, round(4 * self.size[1] / 720))
        display.ShowBorder, display.BorderThickness = "Always", 0.0  # there is no background without a border
        set_font(display)
        display.Bold = 1 if bold else 0
        return source

    def look_at_scene(self):
        """The run's fixed camera: obliquely from above in 3D (z up, x to the right), from the front in the plane."""
        s = settings()
        if s["dimension"] == 2:
            return self.look(s["view_center"], s["view_size"], [0.0, 0.0, -1.0], [0.0, 1.0, 0.0])
        turn, tilt = math.radians(18), math.radians(22)
        direction = [-math.sin(turn) * math.cos(tilt), math.cos(turn) * math.cos(tilt), -math.sin(tilt)]
        return self.look(s["view_center"], s["view_size"], direction, [0.0, 0.0, 1.0])

    def look(self, centre, width, direction, up):
        """Looks along `direction` at `centre`; `width` [m] fills the frame from left to right."""
        v = self.view
        v.CameraFocalPoint = centre
        v.CameraPosition = [c - 10 * width * d for c, d in zip(centre, direction)]
        v.CameraViewUp = up
        v.CenterOfRotation = centre
        v.CameraParallelScale = 0.5 * width / self.aspect
        return self

    def show(self, source, representation, **properties):
        display = Show(source, self.view)
        display.SetRepresentationType(representation)
        for name, value in properties.items():
            setattr(display, name, value)
        return display

    def spheres(self, source, field, table=None, behind=None):
        """Particles as shaded spheres (discs in the plane) of their own size coloured by a field; `behind`: only those with y above it."""
        picked = ProgrammableFilter(Input=source, OutputDataSetType="vtkPolyData")
        picked.Script = (f"import ejecta_view\n"
                         f"ejecta_view.pick(inputs[0].VTKObject, output.VTKObject, {field!r}, {behind!r})\n")
        display = self.show(picked, "Point Gaussian", Emissive=0, Ambient=0.3, Diffuse=0.8, ScaleByArray=1,
                            ShaderPreset="Sphere" if settings()["dimension"] == 3 else "Plain circle",
                            SetScaleArray=["POINTS", "radius"], UseScaleFunction=0, GaussianRadius=1.0)
        display.ColorArrayName = ["POINTS", field]
        display.LookupTable = table or colour_map(field, source)
        return display

    def scale_bar(self, x, y, longest):
        """A line of a round length, at most `longest` [m], from the fraction (x, y) of the frame to the right."""
        power = 10.0 ** math.floor(math.log10(longest))
        length = max(f * power for f in (1, 2, 5) if f * power <= longest)
        v = self.view
        width = 2 * v.CameraParallelScale * self.aspect
        toward_eye = _unit([p - c for p, c in zip(v.CameraPosition, v.CameraFocalPoint)])
        right = _unit(_cross(v.CameraViewUp, toward_eye))
        up = _cross(toward_eye, right)
        start = [c + (x - 0.5) * width * r + (y - 0.5) * width / self.aspect * u + width * e
                 for c, r, u, e in zip(v.CameraFocalPoint, right, up, toward_eye)]
        line = Line()
        line.Point1, line.Point2 = start, [p + length * r for p, r in zip(start, right)]
        self.show(line, "Wireframe", AmbientColor=INK, DiffuseColor=INK, LineWidth=3, Ambient=1, Diffuse=0)
        unit, scale = readable_unit("m", length)
        self.text(f"{length * scale:g} {unit}", x, y + 0.008, 14)

    def colour_bar(self, field, source, x, y, length, upright=False, under_ink=False):
        """A colour bar titled `field [unit]` that counts in a readable unit; (x, y) is its lower left corner."""
        unit, scale = readable_unit(style(field)["unit"], max(map(abs, colour_range(field, source))))
        table = colour_map(field, source, f"{self.name} bar {field}", scale, under_ink)
        bar = GetScalarBar(table, self.view)
        bar.Title = label(field) + (f" [{unit}]" if unit else "")
        bar.ComponentTitle = ""
        bar.Orientation = "Vertical" if upright else "Horizontal"
        bar.WindowLocation = "Any Location"
        bar.Position = [x, y]
        bar.ScalarBarLength = length
        bar.ScalarBarThickness = max(6, round(14 * self.size[1] / 720))
        bar.TitleColor = bar.LabelColor = INK
        bar.TitleFontSize = bar.LabelFontSize = max(6, round(15 * self.size[1] / 720))
        set_font(bar, "Title")
        set_font(bar, "Label")
        bar.AutomaticLabelFormat = 0
        bar.LabelFormat = "%-.4g"
        bar.AddRangeLabels = 0
        bar.UseCustomLabels = 1
        bar.CustomLabels = round_ticks(*(scale * value for value in colour_range(field, source)))
        bar.DrawTickMarks = 1
        bar.DrawBackground, bar.BackgroundColor = 1, [*PAPER, 0.8]
        bar.BackgroundPadding = 4
        bar.Visibility = 1
        return bar

    def save(self, info):
        """Draws the view and writes images/<name>_<step>.png."""
        self.view.ViewTime = info.time
        self.stamp.Text = f"t = {info.time * self.time_scale:.2f} {self.time_unit}"
        folder = os.path.join(settings()["run_folder"], "images")
        image = self.view.SMProxy.CaptureWindow(1)
        writer = vtkPNGWriter()
        writer.SetFileName(os.path.join(folder, f"{self.name}_{info.timestep:06d}.png"))
        writer.SetCompressionLevel(1)
        writer.SetInputData(image)
        writer.Write()
        image.UnRegister(None)  # CaptureWindow hands its image over: nobody else would ever release it
