"""Noh's problem in one, two and three dimensions: shocks of infinite strength into cold gas."""
import numpy as np

from exact.noh import Noh
from harness import Bound, Case, l1, linf, relative

ROWS = 12
NO_NEGATIVE_ENERGY = Bound("negative energy", "relative", 1e-12, why="there is none but for round-off")


class NohCase(Case):
    exact = "Noh (1987): behind the shock density 4^nu, specific energy 1/2, at rest; shock speed 1/3"
    nu: int
    reach = 0.05, 0.35  # m: where errors are measured, as by Spheral: without the heated wall and the open end

    def radial(self, state):
        """Distance from the wall, and density, speed inwards, pressure and specific energy."""
        r = np.linalg.norm(state["position"][:, :self.nu], axis=1)
        inwards = -np.sum(state["position"][:, :self.nu] * state["velocity"][:, :self.nu], axis=1) / r
        return r, (state["density"], inwards, state["pressure"], state["specific_energy"])

    profile_axis = "r [m]"

    def profiles(self, run):
        r, values = self.radial(run.final)
        labels = "density [kg/m^3]", "speed inwards [m/s]", "pressure [Pa]", "specific energy [J/kg]"
        near = r <= self.reach[1]
        return [(label, r[near], value[near], exact) for label, value, exact in zip(
            labels, values, Noh(self.nu).at(r[near], run.final.time))]

    def errors(self, run, resolution):
        state, noh = run.final, Noh(self.nu)
        r, values = self.radial(state)
        k = (self.reach[0] <= r) & (r <= self.reach[1])
        errors = {}
        for name, value, exact in zip(("density", "velocity", "pressure", "energy"), values, noh.at(r[k], state.time)):
            errors[name, "L1"] = l1(value[k], exact, state.volume[k])
            if self.nu == 1:
                errors[name, "Linf"] = linf(value[k], exact)
        inner = (0.05 < r) & (r < 0.15)
        plateau = np.average(state["density"][inner], weights=state.volume[inner])
        errors["plateau density", "relative"] = relative(plateau, noh.density)
        energy = state["specific_energy"]
        errors["negative energy", "relative"] = max(0, -energy.min() / np.abs(energy).max())
        return errors


class NohPlanar(NohCase):
    """Resolution: particles along the gas, 1 m at the start."""
    name = "noh_planar"
    title = "Noh's problem, planar, t = 0.6 s"
    scene = "planar.toml"
    nu = 1
    quick = (25, 50, 100)
    full = (25, 50, 100, 200, 400)
    boost = "y"
    shock = "a particle inside the shock, whose width is a number of particles"
    bounds = (  # Spheral, SPH with the same kernel in one dimension: 0.0538, 0.0245, 0.0181, 0.0106 at 100
        Bound("density", "L1", {100: 0.0538, 400: 0.019}, 0.85),
        Bound("velocity", "L1", {100: 0.021, 400: 0.0053}, 0.85),
        Bound("pressure", "L1", {100: 0.016, 400: 0.0044}, 0.85),
        Bound("energy", "L1", {100: 0.0069, 400: 0.0018}, 0.85),
        Bound("density", "Linf", 2.6, why=shock),
        Bound("velocity", "Linf", 1.1, why=shock),
        Bound("pressure", "Linf", 0.9, why=shock),
        Bound("energy", "Linf", 0.4, why=shock),
        Bound("plateau density", "relative", {50: 0.0036, 100: 0.0009, 400: 0.0009}, why="far below the other errors"),
        NO_NEGATIVE_ENERGY,
    )

    def settings(self, resolution):
        spacing = 1 / (4 * resolution)
        height = ROWS * spacing
        return {"resolution.spacing": (spacing, "m"), "bodies.gas.size": (0.25, height, "m"),
                "boundary.min": (0, -height / 2, "m"), "boundary.max": (2, height / 2, "m")}


class NohCylindrical(NohCase):
    """Resolution: particles along the radius, 1 m at the start."""
    name = "noh_cylindrical"
    title = "Noh's problem, cylindrical, t = 0.6 s"
    scene = "cylindrical.toml"
    nu = 2
    quick = (25, 50)
    full = (25, 50, 100, 200)
    boost = "there is a wall on every axis"
    bounds = (
        Bound("density", "L1", {50: 0.95, 200: 0.12}, 1.2),
        Bound("velocity", "L1", {50: 0.067, 200: 0.0085}, 1.2),
        Bound("pressure", "L1", {50: 0.26, 200: 0.033}, 1.2),
        Bound("energy", "L1", {50: 0.029, 200: 0.0038}, 1.2),
        Bound("plateau density", "relative", {50: 0.08, 100: 0.05, 200: 0.01}, 1.3),
        NO_NEGATIVE_ENERGY,
    )

    def settings(self, resolution):
        return {"resolution.spacing": (1 / resolution, "m")}


class NohSpherical(NohCylindrical):
    name = "noh_spherical"
    title = "Noh's problem, spherical, t = 0.6 s"
    scene = "spherical.toml"
    nu = 3
    quick = (10, 20)
    full = (10, 15, 25, 50)
    bounds = (  # the shock has run over 2 to 10 particles' worth of gas: orders are those of a start
        Bound("density", "L1", {20: 15, 50: 6.2}, why="peaks when the shock begins to be resolved; falls from 15 on"),
        Bound("velocity", "L1", {20: 0.43, 50: 0.1}, 0.7),
        Bound("pressure", "L1", {20: 5.5, 50: 2}, why="as density"),
        Bound("energy", "L1", {20: 0.25, 50: 0.053}, 0.7),
        Bound("plateau density", "relative", {20: 0.7, 50: 0.29}, 0.2),
        NO_NEGATIVE_ENERGY,
    )


