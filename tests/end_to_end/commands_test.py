"""The commands beside `run`: check, describe, info, movie, replay, and the help of each."""
import re
import tomllib
import unittest
from ejecta_run import IMPACT_2D, IMPACT_3D, SOD, SOURCE, RunTest, ejecta, movie_frames, settings

COARSE = {"basalt_impact": "3 mm", "gasgun_tube": "3 mm", "he_tube": "6 mm", "pumice_impact": "4 mm", "rubber_balls_3d": "4 mm", "tensile_rod_3d": "0.7 mm",
          "blast_10kt": "50 cm", "blast_block": "20 cm", "blast_hybrid": "40 cm"}
SECTION = re.compile(r"^\[+([\w.<>]+)\]+ ")
KEY = re.compile(r"^  (\S+) +\S")


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
        for command in ("run", "check", "reference", "describe", "control", "movie", "fragments", "replay", "info"):
            self.assertIn(command, overview.stdout)
            result = ejecta(command, "--help")
            self.assertEqual(result.returncode, 0)
            self.assertIn("Usage:", result.stdout)
        version = ejecta("--version")
        self.assertEqual(version.returncode, 0)
        self.assertRegex(version.stdout, r"^ejecta \d+\.\d+\.\d+\n$")
        info = ejecta("info")
        self.assertEqual(info.returncode, 0)
        self.assertRegex(info.stdout, r"ejecta \d+\.\d+")

    def test_a_mistyped_command_is_answered_with_the_nearest(self):
        for typed, meant in (("rnu", "run"), ("chekc", "check"), ("contol", "control")):
            result = ejecta(typed, "scene.toml")
            self.assertEqual(result.returncode, 2)
            self.assertEqual(result.stderr, f'ejecta: expected a command, got "{typed}", did you mean {meant}?\n')
        self.assertIn("--help lists them", ejecta("xyzzy").stderr)

    def test_the_script_adds_its_commands(self):
        script = (SOURCE / "ejecta").read_text()
        names = {"EJECTA_LAUNCHER": re.search(r"EJECTA_LAUNCHER='([^']*)'", script)[1]}
        overview = ejecta("--help", environment=names).stdout
        for command in ("test", "report", "fuzz"):
            self.assertRegex(script, rf"(?m)^  {command}\) ")
            self.assertRegex(overview, rf"(?m)^  {command} ")
        self.assertIn("did you mean report?", ejecta("repotr", environment=names).stderr)

    def test_check_of_a_gas_lists_what_a_gas_needs(self):
        result = ejecta("check", SOD)
        self.assertEqual(result.returncode, 0, result.stderr)
        columns = result.stdout.split("columns\n")[1].split("estimate\n")[0]
        self.assertIn("pressure", columns)
        names = [line.split()[0] for line in columns.splitlines()]
        for word in ("stress", "damage", "distension", "flaw", "crack", "plastic", "gradient", "switch", "compression_rate"):
            self.assertFalse([name for name in names if word in name])

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
        sections = reference()
        self.assertTrue({"scene", "resolution", "time", "bodies", "numerics", "insitu", "random", "run"} <= set(sections))
        keys = [f"{section}.{key}" for section, keys in sections.items() for key in keys]
        self.assertGreater(len(keys), 40)
        defaults, of_grids = {}, {}
        for path in keys:
            section, key = path.rsplit(".", 1)
            default = re.search(r"; default (.+)$", sections[section][key])
            # Bodies have names; the dimension belongs to their shapes; a scene need not be a blast, nor on a grid.
            others = (section in ("bodies", "bodies.profile", "insitu.ranges", "charge", "gas", "grid", "hybrid")
                      or section.startswith("materials"))
            if default and not others and path != "scene.dimension":
                defaults[path] = default[1].strip('"')
            if default and section in ("grid", "hybrid"):
                of_grids[path] = default[1].strip('"')
        self.assertGreater(len(defaults), 30)
        self.assertGreater(len(of_grids), 8)
        result = ejecta("check", SOURCE / "inputs" / "blast_hybrid.toml", *settings(of_grids))
        self.assertEqual(result.returncode, 0, result.stderr)
        result = ejecta("check", IMPACT_2D, *settings(defaults))
        self.assertEqual(result.returncode, 0, result.stderr)
        for name in ("scene.name", "resolution.spacing", "time.end", "numerics.scheme", "numerics.precision",
                     "numerics.nodes_per_h", "insitu.enabled", "insitu.frames", "run.threads", "random.seed"):
            self.assertIn(name, keys)

    def test_every_shipped_scene_is_accepted(self):
        scenes = sorted((SOURCE / "inputs").glob("*.toml"))
        self.assertGreater(len(scenes), 15)
        for scene in scenes:
            with self.subTest(scene.stem):
                coarse = {"resolution.spacing": COARSE[scene.stem]} if scene.stem in COARSE else {}
                result = ejecta("check", scene, *settings(coarse | {"time.max_steps": 2}))
                self.assertEqual(result.returncode, 0, result.stderr)
                self.assertEqual(tomllib.loads(scene.read_text())["scene"]["name"], scene.stem)

    def test_a_folder_without_images_has_no_movie(self):
        result = ejecta("movie", self.folder)
        self.assertEqual(result.returncode, 2)
        self.assertIn(f"{self.folder}: expected a run folder with images, found none", result.stderr)

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
