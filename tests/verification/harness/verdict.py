"""Runs a case, prints what was measured, and says what is not as it must be."""
import math
import tempfile
from pathlib import Path

from .invariance import check_invariances
from .ladder import measure
from .norms import order
from .run import RunFailed


def verify(case, resolutions, settings=None, threads=1, invariances=True, keep=None):
    """Returns (measurements, complaints); no complaints: the case has passed."""
    print(f"\n{case.name}: {case.title}\nexact solution: {case.exact}")
    case.check_exact()
    with tempfile.TemporaryDirectory(prefix=f"ejecta_{case.name}_") as temporary:
        workspace = Path(keep or temporary)
        measurements, complaints = [], []
        try:
            for r in resolutions:
                measurements.append(measure(case, r, workspace, settings, threads, bool(keep)))
            complaints = judge_errors(case, measurements) + judge_conservation(case, measurements)
            if invariances:
                complaints += check_invariances(case, resolutions[0], measurements[0], workspace, settings)
        except RunFailed as failure:
            complaints.append(str(failure))
    print("\n".join(f"FAILED {case.name}: {c}" for c in complaints) or f"passed {case.name}", flush=True)
    return measurements, complaints


def judge_errors(case, measurements):
    resolutions = [m.resolution for m in measurements]
    bounds = {(b.quantity, b.norm): b for b in case.bounds}
    keys = list(measurements[0].errors)
    complaints = [f"there is no bound on {' '.join(key)}" for key in keys if key not in bounds]
    complaints += [f"nothing measures {' '.join(key)}" for key in bounds if key not in keys]
    width = max(len(" ".join(key)) for key in keys)
    print(f"{'error at':{width}} " + " ".join(f"{r:>11}" for r in resolutions) + "   order   asked")
    for key in keys:
        errors, bound = [m.errors[key] for m in measurements], bounds.get(key)
        measured = order(resolutions, errors)
        print(f"{' '.join(key):{width}} " + " ".join(f"{e:11.4g}" for e in errors) + f"  {measured:6.2f}   {bound}")
        if bound is None:
            continue
        applied = [(r, e, bound.limit(r)) for r, e in zip(resolutions, errors) if bound.limit(r) is not None]
        if not applied:
            complaints.append(f"no limit on {' '.join(key)} applies to any of the resolutions {resolutions}")
        complaints += [f"{' '.join(key)} at {r}: {e:.5g}, the limit is {limit:.5g}" for r, e, limit in applied
                       if not e <= limit]
        asked = [(r, e) for r, e in zip(resolutions, errors) if r <= bound.up_to]
        if bound.order is not None and len(asked) > 1 and not order(*zip(*asked)) >= bound.order:
            complaints.append(f"{' '.join(key)}: order {order(*zip(*asked)):.2f}, the least is {bound.order}")
    cost = " ".join(f"{m.core_seconds:11.2f}" for m in measurements)
    print(f"{'core-seconds':{width}} {cost}")
    return complaints


def judge_conservation(case, measurements):
    """Energy, momentum and mass; the sum of the masses may be taken in another order each time."""
    complaints = []
    for name, limit in (("energy", case.energy), ("momentum", case.momentum), ("mass", case.mass)):
        worst = max((getattr(m, f"{name}_drift") for m in measurements), key=lambda d: -1 if math.isnan(d) else d)
        if name == "momentum" and math.isnan(worst):
            print("momentum: walls on every axis")
            continue
        print(f"{name}: largest relative drift {worst:.2g}, limit {limit:.2g}")
        if not worst <= limit:
            complaints.append(f"{name} drifts by {worst:.3g}, the limit is {limit:.3g}")
    return complaints
