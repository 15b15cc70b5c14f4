"""A blast with particles at its front as a user runs it: balances, shock.csv, pictures, restart, threads, what is refused."""
import unittest

from ejecta_run import SOURCE, RunTest, Snapshot, Table, ejecta, settings, summary

BLAST = SOURCE / "inputs" / "blast_1kt.toml"
VALUES = {"numerics.scheme": "hybrid", "resolution.spacing": "40 cm", "charge.start": "50 us", "boundary.x_min": "symmetry",
          "boundary.y_min": "symmetry", "boundary.min": '["0 m", "0 m"]', "time.end": "120 us", "output.times": "[]",
          "insitu.frames": 3, "insitu.max_share": 1, "insitu.image_width": 480, "insitu.image_height": 360}


WALL = SOURCE / "inputs" / "blast_block.toml"
WALL_VALUES = {"resolution.spacing": "25 cm", "time.end": "4.5 ms", "insitu.frames": 3, "insitu.max_share": 1,
               "insitu.image_width": 480, "insitu.image_height": 360}


class Hybrid(RunTest):
    def test_a_blast(self):
        out = self.run_scene(BLAST, "blast", VALUES)
        end, shock = summary(out), Table(out / "shock.csv")
        self.assertLess(abs(shock.numbers("radius")[-1] / 12.13 - 1), 0.02)  # ejecta reference
        self.assertLess(end["mass_error_rel"], 1e-13)
        self.assertLess(end["momentum_error_rel"], 1e-13)
        self.assertLess(abs(end["energy_error_rel"]), 1e-13)
        history = Table(out / "history.csv")
        self.assertGreater(min(history.numbers("particles")), 500)
        self.assertGreater(min(history.numbers("zone")), 50)
        self.assertEqual(len(list((out / "images").glob("slice_*.png"))), 3)

    def test_a_wall(self):
        out = self.run_scene(WALL, "wall", WALL_VALUES)
        end = summary(out)
        self.assertLess(end["mass_error_rel"], 1e-13)
        self.assertLess(abs(end["energy_error_rel"]), 1e-13)
        self.assertEqual(end["fragment_target"], "wall")
        history = Table(out / "history.csv")
        self.assertGreater(history.numbers("solids: max pressure")[-1], 5e6)  # the wave is in the wall
        self.assertGreater(history.numbers("solids: damaged mass fraction")[-1], 0)
        self.assertEqual(len(list((out / "images").glob("slice_*.png"))), 3)
        self.assertEqual(len(list((out / "images").glob("fragments_*.png"))), 3)

    def test_restart_and_threads_change_no_bit(self):
        columns = ["grid.density", "grid.energy", "gas.mass", "gas.position_0", "gas.velocity_1", "gas.specific_energy"]
        for scene, values, names in ((BLAST, VALUES, columns),
                                     (WALL, WALL_VALUES, [*columns, "position_0", "velocity_1", "damage"])):
            with self.subTest(scene.stem):
                values = values | {"insitu.enabled": "false"}
                whole = self.run_scene(scene, "whole_" + scene.stem, values, "--threads", 2)
                parts = self.run_scene(scene, "parts_" + scene.stem, values | {"time.max_steps": 20}, "--threads", 1)
                result = ejecta("run", scene, "--out", parts, "--threads", 1, "--restart", *settings(values))
                self.assertEqual(result.returncode, 0, result.stderr)
                a, b = (Snapshot(sorted((out / "checkpoints").glob("*.h5"))[-1]) for out in (whole, parts))
                for name in names:
                    self.assertEqual(a.column(name), b.column(name), name)
                self.assertEqual(Table(whole / "history.csv").rows[-1], Table(parts / "history.csv").rows[-1])

    def test_what_is_refused(self):
        for values, words in (({"hybrid.ratio": 3}, "expected a power of two, got 3"),
                              ({"gas.material": "iron"}, "only a gas can be given one"),
                              ({"numerics.density": "continuity"}, "numerics.density: expected summation"),
                              ({"hybrid.jump": 0}, "hybrid.jump"),
                              ({"numerics.scheme": "fvm", "hybrid.ratio": 2}, 'expected numerics.scheme = "hybrid" with it')):
            with self.subTest(words):
                result = ejecta("check", BLAST, *settings(VALUES | values))
                self.assertEqual(result.returncode, 2)
                self.assertIn(words, result.stderr)


if __name__ == "__main__":
    unittest.main()
