"""The commands beside `run`: check, describe, info, movie, replay, and the help of each."""
import re
import unittest
from ejecta_run import IMPACT_2D, IMPACT_3D, SOD, RunTest, ejecta, movie_frames

SECTION = re.compile(r"^\[+([\w.<>]+)\]+ ")
KEY = re.compile(r"^  (\S+) ")


def reference(*section):
    """{section: {key: text after it}} as `ejecta describe` prints it."""
    sections, key = {}, None
    for line in ejecta("describe", *section).stdout.splitlines():
        if found := SECTION.match(line):
            keys = sections.setdefault(found[1], {})
        elif found := KEY.match(line):
            key = found[1]
            keys[key] = ""
        elif key and line.strip():
            keys[key] += line.strip()
    return sections


class Commands(RunTest):
    def test_help_and_info(self):
        overview = ejecta("--help")
        self.assertEqual(overview.returncode, 0)
        for command in ("run", "check", "describe", "movie", "replay", "info"):
            self.assertIn(command, overview.stdout)
            result = ejecta(command, "--help")
            self.assertEqual(result.returncode, 0)
            self.assertIn("Usage:", result.stdout)
        info = ejecta("info")
        self.assertEqual(info.returncode, 0)
        self.assertRegex(info.stdout, r"ejecta \d+\.\d+")

    def test_check_of_a_gas_lists_what_a_gas_needs(self):
        result = ejecta("check", SOD)
        self.assertEqual(result.returncode, 0, result.stderr)
        columns = result.stdout.split("columns\n")[1].split("estimate\n")[0]
        self.assertIn("pressure", columns)
        for word in ("stress", "damage", "distension", "flaw", "crack", "plastic", "shear_switch", "density_rate"):
            self.assertNotIn(word, result.stdout)

    def test_check_of_the_impacts(self):
        for scene in (IMPACT_2D, IMPACT_3D):
            result = ejecta("check", scene)
            self.assertEqual(result.returncode, 0, result.stderr)
            for word in ("stages", "columns", "deviatoric_stress", "distension", "flaw_strain", "particles", "bytes a particle",
                         "steps", "wall time"):
                self.assertIn(word, result.stdout)
        particles = int(re.search(r"particles +(\d+)", result.stdout)[1])
        self.assertGreater(particles, 50_000)

    def test_every_key_described_is_accepted(self):
        """With its default, or with any value that is refused for another reason than being unknown."""
        sections = reference()
        self.assertTrue({"scene", "resolution", "time", "bodies", "numerics", "insitu", "random", "run"} <= set(sections))
        keys = [f"{section}.{key}" for section, keys in sections.items() for key in keys]
        self.assertGreater(len(keys), 40)
        accepted = 0
        for path in keys:
            section, key = path.rsplit(".", 1)
            if section in ("bodies", "insitu.ranges") or "<" in path or section.startswith("materials"):
                continue
            default = re.search(r"; default (.*?);", sections[section][key])
            if not default:
                continue
            result = ejecta("check", IMPACT_2D, "--set", f"{path}={default[1].strip(chr(34))}")
            if path != "scene.dimension":  # the shapes of the scene belong to its own
                self.assertEqual(result.returncode, 0, f"{path}: {result.stderr}")
            accepted += 1
        self.assertGreater(accepted, 30)
        for name in ("scene.name", "resolution.spacing", "time.end", "numerics.scheme", "numerics.precision",
                     "numerics.nodes_per_h", "insitu.enabled", "insitu.frames", "run.threads", "random.seed"):
            self.assertIn(name, keys)

    def test_movie_and_replay_of_a_run(self):
        out = self.run_scene(IMPACT_2D, "run", {"resolution.spacing": "4mm", "time.end": "5us", "insitu.frames": 3,
                                                "insitu.max_share": 1})
        movies = sorted(out.glob("movie_*.mp4"))
        self.assertTrue(movies)
        for movie in movies:
            movie.unlink()
        result = ejecta("movie", out, "--fps", 5)
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertEqual(sorted(out.glob("movie_*.mp4")), movies)
        for movie in movies:
            self.assertEqual(movie_frames(movie), 3)
        before = {path: path.read_bytes() for path in out.rglob("*") if path.is_file()}
        result = ejecta("replay", out, "--out", self.folder / "again")
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertEqual(before, {path: path.read_bytes() for path in out.rglob("*") if path.is_file()})
        last = max(path.name for path in (out / "images").glob("slice_*.png"))
        self.assertTrue((self.folder / "again/images" / last).exists())
        # Not a bit of the picture depends on when it is drawn.
        self.assertEqual((self.folder / "again/images" / last).read_bytes(), (out / "images" / last).read_bytes())


if __name__ == "__main__":
    unittest.main()
