"""The runs of the campaign: every one is a shipped scene with a few of its values replaced."""
from dataclasses import dataclass, field

# The two configurations that the GASPHiA note compares.
CONFIGURATIONS = {
    "classical": {},
    "corrected": {"numerics.gradient_correction": "true", "numerics.balsara": "true"},
}
# What the pumice's outcome hangs on: one thing changed at a time, at the coarsest spacing.
VARIATIONS = {
    "correction_only": {"numerics.gradient_correction": "true"},
    "balsara_only": {"numerics.balsara": "true"},
    "no_crush_damage": {"materials.pumice.porosity.crush_damage": "false"},
    "flaws_from_4.6MPa": {"materials.pumice.damage.weibull_k": "8e37 1/m^3"},  # the shipped ones open from 1 MPa on
    "hexagonal": {"resolution.lattice": "hexagonal"},
    "mixed_precision": {"numerics.precision": "mixed"},
}
SPACINGS = {"pumice_impact": [2.4, 1.8, 1.2], "basalt_impact": [1.5, 1.0]}  # mm, the coarsest first
IN_MIXED_PRECISION = [1.2, 1.0]  # mm: the long runs
SEEDS = {"pumice_impact": 5, "basalt_impact": 3}  # at the coarsest spacing


@dataclass
class Case:
    scene: str
    configuration: str
    spacing: float  # mm
    seed: int
    settings: dict = field(default_factory=dict)

    @property
    def main(self):
        """Whether this is more than a variation of another run."""
        return self.configuration in CONFIGURATIONS

    @property
    def name(self):
        return f"{self.scene}_{self.configuration}_{self.spacing:.1f}mm_seed{self.seed}"


def make_case(scene, configuration, spacing, seed, pictures):
    settings = {"resolution.spacing": f"{spacing}mm", "random.seed": str(seed), "insitu.frames": "31",
                **(CONFIGURATIONS | VARIATIONS)[configuration]}
    if not pictures:
        settings["insitu.enabled"] = "false"
    if spacing in IN_MIXED_PRECISION:
        settings["numerics.precision"] = "mixed"
    return Case(scene, configuration, spacing, seed, settings)


def cases(quick):
    """Cheap runs first. The coarsest runs, being many, draw no pictures unless they are all there is."""
    chosen = []
    for scene, spacings in SPACINGS.items():
        for spacing in spacings[:1] if quick else spacings:
            many = spacing == spacings[0] and not quick
            for seed in range(1, 1 + (SEEDS[scene] if many else 1)):
                for configuration in CONFIGURATIONS if scene == "pumice_impact" else ["classical"]:
                    chosen.append(make_case(scene, configuration, spacing, seed, pictures=not many))
    if not quick:
        coarsest = SPACINGS["pumice_impact"][0]
        chosen += [make_case("pumice_impact", name, coarsest, 1, pictures=False) for name in VARIATIONS]
    return sorted(chosen, key=lambda case: -case.spacing)
