"""The result of a run does not depend on the number of threads, not by a bit."""
import unittest
from ejecta_run import IMPACT_2D, IMPACT_3D, RunTest

SCENES = {IMPACT_2D: {"resolution.spacing": "2mm", "time.end": "20us"},
          IMPACT_3D: {"resolution.spacing": "4mm", "time.end": "10us"}}


class Threads(RunTest):
    def test_histories_and_fragments_are_identical(self):
        for scene, values in SCENES.items():
            for precision in ("double", "mixed"):
                with self.subTest(scene=scene.stem, precision=precision):
                    values = {**values, "insitu.enabled": "false", "numerics.precision": precision}
                    name = f"{scene.stem}_{precision}"
                    one, two = (self.run_scene(scene, f"{name}_{n}", values, "--threads", n) for n in (1, 2))
                    for file in ("history.csv", "fragments.csv"):
                        self.assertEqual((one / file).read_bytes(), (two / file).read_bytes())
                    self.assertGreater((one / "history.csv").read_bytes().count(b"\n"), 50)

    def test_precisions_differ(self):
        """Otherwise the test above would compare the same passes twice."""
        values = {**SCENES[IMPACT_2D], "time.end": "2us", "insitu.enabled": "false"}
        double, mixed = (self.run_scene(IMPACT_2D, p, {**values, "numerics.precision": p}) for p in ("double", "mixed"))
        self.assertNotEqual((double / "history.csv").read_bytes(), (mixed / "history.csv").read_bytes())


if __name__ == "__main__":
    unittest.main()
