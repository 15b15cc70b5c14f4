# script-version: 2.0
"""The particles coloured by the rank of their fragment: the heaviest are strong, what follows pales, dust is faint."""
import ejecta_paint
import numpy
from paraview import catalyst

import ejecta_view as ejecta

options = catalyst.Options()
source = ejecta.channel("particles")
pieces = ejecta.channel("fragments")
view = None

NAMED = 5   # fragments in the legend
PALE = 200  # ranks with a colour of their own
DUST_SIZE = 0.35  # of a whole particle


def ranks():
    """Rank of each fragment by its number, 0 for dust, and their masses, largest first."""
    if not ejecta.has_data(pieces):
        return numpy.zeros(1, int), numpy.zeros(0)
    mass, number = ejecta.column(pieces, "mass"), ejecta.column(pieces, "number").astype(int)
    order = numpy.lexsort((number, -mass))  # of equal masses the older one first
    rank = numpy.zeros(number.max() + 1, int)
    rank[number[order]] = 1 + numpy.arange(len(order))
    return rank, mass[order]


def entries(mass, colours):
    unit = ejecta.style("mass")["unit"]
    total = ejecta.column(source, "mass").sum()
    words = []
    for rank, m in enumerate(mass[:NAMED], 1):
        amount = f"{1e3 * m:.3g} g" if unit == "kg" else f"{m:.3g} {unit}"
        words.append((int(colours[rank]), f"{rank}   {amount}   {100 * m / total:.3g} %"))
    if len(mass) > NAMED:
        words.append((int(colours[NAMED + 1]), f"{len(mass) - NAMED} more   {100 * mass[NAMED:].sum() / total:.3g} %"))
    words.append((int(colours[0]), f"dust   {max(0.0, 100 * (1 - mass.sum() / total)):.3g} %"))
    return words


def catalyst_execute(info):
    global view
    if not ejecta.has_data(source) or ejecta.NUMBER not in ejecta.fields(source):
        return
    s = ejecta.settings()
    if view is None:
        view = ejecta.View("fragments", "fragments by mass", key_width=15).look_at_scene()
    rank, mass = ranks()
    colours = numpy.array([ejecta_paint.rank_colour(r) for r in range(PALE)], numpy.uint32)
    number = ejecta.column(source, ejecta.NUMBER)
    own = numpy.where(number < len(rank), rank[numpy.minimum(number, len(rank) - 1)], 0)
    own[own >= PALE] = NAMED + 1 + own[own >= PALE] % (PALE - NAMED - 1)
    keep = slice(None)
    if s["dimension"] == 3:  # dust before the middle would hide everything
        keep = (own != 0) | (ejecta.column(source, "position_y") >= s["view_center"][1])
    radii = ejecta.radii_of(source)
    radii[own == 0] *= DUST_SIZE
    view.balls(ejecta.places_of(source)[keep], radii[keep], colours[own[keep]])
    view.legend("fragments, largest first", entries(mass, colours))
    view.save(info)
