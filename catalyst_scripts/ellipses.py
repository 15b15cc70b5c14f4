# script-version: 2.0
"""The smoothing ellipses one node spacing wide, coloured by damage or aspect, and the whole support of a few."""
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
    s = ejecta.settings()
    field = "damage" if "damage" in ejecta.fields(source) else "aspect"
    if view is None:
        view = ejecta.View("ellipses", f"smoothing ellipses, one node spacing wide, by {ejecta.label(field)}; "
                                       f"lines: full support ({s['kernel_support']:g} h)")
        tensor_shapes.look_at_layer(view)
    view.polygons(tensor_shapes.ellipses(source, 0.95 * 0.5 / s["nodes_per_h"]), field, source)
    view.lines(tensor_shapes.outlines(source, s["kernel_support"]))
    view.save(info)
