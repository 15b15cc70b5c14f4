"""A run can be asked for things while it goes on, is alone in its folder, and survives being killed at any time."""
import json
import random
import re
import signal
import subprocess
import time
import unittest
from ejecta_run import IMPACT_2D, PROGRAM, RunTest, Table, ejecta, settings, summary

COARSE = {"resolution.spacing": "4mm", "insitu.enabled": "false", "run.threads": 1}
LONG = {**COARSE, "resolution.spacing": "2mm", "time.end": "10ms"}  # minutes, if nobody ends it


class Control(RunTest):
    def launch(self, values, *more):
        self.out = self.folder / "run"
        self.process = subprocess.Popen([PROGRAM, "run", IMPACT_2D, "--out", self.out, *settings(values), *more],
                                        stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        self.addCleanup(self.process.wait)
        self.addCleanup(self.process.stdout.close)
        self.addCleanup(self.process.stderr.close)
        self.addCleanup(self.process.kill)

    def start(self, values, *more):
        self.launch(values, *more)
        self.wait_for(lambda: self.status()["step"] > 0)

    def status(self):
        try:
            return json.loads((self.out / "monitor/status.json").read_text())
        except FileNotFoundError:
            return {"step": -1}

    def wait_for(self, ready, seconds=60):
        give_up = time.monotonic() + seconds
        while not ready() and time.monotonic() < give_up:
            time.sleep(0.05)
        self.assertTrue(ready())

    def ask(self, *words, answer):
        result = ejecta("control", self.out, *words)
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertRegex(result.stdout, answer)
        self.assertIn(result.stdout.strip(), self.status()["control"])
        self.assertIn("control: " + result.stdout.strip(), (self.out / "run.log").read_text())

    def log(self):
        return (self.out / "run.log").read_text()

    def test_what_can_be_asked(self):
        self.start({**LONG, "insitu.enabled": "true", "insitu.frames": 2, "insitu.image_width": 320,
                    "insitu.image_height": 240})
        self.ask("pause", answer=r"paused at t = .* step \d+")
        self.assertEqual(self.status()["state"], "paused")
        step = self.status()["step"]
        time.sleep(1)
        self.assertEqual(self.status()["step"], step)
        self.ask("checkpoint", answer="written at t =")
        self.wait_for(lambda: (self.out / f"checkpoints/checkpoint_{step:012d}.h5").exists())
        self.ask("frame", answer="drawn at t =")
        self.wait_for(lambda: (self.out / f"images/slice_{step:06d}.png").exists())
        # What makes no sense is refused and changes nothing.
        before = self.log()
        for words, reason in ((["paus"], "did you mean pause"), (["end"], "end=TIME"), (["end=12 kg"], "end: "),
                              (["every=-1us"], "time > 0"), (["stop", "now"], "expected stop")):
            result = ejecta("control", self.out, *words)
            self.assertEqual(result.returncode, 2)
            self.assertIn(reason, result.stderr)
        self.assertEqual(self.log(), before)
        self.assertFalse((self.out / "control").exists())
        # Written by hand it is ignored, and the run says so.
        (self.out / "control").write_text("end=yesterday\n")
        self.wait_for(lambda: "W control: end=yesterday: ignored: " in self.log())
        self.ask("end", "=", "1 ns", answer="ignored: end: expected a time to come")
        self.ask("resume", answer="goes on at t =")
        self.ask("every=1us", answer="a frame every 1 us")
        self.wait_for(lambda: len(list(self.out.glob("images/slice*.png"))) > 4)
        self.ask("stop", answer="stops at t =")
        said, _ = self.process.communicate(timeout=60)
        self.assertEqual(self.process.returncode, 4)
        self.assertEqual((summary(self.out)["state"], summary(self.out)["reason"]), ("stopped", "stopped by control"))
        self.assertEqual(len(said.splitlines()), 3, said)
        self.assertIn("--restart goes on", said)
        result = ejecta("control", self.out, "stop")
        self.assertEqual(result.returncode, 2)
        self.assertIn("a run that goes on, found none", result.stderr)

    def test_what_comes_before_the_first_step_is_kept(self):
        pictures = {"insitu.enabled": "true", "insitu.frames": 2, "insitu.image_width": 320, "insitu.image_height": 240}
        self.run_scene(IMPACT_2D, "run", {**COARSE, "time.max_steps": 2})
        (self.folder / "run/control").write_text("stop\n")  # of a client of that run
        self.launch({**LONG, **pictures}, "--overwrite")
        self.wait_for(lambda: (self.out / "run.lock").exists())
        self.process.send_signal(signal.SIGUSR1)
        self.ask("pause", answer=r"paused at t = 0 s, step 0")
        self.wait_for(lambda: (self.out / f"checkpoints/checkpoint_{0:012d}.h5").exists())
        self.ask("stop", answer="stops at t =")
        self.process.communicate(timeout=60)
        self.assertEqual(self.process.returncode, 4)

    def test_what_comes_after_the_last_step_is_refused(self):
        self.launch({**LONG, "time.max_steps": 30, "insitu.enabled": "true"})  # movies and figures take a while
        self.wait_for(lambda: (self.out / "run.log").exists() and "step     30" in self.log())
        result = ejecta("control", self.out, "frame")
        self.process.communicate(timeout=60)
        said = result.stdout + result.stderr + self.log()  # the run may still be making movies when the client gives up
        self.assertRegex(said, "ignored: the run has ended|the run has ended and has not done it|folder of a run that goes on")
        self.assertFalse((self.out / "control").exists())

    def test_another_end(self):
        self.start(LONG)
        self.ask("end=9ms", answer="ends at 9 ms")
        self.assertEqual(self.status()["time_end_s"], 9e-3)
        now = self.status()["time_s"]
        self.ask(f"end={now + 3e-4} s", answer="ends at ")
        _, log = self.process.communicate(timeout=100)
        self.assertEqual(self.process.returncode, 0, log)
        self.assertAlmostEqual(summary(self.out)["time_s"], now + 3e-4, delta=1e-12)

    def test_pausing_changes_no_bit(self):
        values = {**COARSE, "resolution.spacing": "2mm", "time.max_steps": 4000, "time.end": "10ms"}
        self.start(values)
        (self.out / "control").write_text("pause\n")
        self.wait_for(lambda: self.status()["state"] == "paused")
        self.ask("checkpoint", answer="written")
        self.ask("resume", answer="goes on")
        self.assertEqual(self.process.wait(timeout=100), 0)
        whole = self.run_scene(IMPACT_2D, "whole", values)
        self.assertEqual((self.out / "history.csv").read_text(), (whole / "history.csv").read_text())

    def test_a_signal_writes_a_checkpoint(self):
        self.start(LONG)
        self.process.send_signal(signal.SIGUSR1)
        self.process.send_signal(signal.SIGPIPE)
        self.wait_for(lambda: list(self.out.glob("checkpoints/checkpoint_*.h5")))
        step = self.status()["step"]
        self.wait_for(lambda: self.status()["step"] > step)
        self.assertRegex(self.log(), r"checkpoint_\d+\.h5 as asked")

    def test_two_runs(self):
        self.start(LONG)
        files = set(self.out.rglob("*"))
        for more in ([], ["--overwrite"], ["--restart"]):
            result = ejecta("run", IMPACT_2D, "--out", self.out, *settings(COARSE), *more)
            self.assertEqual(result.returncode, 2)
            self.assertRegex(result.stderr, rf"expected a folder that no run is using, got that of process {self.process.pid} on \S+$")
        self.assertTrue(files <= set(self.out.rglob("*")))
        self.process.kill()
        self.process.wait()
        self.assertTrue((self.out / "run.lock").exists())
        self.run_scene(IMPACT_2D, "run", {**COARSE, "time.max_steps": 2}, "--overwrite")
        self.assertIn(f"process {self.process.pid} on", self.log())
        self.assertFalse((self.out / "run.lock").exists())
        # Locks may not reach from one host to another.
        (self.out / "run.lock").write_text("process 12 on another-host\n")
        result = ejecta("run", IMPACT_2D, "--out", self.out, *settings(COARSE), "--overwrite")
        self.assertEqual(result.returncode, 2)
        self.assertIn("another-host; if that process is gone, remove run.lock", result.stderr)

    def test_killed_at_random_times(self):
        values = {**COARSE, "resolution.spacing": "2mm", "time.end": "600us", "output.checkpoint_interval": "0.2s",
                  "output.snapshots": 6, "fragments.enabled": "false"}
        whole = self.run_scene(IMPACT_2D, "whole", values)
        chance = random.Random(time.time_ns())
        for more in ([], ["--restart"], ["--restart"]):
            self.start(values, *more)
            self.wait_for(lambda: list(self.out.glob("checkpoints/checkpoint_*.h5")))
            time.sleep(chance.uniform(0, 1))
            self.process.kill()
            self.process.wait()
        out = self.run_scene(IMPACT_2D, "run", values, "--restart")
        self.assertEqual((out / "history.csv").read_text(), (whole / "history.csv").read_text())
        names = [sorted(file.name for file in (folder / "snapshots").iterdir()) for folder in (out, whole)]
        self.assertEqual(names[0], names[1])

    def test_checkpoints_that_are_damaged(self):
        values = {**COARSE, "time.max_steps": 40, "time.end": "10us", "output.checkpoint_every": "1us"}
        out = self.run_scene(IMPACT_2D, "run", values)
        history = (out / "history.csv").read_text()
        *_, before, newest = sorted((out / "checkpoints").iterdir())
        newest.write_bytes(newest.read_bytes()[:-9])
        self.run_scene(IMPACT_2D, "run", values, "--restart")
        self.assertRegex(self.last.stderr, rf"W .*{newest.name}: .*; the checkpoint before it is used")
        self.assertIn(f"restarted from {before.name}", self.last.stderr)
        self.assertTrue(newest.with_name(newest.name + ".aside").exists())
        self.assertEqual((out / "history.csv").read_text(), history)
        both = sorted((out / "checkpoints").glob("*.h5"))
        for file in both:
            file.write_bytes(b"nothing")
        result = ejecta("run", IMPACT_2D, "--out", out, *settings(values), "--restart")
        self.assertEqual(result.returncode, 2)
        for file in both:
            self.assertIn(file.name, result.stderr)


if __name__ == "__main__":
    unittest.main()
