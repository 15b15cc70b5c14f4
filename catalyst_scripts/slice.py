# script-version: 2.0
"""The slice through the middle, one panel a field at equal scale: pressure | distension | damage, or what there is."""
from paraview import catalyst
from paraview.simple import PassArrays

import ejecta_view as ejecta

options = catalyst.Options()
source = ejecta.channel("slice")
view = None


def make_view():
    bounds = ejecta.data_of(source).GetBounds()
    size = [bounds[2 * i + 1] - bounds[2 * i] for i in range(3)]
    centre = [0.5 * (bounds[2 * i + 1] + bounds[2 * i]) for i in range(3)]
    # The slice is flat along one axis; the other two become the picture's right and up.
    flat = size.index(min(size))
    right, up = {0: (1, 2), 1: (0, 2), 2: (0, 1)}[flat]
    names = ejecta.settings()["slice_fields"]
    count = len(names)
    view = ejecta.View("slice", "slice through the middle")
    width, height = view.size

    # Panels beside each other, or above each other where the slice is long: whichever shows them larger [pixels/m].
    beside = min(0.95 * width / count / size[right], 0.70 * height / size[up])
    above = min(0.80 * width / size[right], 0.88 * 0.92 * height / count / size[up])
    scale = max(beside, above)
    direction, upward = [0.0] * 3, [0.0] * 3
    direction[flat] = 1.0 if flat == 1 else -1.0
    upward[up] = 1.0
    view.look(centre, width / scale, direction, upward)
    for i, field in enumerate(names):
        if beside >= above:
            x, y = (i + 0.5) / count, 0.53
        else:
            x, y = 0.43, 0.88 * (count - i - 0.5) / count
        panel = PassArrays(Input=source, PointDataArrays=[field], CellDataArrays=[])
        shift = [0.0] * 3
        shift[right], shift[up] = (x - 0.5) * width / scale, (y - 0.5) * height / scale
        display = view.show(panel, "Slice", Position=shift, ColorArrayName=["POINTS", field])
        display.LookupTable = ejecta.colour_map(field, source)
        half_width, half_height = 0.5 * size[right] * scale / width, 0.5 * size[up] * scale / height
        if beside >= above:
            view.colour_bar(field, source, x - 0.8 * half_width, y - half_height - 0.09, 1.6 * half_width)
        else:
            view.colour_bar(field, source, x + half_width + 0.02, y - half_height, 2 * half_height, upright=True)
        if i == 0:
            view.scale_bar(x - half_width + 0.01, y - half_height + 0.015, 0.3 * size[right])
    return view


def catalyst_execute(info):
    global view
    if not ejecta.has_data(source):
        return
    if view is None:
        view = make_view()
    view.save(info)
