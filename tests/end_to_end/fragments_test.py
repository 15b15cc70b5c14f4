"""What counts as a fragment, and of what: the target's pieces over the target's mass, across periodic faces, body by
body; what particles remember of their peaks; which momenta are judged."""
import json
import math
import unittest
from ejecta_run import SOURCE, RunTest, Snapshot, Table, ejecta, settings, summary

# An iron ball shatters a small basalt disc.
IMPACT = """[scene]
name = "target_dust"
dimension = 2
[resolution]
spacing = "1 mm"
[time]
end = "5 us"
[[bodies]]
name = "target"
material = "basalt_von_mises"
shape = "disc"
radius = "10 mm"
[[bodies]]
name = "ball"
material = "iron"
shape = "disc"
center = ["0 mm", "13.5 mm"]
radius = "3 mm"
velocity = ["0 m/s", "-1 km/s"]
[insitu]
enabled = false
[fragments]
enabled = true
"""
# A disc flies half a box, onto a face.
FLIGHT = """[scene]
name = "flight"
dimension = 2
[resolution]
spacing = "1 mm"
[time]
end = "100 us"
[[bodies]]
name = "disc"
material = "basalt"
shape = "disc"
radius = "8 mm"
velocity = ["200 m/s", "0 m/s"]
[boundary]
x = "periodic"
min = ["-20 mm", "-20 mm"]
max = ["20 mm", "20 mm"]
[fragments]
enabled = true
[insitu]
enabled = false
"""

RING = SOURCE / "inputs/expanding_ring.toml"


