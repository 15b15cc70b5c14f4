"""The cells of a grid at one time, as particles are seen."""
import h5py
import numpy as np


class GridState:
    """All cells, those along x first: state["density"], state["velocity"] (one row a cell), state["position"] (centres).

    Pressures are those of an ideal gas.
    """
    names = ["density", "mass", "position", "pressure", "sound_speed", "specific_energy", "velocity"]

    def __init__(self, file, spacing, gamma):
        with h5py.File(file) as data:
            self.time, self.step = float(data.attrs["time"]), int(data.attrs["step"])
            scalars, columns = data["scalars"], data["columns"]
            axes = [axis for axis in "xyz" if f"grid.cells_{axis}" in scalars]
            self.cells = tuple(int(scalars[f"grid.cells_{axis}"][0]) for axis in axes)
            corner = [float(scalars[f"grid.corner_{axis}"][0]) for axis in axes]
            density, energy = columns["grid.density"][:], columns["grid.energy"][:]
            velocity = np.stack([columns[f"grid.momentum_{axis}"][:] / density for axis in axes], axis=-1)
        places = np.meshgrid(*(low + (np.arange(n) + 0.5) * spacing for low, n in zip(corner, self.cells)), indexing="ij")
        specific = energy / density - 0.5 * np.sum(velocity ** 2, axis=1)
        self.volume = np.full(len(density), spacing ** len(axes))
        self._fields = {"position": np.stack([place.ravel(order="F") for place in places], axis=-1), "density": density,
                        "velocity": velocity, "specific_energy": specific, "pressure": (gamma - 1) * density * specific,
                        "sound_speed": np.sqrt(gamma * (gamma - 1) * np.maximum(specific, 0)),
                        "mass": density * self.volume, "id": np.arange(len(density))}

    def __getitem__(self, name):
        return self._fields[name]

    def __len__(self):
        return len(self.volume)
