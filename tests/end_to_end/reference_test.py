#!/usr/bin/env python3
"""`ejecta reference`: the one-dimensional solution of a scene, its files, its table and its refusals."""
import math
import re
import unittest

from ejecta_run import SOD, RunTest, Table, ejecta, settings

BLAST = """\
[scene]
name = "blast"
dimension = 2

[resolution]
spacing = "20 cm"

[time]
end = "1 ms"

[charge]
radius = "50 cm"
density = "1.225 kg/m^3"
energy_per_length = "4.184e12 J/m"

[gas]
density = "1.225 kg/m^3"
pressure = "102 kPa"

[numerics]
scheme = "fvm"

[output]
times = ["100 us", "500 us", "5 ms"]
"""
SHOCK_COLUMNS = ["time [s]", "radius [m]", "peak_density [kg/m^3]", "peak_pressure [Pa]"]


class Reference(RunTest):
    def setUp(self):
        super().setUp()
        self.scene = self.folder / "blast.toml"
        self.scene.write_text(BLAST)

    def reference(self, *arguments, scene=None, code=0):
        result = ejecta("reference", scene or self.scene, *arguments, cwd=self.folder)
        self.assertEqual(result.returncode, code, result.stderr)
        return result

    def refused(self, *arguments, part):
        before = {path: path.read_bytes() for path in self.folder.rglob("*") if path.is_file()}
        result = self.reference(*arguments, code=2)
        self.assertEqual(result.stdout, "")
        self.assertEqual(len(result.stderr.splitlines()), 1, result.stderr)
        self.assertIn(part, result.stderr)
        self.assertEqual(before, {path: path.read_bytes() for path in self.folder.rglob("*") if path.is_file()})

    def test_files_and_table_of_a_blast(self):
        result = self.reference("--spacing", "10cm")
        out = self.folder / "runs/blast_reference"
        self.assertEqual(sorted(path.name for path in out.iterdir()), ["profile.csv", "shock.csv"])
        self.assertEqual((out / "shock.csv").read_text().splitlines()[0].split(","), SHOCK_COLUMNS)
        header = (out / "profile.csv").read_text().splitlines()[0]
        self.assertEqual(header, "time [s],radius [m],density [kg/m^3],velocity [m/s],pressure [Pa],specific energy [J/kg]")
        shock, profile = Table(out / "shock.csv"), Table(out / "profile.csv")
        times = shock.numbers("time")
        self.assertEqual(times, sorted(times))
        self.assertEqual(len(times), 200)  # the times of output are among the two hundred; what is after the end is not
        self.assertEqual(times[-1], 1e-3)
        self.assertEqual(sorted(set(profile.numbers("time"))), [1e-4, 5e-4, 1e-3])
        # The charge is as dense as the gas, and so nearly a point source: Sedov, R = 43.1625 m at the end.
        self.assertAlmostEqual(shock.numbers("radius")[-1] / 43.1625, 1, delta=3e-3)
        self.assertAlmostEqual(shock.numbers("radius")[times.index(5e-4)] / 43.1625, math.sqrt(0.5), delta=3e-3)
        # Pressure is (gamma - 1) rho e in every row.
        for rho, e, p in zip(*map(profile.numbers, ("density", "specific energy", "pressure"))):
            self.assertAlmostEqual(p / (0.4 * rho * e), 1, delta=1e-12)
        for word in ("cylindrical", "cells of 100 mm", "Richardson", "Sedov", "mass error", "energy error", "wall time"):
            self.assertIn(word, result.stdout)
        last = re.search(r"^ +1 ms +(\S+) +(\S+) +(\S+) % +(\S+) ", result.stdout, re.M)
        coarse, fine, change, limit = map(float, last.groups())
        self.assertAlmostEqual(fine, shock.numbers("radius")[-1], delta=1e-4)
        self.assertAlmostEqual(change, 100 * (fine / coarse - 1), delta=1e-3)
        self.assertAlmostEqual(limit, 2 * fine - coarse, delta=3e-4)
        for mass, energy in re.findall(r"^ +\d+ mm +\d+ +\S+ +(\S+) +(\S+) ", result.stdout, re.M):
            self.assertLess(abs(float(mass)), 1e-13)
            self.assertLess(abs(float(energy)), 1e-13)

    def test_a_later_reference_replaces_an_earlier_one_and_nothing_else(self):
        out = self.folder / "out"
        self.reference("--spacing", "20cm", "--out", out)
        before = (out / "profile.csv").read_text()
        self.reference("--spacing", "25cm", "--out", out)
        self.assertNotEqual(before, (out / "profile.csv").read_text())
        self.reference("--out", out, "--spacing", "2cm", scene=SOD)
        self.assertEqual([path.name for path in out.iterdir()], ["profile.csv"])  # there is no shock.csv of a tube
        (out / "mine.txt").write_text("precious")
        self.refused("--spacing", "20cm", "--out", out, part="mine.txt")
        self.refused("--spacing", "20cm", "--out", self.scene, part="expected a folder")

    def test_the_same_numbers_again(self):
        for name in ("a", "b"):
            self.reference("--spacing", "20cm", "--out", name)
        for file in ("profile.csv", "shock.csv"):
            self.assertEqual((self.folder / "a" / file).read_bytes(), (self.folder / "b" / file).read_bytes())

    def test_riemanns_problem(self):
        result = self.reference("--out", "sod", "--spacing", "5mm", scene=SOD)
        self.assertTrue((self.folder / "sod/profile.csv").read_text().startswith("time [s],x [m],density"))
        self.assertIn("p* 0.30313 Pa, u* 0.927453 m/s, densities 0.426319 and 0.265574 kg/m^3", result.stdout)
        errors = result.stdout.split("mean absolute error")[1].splitlines()[2].split()
        self.assertEqual(errors[:2], ["200", "ms"])
        coarse, fine, order = map(float, errors[2:5])
        self.assertLess(fine, 0.004)
        self.assertAlmostEqual(math.log2(coarse / fine), order, delta=0.01)
        self.assertGreater(order, 0.7)

    def test_geometry_is_a_choice(self):
        self.assertIn("spherical", self.reference("--spacing", "20cm", "--geometry", "spherical").stdout)

    def test_wrong_input(self):
        self.refused("--spacing", "5 kg", part="--spacing: expected a length")
        self.refused("--spacing", "0 m", part="--spacing: expected a length > 0")
        self.refused("--spacing", "60 cm", part="--spacing: expected at most the radius of the charge")
        self.refused("--geometry", "conical", part="--geometry: expected planar, cylindrical or spherical")
        self.refused(*settings({"charge.radius": "-1 m"}), part="charge.radius")
        self.refused(*settings({"charge.material": '"water"'}), part="expected one material")
        self.assertEqual(ejecta("reference", self.folder / "none.toml").returncode, 2)
        self.assertEqual(ejecta("reference").returncode, 2)


if __name__ == "__main__":
    unittest.main()
