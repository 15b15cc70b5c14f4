"""A second package with steps of its own lives in a run of particles: it votes, conserves, persists, and is seen."""
import math
import unittest
from ejecta_run import SOD, RunTest, Table, ejecta, resolved, settings, summary

OSCILLATORS = {"oscillators.count": 4, "oscillators.mass": "2 kg", "oscillators.period": "50 ms",
               "oscillators.amplitude": "3 mm", "oscillators.damping": "1 kg/s"}
VALUES = {"time.end": "0.1 s", "insitu.frames": 2, "output.history_interval": "2 ms", **OSCILLATORS}


class Package(RunTest):
    def test_it_is_there_only_if_the_scene_asks_for_it(self):
        out = self.run_scene(SOD, "without", {"insitu.enabled": "false"})
        self.assertNotIn("displacement", Table(out / "history.csv").names)
        self.assertNotIn("oscillators", (out / "resolved.toml").read_text())

    def test_history_summary_monitor_check_and_reference_show_it(self):
        out = self.run_scene(SOD, "shown", VALUES)
        history = Table(out / "history.csv")
        times, displacements = history.numbers("time"), history.numbers("displacement")
        rate, omega = 1 / (2 * 2), 2 * math.pi / 50e-3
        omega_damped = math.sqrt(omega**2 - rate**2)
        for t, x in zip(times, displacements):  # damped oscillation, by its exact solution
            exact = 3e-3 * math.exp(-rate * t) * (math.cos(omega_damped * t) + rate / omega_damped * math.sin(omega_damped * t))
            self.assertAlmostEqual(x, exact, delta=3e-3 * 2e-3, msg=t)
        self.assertLess(max(map(abs, history.numbers("energy error"))), 1e-12)
        self.assertEqual(summary(out)["quantities"]["displacement [m]"], displacements[-1])
        self.assertIn("displacement", (out / "monitor/status.json").read_text())
        self.assertIn("count = 4", (out / "resolved.toml").read_text())
        check = ejecta("check", SOD, *settings(VALUES))
        self.assertRegex(check.stdout, r"oscillators +4")
        self.assertIn("damping", ejecta("describe", "oscillators").stdout)
        refused = ejecta("check", SOD, *settings({**VALUES, "oscillators.count": 0}))
        self.assertEqual(refused.returncode, 2)
        self.assertIn("oscillators.count", refused.stderr)

    def test_its_vote_bounds_the_step(self):
        out = self.run_scene(SOD, "vote", {**VALUES, "oscillators.period": "1 us", "time.end": "20 us",
                                           "output.history_interval": "0.1 us"})
        history = Table(out / "history.csv")
        self.assertEqual(set(history["limited by"][1:]), {"oscillators"})
        self.assertLessEqual(max(history.numbers("dt")), 0.5e-6 * (1 + 1e-9))
        self.assertLess(max(map(abs, history.numbers("energy error"))), 1e-12)

    def test_its_list_of_things_is_read_echoed_and_checked(self):
        scene = self.folder / "kicked.toml"
        scene.write_text(SOD.read_text().replace("[[bodies]]", '[[oscillators.kicks]]\nname = "hard"\nvelocity = "1 m/s"\n\n'
                                                               "[[bodies]]", 1))
        out = self.run_scene(scene, "kicked", {**VALUES, "oscillators.kicks.hard.velocity": "2 m/s"})
        rate, omega, speed = 1 / (2 * 2), 2 * math.pi / 50e-3, 2
        omega_damped = math.sqrt(omega**2 - rate**2)
        history = Table(out / "history.csv")
        for t, x in zip(history.numbers("time"), history.numbers("displacement")):
            exact = math.exp(-rate * t) * (3e-3 * math.cos(omega_damped * t)
                                           + (speed + rate * 3e-3) / omega_damped * math.sin(omega_damped * t))
            self.assertAlmostEqual(x, exact, delta=16e-3 * 2e-3, msg=t)
        self.assertEqual([kick["name"] for kick in resolved(out)["oscillators"]["kicks"]], ["hard"])
        self.assertIn("[[oscillators.kicks]]", ejecta("describe", "oscillators").stdout)
        for key, value, complaint in (("oscillators.kicks.soft.velocity", "2 m/s", 'one of the oscillators.kicks "hard"'),
                                      ("oscillators.kicks[0].velocty", "2 m/s", "did you mean oscillators.kicks[0].velocity?"),
                                      ("oscillators.kicks.hard.oscillator", 5, "kicked.toml:")):
            refused = ejecta("check", scene, *settings({**VALUES, key: value}))
            self.assertEqual(refused.returncode, 2)
            self.assertIn(complaint, refused.stderr)

    def test_its_fields_may_have_fixed_colour_ranges(self):
        accepted = ejecta("check", SOD, *settings({**VALUES, "insitu.ranges.displacement": '["-3 mm", "3 mm"]'}))
        self.assertEqual(accepted.returncode, 0, accepted.stderr)
        for name, bounds, complaint in (("displacment", "[-1, 1]", "no such field, did you mean displacement?"),
                                        ("displacement", '["-1 Pa", "1 Pa"]', "expected a length")):
            refused = ejecta("check", SOD, *settings({**VALUES, f"insitu.ranges.{name}": bounds}))
            self.assertEqual(refused.returncode, 2)
            self.assertIn(complaint, refused.stderr)

    def test_restart_goes_on_bit_for_bit(self):
        whole = self.run_scene(SOD, "whole", {**VALUES})
        half = self.run_scene(SOD, "half", {**VALUES, "time.max_steps": 30})
        result = ejecta("run", SOD, "--out", half, "--restart", *settings({**VALUES}))
        self.assertEqual(result.returncode, 0, result.stderr)
        ours, theirs = Table(half / "history.csv"), Table(whole / "history.csv")
        self.assertEqual(ours.rows[-1], theirs.rows[-1])

    def test_a_script_sees_its_channel(self):
        script = self.folder / "look.py"
        script.write_text("# script-version: 2.0\n"
                          "from paraview.simple import *\n"
                          "from paraview import catalyst\n"
                          "particles = PVTrivialProducer(registrationName='oscillators')\n"
                          "options = catalyst.Options()\n"
                          "def catalyst_execute(info):\n"
                          "    particles.UpdatePipeline()\n"
                          "    data = particles.GetDataInformation()\n"
                          f"    open('{self.folder}/seen.txt', 'a').write(f'{{data.GetNumberOfPoints()}}\\n')\n")
        self.run_scene(SOD, "channel", {**VALUES, "insitu.enabled": "true", "insitu.pipelines": f'["{script}"]'})
        self.assertEqual((self.folder / "seen.txt").read_text().split(), ["4", "4"])


if __name__ == "__main__":
    unittest.main()
