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
