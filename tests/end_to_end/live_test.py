"""Catalyst Live with a client of the same ParaView: it sees the particles, and either end may die."""
import os
import shutil
import signal
import socket
import subprocess
import threading
import time
import unittest
from pathlib import Path
from ejecta_run import IMPACT_2D, PROGRAM, RunTest, settings, summary

SCRIPT = """# script-version: 2.0
from paraview import catalyst
import ejecta_view as ejecta
source = ejecta.channel("particles")
options = catalyst.Options()
options.EnableCatalystLive = 1
options.CatalystLiveURL = "localhost:{port}"
options.CatalystLiveTrigger.Frequency = 5
"""


def free_port():
    with socket.socket() as probe:
        probe.bind(("localhost", 0))
        return probe.getsockname()[1]


@unittest.skipUnless(shutil.which("pvpython"), "needs pvpython (Debian package paraview)")
class Live(RunTest):
    def start(self, command, **more):
        process = subprocess.Popen([str(word) for word in command], text=True, **more)
        self.addCleanup(process.wait)
        self.addCleanup(process.kill)
        return process

    def start_both(self, steps):
        port = free_port()
        environment = {name: value for name, value in os.environ.items() if name != "DISPLAY"}
        self.client = self.start(["pvpython", Path(__file__).parent / "live_client.py", port], env=environment,
                                 stdout=subprocess.PIPE, stderr=subprocess.DEVNULL)
        self.said = []
        threading.Thread(target=lambda: self.said.extend(iter(self.client.stdout.readline, "")), daemon=True).start()
        self.wait_for("client: listening")
        (self.folder / "live.py").write_text(SCRIPT.format(port=port))
        shutil.copy(IMPACT_2D, self.folder / "scene.toml")
        self.log = open(self.folder / "log", "w+")
        self.addCleanup(self.log.close)
        values = {"resolution.spacing": "3mm", "time.end": "10ms", "time.max_steps": steps, "insitu.max_share": 1, "insitu.frames": 2,
                  "insitu.pipelines": '["live.py"]'}
        self.run_process = self.start([PROGRAM, "run", self.folder / "scene.toml", "--out", self.folder / "run",
                                       *settings(values)], stdout=subprocess.DEVNULL, stderr=self.log)
        self.wait_for("client: points")

    def wait_for(self, words):
        give_up = time.monotonic() + 60
        while not any(line.startswith(words) for line in self.said):
            self.assertLess(time.monotonic(), give_up, self.said)
            time.sleep(0.02)

    def test_the_client_is_killed(self):
        self.start_both(3000)
        self.client.send_signal(signal.SIGKILL)
        self.assertEqual(self.run_process.wait(timeout=120), 0, (self.folder / "log").read_text())
        self.assertEqual(summary(self.folder / "run")["steps"], 3000)

    def test_the_run_is_killed(self):
        self.start_both(1000000)
        points = next(line for line in self.said if line.startswith("client: points"))
        for field in ("pressure", "velocity", "damage"):
            self.assertIn(f" {field}", points)
        self.wait_for("client: updated ten times")  # its trigger fires, there are no frames
        self.run_process.send_signal(signal.SIGKILL)
        self.wait_for("client: closed")
        self.assertEqual(self.client.wait(timeout=30), 0)


if __name__ == "__main__":
    unittest.main()
