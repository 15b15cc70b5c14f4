"""What cannot be written ends no run: it is said once, tried again, and the run ends with exit code 3 and the reason."""
import contextlib
import json
import os
import resource
import shutil
import subprocess
import time
import unittest
from ejecta_run import IMPACT_2D, PROGRAM, RunTest, Table, settings, summary

COARSE = {"resolution.spacing": "4mm", "time.max_steps": 30, "insitu.enabled": "false", "run.threads": 1,
          "output.history_interval": "1ns"}
# Long enough to be disturbed in the middle.
DRAWN = {"resolution.spacing": "2mm", "time.end": "120us", "insitu.frames": 13, "insitu.max_share": 1, "run.threads": 1,
         "insitu.image_width": 320, "insitu.image_height": 240}


def complaints(log):
    """Lines of the log that are more than information."""
    return [line for line in log.splitlines() if line[9:11] != "I "]


class OutputFailure(RunTest):
    def run_with_files_up_to(self, most, name, values):
        """No file may grow beyond `most` bytes."""
        out = self.folder / name
        run = subprocess.run([PROGRAM, "run", IMPACT_2D, "--out", out, *settings(values)], text=True, timeout=120,
                             capture_output=True,
                             preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (most, most)))
        return out, run

    def start(self, out, values):
        run = subprocess.Popen([PROGRAM, "run", IMPACT_2D, "--out", out, *settings(values)], text=True,
                               stdout=subprocess.DEVNULL, stderr=subprocess.PIPE)
        self.addCleanup(run.stderr.close)
        self.addCleanup(run.kill)
        return run

    def wait_for(self, run, ready):
        give_up = time.monotonic() + 60
        while not ready() and run.poll() is None and time.monotonic() < give_up:
            time.sleep(0.02)
        self.assertTrue(ready())

    def test_a_run_that_cannot_begin(self):
        for most, name in ((0, "run.lock"), (4000, "resolved.toml")):
            out, run = self.run_with_files_up_to(most, f"most_{most}", COARSE)
            self.assertEqual(run.returncode, 3, run.stderr)
            self.assertEqual(len(run.stderr.splitlines()), 1, run.stderr)
            self.assertRegex(run.stderr, f"ejecta: .*/{name}: cannot be written: File too large")

    def test_files_that_grow_too_large(self):
        failed = set()
        for most in (20_000, 50_000, 100_000):
            with self.subTest(most):
                out, run = self.run_with_files_up_to(most, f"most_{most}", {**COARSE, "output.snapshots": 400,
                                                                             "time.max_steps": 90})
                self.assertEqual(run.returncode, 3, run.stderr)
                self.assertIn("step     90 ", run.stderr)  # it went on to its end
                self.assertEqual((summary(out)["state"], summary(out)["exit"], summary(out)["steps"]), ("failed", 3, 90))
                missing = summary(out)["not_written"]
                self.assertIn("File too large", summary(out)["reason"])
                names = [sentence.split(":")[0] for sentence in missing]
                for name in names:  # once when it begins, once at the end
                    self.assertLessEqual(len([line for line in complaints(run.stderr) if name.split(".")[0] in line]), 2)
                self.assertEqual(list(out.rglob("*.part")), [])
                failed |= set(names)
                lines = (out / "history.csv").read_text().splitlines()
                self.assertTrue(all(line.count(",") == lines[0].count(",") for line in lines))
        self.assertTrue({"checkpoints", "history.csv", "monitor", "snapshots"} <= failed, failed)

    def test_checkpoints_that_cannot_be_written_at_any_length(self):
        # HDF5 writes in pieces, and each of them may be the one that fails.
        for most in range(30_000, 130_000, 20_000):
            with self.subTest(most):
                out, run = self.run_with_files_up_to(most, f"most_{most}", {**COARSE, "time.max_steps": 2})
                self.assertEqual(run.returncode, 3, run.stderr)
                self.assertEqual([sentence.split(":")[0] for sentence in summary(out)["not_written"]], ["checkpoints"])
                self.assertNotIn("HDF5", run.stderr)

    def test_folders_that_are_removed(self):
        for name in ("monitor", "images", "checkpoints", "."):
            with self.subTest(name):
                out = self.folder / f"run_{name.strip('.')}"
                run = self.start(out, {**DRAWN, "time.end": "200us", "insitu.frames": 41,
                                       "output.checkpoint_interval": "1s"})
                self.wait_for(run, lambda: len(list(out.glob("images/slice*.png"))) > 2 and (out / name).exists())
                shutil.rmtree(out / name, ignore_errors=True)
                _, log = run.communicate(timeout=120)
                # A frame that was being drawn is lost, nothing else.
                missing = summary(out)["not_written"]
                self.assertTrue(all(sentence.startswith("images: 1 not written") for sentence in missing), missing)
                self.assertEqual(run.returncode, 3 if missing else 0, log)
                self.assertEqual(json.loads((out / "monitor/status.json").read_text())["exit"], run.returncode)
                for file in ("monitor/index.html", "resolved.toml", "run.log", "movie_slice.mp4"):
                    self.assertTrue((out / file).exists(), file)
                self.assertEqual(float(Table(out / "history.csv")["time"][0]), 0)
                self.assertTrue(list(out.glob("checkpoints/checkpoint_*.h5")))
                self.assertEqual(sorted(Table(out / "images/data.csv")["FILE"]),
                                 sorted(file.name for file in out.glob("images/*.png")))

    def test_no_room_for_temporary_files(self):
        out = self.run_scene(IMPACT_2D, "run", {**DRAWN, "time.max_steps": 3}, environment={"TMPDIR": "/proc"})
        self.assertTrue(list(out.glob("images/fragments*.png")))
        self.assertEqual(complaints(self.last.stderr), [])

    def test_a_full_disk(self):
        disk = self.folder / "disk"
        disk.mkdir()
        if subprocess.run(["mount", "-t", "tmpfs", "-o", "size=1m", "tmpfs", disk], capture_output=True).returncode != 0:
            self.skipTest("a small disk can be mounted by root alone")
        self.addCleanup(subprocess.run, ["umount", "-l", disk])
        run = self.start(disk / "run", DRAWN)
        _, log = run.communicate(timeout=120)
        self.assertEqual(run.returncode, 3, log)
        self.assertNotIn("libpng", log)
        begins = [line for line in log.splitlines() if line[9:11] == "W " and "No space left on device; the run goes on" in line]
        self.assertEqual(len([line for line in begins if "/images/" in line]), 1, log)
        self.assertIn("E images: ", log)
        self.assertIn("t     120 us of 120 us", log)

    def test_a_disk_that_is_full_for_a_while(self):
        # A file where the folder of checkpoints should be stands for any obstacle.
        out = self.folder / "run"
        run = self.start(out, {**COARSE, "resolution.spacing": "2mm", "time.max_steps": 3000, "output.checkpoint_interval": "0.3s",
                               "time.end": "10ms"})
        self.wait_for(run, lambda: list(out.glob("checkpoints/checkpoint_*.h5")))
        while not (out / "history.csv").is_dir():  # the run may write a row between the two
            (out / "history.csv").unlink(missing_ok=True)
            with contextlib.suppress(FileExistsError):
                (out / "history.csv").mkdir()
        self.wait_for(run, lambda: "history.csv: cannot be written" in (out / "run.log").read_text())
        (out / "history.csv").rmdir()
        _, log = run.communicate(timeout=120)
        self.assertEqual(run.returncode, 0, log)
        self.assertEqual(len(complaints(log)), 1, log)
        self.assertIn("history.csv: written again", log)
        self.assertEqual([int(step) for step in Table(out / "history.csv")["step"]], list(range(3001)))

    def test_a_folder_without_permission(self):
        if os.geteuid() == 0:
            self.skipTest("root may write everywhere")
        closed = self.folder / "closed"
        closed.mkdir(mode=0o500)
        _, run = self.run_with_files_up_to(resource.RLIM_INFINITY, "closed/run", COARSE)
        self.assertEqual(run.returncode, 2, run.stderr)
        self.assertRegex(run.stderr, r"ejecta: .*/closed: expected a folder to write to, got no permission")

    def test_a_terminal_that_has_gone(self):
        out = self.folder / "run"
        with open("/dev/full", "w") as full:
            run = subprocess.run([PROGRAM, "run", IMPACT_2D, "--out", out, *settings(COARSE)], stdout=full,
                                 stderr=subprocess.PIPE, text=True, timeout=120)
        self.assertEqual(run.returncode, 0, run.stderr)
        self.assertTrue((out / "summary.json").exists())


if __name__ == "__main__":
    unittest.main()
