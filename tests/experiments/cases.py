"""The runs of the campaign: every one is a shipped scene with a few of its values replaced."""
from dataclasses import dataclass, field

# The two configurations that the GASPHiA note compares.
CONFIGURATIONS = {
    "classical": {},
    "corrected": {"numerics.gradient_correction": "true", "numerics.balsara": "true"},
}
SPACINGS = {"pumice_impact": [2.4, 1.8, 1.2], "basalt_impact": [1.5, 1.0]}  # mm, the coarsest first
SEEDS = {"pumice_impact": 5, "basalt_impact": 3}  # at the coarsest spacing


@dataclass
class Case:
    scene: str
    configuration: str
    spacing: float  # mm
    seed: int
    settings: dict = field(default_factory=dict)

    @property
    def name(self):
        return f"{self.scene}_{self.configuration}_{self.spacing:.1f}mm_seed{self.seed}"


def make_case(scene, configuration, spacing, seed, pictures):
    settings = {"resolution.spacing": f"{spacing}mm", "random.seed": str(seed), **CONFIGURATIONS[configuration]}
    if not pictures:
        settings |= {"insitu.enabled": "false", "insitu.frames": "31"}
    return Case(scene, configuration, spacing, seed, settings)


def cases(quick):
    """Cheap runs first. Only the first seed at each spacing draws pictures."""
    chosen = []
    for scene, configurations in (("pumice_impact", list(CONFIGURATIONS)), ("basalt_impact", ["classical"])):
        for spacing in SPACINGS[scene][:1] if quick else SPACINGS[scene]:
            coarsest = spacing == SPACINGS[scene][0]
            for seed in range(1, 1 + (SEEDS[scene] if coarsest and not quick else 1)):
                for configuration in configurations:
                    chosen.append(make_case(scene, configuration, spacing, seed, pictures=seed == 1))
    return sorted(chosen, key=lambda c: -c.spacing)
