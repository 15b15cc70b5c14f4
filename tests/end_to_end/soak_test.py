"""A run of an hour that draws, writes, searches for fragments and is watched: it holds no more memory, files and threads
at its end than at its beginning, and its steps take no longer. EJECTA_SOAK_MINUTES shortens it; EJECTA_SOAK_TABLE names
a file for what was seen."""
import json
import os
import re
import subprocess
import time
import unittest
import urllib.request
from pathlib import Path
from statistics import median
from ejecta_run import PROGRAM, SOURCE, RunTest, ejecta, settings, summary

MINUTES = float(os.environ.get("EJECTA_SOAK_MINUTES", 60))
SAMPLES = 720
# The rings bounce within the first 0.2 s of a minute's run and ring on ever after: all steps cost the same.
VALUES = {"time.end": "60 s", "resolution.spacing": "4mm", "run.threads": 1, "output.snapshots": 0,
          "output.checkpoint_interval": "20 s", "insitu.every": '["10 s wall"]',
          "insitu.image_width": 640, "insitu.image_height": 360, "insitu.max_share": 0.5}


class Soak(RunTest):
    def sample(self, process):
        """Memory [MB], open files, threads, and processor time [s] so far."""
        proc = Path(f"/proc/{process.pid}")
        status = (proc / "status").read_text()
        number = lambda key: int(re.search(rf"^{key}:\s+(\d+)", status, re.M)[1])
        ticks = (proc / "stat").read_text().rsplit(")", 1)[1].split()
        return {"memory": number("VmRSS") / 1024, "files": len(list((proc / "fd").iterdir())),
                "threads": number("Threads"), "cpu": (int(ticks[11]) + int(ticks[12])) / os.sysconf("SC_CLK_TCK")}

    def test_nothing_grows(self):
        out = self.folder / "run"
        log = (self.folder / "log").open("w")
        self.addCleanup(log.close)
        run = subprocess.Popen([PROGRAM, "run", SOURCE / "inputs/rubber_balls_2d.toml", "--out", out, *settings(VALUES)],
                               stdout=log, stderr=log)
        self.addCleanup(run.wait)
        self.addCleanup(run.kill)
        while not (out / "monitor/status.json").exists():
            self.assertIsNone(run.poll(), (self.folder / "log").read_text())
            time.sleep(0.1)
        server = subprocess.Popen([PROGRAM, "serve", out], stdout=subprocess.PIPE, stderr=log, text=True)
        self.addCleanup(server.stdout.close)
        self.addCleanup(server.wait)
        self.addCleanup(server.kill)
        page = re.search(r"http://\S+", server.stdout.readline())[0].rstrip("/")
        seen, served = [], []
        start = time.monotonic()
        while len(seen) < SAMPLES:
            time.sleep(max(0, start + len(seen) * MINUTES * 60 / SAMPLES - time.monotonic()))
            self.assertIsNone(run.poll(), (self.folder / "log").read_text())
            status = urllib.request.urlopen(page + "/monitor/status.json").read().decode()
            self.assertEqual(urllib.request.urlopen(page + "/").status, 200)
            step = json.loads(status)["step"]
            seen.append({"minutes": (time.monotonic() - start) / 60, "step": step, **self.sample(run)})
            served.append(self.sample(server))
        if table := os.environ.get("EJECTA_SOAK_TABLE"):
            Path(table).write_text("\n".join(",".join(f"{value:.6g}" for value in row) for row in
                                             [list(s.values()) + list(t.values()) for s, t in zip(seen, served)]) + "\n")
        self.assertEqual(ejecta("control", out, "stop").returncode, 0)
        self.assertEqual(run.wait(timeout=60), 4)
        self.assertGreater(summary(out)["frames"], 4 * MINUTES)

        def middle(of, key, quarter):
            return median(s[key] for s in of[quarter * SAMPLES // 4:(quarter + 1) * SAMPLES // 4])

        for process in (seen, served):
            self.assertLess(middle(process, "memory", 3) - middle(process, "memory", 1), 2)  # MB
            for key in ("files", "threads"):
                self.assertEqual(middle(process, key, 3), middle(process, key, 1))

        def cost(quarter):  # s of the processor for a step
            first, last = seen[quarter * SAMPLES // 4], seen[(quarter + 1) * SAMPLES // 4 - 1]
            return (last["cpu"] - first["cpu"]) / (last["step"] - first["step"])

        self.assertLess(cost(3) / cost(1), 1.1)


if __name__ == "__main__":
    unittest.main()
