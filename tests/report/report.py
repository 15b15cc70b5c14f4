"""Speed against error: runs the studies of studies.py and writes a page of figures and tables.

`./ejecta report [options]` builds what is needed and calls this. Everything runs on one thread, one run at a time.
"""
import argparse
import datetime
import hashlib
import json
import os
import re
import subprocess
import sys
import tempfile
import time
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent / "verification"))

import harness.run  # noqa: E402  (found through the line above)
from harness import load_cases  # noqa: E402

from campaign import run_campaign  # noqa: E402
from content import Report  # noqa: E402
from page import markdown, web  # noqa: E402
from results import Results  # noqa: E402
from studies import AXES, STUDIES, TOLERANCE  # noqa: E402
from survival import SETS, survival  # noqa: E402

PARTS = ["verification", *(axis.name for axis in AXES), "solver", "tolerance"]


def machine():
    """Processor, cores and memory in a line."""
    cpu = dict(re.findall(r"^(\S[^\t:]*?)\s*: (.*)$", Path("/proc/cpuinfo").read_text(), re.MULTILINE))
    vectors = "AVX-512" if "avx512f" in cpu.get("flags", "") else "AVX2" if "avx2" in cpu.get("flags", "") else ""
    words = [f"{cpu.get('model name', 'unknown processor')} (family {cpu.get('cpu family', '?')})",
             f"{float(cpu.get('cpu MHz', 0)) / 1000:.1f} GHz", f"{os.cpu_count()} cores", vectors]
    return ", ".join(word for word in words if word)


def fingerprint(program):
    return hashlib.sha256(Path(program).read_bytes()).hexdigest()


def conditions(options):
    info = subprocess.run([options.program, "info"], capture_output=True, text=True, check=True).stdout
    return {"machine": machine(), "commit": re.search(r"commit ([^)]+)", info)[1],
            "compiler": re.search(r"compiler (.*)", info)[1],
            "date": datetime.date.today().isoformat(), "options": " ".join(options.words), "failures": []}


def chosen(only):
    """Words of --only name cases and parts; a group of which none is named is wanted as a whole."""
    words = only.split(",") if only else []
    cases = load_cases()
    names = {case.name for case in cases} | {case.folder for case in cases}
    unknown = [word for word in words if word not in PARTS and word not in names]
    if unknown:
        sys.exit(f"report: --only knows no {', '.join(unknown)}; parts: {', '.join(PARTS)}; "
                 f"cases: {', '.join(sorted(names))}")
    parts = [part for part in PARTS if part in words] or PARTS
    named = {case.name for case in cases if case.name in words}
    wanted = [case for case in cases if case.name in named or case.folder in words and case.folder not in named]
    return parts, wanted or cases


def main():
    parser = argparse.ArgumentParser(prog="./ejecta report", description="Runs verification and speed against error; "
                                     "writes figures, tables and a page. About 20 minutes on a quiet machine.")
    parser.add_argument("--program", default=str(HERE.parents[1] / "build" / "ejecta"), help=argparse.SUPPRESS)
    parser.add_argument("--solver-work", help=argparse.SUPPRESS)
    parser.add_argument("--out", type=Path, default=Path("report"), help="folder to write (default: report)")
    parser.add_argument("--quick", action="store_true", help="coarse runs: a few minutes")
    parser.add_argument("--verify", choices=("quick", "full", "none"), default="quick",
                        help="ladder of the verification cases (default: quick; full takes much longer)")
    parser.add_argument("--only", metavar="WORDS", help=f"cases and parts, such as sod,precision. "
                                                         f"Parts: {', '.join(PARTS)}")
    parser.add_argument("--survival", nargs="?", const="2d", choices=tuple(SETS),
                        help="in place of all this: impacts of every material into every other. quick: 44 of them; "
                             "2d (default): discs, minutes; all: spheres, asph, tensor damage, mixed precision too")
    parser.add_argument("--survival-program", help=argparse.SUPPRESS)
    parser.add_argument("--draw", action="store_true", help="run nothing; draw again what is in the folder")
    options = parser.parse_args()
    options.words = [f"--verify {options.verify}", *(["--quick"] if options.quick else []),
                     *([f"--only {options.only}"] if options.only else [])]
    parts, cases = chosen(options.only)
    options.out.mkdir(parents=True, exist_ok=True)
    if options.survival:
        return survival(options, conditions(options))
    if not options.draw:
        run(options, parts, cases)
    results = Results.read(options.out)
    blocks = Report(results, cases, options.out).build()
    (options.out / "report.md").write_text(markdown(blocks))
    (options.out / "index.html").write_text(web(blocks, "Ejecta: errors and what they cost"))
    print(f"report: {options.out / 'index.html'}")


def run(options, parts, cases):
    harness.run.PROGRAM = options.program
    for old in (*options.out.glob("*.csv"), *options.out.glob("*.png"), options.out / "profiles.npz"):
        old.unlink(missing_ok=True)  # nothing of another program may stay on the page
    meta, start, load, digest = conditions(options), time.monotonic(), os.getloadavg()[0], fingerprint(options.program)
    names = {case.name for case in cases}
    meta["skipped"] = [] if options.only else sorted({study.case for study in (*STUDIES, TOLERANCE)} - names)
    with tempfile.TemporaryDirectory(prefix="ejecta_report_") as workspace:
        run_campaign(options, parts, cases, Path(workspace), meta)
    if fingerprint(options.program) != digest:
        meta["failures"].append("the program was replaced while the report ran: the numbers are not of one program")
    meta["minutes"], meta["load"] = (time.monotonic() - start) / 60, (load, os.getloadavg()[0])
    (options.out / "run.json").write_text(json.dumps(meta, indent=2) + "\n")


if __name__ == "__main__":
    main()
