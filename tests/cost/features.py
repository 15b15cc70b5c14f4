"""What each feature of a scene adds: stages, columns, and nothing else.

A case is the case it is based on with settings added. The first case of each scene says all it has; every other one
only what it adds to its base and what it drops."""
from dataclasses import dataclass
from pathlib import Path

FOLDER = Path(__file__).resolve().parent

# Every stage there is, in the order of the algorithm.
ALGORITHM = ["neighbours", "density", "equation of state", "strength", "bonds", "damage", "slopes",
             "pair rates",
             "strain rates", "viscosity switches", "smoothing lengths"]

# Components in three dimensions of what is no plain number.
COMPONENTS = {"position": 3, "velocity": 3, "acceleration": 3, "velocity_gradient": 9, "density_gradient": 3,
              "pressure_gradient": 3, "face_correction": 9, "deviatoric_stress": 5,
              "stress_rate": 5, "start_position": 3}
# Rates are kept three times: the integrator needs those of the step before, and but for motion what it expected of them.
COPIES = {"acceleration": 2, "specific_energy_rate": 3, "compression_rate": 3, "stress_rate": 3}

GAS_COLUMNS = """position velocity acceleration mass density specific_energy specific_energy_rate pressure sound_speed
smoothing_length zeroth_moment largest_mu""".split()


def bytes_of(columns):
    """Memory of one particle in these columns."""
    return sum(8 * COMPONENTS.get(c, 1) * COPIES.get(c, 1) for c in columns)


@dataclass
class Case:
    name: str
    base: "Case | Path"  # what it is compared with; for the first case of a scene its file
    settings: dict
    adds_stages: tuple = ()
    drops_stages: tuple = ()
    adds_columns: tuple = ()
    drops_columns: tuple = ()
    other_bytes: float = 0  # of a particle, beside columns

    @property
    def scene(self):
        return self.base.scene if isinstance(self.base, Case) else self.base

    @property
    def all_settings(self):
        return {**(self.base.all_settings if isinstance(self.base, Case) else {}), **self.settings}

    @property
    def stages(self):
        """In the order of the algorithm."""
        stages = set(self.base.stages if isinstance(self.base, Case) else ()) - set(self.drops_stages)
        return [s for s in ALGORITHM if s in stages | set(self.adds_stages)]

    @property
    def columns(self):
        columns = set(self.base.columns if isinstance(self.base, Case) else ()) - set(self.drops_columns)
        return columns | set(self.adds_columns)


def material(section, **values):
    """Settings of one section of the material of solid.toml."""
    return {f"materials.matter.{section}.{key}": value for key, value in values.items()}


VON_MISES = material("strength", model="von_mises", yield_stress="100 MPa")
COLLINS = material("strength", model="collins", cohesion="90 MPa", friction=2, limit="1.5 GPa",
                   damaged_cohesion="0 Pa", damaged_friction=0.8)
GRADY_KIPP = material("damage", model="grady_kipp", weibull_m=9.5, weibull_k="1.6e44 1/m^3")
PORES = material("porosity", model="two_power", initial_distension=3.3242857142857143, elastic_pressure="1 MPa",
                 transition_pressure="68 MPa", solid_pressure="213 MPa", reference_distension=4.64,
                 transition_distension=1.90, n1=12, n2=3)
# Beside columns: a number of the packed records, with room for an eighth more of
# them; and the sums over the surroundings (two tensors, a vector and three numbers).
RECORDED, SURROUNDINGS = 9, 8 * (9 + 9 + 2 + 3 + 1)
BONDS = ("start_position", "bond", "stretch")
# Images have records too: the gas of cost_test.py, 10 particles wide, has 3 more layers beyond each of its faces.
WITH_IMAGES = 1.6**3
BONDED = 14 * RECORDED  # the place at the start, how far the bond reaches, the deformation since and how stiff it is
STRAINED = 7 * RECORDED * WITH_IMAGES  # of a gas: its rate of strain and switch
# A byte for each cluster of as many particles as a register has lanes: whether it touches another piece.
TOUCHING = 1 / (8 if "avx512f" in Path("/proc/cpuinfo").read_text() else 4)
CRACKS = ("damage", "crack_length", "local_strain", "flaw_strain")

gas = Case("gas", FOLDER / "gas.toml", {"numerics.density": "summation"},
           adds_stages=("neighbours", "density", "equation of state", "pair rates"), adds_columns=tuple(GAS_COLUMNS))
