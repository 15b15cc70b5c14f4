"""A blast on a grid as a user runs it: shock.csv, line-outs, times of output, channel, restart, threads."""
import unittest

from ejecta_run import SOURCE, RunTest, Snapshot, Table, ejecta, settings, summary
from scripts import WRITES

BLAST = SOURCE / "inputs" / "blast_1kt.toml"
VALUES = {"resolution.spacing": "80 cm", "charge.start": "20 us", "time.end": "225 us", "output.times": '["56 us", "100 us"]', "insitu.frames": 3,
          "insitu.max_share": 1, "insitu.image_width": 480, "insitu.image_height": 360}
COLUMNS = ("density", "momentum_x", "momentum_y", "energy")


class Blast(RunTest):
    def test_colours_of_a_blast_that_leaves_its_box(self):
        script = self.folder / "tells.py"
        script.write_text(WRITES.format(name="tells", what="ejecta.settings()['fields']['pressure']['range'][1]", channel="grid"))
        values = VALUES | {"insitu.pipelines": f'["{script}"]', "time.max_steps": 2, "output.times": "[]"}
        ranges = []
        for name, box in (("grows", {}), ("box", {"boundary.min": '["-8 m", "-8 m"]', "boundary.max": '["8 m", "16 m"]'})):
            out = self.run_scene(BLAST, name, values | box | {"time.end": "1 ms"})
            ranges.append(float(next((out / "images").glob("tells_*.txt")).read_text()))
        # 3/2 E/(pi r^2), rounded up: at 44 m, where the shock comes to, or at 16 m, where it is last seen
        self.assertAlmostEqual(ranges[0] / 1e9, 1.1, delta=0.05)
        self.assertAlmostEqual(ranges[1] / 1e9, 7.9, delta=0.05)

    def test_files_of_a_blast(self):
        script = self.folder / "peak.py"
        script.write_text("# script-version: 2.0\nfrom paraview import catalyst\nimport ejecta_view as ejecta\n"
                          "options = catalyst.Options()\nsource = ejecta.channel('grid')\n"
                          "def catalyst_execute(info):\n"
                          "    data = ejecta.data_of(source)\n"
                          f"    with open('{self.folder}/peaks', 'a') as out:\n"
                          "        print(data.GetPointData().GetArray('density').GetRange()[1],\n"
                          "              data.GetNumberOfPoints(), file=out)\n")
        out = self.run_scene(BLAST, "blast", VALUES | {"insitu.pipelines": f'["default", "{script}"]'})
        self.assertEqual((out / "shock.csv").read_text().splitlines()[0],
                         "time [s],radius [m],peak_density [kg/m^3],peak_pressure [Pa]")
        shock = Table(out / "shock.csv")
        times, radius = shock.numbers("time"), shock.numbers("radius")
        for time, reference in ((56e-6, 6.729), (100e-6, 10.578), (225e-6, 18.875)):  # ejecta reference
            self.assertIn(time, [float(f"{t:.12g}") for t in times])
            at = min(range(len(times)), key=lambda k: abs(times[k] - time))
            self.assertLess(abs(radius[at] / reference - 1), 0.1)  # at cells larger than the charge
        self.assertEqual(len(list((out / "lineouts").glob("lineout_*.csv"))), 3)
        end = summary(out)
        snapshots = sorted((out / "snapshots").glob("*.h5"))
        self.assertEqual(len(snapshots), 2)
        density = Snapshot(sorted((out / "checkpoints").glob("*.h5"))[-1]).column("grid.density")
        self.assertEqual(len(density), end["cells"])
        self.assertEqual(end["particles"], 0)
        self.assertGreater(end["cell_steps_per_s"], 0)
        self.assertLess(end["mass_error_rel"], 1e-13)
        self.assertLess(end["momentum_error_rel"], 1e-13)
        self.assertLess(abs(end["energy_error_rel"]), 1e-13)
        # Frames: three equally spaced, and the two times.
        frames = sorted((out / "images").glob("slice_*.png"))
        self.assertEqual(len(frames), 5)
        peaks = [line.split() for line in (self.folder / "peaks").read_text().splitlines()]
        self.assertEqual(len(peaks), 5)
        self.assertEqual(float(peaks[-1][0]), max(density))
        self.assertEqual(int(peaks[-1][1]), end["cells"])
        last = Table(sorted((out / "lineouts").glob("*.csv"))[-1]).numbers("density")
        self.assertLessEqual(max(last), max(density))
        self.assertEqual(Table(out / "profile.csv").numbers("density"), last)
        self.assertTrue((out / "figures/profile.png").exists())

    def test_restart_and_threads_change_no_bit(self):
        values = VALUES | {"insitu.enabled": "false", "output.times": "[]"}
        whole = self.run_scene(BLAST, "whole", values, "--threads", 2)
        parts = self.run_scene(BLAST, "parts", values | {"time.max_steps": 40}, "--threads", 1)
        result = ejecta("run", BLAST, "--out", parts, "--threads", 1, "--restart", *settings(values))
        self.assertEqual(result.returncode, 0, result.stderr)
        a, b = (Snapshot(sorted((out / "checkpoints").glob("*.h5"))[-1]) for out in (whole, parts))
        for name in COLUMNS:
            self.assertEqual(a.column("grid." + name), b.column("grid." + name), name)
        self.assertEqual(Table(whole / "history.csv").rows[-1], Table(parts / "history.csv").rows[-1])
        self.assertEqual(Table(whole / "shock.csv").rows[-1], Table(parts / "shock.csv").rows[-1])

    def test_what_is_refused(self):
        for values, words in (({"fragments.enabled": "true"}, "a fluid has no pieces"),
                              ({"charge.energy": "1 J"}, "charge.energy"),
                              ({"gas.material": "iron"}, "only a gas can be given one"),
                              ({"grid.riemann": "roe"}, "hllc, exact")):
            with self.subTest(words):
                result = ejecta("check", BLAST, *settings(values))
                self.assertEqual(result.returncode, 2)
                self.assertIn(words, result.stderr)
        result = ejecta("check", SOURCE / "inputs" / "sod.toml", "--set", "grid.courant=0.5")
        self.assertEqual(result.returncode, 2)
        self.assertIn('numerics.scheme = "fvm"', result.stderr)


if __name__ == "__main__":
    unittest.main()
