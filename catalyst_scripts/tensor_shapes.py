"""Ellipses of smoothing tensors and strokes along cracks, as polygons and lines in the picture plane.

The picture plane is x-y in the plane and x-z in space, where ellipsoids are shown by their outline. `source` is the
channel `ellipsoids`.
"""
import math

import numpy

import ejecta_view as ejecta

FULL_SUPPORTS = 12        # about as many particles show the whole ellipse their kernel reaches
LEAST_DAMAGE = 0.05       # below this a stroke would be a dot
SHORTEST_STROKE = 1 / 60  # of the width of the picture; finer particles share strokes


def look_at_layer(view):
    """The plane seen from the front: the whole scene in 2D, the layer of the ellipsoids in 3D."""
    s = ejecta.settings()
    if s["dimension"] == 2:
        return view.look_at_scene()
    return view.look(s["view_center"], s["view_width"], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0], s["view_height"])


def picture_axes():
    """Indices of the directions to the right, up and into the picture."""
    return (0, 1, 2) if ejecta.settings()["dimension"] == 2 else (0, 2, 1)


def outline_matrices(source, keep):
    """L with outline = centre + L (cos t, sin t) for the ellipsoid |H x| = 1: L L^T is the picture's part of
    H^-2 = sum of axis axis^T, because a projection keeps the covariance of its directions."""
    right, up, _ = picture_axes()
    c = sum(axis[:, (right, up), None] * axis[:, None, (right, up)]
            for axis in (ejecta.array(source, f"axis_{k + 1}")[keep] for k in range(ejecta.settings()["dimension"])))
    return numpy.linalg.cholesky(c)


def centres(source, keep, toward_eye):
    """Places of the particles, `toward_eye` [m] in front of the layer, which lies in one plane."""
    _, _, depth = picture_axes()
    x = numpy.stack([ejecta.array(source, "position_" + axis)[keep] for axis in "xyz"], axis=1)
    plane, sign = (0.0, 1.0) if depth == 2 else (ejecta.settings()["view_center"][1], -1.0)
    x[:, depth] = plane + sign * toward_eye
    return x


def few(source):
    """About FULL_SUPPORTS particles, the same ones in every frame."""
    identity = ejecta.array(source, "id")
    return identity % max(1, int(1.03 * len(identity) / FULL_SUPPORTS)) == 0


def ellipses(source, scale, keep=None, corners=20, lift=0.0):
    """(n, corners, 3) points of ellipses of semi-axes scale * h along each direction, those of a mask or all."""
    keep = numpy.ones(ejecta.data_of(source).GetNumberOfPoints(), bool) if keep is None else keep
    right, up, _ = picture_axes()
    turn = 2 * math.pi * numpy.arange(corners) / corners
    offset = scale * numpy.einsum("nab,bk->nka", outline_matrices(source, keep),
                                  numpy.stack([numpy.cos(turn), numpy.sin(turn)]))
    points = numpy.repeat(centres(source, keep, lift)[:, None, :], corners, axis=1)
    points[:, :, (right, up)] += offset
    return points


def outlines(source, scale):
    """(n, corners, 3) points of closed lines about a few particles, before the layer."""
    points = ellipses(source, scale, few(source), 48, 1e-3 * ejecta.settings()["view_width"])
    return numpy.concatenate([points, points[:, :1]], axis=1)


def most_damaged(source, cell):
    """Of each square of edge `cell` [m] of the picture that holds particles, the most damaged one."""
    right, up, _ = picture_axes()
    bins = [numpy.floor(ejecta.array(source, "position_" + "xyz"[a]) / cell) for a in (right, up)]
    order = numpy.lexsort((ejecta.array(source, "id"), -ejecta.array(source, "damage_1"), *bins))
    u, v = (b[order] for b in bins)
    first = numpy.ones(len(order), bool)
    first[1:] = (u[1:] != u[:-1]) | (v[1:] != v[:-1])
    return order[first]


def cracks(source):
    """(n, 2, 3) ends of lines: for each principal direction of damage a stroke where the plane across it cuts the
    picture. Its length goes with the damage, up to one node spacing or what can be seen, and with how steeply the crack
    stands on the picture."""
    s = ejecta.settings()
    right, up, _ = picture_axes()
    spacing = numpy.median(ejecta.array(source, "smoothing_length")) / s["nodes_per_h"]
    length = max(spacing, SHORTEST_STROKE * s["view_width"])
    chosen = most_damaged(source, length)
    strokes = []
    for k in range(s["dimension"]):
        across = ejecta.array(source, f"damage_axis_{k + 1}")[chosen]
        along = numpy.zeros_like(across)
        along[:, right], along[:, up] = -across[:, up], across[:, right]
        seen = numpy.hypot(along[:, right], along[:, up]) > LEAST_DAMAGE
        half = 0.5 * length * along[seen]
        centre = centres(source, chosen[seen], 2e-3 * s["view_width"])
        strokes.append(numpy.stack([centre - half, centre + half], axis=1))
    return numpy.concatenate(strokes)
