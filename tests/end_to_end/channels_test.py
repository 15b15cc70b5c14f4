"""Of all that scripts may read, a frame makes what the scene's scripts do read."""
import unittest
from ejecta_run import IMPACT_2D, SOURCE, RunTest, Table

FRAMES = 3
VALUES = {"resolution.spacing": "4mm", "time.end": "5us", "insitu.frames": FRAMES, "insitu.max_share": 1,
          "insitu.image_width": 320, "insitu.image_height": 240}


class Channels(RunTest):
    def made(self, **more):
        """How often each channel was made in a run."""
        out = self.run_scene(IMPACT_2D, "run", {**VALUES, **more})
        timers = Table(out / "timers.csv")
        counts = dict(zip(timers["name"], map(int, timers["calls"])))
        return {name: counts.get(f"in situ: {name}", 0) for name in ("particles", "slice", "ellipsoids", "fragments")}

    def test_default_scripts(self):
        self.assertEqual(self.made(), {"particles": FRAMES, "slice": FRAMES, "ellipsoids": 0, "fragments": FRAMES})

    def test_ellipses(self):
        self.assertEqual(self.made(**{"insitu.pipelines": f'["{SOURCE}/catalyst_scripts/ellipses.py"]'}),
                         {"particles": 0, "slice": 0, "ellipsoids": FRAMES, "fragments": 0})


if __name__ == "__main__":
    unittest.main()
