#!/usr/bin/env python3
"""What the README tells a newcomer to write runs as it says: the scene, with the view of ten lines."""
import re
import unittest

from ejecta_run import SOURCE, RunTest, summary


class Readme(RunTest):
    def test_scene_and_view(self):
        text = (SOURCE / "README.md").read_text()
        for kind, name in (("toml", "my_scene.toml"), ("python", "my_view.py")):
            block, = re.findall(rf"```{kind}\n(.*?)```", text, re.S)
            (self.folder / name).write_text(block)
        run = self.run_scene(self.folder / "my_scene.toml", "run", {
            "insitu.pipelines": '["default", "my_view.py"]', "time.end": "2us", "insitu.frames": 2})
        self.assertEqual(summary(run)["exit"], 0)
        self.assertEqual(len(list((run / "images").glob("energy_*.png"))), 2)
        self.assertTrue((run / "movie_energy.mp4").is_file())


if __name__ == "__main__":
    unittest.main()
