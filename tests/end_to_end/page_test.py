"""The monitor page in a browser, while a run goes on: from the disk and through `ejecta serve`, wide and narrow."""
import json
import re
import subprocess
import time
import unittest
from browser import CHROMIUM, Browser
from ejecta_run import IMPACT_2D, PROGRAM, RunTest, SOD, settings

IMPACT = {"resolution.spacing": "3mm", "time.end": "10ms", "insitu.frames": 1000, "insitu.image_width": 320, "insitu.image_height": 240,
          "run.threads": 1}
WIDE, NARROW = 1400, 390


@unittest.skipUnless(CHROMIUM, "no chromium here (apt-get install chromium)")
class Page(RunTest):
    def setUp(self):
        super().setUp()
        self.out = self.folder / "run"
        self.browser = Browser()
        self.addCleanup(self.browser.close)

    def start(self, scene, values):
        run = subprocess.Popen([PROGRAM, "run", scene, "--out", self.out, *settings(values)], stdout=subprocess.DEVNULL,
                               stderr=subprocess.DEVNULL)
        self.addCleanup(run.wait)
        self.addCleanup(run.kill)
        return run

    def wait_for_status(self, ready):
        give_up = time.monotonic() + 60
        while time.monotonic() < give_up:
            file = self.out / "monitor/status.json"
            if file.exists() and ready(json.loads(file.read_text())):
                return
            time.sleep(0.1)
        self.fail("the run has not come so far")

    def serve(self, *options):
        server = subprocess.Popen([PROGRAM, "serve", self.out, *options], stdout=subprocess.PIPE, text=True)
        self.addCleanup(server.wait)
        self.addCleanup(server.stdout.close)
        self.addCleanup(server.kill)
        return server.stdout.readline().strip()

    def text(self, selector):
        return self.browser.run(f"document.querySelector({selector!r}).innerText")

    def titles(self, section):
        return self.browser.run(f"[...document.querySelectorAll('#{section} h3')].map((h) => h.textContent)")

    def check_layout(self, width):
        """Nothing sticks out, every plot has units on both axes where it has any, all pictures are there."""
        self.assertEqual(self.browser.run("document.documentElement.scrollWidth"), width)
        self.browser.wait_for("[...document.images].every((i) => i.loading === 'lazy' || i.complete && i.naturalWidth > 0)")
        plots = self.browser.run("[...document.querySelectorAll('svg')].map((p) => [p.ariaLabel ?? p.getAttribute('aria-label'),"
                                 " [...p.querySelectorAll('text')].slice(-3).map((t) => t.textContent)])")
        self.assertGreater(len(plots), 3)
        for title, texts in plots:
            self.assertTrue(any(re.search(r"\[.+\]|m / mass of", text) for text in texts), (title, texts))

    def focused_by_tab(self, most=200):
        """What the tabulator reaches, as tag and name."""
        reached = []
        self.browser.run("document.activeElement.blur()")
        for _ in range(most):
            self.browser.press("Tab", 9)
            at = self.browser.run("((e) => e.tagName.toLowerCase() + ' ' + (e.getAttribute('aria-label') || e.id || e.textContent))"
                                  "(document.activeElement)")
            if at.startswith("body") or at in reached[:1]:
                break
            reached.append(at)
        return reached

    def test_live_run(self):
        run = self.start(IMPACT_2D, IMPACT)
        self.wait_for_status(lambda s: s["step"] > 5 and len(s["views"]) > 2 and len(s["limits"]["rows"]) > 2)
        served = self.serve("--control")
        for address in (f"file://{self.out}/monitor/index.html", served.split("#")[0], served):
            for width in (WIDE, NARROW):
                self.browser.open(address, width)
                self.browser.wait_for("document.querySelectorAll('#views article').length > 2 && document.querySelectorAll('svg').length > 3")
                self.assertEqual(self.text("#state"), "running")
                self.assertRegex(self.text("#eta"), r"about .* left")
                self.check_layout(width)
                self.assertEqual(self.browser.run("by_id('steer').hidden"), "#" not in address)
                self.assertIn("in-situ work", self.text("#numbers"))
                self.assertRegex(self.text("#numbers"), r"limited by .* in (ball|target|rod|projectile)\b.* at \(")
                self.assertRegex(self.text("#numbers"), r"\d\sMB")
                self.assertIn("Time step and what limits it", self.titles("plots"))
                self.assertIn("run.log", self.text("#files"))
                self.assertIn("particles in 2D", self.text("#log"))
        first = self.browser.run("+document.querySelector('#numbers dd').textContent.replace(/\\D/g, '')")
        self.browser.wait_for(f"+document.querySelector('#numbers dd').textContent.replace(/\\D/g, '') > {first}")
        # All that can be used can be reached and used by keys, though the page is renewed meanwhile.
        reached = self.focused_by_tab()
        for expected in ("button pause", "button stop", "input end", "svg Energy", "input frame of slice", "a history.csv", "pre last lines of run.log"):
            self.assertIn(expected, reached)
        self.browser.run("document.querySelector('svg[aria-label=Energy]').focus()")
        self.browser.press("ArrowLeft", 37)
        time.sleep(3)
        self.assertEqual(self.browser.run("document.activeElement.getAttribute('aria-label')"), "Energy")
        self.assertIn(" at ", self.browser.run("document.activeElement.closest('article').querySelector('output').textContent"))
        self.browser.run("[...document.querySelectorAll('#steer button')].find((b) => b.textContent === 'pause').click()")
        self.browser.wait_for("document.querySelector('#steer output').textContent.includes('paused at t')")
        self.browser.wait_for("document.querySelector('#state').textContent === 'paused'")
        self.browser.wait_for("document.querySelector('#control').textContent.includes('pause: paused at t')")
        # A run that is killed falls silent, and nobody says how long it will still take.
        run.kill()
        run.wait()
        self.browser.run("Date.now = ((now) => () => now() + 200e3)(Date.now)")
        self.browser.wait_for("document.querySelector('#state').textContent === 'silent'")
        self.assertRegex(self.text("#eta"), "^silent since ")
        self.assertTrue(self.browser.run("by_id('steer').hidden"))
        self.assertEqual(self.browser.problems, [])

    def test_profiles_where_there_are_no_images(self):
        self.run_scene(SOD, "run", {"time.end": "0.1 s"})
        for width in (WIDE, NARROW):
            self.browser.open(f"file://{self.out}/monitor/index.html", width)
            self.browser.wait_for("document.querySelectorAll('#profiles svg').length === 3")
            self.assertEqual(self.titles("profiles"), ["Density along x", "Velocity x along x", "Pressure along x"])
            self.check_layout(width)
            self.assertNotIn("no images", self.text("main"))
            self.assertIn("summary.json", self.text("#files"))
        profile = json.loads((self.out / "monitor/status.json").read_text())["profile"]
        density = dict(zip(profile["place"], profile["fields"][0]["values"]))
        near = lambda x: min(density.items(), key=lambda item: abs(item[0] - x))[1]
        for x, exact in ((-0.4, 1), (0.05, 0.42632), (0.14, 0.26557), (0.4, 0.125)):  # Sod's solution at 0.1 s
            self.assertAlmostEqual(near(x), exact, delta=0.03 * exact)
        self.assertEqual(self.browser.problems, [])


if __name__ == "__main__":
    unittest.main()
