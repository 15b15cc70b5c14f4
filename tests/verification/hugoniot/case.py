"""Hugoniots: a bar of every material that has Tillotson's or Mie and Grueneisen's equation of state, at a wall."""
import tomllib

import numpy as np

from exact.hugoniot import Shock, from_library
from exact.mie_grueneisen import MieGrueneisen
from exact.tillotson import Tillotson
from harness import Bound, Case, binned, fall, l1, relative
from harness.run import SOURCE

LENGTH, ROWS = 0.2, 8  # m; spacings
SPEEDS = 500, 1000, 2000  # m/s
LIBRARY = SOURCE / "inputs" / "materials"
EQUATIONS = {file.stem: eos for file in sorted(LIBRARY.glob("*.toml"))
             if (eos := tomllib.loads(file.read_text())["eos"])["model"] == "tillotson"}
METALS = {name: tomllib.loads((LIBRARY / f"{name}.toml").read_text())["eos"] for name in ("steel_304", "copper_ofhc")}

# Shock speed [m/s], pressure [GPa] and, where given, density [kg/m^3] worked out by another program.
PRINTED = {
    ("basalt", 500): (3905, 5.271, 3096), ("basalt", 1000): (4684, 12.646, 3433),
    ("basalt", 2000): (6298, 34.009, 3956),
    ("aluminium", 500): (6016, 8.122, 2945), ("aluminium", 1000): (6754, 18.234, 3169),
    ("aluminium", 2000): (8183, 44.186, 3573), ("iron", 500): (4768, 18.60, 8714), ("iron", 1000): (5501, 42.91, 9533),
    ("iron", 2000): (6980, 108.9, 10932), ("nylon", 500): (4144, 2.455, 1348), ("nylon", 1000): (5200, 6.162, 1467),
    ("nylon", 2000): (7111, 16.85, 1649), ("polycarbonate", 500): (3413, 2.037), ("polycarbonate", 1000): (4055, 4.841),
    ("polycarbonate", 2000): (5322, 12.71)}


class Hugoniot(Case):
    """Resolution: particles along the bar."""
    exact = "jump conditions of Rankine and Hugoniot with Tillotson's equation of state, constants of the run"
    full = (50, 100, 200)
    boost = "y"
    equation, densest = Tillotson, 20
    bounds = (
        Bound("plateau pressure", "relative", {50: 0.022, 100: 0.005, 200: 0.005}, why="1 % is asked; what is left "
              "beyond 100 particles is no longer the width of the shock but the spacing behind it, so no order"),
        Bound("shock speed", "relative", {50: 0.01, 100: 0.005, 200: 0.002}, why="0.5 % is asked; the smallest of them "
              "are at the accuracy of a place in a lattice, so no order"),
        Bound("density", "L1", {50: 0.075, 100: 0.045, 200: 0.025}, 0.8),
        Bound("pressure", "L1", {50: 0.07, 100: 0.04, 200: 0.022}, 0.8),
        Bound("velocity", "L1", {50: 0.07, 100: 0.04, 200: 0.022}, 0.8),
    )

    def __init__(self, material, speed):
        self.material, self.speed = material, speed
        self.name = f"hugoniot_{material}_{speed}"
        self.title = f"{material} at a particle speed of {speed} m/s"
        self.shock = Shock.behind_piston(from_library(EQUATIONS[material]), speed)
        if (material, speed) == ("basalt", 1000):
            self.quick = (50, 100, 200)
        else:
            self.quick = (100,) if speed == 1000 else ()
            self.rotation = self.boost = self.mixed_margin = "shown with basalt at 1000 m/s; only constants differ"

    def settings(self, resolution):
        constants = {f"materials.fluid.eos.{key}": value for key, value in EQUATIONS[self.material].items()}
        return {**constants, **self.geometry(resolution)}

    def geometry(self, resolution):
        spacing = LENGTH / resolution
        width = ROWS * spacing
        return {"resolution.spacing": (spacing, "m"), "bodies.bar.size": (LENGTH, width, "m"),
                "bodies.bar.velocity": (-self.speed, 0, "m/s"),
                "boundary.min": (0, -width / 2, "m"), "boundary.max": (1.5 * LENGTH, width / 2, "m"),
                "time.end": (0.7 * LENGTH / self.shock.speed, "s")}

    def errors(self, run, resolution):
        """Profiles relative to the jump and over the whole bar; the plateau without the wall and the shock itself."""
        state = run.final
        shock = Shock.behind_piston(self.equation.of(run.scene, "fluid"), self.speed, self.densest)
        x, front = state["position"][:, 0], (shock.speed - self.speed) * state.time
        behind = x < front
        rho0 = shock.density * (1 - self.speed / shock.speed)
        fields = {"density": (state["density"], np.where(behind, shock.density, rho0), shock.density - rho0),
                  "pressure": (state["pressure"], np.where(behind, shock.pressure, 0), shock.pressure),
                  "velocity": (state["velocity"][:, 0], np.where(behind, 0, -self.speed), self.speed)}
        errors = {(name, "L1"): l1(value, exact, state.volume) / jump for name, (value, exact, jump) in fields.items()}
        plateau = (x > 0.2 * front) & (x < 0.8 * front)
        errors["plateau pressure", "relative"] = relative(state["pressure"][plateau].mean(), shock.pressure)
        errors["shock speed", "relative"] = relative(self.measured_speed(run, LENGTH / resolution), shock.speed)
        return errors

    def measured_speed(self, run, spacing):
        """Relative to the bar: slope of the line through the places where the pressure has half its jump."""
        later = run.states[3:]
        places = [fall(*binned(s["position"][:, 0], s["pressure"], 0.2 * spacing), self.shock.pressure / 2)
                  for s in later]
        return np.polyfit([s.time for s in later], places, 1)[0] + self.speed

    def check_exact(self):
        printed = PRINTED.get((self.material, self.speed))
        if printed:
            found = self.shock.speed, self.shock.pressure * 1e-9, self.shock.density
            assert np.allclose(found[:len(printed)], printed, rtol=5e-4), (found, printed)


class MetalHugoniot(Hugoniot):
    """Mie and Grueneisen's equation of state, whose Hugoniot is known in closed form."""
    scene = "metal.toml"
    equation, densest = MieGrueneisen, 1.5
    exact = "us = c0 + S1 up, P = rho0 us up"

    def __init__(self, material, speed):
        self.material, self.speed = material, speed
        self.name = f"hugoniot_{material}_{speed}"
        self.title = f"{material} at a particle speed of {speed} m/s"
        eos = METALS[material]
        self.constants = {key: eos.get(key, 0) for key in MieGrueneisen.__dataclass_fields__}
        self.shock = Shock.behind_piston(from_library(self.constants, MieGrueneisen), speed, self.densest)
        self.quick = (100,) if speed == 1000 else ()
        self.rotation = self.boost = self.mixed_margin = "shown with basalt at 1000 m/s; only the equation differs"

    def settings(self, resolution):
        constants = {f"materials.fluid.eos.{key}": value for key, value in self.constants.items()}
        return {**constants, **self.geometry(resolution)}

    def check_exact(self):
        eos = from_library(self.constants, MieGrueneisen)
        speed = eos.c0 + eos.S1 * self.speed
        assert np.allclose((self.shock.speed, self.shock.pressure), (speed, eos.density * speed * self.speed), rtol=1e-9)


CASES = [Hugoniot(material, speed) for material in EQUATIONS for speed in SPEEDS]
CASES += [MetalHugoniot(material, speed) for material in METALS for speed in SPEEDS]
