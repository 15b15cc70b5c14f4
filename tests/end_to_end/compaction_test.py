"""Crushing follows the curve of the scene, and nothing ever opens a pore again: seen from outside, step by step."""
import unittest
from ejecta_run import IMPACT_2D, RunTest, Snapshot, Table, resolved

STEPS = 330  # a snapshot every 30 ns is shorter than a step, so that there is one after every step


def crush_curve(p):
    """Jutzi's two-power curve of resolved.toml as alpha(P)."""
    pascal = {key: float(p[key].split()[0]) for key in ("elastic_pressure", "transition_pressure", "solid_pressure")}
    elastic, transition, solid = pascal.values()
    alpha0, alpha_e, alpha_t = (float(p[k]) for k in ("initial_distension", "reference_distension", "transition_distension"))
    scale = (alpha0 - 1) / (alpha_e - 1)

    def alpha(pressure):
        if pressure <= elastic:
            return alpha0
        if pressure >= solid:
            return 1.0
        value = 1 + scale * (alpha_t - 1) * ((solid - pressure) / (solid - elastic)) ** p["n2"]
        if pressure < transition:
            value += scale * (alpha_e - alpha_t) * ((transition - pressure) / (transition - elastic)) ** p["n1"]
        return value

    return alpha


class Compaction(RunTest):
    def test_crushing_and_release(self):
        out = self.run_scene(IMPACT_2D, "run", {"resolution.spacing": "2mm", "time.end": "10us", "insitu.enabled": "false",
                                                "output.snapshots": STEPS})
        porosity = resolved(out)["materials"]["pumice"]["porosity"]
        alpha = crush_curve(porosity)
        before, loading, holding, worst_loading, worst_above = {}, 0, 0, 0.0, 0.0
        snapshots = sorted((out / "snapshots").glob("*.h5"))
        self.assertGreater(len(snapshots), 0.9 * STEPS)
        last_step = 0
        for file in snapshots:
            snapshot, now, step = Snapshot(file), {}, int(file.stem.split("_")[1])
            if step != last_step + 1:  # in two steps a particle may be loaded and released
                before = {}
            last_step = step
            for i, a, p, material in zip(snapshot.label("id"), snapshot.column("distension"), snapshot.column("pressure"),
                                         snapshot.label("material")):
                if a == 1.0 and before.get(i, (1.0, 0))[0] == 1.0:
                    continue  # solid
                now[i] = a, p
                self.assertTrue(1 <= a <= porosity["initial_distension"])
                worst_above = max(worst_above, a - alpha(p))
                if i not in before:
                    continue
                last = before[i][0]
                self.assertLessEqual(a, last)  # no rebound
                if a < last - 1e-9:  # crushed further in this step
                    if 1 < a:
                        loading += 1
                        worst_loading = max(worst_loading, abs(a - alpha(p)))
                elif p < before[i][1] and a < porosity["initial_distension"] - 1e-6:
                    holding += 1
                    self.assertEqual(a, last)  # release moves no pore
            before = now
        print(f"{loading} loading: off the curve by at most {worst_loading:.1e}; {holding} unloading: unchanged")
        self.assertGreater(loading, 1000)
        self.assertGreater(holding, 100)
        self.assertLess(worst_loading, 1e-6)
        self.assertLess(worst_above, 1e-6)

    def test_table_for_the_plot(self):
        out = self.run_scene(IMPACT_2D, "run", {"resolution.spacing": "2mm", "time.end": "10us", "insitu.enabled": "false"})
        alpha = crush_curve(resolved(out)["materials"]["pumice"]["porosity"])
        table = Table(out / "figures/compaction.csv")
        rows = list(zip(table.numbers("pressure"), table.numbers("distension"), table["loading"]))
        on_curve = [abs(a - alpha(p)) for p, a, loading in rows if loading == "1"]
        self.assertGreater(len(on_curve), 20)
        self.assertLess(max(on_curve), 1e-6)
        self.assertTrue(any(loading == "0" for *_, loading in rows))
        for p, a, _ in rows:  # beside the curve is below it
            self.assertLess(a, alpha(p) + 1e-6)
        curve = Table(out / "figures/crush_curve.csv")
        for p, a in zip(curve.numbers("pressure"), curve.numbers("distension")):
            self.assertAlmostEqual(a, alpha(p), delta=1e-12)


if __name__ == "__main__":
    unittest.main()
