"""A machine where nothing can be rendered: all data, slices drawn without OpenGL, and one line that says so."""
import unittest
from ejecta_run import IMPACT_2D, IMPACT_3D, RunTest, Table, colours, movie_frames, pixels, summary

VALUES = {"resolution.spacing": "4mm", "time.end": "10us", "insitu.frames": 3, "insitu.max_share": 1,
          "insitu.image_width": 960, "insitu.image_height": 720}
# Mesa loads its software renderer by this name.
NO_GL = {"GALLIUM_DRIVER": "no-such-driver"}


class NoGl(RunTest):
    def test_run_goes_on_without_it(self):
        for scene in (IMPACT_2D, IMPACT_3D):
            with self.subTest(scene.stem):
                out = self.run_scene(scene, scene.stem, VALUES, environment=NO_GL)
                self.assertEqual(sum("OpenGL" in line for line in self.last.stderr.splitlines()), 1)
                self.assertEqual((out / "run.log").read_text().count("OpenGL"), 1)
                self.assertEqual(summary(out)["exit"], 0)
                images = sorted((out / "images").glob("*.png"))
                self.assertEqual(len(images), 3)
                self.assertEqual(summary(out)["images"], 3)
                self.assertEqual(sorted(Table(out / "images/data.csv")["FILE"]), [file.name for file in images])
                for file in images:
                    width, height, rows = pixels(file)
                    self.assertEqual((width, height), (960, 720))
                    self.assertGreater(len(set(colours(rows[height // 2]) + colours(b"".join(rows[::8])))), 30)
                self.assertEqual(movie_frames(out / "movie_slice.mp4"), 3)
                for name in ("history.csv", "fragments.csv", "largest_fragment.csv", "monitor/index.html"):
                    self.assertTrue((out / name).exists(), name)

    def test_run_is_refused_if_the_scene_says_so(self):
        out = self.run_scene(IMPACT_2D, "run", {**VALUES, "insitu.on_error": "abort"}, code=2, environment=NO_GL)
        self.assertEqual(len(self.last.stderr.splitlines()), 1)
        self.assertIn("insitu.on_error", self.last.stderr)
        self.assertFalse(out.exists())


if __name__ == "__main__":
    unittest.main()
