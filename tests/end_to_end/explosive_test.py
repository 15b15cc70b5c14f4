"""A charge that burns in a tube of copper: warnings, the ledger, threads, and a restart in the middle of the burn."""
import unittest

from ejecta_run import SOURCE, RunTest, Table, ejecta, settings, summary

SCENE = SOURCE / "inputs" / "cylinder_test.toml"
VALUES = {"resolution.spacing": "4mm", "insitu.enabled": "false", "output.history_interval": "0.2 us"}


class Explosive(RunTest):
    def run_to(self, name, steps, *arguments):
        return self.run_scene(SCENE, name, VALUES | {"time.max_steps": steps}, *arguments)

    def test_goes_on_bit_for_bit_while_it_burns(self):
        whole = self.run_to("whole", 80, "--threads", 1)
        out = self.run_to("parts", 40, "--threads", 1)
        half = float(Table(out / "history.csv").numbers("burnt mass fraction")[-1])
        self.assertTrue(0.1 < half < 0.9, half)
        result = ejecta("run", SCENE, "--out", out, "--threads", 2, "--restart",
                        *settings(VALUES | {"time.max_steps": 80}))
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertEqual(Table(out / "history.csv").rows[-1], Table(whole / "history.csv").rows[-1])

    def test_keeps_energy_with_what_the_explosive_brings(self):
        out = self.run_scene(SCENE, "all", VALUES)
        history, done = Table(out / "history.csv"), summary(out)
        self.assertLess(max(map(abs, history.numbers("energy error"))), 1e-12)
        released = history.numbers("energy released")
        self.assertEqual(released, sorted(released))
        self.assertAlmostEqual(history.numbers("burnt mass fraction")[-1], 1, places=12)
        # A quarter of 10.2 GJ/m^3, but for the particles that the planes of symmetry cut.
        self.assertAlmostEqual(released[-1] / (10.2e9 * 3.14159 / 4 * 0.0508**2), 1, delta=0.02)
        self.assertGreater(history.numbers("kinetic energy")[-1], 0.3 * released[-1])
        self.assertEqual(done["quantities"]["burnt mass fraction"], history.numbers("burnt mass fraction")[-1])

    def test_warns_of_what_is_never_lit(self):
        result = ejecta("check", SCENE, *settings(VALUES | {"detonators[0].time": "50 us"}))
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertIn("charge: the run ends at 40 us, before all of it has been lit at 55.", result.stderr)


if __name__ == "__main__":
    unittest.main()
