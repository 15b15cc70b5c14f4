"""Taylor's anvil: the energy balance of a mushrooming rod, its length, and the wall as a mirror."""
import numpy as np
from scipy.spatial import cKDTree

from exact.viscosity import viscous_power
from harness import Bound, Case, execute
from harness.run import number

LENGTH, RADIUS, SPEED = 0.024, 0.004, 205  # m, m, m/s


def again(scene, run, name, settings):
    """A scene with the spacing and the numerics of a run, in its folder."""
    numerics = {f"numerics.{key}": value for key, value in run.scene["numerics"].items()}
    return execute(scene, {"resolution.spacing": run.scene["resolution"]["spacing"], **numerics, **settings},
                   run.folder / name)


class TaylorAnvil(Case):
    """Resolution: particles in the radius. Work relative to the kinetic energy that is lost."""
    name = "taylor_anvil"
    title = "copper rod, yield stress 400 MPa, at a wall with 205 m/s"
    exact = ("kinetic energy lost = plastic work + viscous work + elastic energy; length: exp(-rho V^2/(2 Y)) "
             "(Wilkins & Guinan 1973, J. Appl. Phys. 44, 1200) with the energy that the viscosity leaves; on the axis "
             "the mean of exp(-plastic strain)")
    quick = (3, 4)
    full = (3, 4, 6, 8, 12)
    boost = "walls on every axis"
    bounds = (
        Bound("energy balance", "relative", 0.005, why="1 % is asked; from 0.01 to 0.2 % at any resolution"),
        Bound("viscous share", "relative", {3: 0.4, 4: 0.3, 6: 0.2, 8: 0.15, 12: 0.1}, 0.5, why="an ideally plastic rod "
              "has none but that of the first shock; a tenth is asked at 12. 27, 23, 18, 13, 9 % were measured: the "
              "coarse rods converge more slowly than at first order: 0.57 from 3 to 4, 0.78 from 3 to 12"),
        Bound("final length", "relative", 0.08, why="the formula is an estimate, of a rod that is compressed evenly: 5.7 to "
              "6.9 % at any resolution. Plastic strain a tenth too large: 10 %"),
        Bound("final length", "change by 3/2 in spacing", 0.01, why="of the error above, of which viscosity is no part: 0.1 "
              "to 0.7 %. It is noise: spacings from 0.60 to 0.72 mm, which cut the circle otherwise, give 5.7 to 6.7 %"),
        Bound("final length", "to strain of the axis", 0.01, why="0.2 to 0.6 % at any resolution; a part is elastic, which "
              "is 0.3 % at yield. Plastic strain a tenth too large: 1.4 % at 4"),
    )

    def settings(self, resolution):
        return {"resolution.spacing": (RADIUS / resolution, "m")}

    def errors(self, run, resolution):
        copper, numerics = run.scene["materials"]["copper"], run.scene["numerics"]
        # The balance by formula, with a viscosity that a snapshot holds all of: the switch of the default changes in
        # every step.
        constant = again(self.scene_file, run, "constant", {"numerics.shock_switch": "false"})
        viscous = self.viscous_work(constant, numerics["viscosity_alpha"], numerics["viscosity_beta"])
        above = self.above_wilkins(run, copper)
        coarse = again(self.scene_file, run, "coarse", {"resolution.spacing": (1.5 * RADIUS / resolution, "m")})
        return {("energy balance", "relative"): abs(self.solid_share(constant, copper) + viscous / self.lost(constant) - 1),
                ("viscous share", "relative"): 1 - self.solid_share(run, copper),
                ("final length", "relative"): abs(above - 1),
                ("final length", "change by 3/2 in spacing"): abs(self.above_wilkins(coarse, copper) / above - 1),
                ("final length", "to strain of the axis"): abs(self.axis_by_strain(run) / self.shortening(run) - 1)}

    @staticmethod
    def lost(run):
        return run.history["kinetic energy"][0] - run.history["kinetic energy"][-1]

    def solid_share(self, run, copper):
        """Plastic work and elastic energy over the kinetic energy lost; the rest is the viscosity's."""
        plastic = self.plastic_work(run, number(copper["strength"]["yield_stress"]), number(copper["eos"]["density"]))
        elastic = self.elastic_energy(run.final, number(copper["elastic"]["shear_modulus"]), number(copper["eos"]["A"]))
        return (plastic + elastic) / self.lost(run)

    def shortening(self, run):
        """Final length over that at the start."""
        return (run.final["position"][:, 0].max() + 0.5 * run.final.volume.mean() ** (1 / 3)) / LENGTH

    def above_wilkins(self, run, copper):
        """The same over the formula with the energy that became plastic work and stress. What the viscosity takes does
        not shorten the rod."""
        strength, density = number(copper["strength"]["yield_stress"]), number(copper["eos"]["density"])
        return self.shortening(run) / np.exp(-self.solid_share(run, copper) * density * SPEED**2 / (2 * strength))

    def axis_by_strain(self, run):
        """What the plastic strain of the particles next to the axis makes of the rod: symmetry lets them be compressed
        along it and nothing else, and plastic strain is the logarithm of that."""
        radius = np.hypot(*run.states[0]["position"][:, 1:].T)
        return np.exp(-run.final["plastic_strain"][radius < 1.01 * radius.min()]).mean()

    def plastic_work(self, run, strength, density):
        """int Y V d(eps_p) along every particle, by the trapezoidal rule over the snapshots."""
        work, strain, volume = 0.0, 0.0, run.final["mass"] / density
        for state in run.states:
            work += strength * np.sum((state["plastic_strain"] - strain) * (state.volume + volume) / 2)
            strain, volume = state["plastic_strain"], state.volume
        return work

    def viscous_work(self, run, alpha, beta):
        """Its power summed over time; the impact itself, with most of it, once more with states close together."""
        impact = again(self.scene_file, run, "impact",
                       {"time.end": "2 us", "output.snapshots": 100, "numerics.shock_switch": "false"})
        states = impact.states + [s for s in run.states if s.time > impact.final.time * (1 + 1e-9)]
        power = [viscous_power(s, alpha, beta) for s in states]
        return np.trapz([power[0], *power], [0.0, *(s.time for s in states)])

    def elastic_energy(self, state, shear_modulus, bulk_modulus):
        """V (S:S/(4 G) + P^2/(2 K))."""
        xx, yy, xy, xz, yz = state["deviatoric_stress"].T
        squared = xx**2 + yy**2 + (xx + yy)**2 + 2 * (xy**2 + xz**2 + yz**2)
        return np.sum(state.volume * (squared / (4 * shear_modulus) + state["pressure"]**2 / (2 * bulk_modulus)))