gas_continuity = Case("gas, continuity", gas, {"numerics.density": "continuity"},
                      drops_stages=("density",), adds_stages=("strain rates", "smoothing lengths"),
                      adds_columns=("compression_rate", "velocity_gradient"), other_bytes=STRAINED)

elastic = Case("elastic", FOLDER / "solid.toml", {},
               adds_stages=("neighbours", "equation of state", "bonds", "pair rates", "strain rates",
                            "viscosity switches", "smoothing lengths"),
               adds_columns=(*GAS_COLUMNS, *BONDS, "shock_switch", "compression_rate", "velocity_gradient",
                             "deviatoric_stress", "stress_rate"))
plastic = Case("elastic, strength", elastic, VON_MISES, adds_stages=("strength",), drops_stages=("bonds",),
               adds_columns=("plastic_strain",), drops_columns=BONDS, other_bytes=-BONDED)
brittle = Case("elastic, strength, damage", plastic, GRADY_KIPP, adds_stages=("damage",),
               adds_columns=(*CRACKS, "intact_share"))
porous = Case("elastic, pores", elastic, {**PORES, **material("porosity", crush_damage="false")},
              drops_stages=("bonds",), adds_columns=("distension", "stress_factor"), drops_columns=BONDS,
              other_bytes=-BONDED)
crushed = Case("elastic, pores, damage by crushing", porous, material("porosity", crush_damage="true"),
               adds_stages=("damage",), adds_columns=("damage", "intact_share"))
rock = Case("elastic, rock", elastic, COLLINS, adds_stages=("strength",), drops_stages=("bonds",),
            adds_columns=("plastic_strain",), drops_columns=BONDS, other_bytes=-BONDED)
sheared = Case("elastic, rock that breaks in shear", rock,
               material("strength", brittle_ductile="1.2 GPa", brittle_plastic="2.4 GPa"), adds_stages=("damage",),
               adds_columns=("damage", "intact_share", "shear_damage"))
pumice = Case("elastic, strength, damage, pores", brittle, PORES, adds_columns=("distension", "stress_factor"))

CASES = [
    gas,
    Case("gas, mixed precision", gas, {"numerics.precision": "mixed"}),
    Case("gas, balsara", gas, {"numerics.balsara": "true"}, adds_stages=("viscosity switches",),
         adds_columns=("viscosity_factor", "velocity_gradient"), other_bytes=STRAINED),
    Case("gas, shock switch", gas, {"numerics.shock_switch": "true"}, adds_stages=("viscosity switches",),
         adds_columns=("shock_switch", "velocity_gradient"), other_bytes=STRAINED),
    # A Riemann problem needs 3 numbers of a particle, one of them for walls, 21 of its slopes and 2 for the conduction of
    # heat; the viscosity's one falls away, and gases touch nothing. Volumes are made to fill space.
    Case("gas, Riemann problems", gas, {"numerics.scheme": "gsph"}, adds_stages=("slopes",),
         adds_columns=("density_gradient", "pressure_gradient", "velocity_gradient", "face_correction", "filling",
                       "volume_excess"),
         other_bytes=25 * RECORDED * WITH_IMAGES - TOUCHING),
    gas_continuity,
    Case("gas, continuity, constant h", gas_continuity, {"numerics.smoothing_growth": 1},
         drops_stages=("smoothing lengths",)),
    # The stress becomes a tensor, and belongs to a piece.
    Case("gas, continuity, gradient correction", gas_continuity, {"numerics.gradient_correction": "true"},
         other_bytes=9 * RECORDED * WITH_IMAGES + SURROUNDINGS),
    elastic,
    Case("elastic, no bonds", elastic, {"numerics.bonds": "false"}, drops_stages=("bonds",), drops_columns=BONDS,
         other_bytes=-BONDED),
    plastic,
    brittle,
    porous,
    crushed,
    rock,
    sheared,
    pumice,
    Case("pumice, balsara", pumice, {"numerics.balsara": "true"}, adds_columns=("viscosity_factor",)),
    Case("pumice, no switches", pumice, {"numerics.shock_switch": "false"},
         drops_stages=("viscosity switches",), drops_columns=("shock_switch",)),
    Case("pumice, raw gradients", pumice, {"numerics.gradient_correction": "false"}),
    Case("pumice, mixed precision", pumice, {"numerics.precision": "mixed"}),
]
