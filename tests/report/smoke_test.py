"""The report on a tiny subset: its files are there, its numbers make sense, its figures show something."""
import argparse
import csv
import re
import subprocess
import sys
import tempfile
from pathlib import Path

import numpy as np
from PIL import Image

from survival import name

REPORT = Path(__file__).resolve().with_name("report.py")
TABLES = ["errors", "precision_table", "solver", "solver_table", "verification_table"]
FIGURES = ["precision", "precision_particle_steps", "solver", "convergence_1", "profiles_sod"]


def table(file):
    with open(file, newline="") as lines:
        return list(csv.DictReader(lines))


def check_errors(rows, commit):
    assert {row["part"] for row in rows} == {"verification", "speed"}, "a part has no errors"
    assert all(row["commit"] == commit and row["machine"] for row in rows), "a row does not name commit and machine"
    precisions = {row["precision"] for row in rows if row["part"] == "speed"}
    assert precisions == {"double", "mixed"}, f"precisions: {precisions}"
    for quantity in ("density", "velocity", "pressure"):
        for variant in {(row["part"], row["settings"]) for row in rows}:
            errors = [float(row["error"]) for row in rows if (row["part"], row["settings"]) == variant
                      and (row["quantity"], row["norm"]) == (quantity, "L1")]
            assert len(errors) == 3, f"{quantity}, {variant}: {len(errors)} errors"
            assert all(fine < 0.8 * coarse for coarse, fine in zip(errors, errors[1:])), \
                f"errors of the {quantity} do not fall with resolution: {errors}"
    assert all(float(row["core_seconds"]) > 0 and int(row["particle_steps"]) > 1000 for row in rows), "a run was free"


def check_figure(file, commit):
    image = Image.open(file)
    pixels = np.asarray(image.convert("L"), float)
    inner = pixels[pixels.shape[0] // 4:-pixels.shape[0] // 4, :]
    assert min(pixels.shape) > 300 and inner.std() > 5, f"{file.name} is blank"
    assert f"commit {commit}," in image.text["Description"], f"{file.name} does not name the commit"


def check_survival(options, out):
    """The page counts the rows of the table, and a run that is named can be written as a scene."""
    subprocess.run([sys.executable, "-B", str(REPORT), "--program", options.program, "--survival-program",
                    options.survival_program, "--out", str(out), "--survival", "quick"], check=True)
    rows = table(out / "survival.csv")
    failed = sum(row["outcome"] != "survived" for row in rows)
    assert len(rows) == 48, f"{len(rows)} runs"
    assert f"{len(rows)} impacts, {failed} not survived" in (out / "survival.md").read_text()
    scene = subprocess.run([options.survival_program, "--scene", name(rows[0])], capture_output=True, text=True,
                           check=True).stdout
    (out / "scene.toml").write_text(scene)
    subprocess.run([options.program, "check", str(out / "scene.toml")], check=True, capture_output=True)


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--program", required=True)
    parser.add_argument("--solver-work", required=True)
    parser.add_argument("--survival-program", required=True)
    options = parser.parse_args()
    info = subprocess.run([options.program, "info"], capture_output=True, text=True, check=True).stdout
    commit = re.search(r"commit ([^)]+)", info)[1]
    with tempfile.TemporaryDirectory(prefix="ejecta_report_smoke_") as out:
        out = Path(out)
        subprocess.run([sys.executable, "-B", str(REPORT), "--program", options.program, "--solver-work",
                        options.solver_work, "--out", str(out), "--quick", "--only",
                        "sod,verification,precision,solver"], check=True)
        for name in TABLES:
            assert table(out / f"{name}.csv"), f"{name}.csv is empty"
        check_errors(table(out / "errors.csv"), commit)
        for name in FIGURES:
            check_figure(out / f"{name}.png", commit)
        for page in ("report.md", "index.html"):
            text = (out / page).read_text()
            assert all(f"{name}.png" in text for name in FIGURES), f"{page} lacks a figure"
            assert commit in text and "at equal error" in text, f"{page} lacks the commit or what to conclude"
        check_survival(options, out)
    print("passed")


if __name__ == "__main__":
    main()
