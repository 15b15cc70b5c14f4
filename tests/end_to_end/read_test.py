"""Checkpoints and snapshots read with the module that comes with Ejecta, and what is exported of them with ParaView's reader."""
import importlib.util
import subprocess
import sys
import unittest
from ejecta_run import IMPACT_2D, SOURCE, RunTest, Snapshot, ejecta

sys.path.insert(0, str(SOURCE / "catalyst_scripts"))
HAS_H5PY = importlib.util.find_spec("h5py") is not None

READ_BACK = """
import sys
from paraview.simple import OpenDataFile
source = OpenDataFile(sys.argv[1])
source.UpdatePipeline(source.TimestepValues[-1])
arrays = source.PointData
print(*source.TimestepValues)
print(source.GetDataInformation().GetNumberOfPoints(), arrays["velocity"].GetNumberOfComponents(),
      arrays["deviatoric_stress"].GetNumberOfComponents(), "fragment_number" in arrays.keys())
"""


class Read(RunTest):
    def a_run(self):
        return self.run_scene(IMPACT_2D, "run", {"resolution.spacing": "4mm", "time.end": "4us", "insitu.enabled": "false",
                                                 "output.snapshots": 2})

    @unittest.skipUnless(HAS_H5PY, "needs h5py (Debian package python3-h5py)")
    def test_reader(self):
        from ejecta_read import State
        file, = (self.a_run() / "checkpoints").glob("*.h5")
        state, raw = State(file), Snapshot(file)
        self.assertAlmostEqual(state.time, 4e-6, delta=1e-15)
        self.assertEqual(state.scene["scene"]["name"], "pumice_impact_2d")
        self.assertEqual(state.fields()["density"], "kg/m^3")
        self.assertEqual(list(state["density"]), raw.column("density"))
        self.assertEqual(list(state["velocity"][:, 1]), raw.column("velocity_1"))
        self.assertEqual(list(state["body"]), raw.label("body"))
        with self.assertRaisesRegex(KeyError, "heat; there are .*density"):
            state["heat"]

    @unittest.skipUnless(HAS_H5PY, "needs h5py (Debian package python3-h5py)")
    def test_reader_of_grids(self):
        from ejecta_read import State
        for scene, along in (("sod_hybrid", 0), ("blast_1kt", 1)):
            with self.subTest(scene):
                out = self.run_scene(SOURCE / "inputs" / f"{scene}.toml", scene,
                                     {"time.max_steps": 4, "insitu.enabled": "false", "output.snapshots": 0,
                                      "output.times": "[]"})
                state = State(next((out / "checkpoints").glob("*.h5")))
                x, density, momentum = state.cell_centres(), state["grid.density"], state["grid.momentum"]
                self.assertEqual(state.fields()["grid.momentum"], "kg/(m^2 s)")
                self.assertEqual(x.shape, (len(density), 2))
                self.assertEqual(momentum.shape, x.shape)
                if scene == "sod_hybrid":
                    self.assertTrue((density[x[:, 0] < -0.1] == 1).all())
                    self.assertTrue((abs(density[x[:, 0] > 0.1] - 0.125) < 1e-12).all())
                    self.assertAlmostEqual(x[:, 0].max(), 0.4975)
                else:  # the charge, about the origin, flies apart
                    inside = (x ** 2).sum(axis=1) ** 0.5 < 0.4
                    self.assertGreater(density[inside].min(), 2 * density[~inside].min())
                    self.assertTrue((momentum * x >= -1e-6 * abs(momentum).max()).all())
        with self.assertRaisesRegex(KeyError, "no grid"):
            State(next((self.a_run() / "checkpoints").glob("*.h5"))).cell_centres()

    def test_paraview_opens_what_is_exported(self):
        out = self.a_run()
        for form, ending in (("vtp", "pvd"), ("xdmf", "xmf")):
            with self.subTest(form):
                self.assertEqual(ejecta("export", out, "--all", "--format", form).returncode, 0)
                file, = (out / "export").glob(f"*.{ending}")
                read = subprocess.run(["/usr/bin/python3", "-c", READ_BACK, file], capture_output=True, text=True)
                self.assertEqual(read.stdout.split(), ["2e-06", "4e-06", "252", "3", "6", "True"], read.stderr)
        self.assertRegex((out / "export/particles.xmf").read_text(),
                         r'<Attribute Name="pressure"[^>]*>\s*<DataItem[^>]*>[^<]*</DataItem>\s*<Information Name="Units" Value="Pa"/>')


if __name__ == "__main__":
    unittest.main()
