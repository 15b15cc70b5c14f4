"""Verification by hand and by ctest: python3 verify.py sod [--full] [--set key=value] [--resolutions 50,100] ...

The environment variable EJECTA names the program; else it is build/ejecta.
"""
import argparse
import sys
from pathlib import Path

from harness import load_cases, rows, verify
from harness.ladder import write_rows


def main():
    parser = argparse.ArgumentParser(description="Runs verification cases; fails if a bound is missed.")
    parser.add_argument("case", nargs="*", help="name of a case or of a folder of cases; none: list all")
    parser.add_argument("--full", action="store_true", help="the long ladder of resolutions")
    parser.add_argument("--resolutions", help="others, such as 50,100")
    parser.add_argument("--set", action="append", default=[], metavar="key=value", help="settings on top of the case's")
    parser.add_argument("--threads", type=int, default=1)
    parser.add_argument("--errors-only", action="store_true", help="leave out the invariances")
    parser.add_argument("--keep", help="folder in which the runs stay")
    parser.add_argument("--csv", help="file for the errors in a form for machines")
    options = parser.parse_args()
    if not options.case:
        for case in load_cases():
            print(f"{case.folder:16} {case.name:24} {case.title}")
        return 0
    settings = dict(pair.split("=", 1) for pair in options.set)
    all_rows, complaints = [], []
    for word in options.case:
        cases = load_cases(word)
        if not cases:
            parser.error(f"there is no case {word}")
        for case in cases:
            ladder = case.full if options.full else case.quick
            if options.resolutions:
                ladder = tuple(int(r) for r in options.resolutions.split(","))
            if not ladder:  # nothing of this case belongs to the ordinary test
                continue
            measurements, wrong = verify(case, ladder, settings, options.threads, not options.errors_only,
                                         Path(options.keep) if options.keep else None)
            all_rows += rows(case, measurements)
            complaints += wrong
    if options.csv:
        write_rows(options.csv, all_rows)
    return 1 if complaints else 0


if __name__ == "__main__":
    sys.exit(main())
