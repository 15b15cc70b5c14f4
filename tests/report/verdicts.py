"""Errors of the verification cases beside what their tests ask for."""
from collections import Counter, defaultdict

from page import show


def bound_of(case, quantity, norm):
    return next((b for b in case.bounds if (b.quantity, b.norm) == (quantity, norm)), None)


def verdict(case, quantity, norm, ladder):
    bound, order = bound_of(case, quantity, norm), ladder[0]["fitted_order"]
    met = bound is not None and all(bound.limit(row["resolution"]) is None or row["error"] <= bound.limit(
        row["resolution"]) for row in ladder) and (bound.order is None or len(ladder) < 2 or order >= bound.order)
    return [case.name, f"{quantity} {norm}", ", ".join(str(row["resolution"]) for row in ladder),
            ", ".join(show(row["error"]) for row in ladder), "–" if order != order else f"{order:.2f}",
            asked(bound, ladder), "yes" if met else "no"]


def asked(bound, ladder):
    """Limits at the resolutions that were run, and the order."""
    if bound is None:
        return "nothing"
    if not isinstance(bound.limits, dict):
        limits = [f"<= {show(float(bound.limits))}"]
    else:
        limits = [f"<= {show(float(bound.limits[row['resolution']]))} at {row['resolution']}" for row in ladder
                  if row["resolution"] in bound.limits]
    orders = [] if bound.order is None else [f"order >= {bound.order}"]
    return ", ".join(limits + orders) or "none at these resolutions"


MANY = 6  # a folder with more cases than this is a family


def first_of_families(names, cases):
    """All names, but of a folder with many of them only the first."""
    sizes, folders = Counter(case.folder for case in cases.values()), defaultdict(list)
    for name in names:
        folders[cases[name].folder].append(name)
    return [name for folder, family in folders.items() for name in (family if sizes[folder] <= MANY else family[:1])]


def worst_of_families(lines, cases):
    """Lines of folders with many cases: for each error only that of the case with the largest one at the finest
    resolution, and all that are not met."""
    families, result, done = defaultdict(list), [], set()
    for line in lines:
        families[cases[line[0]].folder, line[1]].append(line)
    for line in lines:
        key = cases[line[0]].folder, line[1]
        family = families[key]
        if len(family) <= MANY:
            result.append(line)
        elif key not in done:
            done.add(key)
            worst = max(family, key=lambda one: float(one[3].split(", ")[-1]))
            result.append([f"{worst[0]} (worst of {len(family)})", *worst[1:]])
            result += [other for other in family if other[-1] == "no" and other is not worst]
    return result
