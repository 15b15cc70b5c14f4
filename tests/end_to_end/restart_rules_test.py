"""What a restart goes on with and what it refuses, what a signal and a crash leave, and what the log says afterwards."""
import json
import re
import signal
import subprocess
import time
import unittest
from ejecta_run import IMPACT_2D, PROGRAM, RunTest, Table, ejecta, resolved, settings, summary

COARSE = {"resolution.spacing": "4mm", "insitu.enabled": "false", "fragments.enabled": "false", "run.threads": 1}
LONG = {**COARSE, "resolution.spacing": "2mm", "time.end": "10ms"}  # minutes, if nobody ends it


def status(out):
    return json.loads((out / "monitor/status.json").read_text())


class RestartRules(RunTest):
    def start(self, name, values, **more):
        """A run that goes on by itself and has made some steps."""
        out = self.folder / name
        run = subprocess.Popen([PROGRAM, "run", IMPACT_2D, "--out", out, *settings(values)], stdout=subprocess.DEVNULL,
                               stderr=subprocess.PIPE, text=True, **more)
        self.addCleanup(run.stderr.close)
        self.addCleanup(run.kill)
        self.wait_for(lambda: (out / "monitor/status.json").exists() and status(out)["step"] > 0)
        return out, run

    def wait_for(self, ready, seconds=60):
        give_up = time.monotonic() + seconds
        while not ready() and time.monotonic() < give_up:
            time.sleep(0.05)
        self.assertTrue(ready())

    def test_a_changed_scene_is_refused(self):
        out = self.run_scene(IMPACT_2D, "run", {**COARSE, "time.max_steps": 5})
        before = {path: path.read_bytes() for path in out.rglob("*") if path.is_file()}
        changed = {"bodies.projectile.velocity": "0 -9 km/s", "materials.pumice.porosity.elastic_pressure": "2 MPa",
                   "numerics.courant": 0.3, "output.peaks": "true", "fragments.min_particles": 3}
        result = ejecta("run", IMPACT_2D, "--out", out, "--restart", *settings({**COARSE, **changed}))
        self.assertEqual(result.returncode, 2, result.stderr)
        lines = result.stderr.splitlines()
        self.assertEqual(len(lines), len(changed), result.stderr)
        for key in changed:
            self.assertTrue([line for line in lines if f": {key}: expected " in line], key)
        self.assertRegex(result.stderr, r'courant: expected 0\.4 as in the checkpoint checkpoint_0+5\.h5, got 0\.3\n')
        self.assertRegex(result.stderr, r'velocity: expected .*as in the checkpoint .*, got .*-9000 m/s')
        self.assertEqual(before, {path: path.read_bytes() for path in out.rglob("*") if path.is_file()})
        # The same number of particles, or another.
        for values in ({"resolution.spacing": "3mm"}, {"resolution.spacing": "4.0001mm"}):
            result = ejecta("run", IMPACT_2D, "--out", out, "--restart", *settings({**COARSE, **values}))
            self.assertEqual(result.returncode, 2)
            self.assertIn("resolution.spacing: expected", result.stderr)

    def test_accepted_changes_are_told(self):
        self.run_scene(IMPACT_2D, "run", {**COARSE, "time.max_steps": 5})
        out = self.run_scene(IMPACT_2D, "run", {**COARSE, "time.max_steps": 8, "numerics.courant": 0.3}, "--restart",
                             "--accept-changes")
        self.assertIn("changed since the checkpoint: numerics.courant: 0.4 -> 0.3", (out / "run.log").read_text())
        self.assertEqual((summary(out)["steps"], resolved(out)["numerics"]["courant"]), (8, 0.3))

    def test_a_failed_state_goes_on_once_the_cause_is_gone(self):
        out = self.run_scene(IMPACT_2D, "run", {**COARSE, "numerics.max_energy_drift": 1e-30}, code=3)
        failed, = (out / "checkpoints").glob("failed_*.h5")
        self.assertEqual(summary(out)["state"], "failed")
        self.assertIn("energy has drifted", summary(out)["reason"])
        steps = summary(out)["steps"]
        self.run_scene(IMPACT_2D, "run", {**COARSE, "time.max_steps": steps + 9}, "--restart", "--accept-changes",
                       "--from", failed)
        self.assertEqual((summary(out)["steps"], summary(out)["state"]), (steps + 9, "finished"))
        rows = [int(step) for step in Table(out / "history.csv")["step"]]
        self.assertEqual(rows, sorted(set(rows)))

    def test_checkpoints_by_simulated_time(self):
        out = self.run_scene(IMPACT_2D, "run", {**COARSE, "time.end": "10us", "output.checkpoint_every": "2us",
                                                "output.checkpoints_kept": 3})
        self.assertEqual(len(list((out / "checkpoints").iterdir())), 3)
        whole = self.run_scene(IMPACT_2D, "whole", {**COARSE, "time.end": "10us"})
        self.assertEqual((out / "history.csv").read_bytes(), (whole / "history.csv").read_bytes())

    def test_a_run_that_has_ended_has_each_row_once(self):
        # Of rows that are due at the end, and of a last row that is there for the end alone.
        for interval in ("5us", "3us"):
            values = {**COARSE, "time.end": "10us", "output.times": '["10us"]' if interval == "5us" else "[]",
                      "output.history_interval": interval}
            rows = (self.run_scene(IMPACT_2D, interval, values) / "history.csv").read_bytes()
            for _ in range(2):
                out = self.run_scene(IMPACT_2D, interval, values, "--restart")
                self.assertEqual((out / "history.csv").read_bytes().count(b"\n"), rows.count(b"\n"))

    def test_what_may_change(self):
        self.run_scene(IMPACT_2D, "run", {**COARSE, "time.max_steps": 5})
        free = {"time.end": "200us", "time.max_steps": 8, "scene.title": "Again", "insitu.frames": 7, "run.threads": 2,
                "output.history_interval": "3us", "output.checkpoint_interval": "9s", "output.snapshots": 2}
        out = self.run_scene(IMPACT_2D, "run", {**COARSE, **free}, "--restart")
        self.assertEqual(summary(out)["steps"], 8)
        self.assertEqual(resolved(out)["scene"]["title"], "Again")

    def test_in_situ_work_of_before_still_counts(self):
        out = self.run_scene(IMPACT_2D, "run", {**COARSE, "time.max_steps": 5, "insitu.enabled": "true"})
        before = summary(out)
        self.assertGreater(before["insitu_share"], 0.1)
        self.run_scene(IMPACT_2D, "run", {**COARSE, "time.max_steps": 6, "insitu.enabled": "false"}, "--restart")
        after = summary(out)
        spent = [s["insitu_share"] * s["wall_s"] for s in (before, after)]
        self.assertGreater(spent[1], 0.99 * spent[0])
        self.assertLess(spent[1], 1.5 * spent[0])

    def test_snapshots_go_on(self):
        values = {**COARSE, "output.snapshots": 6, "time.end": "60us"}
        whole = self.run_scene(IMPACT_2D, "whole", values)
        steps = summary(whole)["steps"]
        self.run_scene(IMPACT_2D, "run", {**values, "time.max_steps": 7 * steps // 10})
        out = self.run_scene(IMPACT_2D, "run", values, "--restart")
        names = sorted(file.name for file in (whole / "snapshots").iterdir())
        self.assertEqual(len(names), 6)
        self.assertEqual(sorted(file.name for file in (out / "snapshots").iterdir()), names)

    def test_the_log_counts_the_steps_and_the_time_since_the_restart(self):
        # The last line of a run is written after its last step.
        self.run_scene(IMPACT_2D, "run", {**COARSE, "time.max_steps": 300})
        before = summary(self.folder / "run")
        out = self.run_scene(IMPACT_2D, "run", {**COARSE, "time.max_steps": 320}, "--restart")
        after = summary(out)
        rate = float(re.findall(r"([\d.]+) M particle-steps/s", self.last.stderr)[-1])
        wrong = after["particles"] * 20 / after["wall_s"] / 1e6
        right = after["particles"] * 20 / (after["wall_s"] - before["wall_s"]) / 1e6
        self.assertGreater(right, 4 * wrong)
        self.assertAlmostEqual(rate, right, delta=0.1 * right + 0.006)

    def test_signals(self):
        for number in (signal.SIGHUP, signal.SIGINT, signal.SIGTERM):
            with self.subTest(number.name):
                out, run = self.start(number.name, LONG)
                run.send_signal(number)
                if number == signal.SIGHUP:
                    run.send_signal(number)  # as a shell does after the terminal has
                _, log = run.communicate(timeout=60)
                self.assertEqual(run.returncode, 4, log)
                self.assertEqual((summary(out)["state"], summary(out)["exit"]), ("stopped", 4))
                self.assertEqual((status(out)["state"], status(out)["exit"]), ("stopped", 4))
                self.assertTrue(list((out / "checkpoints").glob("checkpoint_*.h5")))
                self.run_scene(IMPACT_2D, number.name, {**LONG, "time.max_steps": summary(out)["steps"] + 2},
                               "--restart")
                self.assertEqual((status(out)["state"], status(out)["exit"]), ("finished", 0))

    def test_nohup(self):
        out, run = self.start("nohup", LONG, preexec_fn=lambda: signal.signal(signal.SIGHUP, signal.SIG_IGN))
        run.send_signal(signal.SIGHUP)
        step = status(out)["step"]
        self.wait_for(lambda: status(out)["step"] > step + 1)
        run.send_signal(signal.SIGTERM)
        run.communicate(timeout=60)
        self.assertEqual(run.returncode, 4)

    def test_a_crash_early_in_a_run_leaves_a_checkpoint(self):
        out, run = self.start("run", {**LONG, "output.checkpoint_interval": "3s"})
        self.wait_for(lambda: list((out / "checkpoints").glob("checkpoint_*.h5")), seconds=30)
        run.kill()
        run.communicate(timeout=60)
        self.run_scene(IMPACT_2D, "run", {**LONG, "output.checkpoint_interval": "3s", "time.max_steps": 1}, "--restart")


if __name__ == "__main__":
    unittest.main()
