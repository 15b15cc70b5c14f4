"""A signal ends a run in good order, and --restart goes on as if nothing had happened."""
import os
import signal
import subprocess
import time
import unittest

import h5py

from ejecta_run import IMPACT_2D, PROGRAM, SOURCE, RunTest, Table, ejecta, movie_frames, settings, summary

# Long enough to be caught in the middle and to sort the particles several times.
VALUES = {"resolution.spacing": "2mm", "time.end": "100us", "insitu.frames": 6, "insitu.max_share": 1,
          "insitu.image_width": 480, "insitu.image_height": 360}


class Restart(RunTest):
    def interrupted(self, name, number, values, after):
        """Starts a run and sends it the signal once it has passed the simulated time `after` [s]."""
        out = self.folder / name
        run = subprocess.Popen([PROGRAM, "run", IMPACT_2D, "--out", out, "--threads", "1", *settings(values)],
                               stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
        give_up = time.monotonic() + 120
        while run.poll() is None and time.monotonic() < give_up:
            try:
                if float(Table(out / "history.csv").rows[-1][0]) > after:
                    break
            except (OSError, IndexError, ValueError):
                pass
            time.sleep(0.02)
        os.kill(run.pid, number)
        _, log = run.communicate(timeout=60)
        self.assertEqual(run.returncode, 4, log)
        self.assertIn("stopped by a signal", log)
        return out

    def test_signals(self):
        whole = self.run_scene(IMPACT_2D, "whole", VALUES, "--threads", 1)
        for number in (signal.SIGINT, signal.SIGTERM):
            with self.subTest(number.name):
                out = self.interrupted(number.name, number, VALUES, after=30e-6)
                stopped = summary(out)
                self.assertEqual(stopped["exit"], 4)
                self.assertTrue(30e-6 < stopped["time_s"] < 100e-6)
                checkpoint, = (out / "checkpoints").glob("checkpoint_*.h5")
                self.assertIn(str(stopped["steps"]), checkpoint.name)
                frames = sorted((out / "images").glob("slice_*.png"))
                self.assertEqual(int(frames[-1].stem.split("_")[1]), stopped["steps"])
                self.assertEqual(movie_frames(out / "movie_slice.mp4"), len(frames))

                result = ejecta("run", IMPACT_2D, "--out", out, "--threads", 2, "--restart", *settings(VALUES))
                self.assertEqual(result.returncode, 0, result.stderr)
                self.assert_same_end(out, whole)
                after = sorted((out / "images").glob("slice_*.png"))
                self.assertGreater(len(after), len(frames))
                self.assertEqual(movie_frames(out / "movie_slice.mp4"), len(after))
                self.assertEqual((out / "images/data.csv").read_text(), (whole / "images/data.csv").read_text())
                for image in (whole / "images").glob("*.png"):
                    self.assertEqual((out / "images" / image.name).read_bytes(), image.read_bytes(), image.name)
                self.assertEqual((out / "figures/compaction.csv").read_text(),
                                 (whole / "figures/compaction.csv").read_text())
                self.assertEqual(sorted(Table(out / "images/data.csv")["FILE"]),
                                 sorted(file.name for file in (out / "images").glob("*.png")))

    def test_a_checkpoint_with_the_former_names_of_fields(self):
        values = VALUES | {"insitu.enabled": "false", "time.max_steps": 60}
        whole = self.run_scene(IMPACT_2D, "whole", values, "--threads", 1)
        out = self.run_scene(IMPACT_2D, "former", values | {"time.max_steps": 30}, "--threads", 1)
        checkpoint, = (out / "checkpoints").glob("*.h5")
        former = {"specific_energy_rate": "heating", "previous_specific_energy_rate": "previous_heating",
                  "zeroth_moment": "neighbour_sum", "largest_mu": "approach_speed", "crack_length": "crack"}
        with h5py.File(checkpoint, "r+") as file:
            for now, then in former.items():
                file["columns"].move(now, then)
        with open(checkpoint, "r+b") as file:
            file.write(b" " * 512)  # they had no checksum
        result = ejecta("run", IMPACT_2D, "--out", out, "--threads", 1, "--restart", *settings(values))
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertEqual(Table(out / "history.csv").rows[-1], Table(whole / "history.csv").rows[-1])

    def test_volumes_that_fill_space(self):
        scene = SOURCE / "tests/verification/sod/gsph.toml"
        values = {"resolution.spacing": "2.5mm", "time.max_steps": 60}
        whole = self.run_scene(scene, "whole", values, "--threads", 1)
        ends = {}
        for name, fills in (("same", "auto"), ("without", "false")):
            begun = values | {"time.max_steps": 30, "numerics.fill_space": fills}
            self.run_scene(scene, name, begun, "--threads", 2)
            out = self.run_scene(scene, name, values, "--threads", 1, "--restart", "--accept-changes")
            ends[name] = Table(out / "history.csv").rows[-1]
        self.assertEqual(ends["same"], Table(whole / "history.csv").rows[-1])
        # A run that had none, as all had once, goes on with volumes by number.
        self.assertEqual(ends["without"][1], ends["same"][1])
        self.assertNotEqual(ends["without"], ends["same"])

    def assert_same_end(self, out, whole):
        """Bit for bit, in the last row and in all rows but what the pieces were at the last frame."""
        ours, theirs = Table(out / "history.csv"), Table(whole / "history.csv")
        self.assertEqual(ours.rows[-1], theirs.rows[-1])
        state = theirs.names.index("largest fragment mass fraction")
        self.assertEqual([row[:state] for row in ours.rows], [row[:state] for row in theirs.rows])
        self.assertEqual(summary(out)["largest_fragment_mass_fraction"], summary(whole)["largest_fragment_mass_fraction"])


if __name__ == "__main__":
    unittest.main()
