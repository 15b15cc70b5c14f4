# script-version: 2.0
"""The particles as spheres coloured by damage. In 3D the half nearest to the eye is cut away to show the inside."""
from paraview import catalyst

import ejecta_view as ejecta

options = catalyst.Options()
source = ejecta.channel("particles")
view = None

FIELDS = ["damage", "distension", "pressure", "density"]


def catalyst_execute(info):
    global view
    if not ejecta.has_data(source):
        return
    s = ejecta.settings()
    solid = s["dimension"] == 3
    field = next(f for f in FIELDS if f in ejecta.fields(source))
    if view is None:
        words = "particles, the near half cut away" if solid else "particles"
        view = ejecta.View("cutaway" if solid else "particles", f"{words}, by {ejecta.label(field)}").look_at_scene()
        view.spheres(source, field, behind=s["view_center"][1] if solid else None)
    view.save(info)
