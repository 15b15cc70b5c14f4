"""States of a run shown to other pipelines, and exported."""
import unittest
from pathlib import Path
from ejecta_run import IMPACT_2D, RunTest, Table, ejecta
from scripts import HEAD, SHORT, WRITES


class Replay(RunTest):
    def a_run(self):
        return self.run_scene(IMPACT_2D, "run", {**SHORT, "insitu.enabled": "false", "output.snapshots": 2, "insitu.events": '["first contact"]'})

    def test_states_through_new_pipelines(self):
        out = self.a_run()
        script = self.folder / "new.py"
        script.write_text(WRITES.format(name="new", what="catalyst.get_args()", channel="particles"))
        for more, count in (((), 1), (("--at", "4us"), 1), (("--all",), 2)):
            with self.subTest(more):
                to = self.folder / f"replay{len(more)}{count}"
                result = ejecta("replay", out, "--pipeline", script, "--out", to, *more)
                self.assertEqual(result.returncode, 0, result.stderr)
                table = Table(to / "images/data.csv")
                self.assertEqual(len(table.rows), count)
                self.assertAlmostEqual(table.numbers("time")[0], 10e-6 if not more else 5e-6, delta=1e-11)
                self.assertEqual(set(table["reason"]), {"frame"})  # no event: nothing happens here
        gui = Path(__file__).parent / "gui_exported.py"
        result = ejecta("replay", out, "--pipeline", gui, "--out", self.folder / "gui", "--at", "4us")
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertEqual(len(list((self.folder / "gui/images").glob("RenderView1_*.png"))), 1)

    def test_no_image_is_an_error(self):
        out = self.a_run()
        script = self.folder / "nothing.py"
        script.write_text(HEAD.format(channel="particles") + "    pass\n")
        result = ejecta("replay", out, "--pipeline", script)
        self.assertEqual(result.returncode, 2)
        self.assertIn("0 images: pipeline nothing was run 1 times, failed 0 times and wrote nothing", result.stderr)
        result = ejecta("replay", out, "--set", "time.end=1us")
        self.assertEqual(result.returncode, 2)
        self.assertIn("--set time.end=1us: expected a key of [insitu]", result.stderr)

    def test_export(self):
        out = self.a_run()
        result = ejecta("export", out, "--all")
        self.assertEqual(result.returncode, 0, result.stderr)
        collection = (out / "export/particles.pvd").read_text()
        self.assertEqual(collection.count("<DataSet"), 2)
        self.assertEqual(len(list((out / "export").glob("particles_*.vtp"))), 2)
        result = ejecta("export", out, "--all", "--format", "xdmf", "--out", self.folder / "xdmf")
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertEqual([file.name for file in (self.folder / "xdmf").glob("*.xmf")], ["particles.xmf"])
        self.assertEqual((self.folder / "xdmf/particles.xmf").read_text().count("<Time "), 2)


if __name__ == "__main__":
    unittest.main()
