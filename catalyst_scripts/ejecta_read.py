"""Reads checkpoints and snapshots of a run. Needs h5py and numpy, nothing else of Ejecta; may be copied anywhere.

    from ejecta_read import State
    state = State("runs/my_run/snapshots/snapshot_000120.h5")
    print(state.time, state.step, state.fields())     # s, a number, {"density": "kg/m^3", ...}
    speed = numpy.linalg.norm(state["velocity"], axis=1)

A field is an array in SI, one row an element: particles, or with a prefix as in "grid.density" cells, whose centres
`cell_centres()` gives in the same order. Vectors have a
column for each dimension. Symmetric tensors are rows XX, YY, XY in the plane and XX, YY, ZZ, XY, XZ, YZ in space;
deviators XX, YY, XY, in space also XZ, YZ (ZZ is minus the sum of the first two); other tensors go row by row.
`ejecta export` writes the same in VTK's order, with the numbers of the fragments.
"""
import re
import tomllib

import h5py
import numpy


class State:
    def __init__(self, file):
        with h5py.File(file, "r") as data:
            self.time, self.step = float(data.attrs["time"]), int(data.attrs["step"])
            scene = data["scene"][()]
            self.scene = tomllib.loads(scene.decode() if isinstance(scene, bytes) else bytes(scene).decode())
            self._numbers = {name: float(value[0]) for name, value in data["scalars"].items()}
            self._columns, self._units = {}, {}
            for group in ("columns", "labels"):
                for name, column in data.get(group, {}).items():
                    field, component = self._split(name)
                    self._columns.setdefault(field, {})[component] = column[()]
                    unit = column.attrs["unit"]
                    self._units[field] = unit.decode() if isinstance(unit, bytes) else str(unit)

    @staticmethod
    def _split(name):
        found = re.fullmatch(r"(.*)_(\d+|[xyz])", name)
        return (found[1], "xyz".find(found[2]) if found[2] in "xyz" else int(found[2])) if found else (name, 0)

    def fields(self):
        """{name: SI unit}"""
        return dict(self._units)

    def cell_centres(self):
        """Of a grid [m]: one row a cell, as in its fields."""
        axes = [axis for axis in "xyz" if f"grid.cells_{axis}" in self._numbers]
        if not axes:
            raise KeyError("there is no grid")
        width = float(self.scene["resolution"]["spacing"].split()[0])
        if "hybrid.clock_time" in self._numbers:
            width *= self.scene["hybrid"]["ratio"]
        along = [self._numbers[f"grid.corner_{axis}"] + width * (0.5 + numpy.arange(self._numbers[f"grid.cells_{axis}"]))
                 for axis in axes]
        places = numpy.meshgrid(*along, indexing="ij")  # cells go along x first
        return numpy.column_stack([place.ravel(order="F") for place in places])

    def __getitem__(self, field):
        if field not in self._columns:
            raise KeyError(f"{field}; there are {', '.join(sorted(self._columns))}")
        columns = [column for _, column in sorted(self._columns[field].items())]
        return columns[0] if len(columns) == 1 else numpy.column_stack(columns)
