"""Catalyst scripts as their users write them: their triggers, arguments, helpers and mistakes."""
import json
import shutil
import unittest
from pathlib import Path
from ejecta_run import IMPACT_2D, RunTest, Table, ejecta, summary
from scripts import HEAD, SHORT, WRITES


class Pipelines(RunTest):
    def script(self, name, text):
        (self.folder / name).write_text(text)

    def writes(self, name, what="1", channel="particles"):
        self.script(f"{name}.py", WRITES.format(name=name, what=what, channel=channel))

    def run_with(self, pipelines, values=None, code=0, *more):
        """Runs the impact with a list of pipelines, as TOML, beside the scene."""
        scene = self.folder / "scene.toml"
        shutil.copy(IMPACT_2D, scene)
        return self.run_scene(scene, "run", {**SHORT, **(values or {}), "insitu.pipelines": pipelines}, *more, code=code)

    def rows(self, out):
        table = Table(out / "images/data.csv")
        return list(zip(map(int, table["step"]), table.numbers("time"), table["view"], table["reason"], table["FILE"]))

    def refused(self, pipelines, *words, values=None):
        out = self.run_with(pipelines, values, code=2)
        lines = self.last.stderr.splitlines()
        complaints = [line for line in lines if line.startswith("ejecta: ")]
        self.assertEqual(len(complaints), 1, self.last.stderr)
        for word in words:
            self.assertIn(word, complaints[0])
        self.assertFalse(out.exists())

    def test_triggers_of_a_script_that_the_gui_has_exported(self):
        shutil.copy(Path(__file__).parent / "gui_exported.py", self.folder)
        out = self.run_with('["gui_exported.py"]', {"time.end": "20us", "resolution.spacing": "3mm"})
        steps = summary(out)["steps"]
        self.assertGreater(steps, 100)
        pictures = [step for step, _, view, _, _ in self.rows(out) if view == "RenderView1"]
        self.assertEqual(pictures, list(range(0, steps + 1, 100)))
        times = [time for _, time, view, _, _ in self.rows(out) if view == "particles"]
        self.assertEqual(len(times), 5)  # every 5 us, at the step that is nearest
        for k, time in enumerate(times):
            self.assertAlmostEqual(time, k * 5e-6, delta=5e-7)
        self.assertEqual({reason for *_, reason, _ in self.rows(out)}, {"trigger of the script"})
        status = json.loads((out / "monitor/status.json").read_text())
        self.assertEqual([view["name"] for view in status["views"]], ["RenderView1"])
        self.assertIn("particles", [extract["name"] for extract in status["extracts"]])
        self.assertTrue((out / "movie_RenderView1.mp4").exists())
        self.assertEqual(summary(out)["images"], len(pictures))
        # Whatever name a pipeline gives to its files: they are of the run.
        again = ejecta("run", self.folder / "scene.toml", "--out", out, "--overwrite", "--set", "insitu.enabled=false",
                       "--set", "time.max_steps=1")
        self.assertEqual(again.returncode, 0, again.stderr)
        self.assertFalse(list(out.rglob("*.vtp")))

    def test_arguments_helpers_and_any_name(self):
        self.script("my_helper.py", 'word = "helped"\n')
        # Python has a module of this name already.
        self.writes("random", "catalyst.get_args(), __import__('my_helper').word")
        out = self.run_with('[{script = "random.py", args = ["--width", "3 cm"], every = "5 us"}]')
        written = sorted((out / "images").glob("random_*.txt"))
        self.assertEqual(len(written), 3)
        self.assertEqual(written[1].read_text(), "['--width', '3 cm'] helped\n")
        self.assertEqual([round(time * 1e6, 6) for _, time, _, reason, _ in self.rows(out)], [0, 5, 10])

    def test_every_pipeline_has_its_own_pace(self):
        for name in ("a", "b", "c"):
            self.writes(name)
        out = self.run_with('["a.py", {script = "b.py", every = "7 steps"}, {script = "c.py", every = "2.5 us"}]',
                            {"insitu.events": '["first contact"]', "insitu.burst": 2})
        steps = summary(out)["steps"]
        rows = {name: [(step, reason) for step, _, view, reason, _ in self.rows(out) if view == name] for name in "abc"}
        self.assertEqual([reason for _, reason in rows["a"]],
                         ["frame", "first contact", "after first contact", "after first contact", "frame", "frame"])
        self.assertEqual([step for step, _ in rows["b"]], sorted({*range(0, steps + 1, 7), steps}))
        self.assertEqual(len(rows["c"]), 5)
        contact = next(time for _, time, view, reason, _ in self.rows(out) if reason == "first contact")
        self.assertAlmostEqual(contact, 0.5e-3 / 2580, delta=0.4e-6)  # half a millimetre apart at the start

    def events_of_gas(self, sides, left, right, *more_bodies):
        """Two blocks of gas, 10 by 2.5 cm each, and more: pressures in bar."""
        body = """[[bodies]]
name = "{name}"
material = "gas"
shape = "rectangle"
center = ["{x} mm", "0 mm"]
size = ["{width} mm", "{height} mm"]
density = "1 kg/m^3"
pressure = "{bar} bar"
"""
        bodies = [("left", -50, 100, 25, left), ("right", 50, 100, 25, right), *more_bodies]
        text = "".join(body.format(**dict(zip(("name", "x", "width", "height", "bar"), b))) for b in bodies)
        (self.folder / "gas.toml").write_text(text + """
[scene]
name = "gas"
dimension = 2
[resolution]
spacing = "5 mm"
[time]
end = "0.2 ms"
[numerics]
density = "continuity"
smoothing_growth = 1
[materials.gas.eos]
model = "ideal_gas"
gamma = 1.4
density = "1 kg/m^3"
[boundary]
x = "SIDES"
y = "SIDES"
min = ["-300 mm", "-12.5 mm"]
max = ["300 mm", "12.5 mm"]
[insitu]
frames = 2
burst = 0
events = ["first contact", "peak pressure passed"]
pipelines = ["a.py"]
""".replace("SIDES", sides))
        self.writes("a")
        out = self.run_scene(self.folder / "gas.toml", "gas", {})
        return [reason for *_, reason, _ in self.rows(out)]

    def test_nothing_happens_in_gas_at_rest(self):
        self.assertEqual(self.events_of_gas("periodic", 1, 1, ("beyond", 200, 200, 25, 1), ("before", -200, 200, 25, 1)),
                         ["frame", "frame"])  # rounding is no contact

    def test_a_particle_on_its_own_holds_no_peak(self):
        reasons = self.events_of_gas("open", 10, 1, ("lone", 250, 5, 5, 50))
        self.assertEqual(reasons, ["frame", "first contact", "peak pressure passed", "frame"])

    def test_a_restart_goes_on_with_the_triggers(self):
        self.writes("a")
        triggers = {"insitu.events": '["first contact", "peak pressure passed"]', "insitu.burst": 0}
        whole = self.run_with('["a.py"]', triggers).rename(self.folder / "whole")
        half = [step for step, *_ in self.rows(whole)][-1] // 2
        self.run_with('["a.py"]', {**triggers, "time.max_steps": half})
        out = self.run_with('["a.py"]', {**triggers, "time.max_steps": 0}, 0, "--restart")
        rows = [row for row in self.rows(out) if row[3] != "end"]  # where the first part ended
        self.assertEqual(rows, self.rows(whole))
        self.assertEqual([reason for *_, reason, _ in rows].count("first contact"), 1)

    def test_pictures_do_not_change_the_result(self):
        self.writes("a")
        plain = self.run_with('["a.py"]').rename(self.folder / "plain")
        busy = self.run_with('[{script = "a.py", every = "step"}]',
                             {"insitu.events": '["first contact", "peak pressure passed"]', "insitu.every": '["3 steps"]'})
        before, after = Table(plain / "history.csv"), Table(busy / "history.csv")
        for column in ("step", "time", "dt", "kinetic energy", "internal energy", "max pressure", "damaged mass fraction"):
            self.assertEqual(before[column], after[column])

    def test_mistakes_are_found_before_the_first_step(self):
        self.script("imports.py", "# script-version: 2.0\nimport no_such_module\n")
        self.refused('["imports.py"]', "imports.py:2: ModuleNotFoundError: No module named 'no_such_module'")
        self.script("exits.py", "# script-version: 2.0\nraise SystemExit(0)\n")
        self.refused('["exits.py"]', "exits.py:2", "asked Python to exit, with 0")
        self.script("channel.py", HEAD.format(channel="input") + "    pass\n")
        known = "channel 'input' unknown; this run has particles, slice, ellipsoids, fragments"
        self.refused('["channel.py"]', known)
        exported = (Path(__file__).parent / "gui_exported.py").read_text()
        self.script("gui_channel.py", exported.replace("particles", "input"))
        self.refused('["gui_channel.py"]', known)
        # Also where no trigger fires at the first step.
        self.script("gui_field.py", exported.replace("'POINTS', 'pressure'", "'POINTS', 'presure'")
                    .replace("Frequency = 100", "UseStartTimeStep = 1\npNG1.Trigger.StartTimeStep = 90")
                    .replace("Length = 5e-6", "UseStartTimeValue = 1\nvTP1.Trigger.StartTimeValue = 1.0"))
        self.refused('["gui_field.py"]', "field 'presure' unknown; channel 'particles' has body,", "pressure")
        self.script("field.py", HEAD.format(channel="particles") + "    ejecta.View('a', 'a').spheres(source, 'heat')\n")
        self.refused('["field.py"]', "field.py:7: ValueError: field 'heat' unknown; this run has ", "damage")

    def test_later_failures_are_counted(self):
        self.script("later.py", HEAD.format(channel="particles") + "    if info.timestep > 0: exit(4)\n")
        self.writes("well")
        for on_error, failed, frames in (("warn", 2, 3), ("disable", 1, 2)):
            with self.subTest(on_error):
                out = self.run_with('["later.py", "well.py"]', {"insitu.on_error": on_error})
                self.assertEqual(summary(out)["pipelines"], {"later": {"frames": frames, "failures": failed},
                                                             "well": {"frames": 3, "failures": 0}})
                self.assertIn(f"pipeline later failed {failed} of {frames} frames", self.last.stderr)
                status = json.loads((out / "monitor/status.json").read_text())
                self.assertEqual(status["pipelines"][0], {"name": "later", "frames": frames, "failures": failed})
                shutil.rmtree(out)
        out = self.run_with('["later.py", "well.py"]', {"insitu.on_error": "abort"}, 3)
        self.assertIn("later.py:7: RuntimeError: the script asked Python to exit, with 4", self.last.stderr)

    def test_the_slice_carries_velocity_and_density(self):
        self.writes("fields", "[(f, ejecta.data_of(source).GetPointData().GetArray(f).GetNumberOfComponents()) "
                              "for f in ejecta.fields(source)]", "slice")
        out = self.run_with('["fields.py"]')
        fields = dict(eval((out / "images/fields_000000.txt").read_text()))
        self.assertEqual((fields["velocity"], fields["density"], fields["pressure"]), (3, 1, 1))


if __name__ == "__main__":
    unittest.main()