class WithTensors:
    """The same with smoothing tensors. Resolutions and limits: measured and 15 %."""

    def settings(self, resolution):
        return {**super().settings(resolution), "numerics.scheme": "asph"}


class NohPlanarTensors(WithTensors, NohPlanar):
    name = "noh_planar_asph"
    title = "Noh's problem, planar, with smoothing tensors"
    quick, full = (25, 50), (25, 50, 100)
    bounds = (
        Bound("density", "L1", {50: 0.126, 100: 0.062}, 0.85),
        Bound("velocity", "L1", {50: 0.0445, 100: 0.0215}, 0.85),
        # At 100 pressure 0.0186 and energy 0.0085 (with lengths 0.0138, 0.0058), which were 0.0137 and 0.0063 with shorter steps:
        # with courant 0.25 they are 0.0146 and 0.0067, with votes on H every 3 steps in place of 10 0.0152 and 0.0069.
        Bound("pressure", "L1", {50: 0.032, 100: 0.0214}, 0.6),
        Bound("energy", "L1", {50: 0.015, 100: 0.0097}, 0.72),
        *(bound for bound in NohPlanar.bounds if bound.norm != "L1" and bound.quantity != "plateau density"),
        Bound("plateau density", "relative", {25: 0.028, 50: 0.0036, 100: 0.0036}, why="at 25 the plateau is short"),
    )


class NohCylindricalTensors(WithTensors, NohCylindrical):
    name = "noh_cylindrical_asph"
    title = "Noh's problem, cylindrical, with smoothing tensors"
    quick = full = (25, 50)
    limits = "40 to 70 % more than with lengths at 50: behind the converging shock the lattice is disordered, and so is H"
    bounds = (
        Bound("density", "L1", {25: 2.45, 50: 1.34}, 0.75, limits),
        Bound("velocity", "L1", {25: 0.195, 50: 0.116}, 0.6, limits),
        # Pressure 0.59 at 25 and 0.38 at 50: an order of 0.63.
        Bound("pressure", "L1", {25: 0.75, 50: 0.445}, 0.58, limits),
        Bound("energy", "L1", {25: 0.09, 50: 0.052}, 0.65, limits),
        Bound("plateau density", "relative", {25: 0.24, 50: 0.068}, 1.3),
        NO_NEGATIVE_ENERGY,
    )


class NohCylindricalRiemann(NohCylindrical):
    """The same with Riemann problems between particles: less than half the errors. Limits: measured and 15 %."""
    name = "noh_cylindrical_gsph"
    title = "Noh's problem, cylindrical, with Riemann problems between particles"
    quick, full = (25, 50), (25, 50, 100)
    bounds = (
        Bound("density", "L1", {25: 0.45, 50: 0.24}, 0.8),
        Bound("velocity", "L1", {25: 0.034, 50: 0.0175}, 0.8),
        Bound("pressure", "L1", {25: 0.158, 50: 0.085}, 0.8),
        Bound("energy", "L1", {25: 0.0177, 50: 0.0093}, 0.8),
        Bound("plateau density", "relative", {25: 0.028, 50: 0.0168}, 0.65, "a third of what it is with viscosity"),
        Bound("negative energy", "relative", 2.5e-5, why="work of p* v* alone may cool cold gas ahead of the shock"),
    )
    mixed_margin = "Riemann problems are solved in double precision"

    def settings(self, resolution):
        return {**super().settings(resolution), "numerics.scheme": "gsph", "numerics.density": "continuity"}


class NohPlanarRiemann(NohPlanar):
    """The same with Riemann problems between particles, densities as by default. Limits: measured and 15 %, of the
    largest error of the density 4 %: volumes that fill space in shocks too have 9 % more."""
    name = "noh_planar_gsph"
    title = "Noh's problem, planar, with Riemann problems between particles"
    quick = full = (25, 50, 100)
    bounds = (
        Bound("density", "L1", {50: 0.0725, 100: 0.0385}, 0.85),
        Bound("velocity", "L1", {50: 0.0107, 100: 0.0055}, 0.85),
        Bound("pressure", "L1", {50: 0.0196, 100: 0.01}, 0.85),
        Bound("energy", "L1", {50: 0.0048, 100: 0.00245}, 0.85),
        Bound("density", "Linf", 1.17, why=NohPlanar.shock),
        Bound("velocity", "Linf", 0.152, why=NohPlanar.shock),
        Bound("pressure", "Linf", 0.53, why=NohPlanar.shock),
        Bound("energy", "Linf", 0.0755, why=NohPlanar.shock),
        Bound("plateau density", "relative", {50: 0.0036, 100: 0.0009}, why="far below the other errors"),
        Bound("negative energy", "relative", 1.2e-10, why="work of p* v* alone may cool cold gas ahead of the shock"),
    )
    mixed_margin = "Riemann problems are solved in double precision"

    def settings(self, resolution):
        return {**super().settings(resolution), "numerics.scheme": "gsph", "numerics.density": "summation"}


CASES = [NohPlanar(), NohCylindrical(), NohSpherical(), NohPlanarTensors(), NohCylindricalTensors(), NohCylindricalRiemann(),
         NohPlanarRiemann()]
