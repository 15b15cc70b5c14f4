"""What a scene does not need costs nothing: each feature adds exactly its stages, columns and bytes."""
import sys
import tempfile
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))
import cost  # noqa: E402
from features import CASES, COMPONENTS, bytes_of, gas  # noqa: E402

CHECKS = ["time step", "integration", "health", "tables", "monitor", "checkpoints"]  # what every run does


class CostTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.checked = {case.name: cost.check(case) for case in CASES}
        cls.runs = {case.name: cls.one_step(case) for case in CASES}

    @staticmethod
    def one_step(case, **settings):
        with tempfile.TemporaryDirectory(prefix="ejecta_cost_") as folder:
            return cost.run(case, Path(folder) / "run", time__end="1e-18 s", time__max_steps=1,
                            resolution__spacing="4 mm", **settings)

    def test_the_stages_are_those_asked_for(self):
        for case in CASES:
            with self.subTest(case.name):
                self.assertEqual(self.checked[case.name][0], case.stages)

    def test_a_run_spends_time_in_these_stages_only(self):
        for case in CASES:
            with self.subTest(case.name):
                self.assertEqual(set(self.runs[case.name][1]) - set(CHECKS), set(case.stages))

    def test_the_columns_are_those_asked_for(self):
        for case in CASES:
            with self.subTest(case.name):
                self.assertEqual(self.checked[case.name][1], {c: COMPONENTS.get(c, 1) for c in case.columns})

    def test_a_gas_has_nothing_of_a_solid(self):
        solid = ("stress", "damage", "crack", "flaw", "distension", "plastic")
        self.assertEqual([c for c in self.checked[gas.name][1] if any(word in c for word in solid)], [])

    def test_memory_grows_by_these_columns_only(self):
        # A step so short that nothing moves, and smoothing lengths that do not grow: pair lists are then the same for
        # all cases of a scene, and memory differs by what the features ask for.
        runs = {case.name: self.one_step(case, numerics__smoothing_growth=1)[0] for case in CASES}
        for case in CASES:
            if case.settings.get("numerics.precision") == "mixed" or isinstance(case.base, Path):
                continue
            with self.subTest(case.name):
                memory, of_base = (runs[name]["bytes_per_particle"] for name in (case.name, case.base.name))
                columns = bytes_of(case.columns) - bytes_of(case.base.columns)
                self.assertAlmostEqual(memory - of_base, columns + case.other_bytes, delta=1e-9)
                estimated = self.checked[case.name][2] - self.checked[case.base.name][2]
                self.assertEqual(estimated, columns)

    def test_mixed_precision_takes_no_more_memory(self):
        for case in CASES:
            if case.settings.get("numerics.precision") != "mixed":
                continue
            with self.subTest(case.name):
                memory, of_double = (self.runs[name][0]["bytes_per_particle"] for name in (case.name, case.base.name))
                self.assertLess(memory, of_double)


if __name__ == "__main__":
    unittest.main()
