#!/usr/bin/env python3
"""An installation works wherever it is moved to, with its own materials, scenes and pipelines."""
import os
import subprocess
import unittest
from pathlib import Path

from ejecta_run import PROGRAM, SOURCE, RunTest, settings, summary

TINY = settings({"resolution.spacing": "3 mm", "time.end": "0.5 us", "insitu.frames": 2,
                 "insitu.pipelines": '["default", "ellipses.py"]'})


class Installation(RunTest):
    def setUp(self):
        super().setUp()
        first, moved = self.folder / "first", self.folder / "moved"
        subprocess.run(["cmake", "--install", Path(PROGRAM).parent, "--prefix", first], check=True, capture_output=True)
        first.rename(moved)
        self.program, self.data = moved / "bin" / "ejecta", moved / "share" / "ejecta"

    def run_program(self, *arguments):
        environment = {name: value for name, value in os.environ.items() if name != "EJECTA_DATA"}
        done = subprocess.run([self.program, *map(str, arguments)], cwd=self.folder, env=environment,
                              capture_output=True, text=True, timeout=300)
        self.assertEqual(done.returncode, 0, done.stderr)
        return done.stdout

    def test_a_moved_installation_runs_its_own_scene(self):
        self.assertIn(f"materials {self.data}/inputs/materials\n", self.run_program("info"))
        self.run_program("run", self.data / "inputs" / "pumice_impact_2d.toml", "--out", "run", *TINY)
        run = self.folder / "run"
        self.assertEqual(summary(run)["exit"], 0)
        self.assertTrue((run / "monitor" / "index.html").is_file())
        self.assertTrue(list((run / "images").glob("ellipses_*.png")), "no image by a shipped pipeline")

    def test_no_path_of_the_source_tree_is_compiled_in(self):
        words = subprocess.run(["strings", self.program], check=True, capture_output=True, text=True).stdout
        self.assertEqual([line for line in words.splitlines() if str(SOURCE) in line], [])


if __name__ == "__main__":
    unittest.main()
