"""A disk that is full or gone ends a run with exit code 3 and one line that names the file and the reason."""
import json
import resource
import shutil
import subprocess
import time
import unittest
from ejecta_run import IMPACT_2D, PROGRAM, RunTest, settings

COARSE = {"resolution.spacing": "4mm", "time.max_steps": 30, "insitu.enabled": "false", "run.threads": 1,
          "output.history_interval": "1ns"}


class OutputFailure(RunTest):
    def run_with_files_up_to(self, most, name, values):
        """No file may grow beyond `most` bytes."""
        out = self.folder / name
        run = subprocess.run([PROGRAM, "run", IMPACT_2D, "--out", out, *settings(values)], text=True, timeout=120,
                             capture_output=True,
                             preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (most, most)))
        return out, run

    def check(self, out, run, reason):
        """Returns the name of the file that could not be written."""
        self.assertEqual(run.returncode, 3, run.stderr)
        complaints = [line for line in run.stderr.splitlines() if line[2:3] != ":"]  # the log begins with the hour
        self.assertEqual(len(complaints), 1, run.stderr)
        self.assertTrue(complaints[0].startswith("ejecta: "), complaints[0])
        self.assertIn(reason, complaints[0])
        if (out / "monitor/status.json").exists():
            status = json.loads((out / "monitor/status.json").read_text())
            self.assertEqual((status["state"], status["exit"]), ("failed", 3))
        self.assertEqual(list(out.rglob("*.part")), [])
        return complaints[0].removeprefix("ejecta: ").split(": ")[0].rsplit("/", 1)[-1]

    def test_files_that_grow_too_large(self):
        failed = set()
        for most in (0, 4000, 12_000, 20_000, 50_000, 100_000):
            with self.subTest(most):
                out, run = self.run_with_files_up_to(most, f"most_{most}", {**COARSE, "output.snapshots": 40})
                failed.add(self.check(out, run, "File too large").split("_")[0])
        self.assertTrue({"resolved.toml", "index.html", "snapshot"} <= failed, failed)

    def test_checkpoints_that_cannot_be_written_at_any_length(self):
        # HDF5 writes in pieces, and each of them may be the one that fails.
        for most in range(30_000, 130_000, 20_000):
            with self.subTest(most):
                out, run = self.run_with_files_up_to(most, f"most_{most}", {**COARSE, "time.max_steps": 2})
                self.assertTrue(self.check(out, run, "File too large").startswith("checkpoint_"))

    def test_a_folder_that_goes_away(self):
        out = self.folder / "run"
        run = subprocess.Popen([PROGRAM, "run", IMPACT_2D, "--out", out, *settings({**COARSE, "time.max_steps": 0,
                                "resolution.spacing": "2mm", "time.end": "10ms"})], text=True,
                               stdout=subprocess.DEVNULL, stderr=subprocess.PIPE)
        self.addCleanup(run.kill)
        give_up = time.monotonic() + 60
        while not (out / "monitor/status.json").exists() and time.monotonic() < give_up:
            time.sleep(0.05)
        shutil.move(out, self.folder / "moved")
        _, log = run.communicate(timeout=60)
        self.assertEqual(run.returncode, 3, log)
        self.assertIn("cannot be written: No such file or directory", log.splitlines()[-1])

    def test_a_terminal_that_has_gone(self):
        out = self.folder / "run"
        with open("/dev/full", "w") as full:
            run = subprocess.run([PROGRAM, "run", IMPACT_2D, "--out", out, *settings(COARSE)], stdout=full,
                                 stderr=subprocess.PIPE, text=True, timeout=120)
        self.assertEqual(run.returncode, 0, run.stderr)
        self.assertTrue((out / "summary.json").exists())


if __name__ == "__main__":
    unittest.main()
