"""Runs the program as a user does and reads what it leaves. Standard library only."""
import csv
import ctypes
import ctypes.util
import json
import os
import re
import shutil
import subprocess
import tempfile
import tomllib
import unittest
from pathlib import Path

PROGRAM = os.environ["EJECTA"]
SOURCE = Path(os.environ["EJECTA_SOURCE"])
IMPACT_2D, IMPACT_3D, SOD = (SOURCE / "inputs" / f"{name}.toml" for name in ("pumice_impact_2d", "pumice_impact", "sod"))

SUMMARY_KEYS = """scene dimension scheme precision threads particles cells steps element_steps time_s wall_s
particle_steps_per_s cell_steps_per_s pair_interactions_per_s neighbours_mean bytes_per_particle peak_rss_mb mass_error_rel momentum_error_rel
angular_momentum_error_rel energy_error_rel shape_votes shape_few_neighbours shape_limited_change shape_largest_aspect
images extracts frames frames_left_out pipelines insitu_share insitu_bytes_written full_dump_bytes_avoided fragment_target
largest_fragment_mass_fraction fragments bodies quantities state reason not_written exit""".split()


def settings(values):
    """{"time.end": "1us"} as arguments of the command line. Who says how many frames there are wants no others."""
    if "insitu.frames" in values:
        values = {"insitu.every": "[]", "insitu.events": "[]"} | values
    return [word for key, value in values.items() for word in ("--set", f"{key}={value}")]


def ejecta(*arguments, cwd=None, environment=None):
    """Runs the program to its end; returns returncode, stdout and stderr."""
    return subprocess.run([PROGRAM, *map(str, arguments)], cwd=cwd, env={**os.environ, **(environment or {})},
                          capture_output=True, text=True, timeout=300)


class Table:
    """A CSV file with units in its header: columns by their name without the unit."""

    def __init__(self, file):
        with open(file, newline="") as lines:
            header, *self.rows = csv.reader(lines)
        self.names = [re.sub(r" \[.*\]$", "", name) for name in header]

    def __getitem__(self, name):
        k = self.names.index(name)
        return [row[k] for row in self.rows]

    def numbers(self, name):
        return [float(cell or "nan") for cell in self[name]]


def pixels(file):
    """Width, height and the rows of an image, each as bytes r g b r g b ..."""
    probe = subprocess.run(["ffprobe", "-v", "error", "-show_entries", "stream=width,height", "-of", "csv=p=0", file],
                           capture_output=True, text=True, check=True)
    width, height = map(int, probe.stdout.split(","))
    raw = subprocess.run(["ffmpeg", "-v", "error", "-i", file, "-f", "rawvideo", "-pix_fmt", "rgb24", "-"],
                         capture_output=True, check=True).stdout
    return width, height, [raw[3 * width * y:3 * width * (y + 1)] for y in range(height)]


def colours(line):
    return [line[k:k + 3] for k in range(0, len(line), 3)]


def movie_frames(file):
    probe = subprocess.run(["ffprobe", "-v", "error", "-count_frames", "-show_entries", "stream=nb_read_frames", "-of",
                            "csv=p=0", file], capture_output=True, text=True, check=True)
    return int(probe.stdout)


class Snapshot:
    """A checkpoint or snapshot, read with the HDF5 library that the program itself uses."""

    def __init__(self, file):
        hdf5 = ctypes.CDLL(ctypes.util.find_library("hdf5_openmpi"))
        handle, number = ctypes.c_int64, ctypes.c_int
        for name in ("H5Fopen", "H5Dopen2", "H5Dget_space"):
            getattr(hdf5, name).restype = handle
        hdf5.H5Sget_simple_extent_npoints.restype = ctypes.c_int64
        hdf5.H5open()
        self._hdf5, self._types = hdf5, {ctypes.c_double: "H5T_NATIVE_DOUBLE_g", ctypes.c_int32: "H5T_NATIVE_INT32_g"}
        self._file = handle(hdf5.H5Fopen(str(file).encode(), number(0), handle(0)))
        if self._file.value < 0:
            raise OSError(f"{file} is not HDF5")

    def _read(self, name, kind):
        hdf5, handle = self._hdf5, ctypes.c_int64
        data = handle(hdf5.H5Dopen2(self._file, name.encode(), handle(0)))
        if data.value < 0:
            raise KeyError(name)
        space = handle(hdf5.H5Dget_space(data))
        values = (kind * hdf5.H5Sget_simple_extent_npoints(space))()
        memory_type = handle.in_dll(hdf5, self._types[kind])
        if hdf5.H5Dread(data, memory_type, handle(0), handle(0), handle(0), values) < 0:
            raise OSError(name)
        hdf5.H5Sclose(space)
        hdf5.H5Dclose(data)
        return list(values)

    def column(self, name):
        return self._read("/columns/" + name, ctypes.c_double)

    def label(self, name):
        return self._read("/labels/" + name, ctypes.c_int32)


class RunTest(unittest.TestCase):
    """A test with a folder of its own to run in."""

    def setUp(self):
        self.folder = Path(tempfile.mkdtemp(prefix="ejecta_test_"))
        self.addCleanup(shutil.rmtree, self.folder)

    def run_scene(self, scene, name, values, *more, code=0, environment=None):
        """Runs a scene into folder/name and returns that folder."""
        out = self.folder / name
        self.last = ejecta("run", scene, "--out", out, *settings(values), *more, environment=environment)
        self.assertEqual(self.last.returncode, code, self.last.stderr)
        return out


def summary(folder):
    return json.loads((folder / "summary.json").read_text())


def resolved(folder):
    return tomllib.loads((folder / "resolved.toml").read_text())
