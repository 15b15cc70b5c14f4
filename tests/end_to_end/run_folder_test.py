"""--overwrite replaces an earlier run and nothing else."""
import os
import unittest
from ejecta_run import IMPACT_2D, RunTest, ejecta, settings, summary

QUICK = {"resolution.spacing": "4mm", "time.max_steps": 3, "insitu.enabled": "false", "run.threads": 1}


class RunFolder(RunTest):
    def run_in(self, out, *more, scene=IMPACT_2D, cwd=None, environment=None):
        return ejecta("run", scene, "--out", out, *settings(QUICK), *more, cwd=cwd, environment=environment)

    def contents(self, folder):
        return {path: path.read_bytes() for path in folder.rglob("*") if path.is_file()}

    def refused(self, out, reason, **more):
        before = self.contents(self.folder)
        result = self.run_in(out, "--overwrite", **more)
        self.assertEqual(result.returncode, 2, result.stderr)
        self.assertEqual(len(result.stderr.splitlines()), 1, result.stderr)
        self.assertIn(reason, result.stderr)
        self.assertEqual(before, self.contents(self.folder))

    def earlier_run(self, name):
        return self.run_scene(IMPACT_2D, name, {**QUICK, "output.snapshots": 100, "time.max_steps": 60})

    def test_folders_that_hold_no_run(self):
        there = self.folder / "there"
        (there / "below").mkdir(parents=True)
        (there / "below" / "thesis.tex").write_text("precious\n")
        self.refused(there, "other files")
        (there / "resolved.toml").write_text("a file of this name alone is no run\n")
        self.refused(there, "other files")

    def test_folders_of_the_scene_and_the_process(self):
        run = self.earlier_run("run")  # even where they hold a run
        (run / "scene.toml").write_bytes(IMPACT_2D.read_bytes())
        (run / "below").mkdir()
        self.refused(run, "scene", scene=run / "scene.toml")
        self.refused(run, "scene", scene=run / "resolved.toml")
        self.refused(".", "scene", scene="scene.toml", cwd=run)
        self.refused(".", "working directory", cwd=run)
        self.refused("..", "working directory", cwd=run / "below")
        self.refused(run, "home", environment={"HOME": str(run)})
        self.refused("/", "around it", cwd="/")

    def test_only_what_a_run_writes_is_replaced(self):
        out = self.earlier_run("run")
        self.assertTrue(list((out / "snapshots").iterdir()))
        own = [out / "notes.txt", out / "images" / "for the paper.png", out / "figures" / "mine" / "energy.png"]
        for file in own:
            file.parent.mkdir(exist_ok=True)
            file.write_text("precious\n")
        (out / "checkpoints" / "checkpoint_000000000099.h5.part").write_text("half of one\n")
        (out / "movie_slice.mp4").write_text("of the earlier run\n")
        result = self.run_in(out, "--overwrite")
        self.assertEqual(result.returncode, 0, result.stderr)
        for file in own:
            self.assertEqual(file.read_text(), "precious\n")
        self.assertEqual(summary(out)["steps"], 3)
        self.assertEqual([file.name for file in (out / "checkpoints").iterdir()], ["checkpoint_000000000003.h5"])
        self.assertFalse((out / "snapshots").exists())
        self.assertFalse((out / "movie_slice.mp4").exists())

    def test_empty_and_new_folders(self):
        (self.folder / "empty").mkdir()
        for name in ("empty", "new"):
            self.assertEqual(self.run_in(self.folder / name, "--overwrite").returncode, 0)

    def test_links_stay_links(self):
        run, images = self.earlier_run("elsewhere"), self.folder / "large disk"
        images.mkdir()
        (run / "images").rmdir()
        (run / "images").symlink_to(images)
        link = self.folder / "run"
        link.symlink_to(run)
        result = self.run_in(link, "--overwrite")
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertTrue(link.is_symlink() and (run / "images").is_symlink())
        self.assertEqual(os.readlink(link), str(run))
        self.assertEqual(summary(run)["steps"], 3)


if __name__ == "__main__":
    unittest.main()
