# script-version: 2.0
"""The particles coloured by the fragment they belong to: the largest of the target grey, dust small and pale."""
import colorsys
import math

from paraview import catalyst
from paraview.simple import GetColorTransferFunction

import ejecta_view as ejecta

options = catalyst.Options()
source = ejecta.channel("particles")
pieces = ejecta.channel("fragments")
view = None

DUST = (0.80, 0.80, 0.82)
LARGEST = (0.45, 0.47, 0.50)


def find_largest():
    """Number of the fragment with most of the target's matter; -1, which no fragment has, where none has any."""
    if not ejecta.has_data(pieces):
        return -1
    arrays = ejecta.data_of(pieces).GetPointData()
    mass, number = arrays.GetArray("target_mass"), arrays.GetArray("number")
    largest = max(range(mass.GetNumberOfTuples()), key=mass.GetTuple1)
    return int(number.GetTuple1(largest)) if mass.GetTuple1(largest) > 0 else -1


def make_colours():
    """Neighbouring numbers get hues far apart: steps of the golden section round the colour circle."""
    colours = [DUST, LARGEST]
    for n in range(ejecta.PALETTE):
        hue = n * (math.sqrt(5) - 1) / 2 % 1
        colours.append(colorsys.hsv_to_rgb(hue, (0.55, 0.75, 0.9)[n % 3], (0.95, 0.80, 0.65)[n // 3 % 3]))
    table = GetColorTransferFunction(ejecta.NUMBER)
    table.AutomaticRescaleRangeMode = "Never"
    table.ColorSpace = "RGB"
    table.Discretize = 1
    table.NumberOfTableValues = len(colours)
    # Table entry i covers [i - 1/2, i + 1/2) and takes the colour at its place between the first and the last point.
    last = len(colours) - 1
    spread = [-0.5 + i * (last + 1) / last for i in range(last + 1)]
    table.RGBPoints = [value for x, colour in zip(spread, colours) for value in (x, *colour)]
    table.ScalarRangeInitialized = 1
    return table


def make_view():
    view = ejecta.View("fragments", f"fragments, the largest of {ejecta.settings()['fragment_target']} grey")
    view.look_at_scene()
    view.spheres(source, ejecta.NUMBER, make_colours())
    view.scale_bar(0.03, 0.04, 0.2 * ejecta.settings()["view_size"])
    return view


def catalyst_execute(info):
    global view
    if not ejecta.has_data(source) or ejecta.NUMBER not in ejecta.fields(source):
        return
    ejecta.largest_fragment = find_largest()
    if view is None:
        view = make_view()
    view.save(info)