class Fragments(RunTest):
    def scene(self, text):
        file = self.folder / "scene.toml"
        file.write_text(text)
        return file

    def test_largest_is_of_the_target_never_the_projectile(self):
        out = self.run_scene(self.scene(IMPACT), "run", {})
        found, bodies = summary(out), summary(out)["bodies"]
        self.assertEqual(found["fragment_target"], "target")
        self.assertLess(found["largest_fragment_mass_fraction"], 0.2)
        self.assertEqual(found["largest_fragment_mass_fraction"], bodies["target"]["largest_fragment_mass_fraction"])
        self.assertEqual(bodies["ball"]["largest_fragment_mass_fraction"], 1)
        self.assertEqual(bodies["ball"]["fragments"], 1)
        self.assertIsNone(bodies["ball"]["pressure_peak_max"])
        table = Table(out / "fragments.csv")
        of_target = [m for m in table.numbers("mass of target")[:-1] if m > 0]
        self.assertEqual(len(of_target), bodies["target"]["fragments"])
        self.assertEqual(sum(map(float, table["mass of target"])), sum(of_target) + float(table["mass of target"][-1]))
        for file in ("history", "largest_fragment"):
            last = Table(out / f"{file}.csv").numbers("largest fragment mass fraction")[-1]
            self.assertEqual(last, found["largest_fragment_mass_fraction"], file)
            self.assertIn("largest fragment mass fraction [mass of target]", (out / f"{file}.csv").read_text())
        self.assertEqual(table.numbers("mass fraction")[0], found["largest_fragment_mass_fraction"])
        status = json.loads((out / "monitor/status.json").read_text())
        self.assertEqual(status["fragment_target"], "target")
        self.assertTrue(all(share <= found["largest_fragment_mass_fraction"] + 1e-6 for share, _ in status["fragments"]))
        self.assertIn("% of the mass of target", (out / "run.log").read_text())

    def test_another_target_may_be_named(self):
        scene = self.scene(IMPACT)
        out = self.run_scene(scene, "run", {"fragments.target": "ball"})
        self.assertEqual(summary(out)["fragment_target"], "ball")
        self.assertEqual(summary(out)["largest_fragment_mass_fraction"], 1)
        refused = ejecta("run", scene, "--out", self.folder / "none", *settings({"fragments.target": "bal"}))
        self.assertEqual(refused.returncode, 2)
        self.assertIn('fragments.target: expected the name of a body (ball, target), got "bal"', refused.stderr)

    def test_theory_and_several_runs_in_one_picture(self):
        theory = {"fragments.theory.strain_rate": "1e4 1/s", "fragments.theory.thickness": "5 mm",
                  "fragments.theory.fracture_energy": '["10 kJ/m^2", "40 kJ/m^2"]',
                  "fragments.theory.flow_stress": '["1 GPa"]', "fragments.theory.mott_gamma": "[10, 40]"}
        theory |= {"resolution.spacing": "1 mm", "insitu.enabled": "false"}
        runs = [self.run_scene(RING, f"seed_{seed}", theory | {"random.seed": seed}) for seed in (1, 2)]
        table = Table(runs[0] / "fragment_theory.csv")
        self.assertEqual(table.names[2:], ["Mott, fewest", "Mott, most", "Grady and Kipp, fewest", "Grady and Kipp, most"])
        mass, density = summary(runs[0])["bodies"]["ring"]["mass"], 7900
        spacings = [(24 * energy / (density * 1e8)) ** (1 / 3) for energy in (1e4, 4e4)]
        lightest, heaviest = (density * 5e-3 * s for s in spacings)
        self.assertIn(f"Grady and Kipp: {mass / heaviest:.0f} to {mass / lightest:.0f} pieces of ring", (runs[0] / "run.log").read_text())
        m, few, most = (table.numbers(name)[0] for name in ("mass", "Grady and Kipp, fewest", "Grady and Kipp, most"))
        self.assertAlmostEqual(few, mass / heaviest * math.exp(-m / heaviest), delta=1e-6 * few)
        self.assertAlmostEqual(most, mass / lightest * math.exp(-m / lightest), delta=1e-6 * most)
        for name in ("Mott", "Grady and Kipp"):
            self.assertTrue(all(a <= b for a, b in zip(table.numbers(name + ", fewest"), table.numbers(name + ", most"))))
        self.assertIn("fragment_theory.csv", (runs[0] / "figures/fragment_distribution.gp").read_text())

        drawn = ejecta("fragments", *runs, "--out", self.folder / "band")
        self.assertEqual(drawn.returncode, 0, drawn.stderr)
        self.assertTrue((self.folder / "band/figures/fragment_runs.png").is_file())
        shares = [sorted((s for s in Table(run / "fragments.csv").numbers("mass fraction")[:-1] if s > 0)) for run in runs]
        self.assertNotEqual(*shares)
        for run, of_run in zip(runs, shares):
            line = next(line for line in drawn.stdout.splitlines() if line.startswith(str(run)))
            self.assertEqual(line.split()[1:3], [str(len(of_run)), f"{100 * of_run[-1]:.2f}"])
        band = Table(self.folder / "band/fragment_runs.csv")
        for share, few, most, middle in zip(*(band.numbers(name) for name in band.names[1:])):
            counts = [sum(s >= share for s in of_run) for of_run in shares]
            self.assertEqual([few, most, middle], [min(counts), max(counts), sum(counts) / 2], share)
        other = self.run_scene(self.scene(IMPACT), "other", {"fragments.target": "ball"})
        empty = self.folder / "empty"
        empty.mkdir()
        refused = ejecta("fragments", runs[0], other, empty, "--out", self.folder / "none")
        self.assertEqual(refused.returncode, 2)
        self.assertIn("expected shares of the mass of ring as in", refused.stderr)
        self.assertIn("empty: expected the folder of a run with fragments.enabled = true", refused.stderr)
        self.assertFalse((self.folder / "none").exists())

    def test_theories_need_all_their_constants(self):
        scene = self.scene(IMPACT)
        for values, complaint in (({"flow_stress": '["1 GPa"]'}, "fragments.theory.mott_gamma: missing: Mott's prediction needs it"),
                                  ({"fracture_energy": '["1 J/m^2"]'}, "fragments.theory.strain_rate: missing"),
                                  ({"fracture_energy": '["2 J/m^2", "1 J/m^2"]'}, "expected one number, or the lower and the upper end of a range, got 2, 1"),
                                  ({"fracture_energy": '["1 m"]'}, "J/m^2")):
            refused = ejecta("check", scene, *settings({f"fragments.theory.{key}": value for key, value in values.items()}))
            self.assertEqual(refused.returncode, 2, values)
            self.assertIn(complaint, refused.stderr)

    def test_bodies_apart_at_the_start_are_apart(self):
        scene = self.scene(IMPACT.replace('"13.5 mm"', '"13.2 mm"'))  # lattices 0.3 mm nearer than a link
        out = self.run_scene(scene, "run", {"time.max_steps": 1})
        self.assertEqual(summary(out)["fragments"], 2)
        self.assertEqual(summary(out)["largest_fragment_mass_fraction"], 1)

    def test_a_disc_on_a_periodic_face_is_whole(self):
        out = self.run_scene(self.scene(FLIGHT), "run", {})
        self.assertEqual(summary(out)["fragments"], 1)
        self.assertEqual(summary(out)["largest_fragment_mass_fraction"], 1)
        table = Table(out / "fragments.csv")
        self.assertAlmostEqual(abs(table.numbers("centre x")[0]), 20e-3, delta=1e-6)
        for axis in "ab":
            self.assertAlmostEqual(table.numbers("semi-axis " + axis)[0], 8e-3, delta=2e-4)

    def test_momentum_is_only_judged_where_faces_leave_it(self):
        scene = self.scene(FLIGHT)
        for x, momentum in (("open", True), ("periodic", True), ("reflecting", False)):
            found = summary(self.run_scene(scene, x, {"boundary.x": x, "time.end": "10us"}))
            self.assertEqual(found["momentum_error_rel"] is not None, momentum, x)
            self.assertEqual(found["angular_momentum_error_rel"] is not None, x == "open", x)
        columns = Table(self.folder / "open/history.csv")
        self.assertLess(max(columns.numbers("angular momentum error")), 1e-12)
        self.assertNotIn("angular momentum error", Table(self.folder / "periodic/history.csv").names)

    def test_peaks_survive_a_restart_bit_for_bit(self):
        scene, values = self.scene(IMPACT), {"output.peaks": "true"}
        whole = self.run_scene(scene, "whole", values)
        half = self.run_scene(scene, "half", values | {"time.max_steps": 40})
        again = ejecta("run", scene, "--out", half, "--restart", *settings(values))
        self.assertEqual(again.returncode, 0, again.stderr)
        ends = [Snapshot(sorted((out / "checkpoints").glob("*.h5"))[-1]) for out in (whole, half)]
        for name in ("pressure_peak", "specific_energy_peak", "density_low", "initial_position_0", "initial_position_1"):
            first, second = (dict(zip(end.label("id"), end.column(name))) for end in ends)
            self.assertEqual(first, second, name)
        peaks = summary(whole)["bodies"]["ball"]
        # 1 km/s of iron onto basalt: 9 GPa by the acoustic impedances of both. The sides let go before the wave is through
        # the ball, so that half of it sees less, but a tenth at least.
        self.assertTrue(0.5 < peaks["pressure_peak_max"] / 9e9 < 2, peaks)
        self.assertTrue(0.1 < peaks["pressure_peak_median"] / 9e9 < 1, peaks)
        self.assertEqual(summary(whole)["bodies"], summary(half)["bodies"])


if __name__ == "__main__":
    unittest.main()
