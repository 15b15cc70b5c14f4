# script-version: 2.0
"""The smoothing ellipses one node spacing wide, coloured by damage or aspect, and the whole support of a few."""
from paraview import catalyst

import ejecta_view as ejecta
import tensor_shapes

options = catalyst.Options()
source = ejecta.channel("ellipsoids")
view = None


def make_view():
    s = ejecta.settings()
    field = "damage" if "damage" in ejecta.fields(source) else "aspect"
    spacing, support = 0.5 / s["nodes_per_h"], s["kernel_support"]
    view = ejecta.View("ellipses", f"smoothing ellipses, one node spacing wide, by {ejecta.label(field)}; "
                                   f"lines: full support ({support:g} h)")
    tensor_shapes.look_at_layer(view)
    shapes = tensor_shapes.draw(source, tensor_shapes.ellipses, field, 0.95 * spacing, True, False)
    tensor_shapes.show_polygons(view, shapes, field, source)
    tensor_shapes.show_lines(view, tensor_shapes.draw(source, tensor_shapes.ellipses, field, support, False, True))
    return view


def catalyst_execute(info):
    global view
    if not ejecta.has_data(source):
        return
    if view is None:
        view = make_view()
    view.save(info)
