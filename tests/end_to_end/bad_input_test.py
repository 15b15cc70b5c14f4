"""Wrong input ends with exit code 2, one clear line, and nothing written."""
import re
import unittest
from ejecta_run import RunTest, ejecta


SCENE = """\
[scene]
name = "two_discs"
dimension = 2

[resolution]
spacing = "1 mm"

[time]
end = "100 us"

[[bodies]]
name = "target"
material = "pumice"
shape = "disc"
radius = "35 mm"

[[bodies]]
name = "projectile"
material = "nylon"
shape = "disc"
center = ["0 mm", "39 mm"]
radius = "3.5 mm"

[insitu]
frames = 40
view_size = "120 mm"

[fragments]
enabled = true
"""


class BadInput(RunTest):
    def setUp(self):
        super().setUp()
        self.scene = self.folder / "scene.toml"
        self.scene.write_text(SCENE)

    def edit(self, old, new):
        text = self.scene.read_text()
        self.assertIn(old, text)
        self.scene.write_text(text.replace(old, new, 1))
        return 1 + text[:text.index(old)].count("\n")  # the line it is on

    def refused(self, *parts, arguments=(), out="run", lines=1):
        """The run ends with code 2 and one line that holds all parts; the folder is as it was. So does the check of the
        scene, unless it is the folder that is wrong."""
        before = {path: path.read_bytes() for path in self.folder.rglob("*") if path.is_file()}
        result = ejecta("run", "scene.toml", "--out", out, *arguments, cwd=self.folder)
        self.assertEqual(result.returncode, 2, result.stderr)
        self.assertEqual(result.stdout, "")
        self.assertEqual(len(result.stderr.splitlines()), lines, result.stderr)
        for part in parts:
            self.assertIn(part, result.stderr)
        self.assertEqual(before, {path: path.read_bytes() for path in self.folder.rglob("*") if path.is_file()})
        self.assertFalse((self.folder / "run").exists())
        if out == "run":
            check = ejecta("check", "scene.toml", *arguments, cwd=self.folder)
            said = [re.sub(r"[\d.]+ GB of free", "GB of free", text) for text in (check.stderr, result.stderr)]
            self.assertEqual((check.returncode, check.stdout, said[0]), (2, "", said[1]))

    def test_unknown_key(self):
        line = self.edit("view_size", "veiw_size")
        self.refused(f"scene.toml:{line}: insitu.veiw_size: unknown key, did you mean insitu.view_size?")

    def test_unknown_section(self):
        line = self.edit("[fragments]", "[fragmnets]")
        self.refused(f"scene.toml:{line}: fragmnets: unknown section, did you mean fragments?")

    def test_all_errors_at_once(self):
        first, second = self.edit("1 mm", "1 kg"), self.edit("frames = 40", "frames = -3")
        self.refused(f"scene.toml:{first}: resolution.spacing:", f"scene.toml:{second}: insitu.frames:", lines=2)

    def test_wrong_unit(self):
        line = self.edit('"1 mm"', '"1 kg"')
        self.refused(f"scene.toml:{line}: resolution.spacing: expected a length", 'got "1 kg"')

    def test_missing_unit(self):
        line = self.edit('"1 mm"', "0.001")
        self.refused(f"scene.toml:{line}: resolution.spacing:", "unit")

    def test_negative_spacing(self):
        line = self.edit('"1 mm"', '"-1 mm"')
        self.refused(f"scene.toml:{line}: resolution.spacing:", "> 0", 'got "-1 mm"')

    def test_not_toml(self):
        line = self.edit("dimension = 2", "dimension = = 2")
        self.refused(f"scene.toml:{line}: not valid TOML")

    def test_missing_scene(self):
        self.scene.unlink()
        self.refused("scene.toml: no such file")

    def test_missing_material(self):
        self.edit('material = "pumice"', 'material = "pumce"')
        self.refused('"pumce"', "no such file", "materials/pumce.toml")

    def test_overlapping_bodies(self):
        self.edit("39 mm", "37 mm")
        self.refused("bodies.projectile", "overlap")

    def test_colour_ranges(self):
        line = self.edit("[fragments]", '[insitu.ranges]\npresure = [0, 1]\n\n[fragments]') + 1
        self.refused(f"scene.toml:{line}: insitu.ranges.presure: no such field, did you mean pressure?")
        self.edit("presure = [0, 1]", 'pressure = ["0 mm", "3 mm"]')
        self.refused(f"scene.toml:{line}: insitu.ranges.pressure: expected a pressure", 'got "0 mm"')
        self.edit('["0 mm", "3 mm"]', '[0, "1 m/s"]')
        self.refused(f"scene.toml:{line}: insitu.ranges.pressure: expected a pressure", 'got "1 m/s"')

    def test_periodic_box_narrower_than_the_kernel(self):
        self.edit("[insitu]", '[boundary]\nx = "periodic"\nmin = ["-1 mm", 0]\nmax = ["1 mm", 0]\n\n[insitu]')
        self.refused("scene.toml: boundary.x: expected a periodic box wider than the kernel", "2.6 mm", "2 mm")

    def test_body_without_a_particle(self):
        self.edit("[insitu]", '[boundary]\nx = "reflecting"\nmin = ["1 m", 0]\nmax = ["2 m", 0]\n\n[insitu]')
        self.refused("bodies.target", "bodies.projectile", "at least one particle", lines=2)

    def test_missing_script(self):
        line = self.edit("frames = 40", 'frames = 40\npipelines = ["mine.py"]') + 1
        self.refused(f"scene.toml:{line}: insitu.pipelines[0].script:", "mine.py")

    def test_script_with_a_syntax_error(self):
        self.edit("frames = 40", 'frames = 40\npipelines = ["mine.py"]')
        (self.folder / "mine.py").write_text("import math\n\ndef draw(:\n    pass\n")
        self.refused("mine.py:3: invalid syntax")

    def test_bad_overrides(self):
        for override, complaint in (("resolution.spacing", "expected key=value"),
                                    ("resolution.spacin=1mm", "did you mean resolution.spacing?"),
                                    ("numerics.kernel=gauss", "expected one of cubic_spline"),
                                    ("time.end=3kg", "expected a time")):
            with self.subTest(override):
                self.refused("--set", complaint, arguments=("--set", override))

    def test_scene_too_large_for_memory(self):
        self.refused("resolution.spacing", "free memory", "particles", arguments=("--set", "resolution.spacing=1um"))

    def test_folder_that_cannot_be_made(self):
        # A place where not even root can write.
        self.refused("scene.toml", "folder", out="scene.toml/run")
        self.refused("scene.toml", "folder", "file", out="scene.toml")
        self.refused("/proc", "folder", out="/proc/self/run")

    def test_folder_with_files_in_it(self):
        there = self.folder / "there"
        there.mkdir()
        (there / "history.csv").write_text("precious\n")
        self.refused("there", "--overwrite", out="there")
        self.refused("there", "checkpoint", out="there", arguments=("--restart",))

    def test_bad_command_lines(self):
        for arguments in ((), ("run",), ("frobnicate",), ("run", "scene.toml", "--nonsense"),
                          ("run", "scene.toml", "--threads", "0"), ("describe", "nosection"), ("movie", "nowhere"),
                          ("replay", "nowhere"), ("check", "nothing.toml")):
            with self.subTest(arguments):
                result = ejecta(*arguments, cwd=self.folder)
                self.assertEqual(result.returncode, 2)
                self.assertEqual(result.stdout, "")
                self.assertTrue(0 < len(result.stderr) < 400, result.stderr)
                self.assertFalse((self.folder / "runs").exists())


if __name__ == "__main__":
    unittest.main()
