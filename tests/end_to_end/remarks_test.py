"""What a scene asks for and does not get, or not well, is said by check, and by run in its log."""
import os
import unittest
from ejecta_run import IMPACT_2D, SOURCE, RunTest, ejecta, settings, summary

COARSE = {"resolution.spacing": "3mm", "insitu.enabled": "false", "time.max_steps": 1}
BLAST = SOURCE / "inputs" / "blast_1kt.toml"
DISC = """\
[scene]
name = "disc"
dimension = 2
[resolution]
spacing = "1 mm"
[time]
end = "1 us"
[boundary]
min = [0, "-5 mm"]
[[bodies]]
name = "ball"
material = "nylon"
shape = "disc"
radius = "1 cm"
"""


class Remarks(RunTest):
    def warnings(self, scene, values):
        """The warnings of check, without their times."""
        result = ejecta("check", scene, *settings({**COARSE, **values}))
        self.assertEqual(result.returncode, 0, result.stderr)
        return [line.split(" W ")[1] for line in result.stderr.splitlines() if " W " in line]

    def test_times_after_the_end(self):
        late = {"time.end": "20us", "output.times": '["5us","30us","21us"]', "insitu.times": '["1us","40us"]'}
        said = self.warnings(IMPACT_2D, late)
        self.assertEqual(said, ["insitu.times: 1 of 2 are after the end of the run, 20 us, and never come: 40 us",
                                "output.times: 2 of 3 are after the end of the run, 20 us, and never come: 21 us, ..."])
        log = (self.run_scene(IMPACT_2D, "late", {**COARSE, **late}) / "run.log").read_text()
        for text in said:
            self.assertIn(text, log)
        self.assertEqual(self.warnings(IMPACT_2D, {"time.end": "20us", "output.times": '["5us","20us"]'}), [])

    def test_more_threads_than_cores(self):
        cores = len(os.sched_getaffinity(0))
        out = self.run_scene(IMPACT_2D, "many", {**COARSE, "run.threads": 3000})
        self.assertIn(f"run.threads: 3000 asked for, {cores} taken", (out / "run.log").read_text())
        self.assertEqual(summary(out)["threads"], cores)
        self.assertEqual(self.warnings(IMPACT_2D, {"run.threads": cores}), [])

    def test_bodies_beyond_faces(self):
        scene = self.folder / "disc.toml"
        scene.write_text(DISC)
        coarse = {"resolution.spacing": "1mm"}
        cut = "ball: 20 % of it is beyond the {} face at y = -5 mm and is left out"  # (acos(1/2) - sqrt(3)/4) / pi
        for kind in ("reflecting", "symmetry"):
            self.assertEqual(self.warnings(scene, {**coarse, "boundary.y_min": kind}), [cut.format(kind)])
        self.assertEqual(self.warnings(scene, coarse), [], "particles go on beyond open faces")
        # Half a body at a plane of symmetry is all of it; at a wall it is half of it.
        self.assertEqual(self.warnings(scene, {**coarse, "boundary.x_min": "symmetry"}), [])
        self.assertEqual(self.warnings(scene, {**coarse, "boundary.x_min": "reflecting"}),
                         ["ball: 50 % of it is beyond the reflecting face at x = 0 m and is left out"])
        self.assertEqual(self.warnings(scene, {**coarse, "boundary.y_min": "reflecting", "boundary.min": '[0, "-1 cm"]'}), [],
                         "it touches the wall")

    def test_charge_of_few_cells(self):
        quarter = {"boundary.x_min": "symmetry", "boundary.y_min": "symmetry", "boundary.min": "[0, 0]",
                   "output.times": "[]"}
        box = {**quarter, "boundary.max": '["8 m", "8 m"]', "charge.start": "0 s"}
        for scheme, spacing, words in (("fvm", "20 cm", "the charge has a radius of 500 mm, 2.5 cells of 200 mm"),
                                       ("hybrid", "10 cm", "the charge has a radius of 500 mm, 2.5 cells of 200 mm"),
                                       ("gsph", "20 cm", "the charge has a radius of 500 mm, 2.5 particles of 200 mm")):
            said, = self.warnings(BLAST, {**box, "numerics.scheme": scheme, "resolution.spacing": spacing})
            self.assertIn(words, said)
        self.assertEqual(self.warnings(BLAST, {**box, "resolution.spacing": "12.5 cm"}), [])
        small = {**box, "numerics.scheme": "gsph", "boundary.max": '["2 m", "2 m"]'}
        self.assertEqual(len(self.warnings(BLAST, {**small, "resolution.spacing": "4.5 cm"})), 1, "11 particles")
        self.assertEqual(self.warnings(BLAST, {**small, "resolution.spacing": "4 cm"}), [], "12.5 particles")
        # Begun later, it is the shock that must be wide enough.
        self.assertEqual(self.warnings(BLAST, {**quarter, "resolution.spacing": "50 cm"}), [])
        said, = self.warnings(BLAST, {**quarter, "resolution.spacing": "50 cm", "charge.start": "2 us"})
        self.assertRegex(said, r"the shock that the run begins with has a radius of .* m?m, [123](\.\d+)? cells of 500 mm")


if __name__ == "__main__":
    unittest.main()
