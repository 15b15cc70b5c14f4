"""Taylor's anvil: the energy balance of a mushrooming rod, its length, and the wall as a mirror."""
import numpy as np
from scipy.spatial import cKDTree

from exact.viscosity import viscous_power
from harness import Bound, Case, execute
from harness.run import number

LENGTH, RADIUS = 0.024, 0.004  # m


class TaylorAnvil(Case):
    """Resolution: particles in the radius. Work relative to the kinetic energy that is lost."""
    name = "taylor_anvil"
    title = "copper rod, yield stress 400 MPa, at a wall with 205 m/s"
    exact = "kinetic energy lost = yield stress times plastic strain, summed over volume and time, + elastic energy"
    quick = (3, 4)
    full = (4, 6, 8)
    boost = "walls on every axis"
    bounds = (
        Bound("energy balance", "relative", 0.01, why="1 % is asked; it is a matter of the time step"),
    )

    def settings(self, resolution):
        return {"resolution.spacing": (RADIUS / resolution, "m")}

    def errors(self, run, resolution):
        copper, numerics, kinetic = run.scene["materials"]["copper"], run.scene["numerics"], run.history["kinetic energy"]
        lost = kinetic[0] - kinetic[-1]
        plastic = self.plastic_work(run, number(copper["strength"]["yield_stress"]), number(copper["eos"]["density"]))
        elastic = self.elastic_energy(run.final, number(copper["elastic"]["shear_modulus"]), number(copper["eos"]["A"]))
        power = [viscous_power(s, numerics["viscosity_alpha"], numerics["viscosity_beta"]) for s in run.states]
        viscous = np.trapz(power, [s.time for s in run.states])
        length = run.final["position"][:, 0].max() + 0.5 * run.final.volume.mean() ** (1 / 3)
        print(plastic / lost, elastic / lost, viscous / lost, length / LENGTH)
        return {("energy balance", "relative"): abs((plastic + elastic + viscous) / lost - 1),
                ("viscous share", "relative"): viscous / lost,
                ("final length", "relative"): length / LENGTH}

    def plastic_work(self, run, strength, density):
        """int Y V d(eps_p) along every particle, by the trapezoidal rule over the snapshots."""
        work, strain, volume = 0.0, 0.0, run.final["mass"] / density
        for state in run.states:
            work += strength * np.sum((state["plastic_strain"] - strain) * (state.volume + volume) / 2)
            strain, volume = state["plastic_strain"], state.volume
        return work

    def elastic_energy(self, state, shear_modulus, bulk_modulus):
        """V (S:S/(4 G) + P^2/(2 K))."""
        xx, yy, xy, xz, yz = state["deviatoric_stress"].T
        squared = xx**2 + yy**2 + (xx + yy)**2 + 2 * (xy**2 + xz**2 + yz**2)
        return np.sum(state.volume * (squared / (4 * shear_modulus) + state["pressure"]**2 / (2 * bulk_modulus)))


class TaylorTwoRods(Case):
    """Resolution: particles in the radius. Differences relative to the length and to the speed of the rod."""
    name = "taylor_two_rods"
    title = "one copper rod against a mirror and two against each other"
    exact = "the same, particle by particle"
    scene = "two_rods.toml"
    quick = (3,)
    full = (3, 4)
    boost = "x"
    boost_speed = 100.0
    bounds = (
        Bound("place", "largest", 1e-10, why="round-off"),
        Bound("velocity", "largest", 1e-10, why="round-off"),
        Bound("plastic strain", "largest", 1e-10, why="round-off"),
    )

    def settings(self, resolution):
        return {"resolution.spacing": (RADIUS / resolution, "m")}

    def errors(self, run, resolution):
        mirror = execute(TaylorAnvil().scene_file, self.settings(resolution), run.folder.with_name(f"{run.folder.name}_mirror"))
        two, one = run.final, mirror.final
        distance, partner = cKDTree(two["position"]).query(one["position"])
        speed = np.abs(two["velocity"][partner] - one["velocity"]).max()
        return {("place", "largest"): distance.max() / LENGTH, ("velocity", "largest"): speed / 205,
                ("plastic strain", "largest"): np.abs(two["plastic_strain"][partner] - one["plastic_strain"]).max()}


CASES = [TaylorAnvil(), TaylorTwoRods()]
