"""The runs of the campaign: every one is a shipped scene with a few of its values replaced."""
from dataclasses import dataclass, field

# What each scene is run with at every spacing. Pumice: the two configurations that the GASPHiA note compares.
# Basalt: the strength that grows with pressure, which is the shipped one, and the older constant yield stress.
CONFIGURATIONS = {
    "pumice_impact": {
        "classical": {"numerics.gradient_correction": "false", "numerics.balsara": "false", "numerics.shock_switch": "false"},
        "corrected": {"numerics.gradient_correction": "true", "numerics.balsara": "true"},
    },
    "basalt_impact": {
        "collins": {},
        "von_mises": {"bodies.target.material": "basalt_von_mises"},
    },
}
# One thing changed at a time, at the coarsest spacing, in the first configuration: what the outcome hangs on.
VARIATIONS = {
    "pumice_impact": {
        "correction_only": {"numerics.gradient_correction": "true", "numerics.balsara": "false"},
        "balsara_only": {"numerics.gradient_correction": "false", "numerics.balsara": "true"},
        "no_crush_damage": {"materials.pumice.porosity.crush_damage": "false"},
        "flaws_from_4.6MPa": {"materials.pumice.damage.weibull_k": "8e37 1/m^3"},  # the shipped ones: from 1 MPa on
        "mixed_precision": {"numerics.precision": "mixed"},
    },
    "basalt_impact": {
        "opensph_strength": {"materials.basalt.strength.cohesion": "90 MPa",  # that code's defaults
                             "materials.basalt.strength.friction": "2"},
    },
}
LATTICES = ["hexagonal", "glass"]  # beside the cubic one, at the coarsest spacing, in every configuration
SPACINGS = {"pumice_impact": [2.4, 1.8, 1.2], "basalt_impact": [1.5, 1.0]}  # mm, the coarsest first
TRIAL_SPACING = 3.0  # mm: tries the campaign itself, seconds a run
IN_MIXED_PRECISION = [1.2, 1.0]  # mm: the long runs
SEEDS = {"pumice_impact": 5, "basalt_impact": 3}  # at the coarsest spacing


@dataclass
class Case:
    scene: str
    configuration: str
    spacing: float  # mm
    seed: int
    lattice: str = "cubic"
    settings: dict = field(default_factory=dict)

    @property
    def main(self):
        """Whether this is more than a variation of another run."""
        return self.configuration in CONFIGURATIONS[self.scene] and self.lattice == "cubic"

    @property
    def name(self):
        lattice = "" if self.lattice == "cubic" else f"_{self.lattice}"
        return f"{self.scene}_{self.configuration}{lattice}_{self.spacing:.1f}mm_seed{self.seed}"


def make_case(scene, configuration, spacing, seed, pictures, lattice="cubic"):
    base = next(iter(CONFIGURATIONS[scene].values()))
    settings = {"resolution.spacing": f"{spacing}mm", "resolution.lattice": lattice, "random.seed": str(seed),
                "insitu.frames": "31",
                **base, **(CONFIGURATIONS[scene] | VARIATIONS[scene])[configuration]}
    if not pictures:
        settings["insitu.enabled"] = "false"
    if spacing in IN_MIXED_PRECISION:
        settings["numerics.precision"] = "mixed"
    return Case(scene, configuration, spacing, seed, lattice, settings)


def seeds_and_lattices(scene, spacing):
    """The many runs of one spacing, which draw no pictures."""
    seeds = range(1, 1 + SEEDS[scene])
    chosen = [make_case(scene, name, spacing, seed, False) for seed in seeds for name in CONFIGURATIONS[scene]]
    chosen += [make_case(scene, name, spacing, seed, False, lattice)
               for lattice in LATTICES for seed in seeds for name in CONFIGURATIONS[scene]]
    return chosen + [make_case(scene, name, spacing, 1, False) for name in VARIATIONS[scene]]


def cases(quick, trial=False):
    """Cheap runs first. Quick: the coarsest spacing with one seed. Trial: everything of the coarsest spacing, coarser
    still."""
    chosen = []
    for scene, (coarsest, *finer) in SPACINGS.items():
        if quick:
            chosen += [make_case(scene, name, coarsest, 1, pictures=True) for name in CONFIGURATIONS[scene]]
        elif trial:
            chosen += [c for c in seeds_and_lattices(scene, TRIAL_SPACING) if c.seed == 1]
        else:
            chosen += seeds_and_lattices(scene, coarsest)
            chosen += [make_case(scene, name, spacing, 1, pictures=True)
                       for spacing in finer for name in CONFIGURATIONS[scene]]
    return sorted(chosen, key=lambda case: -case.spacing)
