"""Ellipses of smoothing tensors and strokes along cracks, as polygons and lines in the picture plane.

The functions named in draw() are called by ParaView with the data of the channel `ellipsoids` and the data set to fill.
The picture plane is x-y in the plane and x-z in space, where ellipsoids are shown by their outline.
"""
import math

import numpy
from paraview.simple import ProgrammableFilter
from vtkmodules.util.numpy_support import numpy_to_vtk, numpy_to_vtkIdTypeArray, vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import vtkCellArray

import ejecta_view as ejecta

FULL_SUPPORTS = 12        # about as many particles show the whole ellipse their kernel reaches
LEAST_DAMAGE = 0.05       # below this a stroke would be a dot
SHORTEST_STROKE = 1 / 60  # of the width of the picture; finer particles share strokes


def draw(source, function, *arguments):
    """A source that holds what function(data, output, *arguments) of this module makes of the channel."""
    made = ProgrammableFilter(Input=source, OutputDataSetType="vtkPolyData")
    values = "".join(f", {argument!r}" for argument in arguments)
    made.Script = f"import tensor_shapes\ntensor_shapes.{function.__name__}(inputs[0].VTKObject, output.VTKObject{values})\n"
    return made


def look_at_layer(view):
    """The plane seen from the front: the whole scene in 2D, the layer of the ellipsoids in 3D."""
    s = ejecta.settings()
    if s["dimension"] == 2:
        return view.look_at_scene()
    return view.look(s["view_center"], s["view_width"], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0], s["view_height"])


def show_polygons(view, drawn, field, source):
    """Shows what draw() made, coloured by `field` of the channel, with its colour bar."""
    view.show(drawn, "Surface", Ambient=1, Diffuse=0, ColorArrayName=["CELLS", field],
              LookupTable=ejecta.colour_map(field, source))
    view.colour_bar(field, source)


def show_lines(view, drawn):
    """Dark lines with a light rim: they stand out on every colour."""
    width = max(1.0, 2.0 * view.size[1] / 720)
    for colour, lines in ((ejecta.PAPER, 2.2 * width), (ejecta.INK, width)):
        view.show(drawn, "Wireframe", Ambient=1, Diffuse=0, AmbientColor=colour, DiffuseColor=colour, LineWidth=lines,
                  ColorArrayName=[None, ""])


def column(data, name):
    return vtk_to_numpy(data.GetPointData().GetArray(name))


def picture_axes():
    """Indices of the directions to the right, up and into the picture."""
    return (0, 1, 2) if ejecta.settings()["dimension"] == 2 else (0, 2, 1)


def outline_matrices(data, keep):
    """L with outline = centre + L (cos t, sin t) for the ellipsoid |H x| = 1: L L^T is the picture's part of
    H^-2 = sum of axis axis^T, because a projection keeps the covariance of its directions."""
    right, up, _ = picture_axes()
    c = sum(axis[:, (right, up), None] * axis[:, None, (right, up)]
            for axis in (column(data, f"axis_{k + 1}")[keep] for k in range(ejecta.settings()["dimension"])))
    return numpy.linalg.cholesky(c)


def fill(output, points, corners, closed, field, values):
    """`points` (n, corners, 3): n polygons, or n lines of that many points; one value of `field` each."""
    n = len(points)
    output.Initialize()  # it comes with the cells of the input
    output.SetPoints(vtkPoints())
    output.GetPoints().SetData(numpy_to_vtk(points.reshape(-1, 3).astype(numpy.float32), deep=True))
    cells = vtkCellArray()
    cells.SetData(numpy_to_vtkIdTypeArray(numpy.arange(0, n * corners + 1, corners, dtype=numpy.int64), deep=True),
                  numpy_to_vtkIdTypeArray(numpy.arange(n * corners, dtype=numpy.int64), deep=True))
    (output.SetPolys if closed else output.SetLines)(cells)
    array = numpy_to_vtk(numpy.ascontiguousarray(values, numpy.float32), deep=True)
    array.SetName(field)
    output.GetCellData().AddArray(array)


def centres(data, keep, toward_eye):
    """Places of the particles, `toward_eye` [m] in front of the layer, which lies in one plane."""
    _, _, depth = picture_axes()
    x = numpy.stack([column(data, "position_" + axis)[keep] for axis in "xyz"], axis=1)
    plane, sign = (0.0, 1.0) if depth == 2 else (ejecta.settings()["view_center"][1], -1.0)
    x[:, depth] = plane + sign * toward_eye
    return x


def ellipses(data, output, field, scale, filled, chosen_only):
    """Ellipses of semi-axes scale * h along each direction, coloured by `field`; `chosen_only`: of a few particles."""
    keep = numpy.ones(data.GetNumberOfPoints(), bool)
    lift = 0.0
    if chosen_only:
        identity = column(data, "id")
        keep = identity % max(1, int(1.03 * len(identity) / FULL_SUPPORTS)) == 0
    if not filled:
        lift = 1e-3 * ejecta.settings()["view_width"]
    corners = 20 if filled else 49
    right, up, _ = picture_axes()
    turn = 2 * math.pi * numpy.arange(corners) / (corners if filled else corners - 1)
    offset = scale * numpy.einsum("nab,bk->nka", outline_matrices(data, keep),
                                  numpy.stack([numpy.cos(turn), numpy.sin(turn)]))
    points = numpy.repeat(centres(data, keep, lift)[:, None, :], corners, axis=1)
    points[:, :, (right, up)] += offset
    fill(output, points, corners, filled, field, column(data, field)[keep])


def most_damaged(data, cell):
    """Of each square of edge `cell` [m] of the picture that holds particles, the most damaged one."""
    right, up, _ = picture_axes()
    bins = [numpy.floor(column(data, "position_" + "xyz"[a]) / cell) for a in (right, up)]
    order = numpy.lexsort((column(data, "id"), -column(data, "damage_1"), *bins))
    u, v = (b[order] for b in bins)
    first = numpy.ones(len(order), bool)
    first[1:] = (u[1:] != u[:-1]) | (v[1:] != v[:-1])
    return order[first]


def cracks(data, output):
    """For each principal direction of damage a stroke where the plane across it cuts the picture: its length goes with
    the damage, up to one node spacing or what can be seen, and with how steeply the crack stands on the picture."""
    s = ejecta.settings()
    right, up, _ = picture_axes()
    spacing = numpy.median(column(data, "smoothing_length")) / s["nodes_per_h"]
    length = max(spacing, SHORTEST_STROKE * s["view_width"])
    chosen = most_damaged(data, length)
    strokes, values = [], []
    for k in range(s["dimension"]):
        across = column(data, f"damage_axis_{k + 1}")[chosen]
        along = numpy.zeros_like(across)
        along[:, right], along[:, up] = -across[:, up], across[:, right]
        seen = numpy.hypot(along[:, right], along[:, up]) > LEAST_DAMAGE
        half = 0.5 * length * along[seen]
        centre = centres(data, chosen[seen], 2e-3 * s["view_width"])
        strokes.append(numpy.stack([centre - half, centre + half], axis=1))
        values.append(column(data, f"damage_{k + 1}")[chosen][seen])
    fill(output, numpy.concatenate(strokes), 2, False, "damage_1", numpy.concatenate(values))
