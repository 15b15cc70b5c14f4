# script-version: 2.0
"""The particles of a layer coloured by their largest damage, with strokes along the cracks where damage is a tensor."""
from paraview import catalyst

import ejecta_view as ejecta
import tensor_shapes

options = catalyst.Options()
source = ejecta.channel("ellipsoids")
view = None


def catalyst_execute(info):
    global view
    if not ejecta.has_data(source):
        return
    if "damage" not in ejecta.fields(source):
        raise ValueError("the scene has no damage to show")
    tensor = "damage_1" in ejecta.fields(source)
    if view is None:
        view = ejecta.View("damage", "damage, with strokes along the cracks" if tensor else "damage")
        tensor_shapes.look_at_layer(view)
    view.polygons(tensor_shapes.ellipses(source, 0.7 / ejecta.settings()["nodes_per_h"]), "damage", source)
    if tensor:
        view.lines(tensor_shapes.cracks(source))
    view.save(info)
