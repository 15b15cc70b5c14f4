"""A run that goes wrong ends with exit code 3, says where and why, and what it has written so far can be read."""
import unittest
from ejecta_run import IMPACT_2D, RunTest, Snapshot, Table, ejecta, resolved, summary

COARSE = {"resolution.spacing": "3mm", "time.end": "20us", "insitu.enabled": "false"}


class Failure(RunTest):
    def check_what_is_left(self, out):
        self.assertEqual(summary(out)["exit"], 3)
        failed, = (out / "checkpoints").glob("failed_*.h5")
        self.assertEqual(len(Snapshot(failed).column("density")), summary(out)["particles"])
        history = Table(out / "history.csv")
        self.assertEqual(int(history["step"][-1]), summary(out)["steps"])
        self.assertEqual(resolved(out)["scene"]["name"], "pumice_impact_2d")
        self.assertIn(self.last.stderr.split(" E ")[1].splitlines()[0], (out / "run.log").read_text())

    def test_energy_drift(self):
        # Round-off is all the drift there is, so only an absurd limit catches it.
        out = self.run_scene(IMPACT_2D, "drift", {**COARSE, "numerics.max_energy_drift": 1e-30}, code=3)
        self.assertRegex(self.last.stderr, r"time .* s, step \d+: total energy has drifted")
        self.check_what_is_left(out)

    def test_collapsed_time_step(self):
        # Viscosity this strong leaves no stable time step once the bodies touch.
        out = self.run_scene(IMPACT_2D, "collapse", {**COARSE, "numerics.viscosity_alpha": 1e9}, code=3)
        self.assertRegex(self.last.stderr, r"time step has collapsed to .* by the Courant condition of particle \d+ "
                                           r"\(body \"\w+\", material \"\w+\"\) at \(.*\) m")

        self.check_what_is_left(out)

    def test_ledger_that_is_no_number(self):
        # The square of this velocity overflows: as a number it is refused, from a formula it ends the run at once.
        self.run_scene(IMPACT_2D, "read", {**COARSE, "bodies.projectile.velocity": "0 -1e297 m/s"}, code=2)
        self.assertRegex(self.last.stderr, r"velocity: expected less than 1e\+150 m/s, .* got 1e\+297 m/s")
        self.run_scene(IMPACT_2D, "formula", {**COARSE, "bodies.projectile.profile.velocity": '["0", "-1e200"]'}, code=3)
        self.assertRegex(self.last.stderr, r"time 0 s, step 0, after set-up: kinetic energy not finite: particle \d+ ")
        # Of every particle it is a number, of all of them it is none.
        out = self.run_scene(IMPACT_2D, "sum", {**COARSE, "bodies.projectile.velocity": "0 -1e149 m/s",
                                                "bodies.projectile.density": "1e15 kg/m^3"}, code=3)
        self.assertIn("time 0 s, step 0: the kinetic energy of everything is not a finite number (inf)",
                      self.last.stderr)
        self.check_what_is_left(out)

    def test_state_that_is_no_number(self):
        self.run_scene(IMPACT_2D, "overflow", {**COARSE, "bodies.projectile.specific_energy": "1e306 J/kg"}, code=3)
        self.assertRegex(self.last.stderr, r"step 0, stage \"pair rates\" \(field acceleration\): state not finite .*: particle \d+ \(body \"\w+\"")


if __name__ == "__main__":
    unittest.main()
