"""A run folder over HTTP: what is in it and nothing else, to this machine alone, and steering only with the token."""
import http.client
import os
import re
import socket
import subprocess
import time
import unittest
from pathlib import Path
from ejecta_run import IMPACT_2D, PROGRAM, RunTest, ejecta, settings

LONG = {"resolution.spacing": "4mm", "insitu.enabled": "false", "run.threads": 1, "time.end": "10ms"}
MOVIE = bytes(range(256)) * 1000


def free_port():
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        return probe.getsockname()[1]


class Serve(RunTest):
    def setUp(self):
        super().setUp()
        self.out = self.folder / "run"
        (self.folder / "secret.txt").write_text("not for you")
        for name, content in {"monitor/index.html": b"<p>page", "monitor/status.js": b"ejecta_status({});",
                              "movies/slice.mp4": MOVIE, "empty.csv": b""}.items():
            (self.out / name).parent.mkdir(parents=True, exist_ok=True)
            (self.out / name).write_bytes(content)

    def serve(self, *options):
        """Starts a server; its port and what it has printed."""
        server = subprocess.Popen([PROGRAM, "serve", self.out, *map(str, options)], stdout=subprocess.PIPE, text=True)
        self.addCleanup(server.wait)
        self.addCleanup(server.stdout.close)
        self.addCleanup(server.kill)
        said = server.stdout.readline()
        self.port = int(re.match(r"http://127\.0\.0\.1:(\d+)/", said)[1])
        return said

    def ask(self, path, method="GET", body=None, **headers):
        """Status, headers and body; the path is sent as it is."""
        connection = http.client.HTTPConnection("127.0.0.1", self.port, timeout=20)
        connection.request(method, path, body, {name.replace("_", "-"): value for name, value in headers.items()})
        answer = connection.getresponse()
        content = answer.read()
        connection.close()
        return answer.status, answer.headers, content

    def test_files_with_their_types(self):
        self.serve()
        status, headers, _ = self.ask("/")
        self.assertEqual((status, headers["Location"]), (302, "/monitor/index.html"))
        for path, kind in (("/monitor/index.html", "text/html"), ("/monitor/status.js?123", "text/javascript"),
                           ("/movies/slice.mp4", "video/mp4"), ("/empty.csv", "text/csv")):
            status, headers, content = self.ask(path)
            self.assertEqual(status, 200, path)
            self.assertTrue(headers["Content-Type"].startswith(kind), path)
            self.assertEqual(content, (self.out / path[1:].split("?")[0]).read_bytes())
        status, headers, content = self.ask("/movies/slice.mp4", "HEAD")
        self.assertEqual((status, int(headers["Content-Length"]), content), (200, len(MOVIE), b""))

    def test_nothing_outside_the_folder(self):
        self.serve()
        os.symlink(self.folder / "secret.txt", self.out / "leak.txt")
        os.symlink(self.folder, self.out / "up")
        os.symlink("movies/slice.mp4", self.out / "inside.mp4")
        os.mkfifo(self.out / "pipe")
        for path in ("/../secret.txt", "/%2e%2e/secret.txt", "/..%2fsecret.txt", "/monitor/../../secret.txt", "/%2e%2e%2fsecret.txt",
                     "//" + str(self.folder) + "/secret.txt", "/" + str(self.folder) + "/secret.txt", "/leak.txt", "/up/secret.txt",
                     "/..%5csecret.txt", "/empty.csv%00", "/up", "/pipe", "/monitor", "/nothing", "/%252e%252e/secret.txt"):
            status, _, content = self.ask(path)
            self.assertEqual(status, 404, path)
            self.assertNotIn(b"not for you", content)
        self.assertEqual(self.ask("/inside.mp4")[2], MOVIE)
        # A folder beside it whose name begins alike.
        beside = self.folder / "run_other"
        beside.mkdir()
        (beside / "secret.txt").write_text("not for you")
        self.assertEqual(self.ask("/../run_other/secret.txt")[0], 404)

    def test_parts_and_versions(self):
        self.serve()
        last = len(MOVIE) - 1
        for asked, first, end in (("0-9", 0, 9), ("100-", 100, last), ("-7", last - 6, last), (f"5-{10 * last}", 5, last),
                                  (f"-{10 * last}", 0, last)):
            status, headers, content = self.ask("/movies/slice.mp4", Range="bytes=" + asked)
            self.assertEqual((status, headers["Content-Range"]), (206, f"bytes {first}-{end}/{len(MOVIE)}"), asked)
            self.assertEqual(content, MOVIE[first:end + 1])
        for asked in (f"{len(MOVIE)}-", f"{2 * last}-{3 * last}"):
            status, headers, content = self.ask("/movies/slice.mp4", Range="bytes=" + asked)
            self.assertEqual((status, headers["Content-Range"]), (416, f"bytes */{len(MOVIE)}"), asked)
        tag = self.ask("/movies/slice.mp4")[1]["ETag"]
        status, _, content = self.ask("/movies/slice.mp4", If_None_Match=tag)
        self.assertEqual((status, content), (304, b""))
        self.assertEqual(self.ask("/movies/slice.mp4", Range="bytes=0-9", If_Range=tag)[0], 206)
        (self.out / "movies/slice.mp4").write_bytes(MOVIE[::-1])
        status, headers, content = self.ask("/movies/slice.mp4", If_None_Match=tag)
        self.assertEqual((status, content), (200, MOVIE[::-1]))
        self.assertNotEqual(headers["ETag"], tag)
        status, _, content = self.ask("/movies/slice.mp4", Range="bytes=0-9", If_Range=tag)
        self.assertEqual((status, content), (200, MOVIE[::-1]))

    def test_read_only_and_for_this_machine(self):
        self.serve()
        for method in ("POST", "PUT", "DELETE", "PATCH", "OPTIONS"):
            for path in ("/control", "/movies/slice.mp4"):
                self.assertEqual(self.ask(path, method, b"stop")[0], 405)
        self.assertEqual((self.out / "movies/slice.mp4").read_bytes(), MOVIE)
        self.assertEqual(self.ask("/monitor/index.html", Host="example.org")[0], 403)
        self.assertEqual(self.ask("/monitor/index.html", Host=f"localhost:{self.port}")[0], 200)
        sockets = [line.split() for line in Path("/proc/net/tcp").read_text().splitlines()]
        listening = [row[1] for row in sockets if row[3] == "0A"]
        ours = [address for address in listening if address.endswith(f":{self.port:04X}")]
        self.assertEqual(ours, [f"0100007F:{self.port:04X}"])

    def test_port_taken(self):
        port = free_port()
        self.serve("--port", port)
        self.assertEqual(self.port, port)
        second = ejecta("serve", self.out, "--port", port)
        self.assertEqual(second.returncode, 2)
        self.assertIn(f"--port: expected a free port, got {port}", second.stderr)
        ports = set()
        for _ in range(2):
            self.serve()
            ports.add(self.port)
        self.assertEqual(len(ports), 2)
        none = ejecta("serve", self.folder)
        self.assertEqual(none.returncode, 2)
        self.assertIn(f"{self.folder}: expected a run folder", none.stderr)

    def test_steering(self):
        self.out = self.folder / "live"
        run = subprocess.Popen([PROGRAM, "run", IMPACT_2D, "--out", self.out, *settings(LONG)],
                               stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        self.addCleanup(run.wait)
        self.addCleanup(run.kill)
        give_up = time.monotonic() + 60
        while not (self.out / "monitor/status.json").exists() and time.monotonic() < give_up:
            time.sleep(0.05)
        token = self.serve("--control").strip().split("#")[1]
        for headers in ({}, {"X_Ejecta_Token": ""}, {"X_Ejecta_Token": token[:-1]}, {"X_Ejecta_Token": "0" * len(token)}):
            self.assertEqual(self.ask("/control", "POST", b"stop", **headers)[0], 403)
        self.assertEqual(self.ask("/control", "POST", b"stop", X_Ejecta_Token=token, Host="example.org")[0], 403)
        self.assertIsNone(run.poll())
        status, _, answer = self.ask("/control", "POST", b"paus", X_Ejecta_Token=token)
        self.assertEqual(status, 400)
        self.assertIn(b"did you mean pause", answer)
        self.assertGreaterEqual(self.ask("/control", "POST", b"frame\n" * 1000, X_Ejecta_Token=token)[0], 400)
        status, _, answer = self.ask("/control", "POST", b"pause", X_Ejecta_Token=token)
        self.assertEqual(status, 200, answer)
        self.assertRegex(answer.decode(), r"^pause: paused at t = ")
        self.assertEqual(self.ask("/control", "POST", b"stop", X_Ejecta_Token=token)[0], 200)
        self.assertEqual(run.wait(60), 4)
        status, _, answer = self.ask("/control", "POST", b"stop", X_Ejecta_Token=token)
        self.assertEqual(status, 400)
        self.assertIn(b"expected the folder of a run that goes on", answer)


if __name__ == "__main__":
    unittest.main()
