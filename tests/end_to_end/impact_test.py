"""The 3D impact without a display: every output of a run folder, and what must add up in it."""
import math
import shutil
import tempfile
import unittest
from pathlib import Path
from ejecta_run import IMPACT_3D, SUMMARY_KEYS, Table, colours, ejecta, movie_frames, pixels, resolved, settings, summary

FRAMES = 4
VALUES = {"resolution.spacing": "4mm", "time.end": "30us", "insitu.frames": FRAMES, "insitu.max_share": 1,
          "insitu.pipelines": "[]", "insitu.image_width": 960, "insitu.image_height": 720}
VIEWS = ("cutaway", "fragments", "slice", "surface")


class Impact(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = Path(tempfile.mkdtemp(prefix="ejecta_test_"))
        cls.addClassCleanup(shutil.rmtree, cls.folder)
        cls.out = cls.folder / "run"
        cls.last = ejecta("run", IMPACT_3D, "--out", cls.out, *settings(VALUES), "--threads", 2)
        if cls.last.returncode != 0:
            raise AssertionError(cls.last.stderr)
        cls.summary = summary(cls.out)

    def test_summary(self):
        self.assertEqual(list(self.summary), SUMMARY_KEYS)
        self.assertIsNone(self.summary["cells"])
        for key, value in {"scene": "pumice_impact", "dimension": 3, "scheme": "sph", "precision": "double", "threads": 2,
                           "exit": 0, "images": FRAMES * len(VIEWS)}.items():
            self.assertEqual(self.summary[key], value, key)
        self.assertAlmostEqual(self.summary["time_s"], 30e-6, delta=1e-15)
        # Columns, records and lists, with those of contact and of the surroundings (stages_test.cpp has the parts).
        self.assertLess(self.summary["bytes_per_particle"], 1500)  # with AVX2; lists of wider clusters are shorter
        self.assertTrue(50 < self.summary["neighbours_mean"] < 90)
        self.assertEqual(self.summary["insitu_bytes_written"],
                         sum(file.stat().st_size for file in (self.out / "images").iterdir()))

    def test_conservation(self):
        self.assertEqual(self.summary["mass_error_rel"], 0)
        self.assertLess(self.summary["momentum_error_rel"], 1e-13)
        self.assertLess(abs(self.summary["energy_error_rel"]), 1e-12)
        worst = max(map(abs, Table(self.out / "history.csv").numbers("energy error")))
        self.assertLess(worst, 1e-12)

    def test_files(self):
        for name in ("resolved.toml", "run.log", "history.csv", "timers.csv", "fragments.csv",
                     "fragment_distribution.csv", "largest_fragment.csv", "monitor/index.html", "monitor/status.json",
                     "figures/compaction.csv", "figures/compaction.png"):
            self.assertGreater((self.out / name).stat().st_size, 0, name)
        self.assertTrue((self.out / "insitu.log").exists())  # empty if ParaView had nothing to say
        self.assertEqual(len(list((self.out / "checkpoints").glob("checkpoint_*.h5"))), 1)
        self.assertEqual(list(self.out.rglob("*.part")), [])

    def test_images_are_listed_and_filmed(self):
        index = Table(self.out / "images/data.csv")
        files = sorted(file.name for file in (self.out / "images").glob("*.png"))
        self.assertEqual(sorted(index["FILE"]), files)
        self.assertEqual(len(files), FRAMES * len(VIEWS))
        for view in VIEWS:
            times = [float(time) for time, name in zip(index["time"], index["view"]) if name == view]
            self.assertEqual(len(times), FRAMES)
            for k, time in enumerate(times):
                self.assertAlmostEqual(time, k * 10e-6, delta=1e-12)
            self.assertEqual(movie_frames(self.out / f"movie_{view}.mp4"), FRAMES, view)

    def test_images_show_the_object_whole(self):
        for file in (self.out / "images").glob("*.png"):
            width, height, rows = pixels(file)
            self.assertEqual((width, height), (960, 720), file)
            self.assertGreater(len({colour for row in rows for colour in colours(row)}), 30, file)
            # The object may throw out dust at the top, but never reaches the sides.
            background = colours(rows[height // 2])[0]
            for x in (0, width - 1):
                below = rows[round(0.06 * height):]  # the band with the title
                self.assertEqual({row[3 * x:3 * x + 3] for row in below}, {background}, file)
            middle = colours(rows[height // 2])
            self.assertGreater(sum(colour != background for colour in middle), width // 8, file)

    def test_colour_bars_never_change(self):
        # Where the bars with their numbers are: left, right, top, bottom in parts of the image.
        for view, (left, right, top, bottom) in {"slice": (0, 1, 0.83, 1), "cutaway": (0.93, 1, 0.2, 0.85),
                                                     "surface": (0.93, 1, 0.2, 0.85)}.items():
            bars = set()
            for file in (self.out / "images").glob(view + "_*.png"):
                width, height, rows = pixels(file)
                a, b = 3 * round(left * width), 3 * round(right * width)
                bars.add(b"".join(row[a:b] for row in rows[round(top * height):round(bottom * height)]))
            self.assertEqual(len(bars), 1, view)
            self.assertGreater(len(set(colours(bars.pop()))), 30, view)

    def test_fragments_add_up(self):
        table, history = Table(self.out / "fragments.csv"), Table(self.out / "history.csv")
        self.assertEqual(int(table["number"][-1]), 0)  # the dust
        self.assertEqual(len(table.rows) - 1, self.summary["fragments"])
        mass = table.numbers("mass")
        total = history.numbers("mass")[-1]
        self.assertAlmostEqual(math.fsum(mass), total, delta=1e-12 * total)
        self.assertEqual(sum(map(int, table["particles"])), self.summary["particles"])
        speed_scale = total * 2580
        for axis in "xyz":
            parts = (m * v for m, v in zip(mass, table.numbers("velocity " + axis)))
            self.assertAlmostEqual(math.fsum(parts), history.numbers("momentum " + axis)[-1], delta=1e-13 * speed_scale)
        self.assertAlmostEqual(table.numbers("mass fraction")[0], self.summary["largest_fragment_mass_fraction"], 14)

    def test_resolved_scene_runs_again_the_same(self):
        again = self.folder / "again"
        result = ejecta("run", self.out / "resolved.toml", "--out", again, "--threads", 1, "--set", "insitu.enabled=false")
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertEqual((again / "history.csv").read_bytes(), (self.out / "history.csv").read_bytes())
        self.assertEqual((again / "fragments.csv").read_bytes(), (self.out / "fragments.csv").read_bytes())
        self.assertFalse(list(again.rglob("*.mp4")))
        first, second = resolved(self.out), resolved(again)
        first["insitu"]["enabled"], first["run"]["threads"] = False, second["run"]["threads"]
        self.assertEqual(first, second)


if __name__ == "__main__":
    unittest.main()