class TaylorTwoRods(Case):
    """Resolution: particles in the radius. Differences relative to the length and to the speed of the rod."""
    name = "taylor_two_rods"
    title = "one copper rod at a plane of symmetry and two that are one"
    exact = "the same, particle by particle"
    scene = "two_rods.toml"
    quick = (3,)
    full = (3, 4)
    boost, boost_speed = "x", 100.0
    mixed_margin = "the errors are round-off"
    bounds = (
        Bound("place", "largest", 1e-10, why="round-off"),
        Bound("velocity", "largest", 1e-10, why="round-off"),
        Bound("plastic strain", "largest", 1e-10, why="round-off"),
    )

    def settings(self, resolution):
        return {"resolution.spacing": (RADIUS / resolution, "m")}

    def errors(self, run, resolution):
        mirror = again(TaylorAnvil().scene_file, run, "mirror",
                       {"boundary.x": "symmetry", "output.snapshots": 0})  # which cut time steps
        two, one = run.final, mirror.final
        distance, partner = cKDTree(two["position"]).query(one["position"])
        speed = np.abs(two["velocity"][partner] - one["velocity"]).max()
        return {("place", "largest"): distance.max() / LENGTH, ("velocity", "largest"): speed / SPEED,
                ("plastic strain", "largest"): np.abs(two["plastic_strain"][partner] - one["plastic_strain"]).max()}


CASES = [TaylorAnvil(), TaylorTwoRods()]
