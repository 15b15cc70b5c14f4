"""Probes read what is known: matter in a prescribed motion, gas at rest; and a restart reads the same."""
import math
import unittest
from ejecta_run import RunTest, SOURCE, Table, ejecta

RATE, SPEED = 2e4, 100.0  # 1/s, m/s

STRETCH = f"""
[scene]
name = "stretch"
dimension = 2
[resolution]
spacing = "1 mm"
[time]
end = "10 us"
[[bodies]]                    # keeps its velocity: x = x0 (1 + RATE t) + SPEED t
name = "strip"
material = "iron"
shape = "rectangle"
size = ["20 mm", "10 mm"]
driven = true
[bodies.profile]
velocity = ["{RATE}*x + {SPEED}", "0"]
[[probes]]
name = "rider"
kind = "tracer"
at = ["3.5 mm", "0.5 mm"]
direction = [1, 0]
interval = "0.5 us"
[[probes]]
name = "window"
kind = "tracer"
at = ["3.5 mm", "0.5 mm"]
interval = "0.5 us"
window = "0.5 us"
[[probes]]
name = "fixed"
at = ["2.3 mm", "1.1 mm"]
[[probes]]
name = "beam"
kind = "velocimeter"
at = ["30 mm", "0 mm"]
direction = [-1, 0]
[[probes]]
name = "short"
kind = "velocimeter"
at = ["30 mm", "0 mm"]
direction = [-1, 0]
range = "15 mm"
[[probes]]                    # of the four particles that its beam meets, the one on the axis
name = "face"
kind = "surface"
at = ["3.5 mm", "30 mm"]
direction = [0, -1]
spot = "2 mm"
interval = "0.5 us"
[[probes]]
name = "end"
kind = "surface"
at = ["30 mm", "0.5 mm"]
direction = [-1, 0]
[[probes]]
name = "outside"
at = ["50 mm", "0 mm"]
[insitu]
enabled = false
[output]
history_interval = "1 us"
"""

GAS = """
[scene]
name = "gas"
dimension = 2
[resolution]
spacing = "10 mm"
[time]
end = "20 us"
[numerics]
scheme = "fvm"
[gas]
material = "air"
pressure = "1 bar"
[boundary]
x = "reflecting"
y = "reflecting"
min = ["0 m", "0 m"]
max = ["0.1 m", "0.1 m"]
[[probes]]
name = "gauge"
at = ["33 mm", "52 mm"]
direction = [0, 1]
[insitu]
enabled = false
"""


