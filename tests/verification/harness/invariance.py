"""What must not change the result: threads, the direction of the axes, a common velocity, the precision of the passes.

Threads and the moving and turned runs are compared on a small version of the case, for some tens of steps, before the
chaos of particles amplifies round-off; precision by the errors of the whole run at the coarsest resolution.
"""
import numpy as np
from scipy.spatial import cKDTree

from .ladder import measure
from .run import execute, number
from .transform import boosted, toml, turned

FIELDS = ("velocity", "density", "pressure", "specific_energy")


def check_invariances(case, resolution, reference, workspace, settings):
    """Complaints; prints a line per invariance. `reference` is the double-precision measurement at this resolution."""
    values = {**case.settings(resolution), **(settings or {}), **case.small}
    base = execute(case.scene_file, values, workspace / "small")
    complaints = same_bits(base, execute(case.scene_file, values, workspace / "small_2_threads", threads=2))
    if case.rotation is True:
        run = execute(write(workspace / "turned.toml", turned(base.scene)), {}, workspace / "turned")
        complaints += close("rotated by 90 degrees", case, base, run, turn_back(run))
    else:
        print(f"rotated by 90 degrees: not applicable: {case.rotation}")
    if case.boost in ("x", "y", "z"):
        moving = boosted(base.scene, case.boost, case.boost_speed)
        run = execute(write(workspace / "boosted.toml", moving), {}, workspace / "boosted")
        complaints += close(f"boosted along {case.boost} by {case.boost_speed} m/s", case, base, run,
                            slow_down(base, run, case))
    else:
        print(f"boosted: not applicable: {case.boost}")
    if isinstance(case.mixed_margin, float):
        complaints += same_errors(case, resolution, reference, workspace, settings)
    else:
        print(f"mixed precision: not applicable: {case.mixed_margin}")
    return complaints


def write(file, scene):
    file.write_text(toml(scene))
    return file


def same_bits(one, two):
    a, b = one.final, two.final
    different = [name for name in (*a.names, "id") if not np.array_equal(a[name], b[name], equal_nan=True)]
    print(f"1 against 2 threads, {one.summary['steps']} steps: "
          + (f"{different} differ" if different else "the same bits"))
    return [f"fields that depend on the number of threads: {different}"] if different else []


def turn_back(run):
    """Fields of a turned run as the original axes see them: (x, y) <- (y, -x)."""
    result = {name: run.final[name] for name in ("position", *FIELDS)}
    for name in ("position", "velocity"):
        result[name] = np.column_stack([result[name][:, 1], -result[name][:, 0], result[name][:, 2:]])
    return result


def slow_down(base, run, case):
    """Fields of a boosted run as its moving frame sees them, in the box of the run at rest."""
    result = {name: run.final[name].copy() for name in ("position", *FIELDS)}
    k, boundary = "xyz".index(case.boost), base.scene["boundary"]
    result["velocity"][:, k] -= case.boost_speed
    result["position"][:, k] -= case.boost_speed * run.final.time
    if boundary[case.boost] == "periodic":
        period = number(boundary["max"][k]) - number(boundary["min"][k])
        apart = result["position"][:, k] - base.final["position"][:, k]
        result["position"][:, k] -= period * np.round(apart / period)
    return result


def close(what, case, base, run, seen):
    """Fields as seen from the original frame against the original, particle by particle."""
    spacing = number(base.scene["resolution"]["spacing"])
    if what.startswith("rotated"):  # ids follow the axes; partners are found by place
        distance, partner = cKDTree(seen["position"]).query(base.final["position"])
        seen = {name: values[partner] for name, values in seen.items()}
        if len(np.unique(partner)) < len(partner):
            return [f"{what}: particles have no partner, the nearest is {distance.max() / spacing:.2g} spacings away"]
    worst = {"position": np.abs(seen["position"] - base.final["position"]).max() / spacing}
    for name in FIELDS:
        scale = np.abs(base.final[name]).max()
        if name == "velocity":
            scale += base.final["sound_speed"].max()
        if scale > 0:
            worst[name] = np.abs(seen[name] - base.final[name]).max() / scale
    name = max(worst, key=worst.get)
    steps = run.summary["steps"]
    print(f"{what}, {steps} steps: largest relative difference {worst[name]:.1g} in {name}, limit {case.tolerance:.1g}")
    complaints = [] if worst[name] <= case.tolerance else [f"{what}: {name} differs by {worst[name]:.3g}"]
    if steps != base.summary["steps"]:
        complaints.append(f"{what}: {steps} steps instead of {base.summary['steps']}")
    return complaints


def same_errors(case, resolution, reference, workspace, settings):
    mixed = measure(case, resolution, workspace, {**(settings or {}), "numerics.precision": "mixed"})
    # Nothing that vanishes but for round-off can keep its digits.
    changes = {key: abs(error - reference.errors[key]) / max(reference.errors[key], 1e-6)
               for key, error in mixed.errors.items()}
    key = max(changes, key=changes.get)
    print(f"mixed precision: largest change of an error {changes[key]:.2g} of it ({' '.join(key)}), limit "
          f"{case.mixed_margin}; energy {mixed.energy_drift:.1g}, momentum {mixed.momentum_drift:.1g}")
    complaints = [f"mixed precision changes the error of {' '.join(key)} from {reference.errors[key]:.5g} to "
                  f"{mixed.errors[key]:.5g}"] if changes[key] > case.mixed_margin else []
    for name in ("energy", "momentum"):
        drift = getattr(mixed, f"{name}_drift")
        if drift > case.mixed_drift:
            complaints.append(f"mixed precision: {name} drifts by {drift:.3g}, the limit is {case.mixed_drift:.3g}")
    return complaints
