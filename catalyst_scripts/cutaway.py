# script-version: 2.0
"""The particles as spheres coloured by damage. In 3D the half nearest to the eye is cut away to show the inside."""
from paraview import catalyst

import ejecta_view as ejecta

options = catalyst.Options()
source = ejecta.channel("particles")
view = None

FIELDS = ["damage", "distension", "pressure", "density"]


def make_view():
    s = ejecta.settings()
    solid = s["dimension"] == 3
    field = next(f for f in FIELDS if f in ejecta.fields(source))
    name = "cutaway" if solid else "particles"
    view = ejecta.View(name, f"{name} by {ejecta.label(field)}")
    view.look_at_scene()
    view.spheres(source, field, behind=s["view_center"][1] if solid else None)
    view.colour_bar(field, source, 0.91, 0.25, 0.5, upright=True)
    view.scale_bar(0.03, 0.04, 0.2 * s["view_size"])
    return view


def catalyst_execute(info):
    global view
    if not ejecta.has_data(source):
        return
    if view is None:
        view = make_view()
    view.save(info)
