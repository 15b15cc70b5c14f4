# script-version: 2.0
"""The particles of a layer coloured by their largest damage, with strokes along the cracks where damage is a tensor."""
from paraview import catalyst

import ejecta_view as ejecta
import tensor_shapes

options = catalyst.Options()
source = ejecta.channel("ellipsoids")
view = None


def make_view():
    s = ejecta.settings()
    tensor = "damage_1" in ejecta.fields(source)
    view = ejecta.View("damage", "damage, with strokes along the cracks" if tensor else "damage")
    tensor_shapes.look_at_layer(view)
    shapes = tensor_shapes.draw(source, tensor_shapes.ellipses, "damage", 0.7 / s["nodes_per_h"], True, False)
    tensor_shapes.show_polygons(view, shapes, "damage", source)
    if tensor:
        tensor_shapes.show_lines(view, tensor_shapes.draw(source, tensor_shapes.cracks))
    return view


def catalyst_execute(info):
    global view
    if not ejecta.has_data(source):
        return
    if "damage" not in ejecta.fields(source):
        raise ValueError("the scene has no damage to show")
    if view is None:
        view = make_view()
    view.save(info)