class Probes(RunTest):
    def scene(self, name, text):
        file = self.folder / name
        file.write_text(text)
        return file

    def test_matter_in_prescribed_motion(self):
        out = self.run_scene(self.scene("stretch.toml", STRETCH), "run", {})
        rider = Table(out / "probe_rider.csv")
        time, strain, x = (rider.numbers(name) for name in ("time", "strain", "x"))
        self.assertGreater(len(time), 15)
        for t, e, place, velocity in zip(time, strain, x, rider.numbers("velocity")):
            self.assertAlmostEqual(e, RATE * t, delta=1e-4)
            self.assertAlmostEqual(place, 3.5e-3 * (1 + RATE * t) + SPEED * t, delta=1e-9)
            self.assertAlmostEqual(velocity, RATE * 3.5e-3 + SPEED, delta=1e-6)
        mean = Table(out / "probe_window.csv")
        for t, here, before in zip(time[2:-1], mean.numbers("x")[2:-1], x[2:-1]):
            self.assertAlmostEqual(before - here, 0.5 * (RATE * 3.5e-3 + SPEED) * 0.5e-6, delta=0.3 * 0.5 * 170 * 0.5e-6)
        fixed = Table(out / "probe_fixed.csv")
        for t, velocity in zip(fixed.numbers("time"), fixed.numbers("velocity x")):
            start = (2.3e-3 - SPEED * t) / (1 + RATE * t)  # of the matter that is there now
            self.assertAlmostEqual(velocity, RATE * start + SPEED, delta=1e-6 * SPEED)
        beam = Table(out / "probe_beam.csv")
        for t, velocity, distance in zip(*(beam.numbers(name) for name in ("time", "velocity", "distance"))):
            last = 9.5e-3  # the surface is half of a stretched spacing before the last column
            self.assertAlmostEqual(velocity, RATE * last + SPEED, delta=1e-6)
            self.assertAlmostEqual(distance, 30e-3 - (last * (1 + RATE * t) + SPEED * t) - 0.5e-3, delta=0.1e-3)
        face = Table(out / "probe_face.csv")
        for t, x, y, along in zip(*(face.numbers(name) for name in ("time", "x", "y", "velocity x"))):
            self.assertAlmostEqual(x, 3.5e-3 * (1 + RATE * t) + SPEED * t, delta=1e-9)
            self.assertAlmostEqual(y, 4.5e-3, delta=1e-12)  # half a spacing below the face
            self.assertAlmostEqual(along, RATE * 3.5e-3 + SPEED, delta=1e-6)
        self.assertNotIn("strain", face.names)
        end = Table(out / "probe_end.csv")
        for t, x, velocity in zip(*(end.numbers(name) for name in ("time", "x", "velocity"))):
            self.assertAlmostEqual(x, 9.5e-3 * (1 + RATE * t) + SPEED * t, delta=1e-9)
            self.assertAlmostEqual(velocity, RATE * 9.5e-3 + SPEED, delta=1e-6)
        self.assertTrue(all(math.isnan(v) for v in Table(out / "probe_short.csv").numbers("velocity")))
        self.assertTrue(all(math.isnan(p) for p in Table(out / "probe_outside.csv").numbers("pressure")))
        history = Table(out / "history.csv")
        self.assertAlmostEqual(history.numbers("probe beam velocity")[-1], RATE * 9.5e-3 + SPEED, delta=1e-6)
        self.assertTrue((out / "figures" / "probe_rider.png").is_file())
        mine = out / "probe_notes.csv"
        mine.write_text("mine")
        self.run_scene(self.scene("stretch.toml", STRETCH.replace('"rider"', '"tracer"')), "run", {}, "--overwrite")
        self.assertTrue(mine.is_file())
        self.assertFalse((out / "probe_rider.csv").exists())
        self.assertIn("probes.outside.at: the point sees nothing at t = 0 s: the nearest particle 40", (out / "run.log").read_text())

    def test_what_was_measured_is_compared(self):
        # Two points within the run, one beyond its end; the beam sees 290 m/s throughout.
        (self.folder / "trace.csv").write_text("time [s],velocity [m/s]\n1e-6,280\n3e-6,310\n20e-6,0\n")
        (self.folder / "masses.csv").write_text("mass [kg]\n0.1\nheavy\n")
        scene = self.scene("stretch.toml", STRETCH)
        out = self.run_scene(scene, "run", {"probes.beam.measured": "trace.csv", "probes.beam.measured_delay": "1us"})
        self.assertIn("probe beam: velocity is 15.81 m/s (rms; mean -5 m/s) off the 2 points", (out / "run.log").read_text())
        for command in ("check", "run"):
            arguments = ["--out", self.folder / "refused"] if command == "run" else []
            done = ejecta(command, scene, *arguments, "--set", "probes.beam.measured=masses.csv")
            self.assertEqual(done.returncode, 2)
            self.assertIn("masses.csv:1: expected a column time [s], got mass [kg]", done.stderr)
            three = SOURCE / "inputs" / "gasgun_tube.toml"
            done = ejecta(command, three, *arguments, "--set", f"fragments.measured={self.folder / 'masses.csv'}",
                          "--set", "resolution.spacing=4mm")
            self.assertEqual(done.returncode, 2)
            self.assertIn('masses.csv:3: mass: expected a number > 0, got "heavy"', done.stderr)

    def test_a_restart_reads_the_same(self):
        scene = self.scene("stretch.toml", STRETCH)
        whole = self.run_scene(scene, "whole", {})
        again = self.run_scene(scene, "again", {"time.max_steps": 25})
        done = ejecta("run", scene, "--out", again, "--restart", "--accept-changes")
        self.assertEqual(done.returncode, 0, done.stderr)
        for name in ("rider", "window", "fixed", "beam", "face"):
            self.assertEqual((whole / f"probe_{name}.csv").read_text(), (again / f"probe_{name}.csv").read_text(), name)

    def test_gas_on_a_grid(self):
        out = self.run_scene(self.scene("gas.toml", GAS), "gas", {})
        gauge = Table(out / "probe_gauge.csv")
        for pressure, velocity in zip(gauge.numbers("pressure"), gauge.numbers("velocity")):
            self.assertAlmostEqual(pressure, 1e5, delta=1e-3)
            self.assertAlmostEqual(velocity, 0, delta=1e-9)

    def test_what_makes_no_sense_is_refused(self):
        for change, complaint in (("probes.rider.at=[\"50 mm\",\"0 mm\"]", "expected a place within matter, got the nearest particle 40"),
                                  ("probes.beam.direction=[0,0,0]", "direction: missing: a velocimeter needs it"),
                                  ("probes.end.direction=[0,0,0]", "direction: missing: a surface needs it"),
                                  ("probes.end.direction=[1,0]", "probes.end.at: expected a beam that meets matter, got one that meets nothing"),
                                  ("probes.rider.at=[\"60 mm\",\"0 mm\"]", "stretch.toml:17: probes.rider.at: expected"),
                                  ("probes.rider.body=stripe", "expected the name of a body (strip), got \"stripe\""),
                                  ("probes.window.window=2us", "expected no more than the interval between rows, 500 ns, got 2 us"),
                                  ("probes.fixed.spot=1mm", "a point has none"),
                                  ("probes.fixed.range=1mm", "a point has none"),
                                  ("probes.fixed.measured=none.csv", "expected a CSV file, got \"none.csv\"")):
            for command in ("check", "run"):
                arguments = ["--out", self.folder / "refused"] if command == "run" else []
                done = ejecta(command, self.scene("stretch.toml", STRETCH), *arguments, "--set", change)
                self.assertEqual(done.returncode, 2, change)
                self.assertIn(complaint, done.stderr)


if __name__ == "__main__":
    unittest.main()
