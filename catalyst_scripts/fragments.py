# script-version: 2.0
"""The particles coloured by the rank of their fragment: the heaviest of the target are strong, what follows pales, dust
is faint. Other bodies have a pale colour each."""
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
    """Rank of each fragment by its number and the target's mass in it, largest first; 0: dust, or nothing of the target."""
    if not ejecta.has_data(pieces):
        return numpy.zeros(1, int), numpy.zeros(0)
    mass, number = ejecta.column(pieces, "target_mass"), ejecta.column(pieces, "number").astype(int)
    order = numpy.lexsort((number, -mass))  # of equal masses the older one first
    order = order[mass[order] > 0]
    rank = numpy.zeros(number.max() + 1, int)
    rank[number[order]] = 1 + numpy.arange(len(order))
    return rank, mass[order]


def entries(mass, dust, colours):
    """Lines of the legend: masses of the target's fragments, and their shares of all the target's mass."""
    total = mass.sum() + dust
    unit = ejecta.style("mass")["unit"]
    words = []
    for rank, m in enumerate(mass[:NAMED], 1):
        amount = f"{1e3 * m:.3g} g" if unit == "kg" else f"{m:.3g} {unit}"
        words.append((int(colours[rank]), f"{rank}   {amount}   {100 * m / total:.3g} %"))
    if len(mass) > NAMED:
        words.append((int(colours[NAMED + 1]), f"{len(mass) - NAMED} more   {100 * mass[NAMED:].sum() / total:.3g} %"))
    if dust > 0:
        words.append((int(colours[0]), f"dust   {100 * dust / total:.3g} %"))
    return words


def pale(colour):
    """Half way to white."""
    return sum((((colour >> shift) & 255) + 255) // 2 << shift for shift in (0, 8, 16))


def catalyst_execute(info):
    global view
    if not ejecta.has_data(source) or ejecta.NUMBER not in ejecta.fields(source):
        return
    s = ejecta.settings()
    if view is None:
        view = ejecta.View("fragments", "fragments by mass", legend_width=15).look_at_scene()
    rank, mass = ranks()
    names = [b["name"] for b in s["bodies"]]
    body, target = ejecta.column(source, "body").astype(int), names.index(s["fragment_target"])
    of_bodies = [pale(ejecta_paint.body_colour(b)) for b in range(len(names))]
    colours = numpy.array([ejecta_paint.rank_colour(r) for r in range(PALE)] + of_bodies, numpy.uint32)
    number = ejecta.column(source, ejecta.NUMBER)
    own = numpy.where(number < len(rank), rank[numpy.minimum(number, len(rank) - 1)], 0)
    own[own >= PALE] = NAMED + 1 + own[own >= PALE] % (PALE - NAMED - 1)
    dust = number == 0
    others = (own == 0) & (body != target)
    own[others] = PALE + body[others]
    keep = slice(None)
    if s["dimension"] == 3:  # dust before the middle would hide everything
        keep = ~dust | (ejecta.column(source, "position_y") >= s["view_center"][1])
    radii = ejecta.radii_of(source)
    radii[dust] *= DUST_SIZE
    view.balls(ejecta.places_of(source)[keep], radii[keep], colours[own[keep]])
    lines = entries(mass, ejecta.column(source, "mass")[dust & (body == target)].sum(), colours)
    lines += [(of_bodies[b], names[b]) for b in numpy.unique(body[others])]
    view.legend(f"fragments of {names[target]}", lines)
    view.save(info)
