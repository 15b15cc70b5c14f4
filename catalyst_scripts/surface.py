# script-version: 2.0
"""Bodies by their surfaces, cut open through the middle. Outside each body has a colour of its own; the face of the cut
shows damage, or the first field of the slice. Matter too thin for a surface is drawn as spheres."""
import ejecta_paint
import numpy
from paraview import catalyst
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkFiltersCore import vtkFlyingEdges3D

import ejecta_view as ejecta

options = catalyst.Options()
volume = ejecta.channel("volume")
slice_channel = ejecta.channel("slice")
source = ejecta.channel("particles")
view = None

LEVEL = 0.5  # of the filling: half of what a kernel sees is matter where a body ends
LONE = 0.3   # filling at a particle that no surface surrounds
SPRAY = 0.6  # its size, of one within matter


def nearest_points(places):
    """Index of the lattice point nearest to each place, and whether it lies within the lattice."""
    data = ejecta.data_of(volume)
    shape = numpy.array(data.GetDimensions())
    index = numpy.rint((places - numpy.array(data.GetOrigin())) / numpy.array(data.GetSpacing())).astype(numpy.int64)
    inside = ((index >= 0) & (index < shape)).all(axis=1)
    index = numpy.clip(index, 0, shape - 1)
    return index[:, 0] + shape[0] * (index[:, 1] + shape[1] * index[:, 2]), inside


def outside(palette):
    """Points, normals, colours and triangles of the surface."""
    data = ejecta.data_of(volume)
    contour = vtkFlyingEdges3D()
    contour.SetInputData(data)
    contour.SetInputArrayToProcess(0, 0, 0, 0, "filling")
    contour.SetValue(0, LEVEL)
    contour.ComputeNormalsOn()
    contour.ComputeScalarsOff()
    contour.Update()
    mesh = contour.GetOutput()
    if mesh.GetNumberOfPoints() == 0:
        return None
    points = vtk_to_numpy(mesh.GetPoints().GetData()).astype(numpy.float32)
    normals = vtk_to_numpy(mesh.GetPointData().GetNormals()).astype(numpy.float32)
    triangles = vtk_to_numpy(mesh.GetPolys().GetConnectivityArray()).astype(numpy.int32)
    at, _ = nearest_points(points - 0.5 * data.GetSpacing()[0] * normals)
    body = ejecta.column(volume, "body")[at].astype(int)
    return points, normals, palette[numpy.maximum(body, 0)], triangles


def face(field, palette):
    """The slice as a picture in space; bodies that do not break have no damage, but their colour."""
    data = ejecta.data_of(slice_channel)
    columns, _, rows = data.GetDimensions()
    values = ejecta.column(slice_channel, field).reshape(rows, columns)
    rgb = ejecta.colour_scale(field, slice_channel).colours(values, ejecta_paint.NOTHING)
    step, corner = data.GetSpacing(), data.GetOrigin()
    if field == "damage":
        across, upwards = numpy.meshgrid(corner[0] + step[0] * numpy.arange(columns), corner[2] + step[2] * numpy.arange(rows))
        places = numpy.stack([across.ravel(), numpy.full(across.size, corner[1]), upwards.ravel()], axis=1)
        body = ejecta.column(volume, "body")[nearest_points(places)[0]].astype(int).reshape(rows, columns)
        breaks = numpy.array([b["breaks"] for b in ejecta.settings()["bodies"]])
        whole = (body >= 0) & ~breaks[body] & numpy.isfinite(values)
        rgb = numpy.where(whole, palette[body], rgb)
    filling = ejecta.column(slice_channel, "filling").reshape(rows, columns)
    return rgb, filling, corner, (step[0], 0, 0), (0, 0, step[2])


def catalyst_execute(info):
    global view
    if not ejecta.has_data(volume):
        return
    s = ejecta.settings()
    field = "damage" if "damage" in s["slice_fields"] else s["slice_fields"][0]
    if view is None:
        view = ejecta.View("surface", f"bodies cut open, the cut by {ejecta.label(field)}").look_at_scene()
    palette = numpy.array([ejecta_paint.body_colour(b) for b in range(len(s["bodies"]))], numpy.uint32)
    places = ejecta.places_of(source)
    at, within = nearest_points(places)
    lone = within & (ejecta.column(volume, "filling")[at] < LONE) & (places[:, 1] >= s["view_center"][1])
    view.balls(places[lone], SPRAY * ejecta.radii_of(source)[lone], palette[ejecta.column(source, "body")[lone]])
    mesh = outside(palette)
    if mesh is not None:
        view.surface(*mesh)
        view.plate(*face(field, palette))
    view.colour_bar(field, slice_channel)
    view.save(info)
