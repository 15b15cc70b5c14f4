"""A charge that burns in a tube of copper: warnings, the ledger, threads, and a restart in the middle of the burn."""
import unittest

from ejecta_run import SOURCE, RunTest, Table, ejecta, settings

SECTION, TUBE = (SOURCE / "inputs" / f"{name}.toml" for name in ("cylinder_test", "cylinder_test_3d"))
PLAIN = {"insitu.enabled": "false", "output.history_interval": "0.2 us"}


class Explosive(RunTest):
    def test_goes_on_bit_for_bit_while_it_burns(self):
        values = PLAIN | {"resolution.spacing": "10.16mm", "time.max_steps": 120}
        whole = self.run_scene(TUBE, "whole", values, "--threads", 1)
        out = self.run_scene(TUBE, "parts", values | {"time.max_steps": 60}, "--threads", 1)
        half = Table(out / "history.csv").numbers("burnt mass fraction")[-1]
        self.assertTrue(0.1 < half < 0.9, half)
        result = ejecta("run", TUBE, "--out", out, "--threads", 2, "--restart", *settings(values))
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertEqual(Table(out / "history.csv").rows[-1], Table(whole / "history.csv").rows[-1])

    def test_keeps_energy_with_what_the_explosive_brings(self):
        out = self.run_scene(SECTION, "all", PLAIN | {"resolution.spacing": "4mm"})
        history = Table(out / "history.csv")
        self.assertLess(max(map(abs, history.numbers("energy error"))), 1e-12)
        released = history.numbers("energy released")
        self.assertEqual(released, sorted(released))
        self.assertAlmostEqual(history.numbers("burnt mass fraction")[-1], 1, places=12)
        # A quarter of 10.2 GJ/m^3, but for the particles that the planes of symmetry cut.
        self.assertAlmostEqual(released[-1] / (10.2e9 * 3.14159 / 4 * 0.0508**2), 1, delta=0.02)
        self.assertGreater(history.numbers("kinetic energy")[-1], 0.3 * released[-1])

    def test_says_what_is_not_lit_in_time(self):
        result = ejecta("check", SECTION, *settings(PLAIN | {"detonators[0].time": "50 us"}))
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertIn("charge: the run ends at 40 us, before all of it has been lit at 50 us", result.stderr)


if __name__ == "__main__":
    unittest.main()
