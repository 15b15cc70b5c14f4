# script-version: 2.0
"""The slice through the middle, one pane a field at equal scale: pressure | distension | damage, or what there is."""
from paraview import catalyst

import ejecta_paint
import ejecta_view as ejecta

options = catalyst.Options()
source = ejecta.channel("slice")
layout = None


def picture_axes(bounds):
    """The slice is flat along one axis; the other two are the picture's right and up."""
    size = [bounds[2 * i + 1] - bounds[2 * i] for i in range(3)]
    return {0: (1, 2), 1: (0, 2), 2: (0, 1)}[size.index(min(size))]


def make_layout(count, right, up):
    data = ejecta.data_of(source)
    bounds, pixel = data.GetBounds(), data.GetSpacing()[right]
    low = [bounds[2 * axis] - 0.5 * pixel for axis in (right, up)]
    high = [bounds[2 * axis + 1] + 0.5 * pixel for axis in (right, up)]
    return ejecta_paint.Layout(*ejecta.settings()["image_size"], count, low + high, nothing_beyond=True)


def catalyst_execute(info):
    global layout
    if not ejecta.has_data(source):
        return
    s, data = ejecta.settings(), ejecta.data_of(source)
    names = s["slice_fields"]
    right, up = picture_axes(data.GetBounds())
    if layout is None:
        layout = make_layout(len(names), right, up)
    sheet = ejecta_paint.Sheet(layout, s["scene_title"], "slice through the middle", info.time, s["time_end"] or 0.0)
    shape = data.GetDimensions()[up], data.GetDimensions()[right]
    for pane, field in enumerate(names):
        scale = ejecta.colour_scale(field, source)
        sheet.put(pane, scale.colours(ejecta.column(source, field).reshape(shape)[::-1]))
        sheet.axes(pane, ["xyz"[right], "xyz"[up]])
        sheet.colour_bar(pane, scale, ejecta.label(field), ejecta.style(field)["unit"])
    sheet.save(ejecta.path_of("slice", info))
