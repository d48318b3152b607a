"""Scenes that the trade between speed and accuracy is measured on, one for each regime, and the knobs that are turned.

layers      two layers, a vertical wave; Thomson and Haskell's closed form
hill        an elastic slope; finite elements (cases/verification/hill)
basin       the dipping edge of a soft basin, elastic; converged
imperial    cases/slope under Imperial Valley (CHI-282), 24 s; converged
loma        the same under Loma Prieta (G06-090)
release     clay that is shaken loose on a plane and runs into a valley; converged

Records are those of SEISMPM_RECORDINGS.
"""
import os
from dataclasses import dataclass, field
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent.parent
CASES = ROOT / "cases"
RECORDINGS = Path(os.environ.get("SEISMPM_RECORDINGS", "recordings"))
ROCK = "{model: elastic, density: 2200 kg/m3, young_modulus: 250 MPa, poisson_ratio: 0.25}"
SOIL = "{model: elastic, density: 1800 kg/m3, young_modulus: 40 MPa, poisson_ratio: 0.35}"
BASIN = f"""schema: seismpm-case/1
name: basin
grid: {{spacing: 1 m, particles_per_cell: 2}}
domain: {{x: [0 m, 140 m], bottom: 0 m}}
surfaces:
  rockhead: {{points: [[0 m, 30 m], [50 m, 30 m], [76 m, 15 m], [140 m, 15 m]]}}
  ground: {{points: [[0 m, 30 m], [140 m, 30 m]]}}
regions:
  - {{material: rock, below: rockhead}}
  - {{material: soil, above: rockhead, below: ground}}
materials: {{rock: {ROCK}, soil: {SOIL}}}
static: {{gravity: 0 m/s2}}
seismic:
  duration: 4 s
  motion: {{recorded_as: outcrop, baseline: none,
           horizontal: {{file: {CASES / "verification/hill/ricker.txt"}, format: two_column, unit: m/s}}}}
output:
  frames: {{every: 4 s}}
  gauges: {{every: 0.005 s, points: {{rock: [20 m, 30 m], edge: [58 m, 30 m], thick: [80 m, 30 m], inside: [100 m, 30 m],
                                    far: [130 m, 30 m]}}}}
"""
RELEASE = f"""schema: seismpm-case/1
name: release
grid: {{spacing: 1 m, particles_per_cell: 2}}
domain: {{x: [0 m, 170 m], bottom: 0 m}}
surfaces:
  rockhead: {{points: [[0 m, 34 m], [34 m, 34 m], [90 m, 8 m], [170 m, 8 m]]}}
  ground: {{points: [[0 m, 42 m], [40 m, 42 m], [60 m, 31 m], [74 m, 15.429 m], [90 m, 8 m], [170 m, 8 m]]}}
regions:
  - {{material: rock, below: rockhead}}
  - {{material: clay, above: rockhead, below: ground}}
materials:
  rock: {ROCK}
  clay:
    model: von_mises
    density: 1800 kg/m3
    young_modulus: 40 MPa
    poisson_ratio: 0.35
    strength: {{peak: 105 kPa, residual: 45 kPa}}
    softening: {{displacement: 0.2 m}}
static: {{ramp: 5 s, until: {{unbalanced: 1e-5, kinetic: 1e-10, at_most: 60 s}}}}
seismic:
  duration: 28 s
  motion: {{recorded_as: outcrop, horizontal: built_in, baseline: none, high_pass: 0.1 Hz}}
output: {{frames: {{every: 2 s}}, gauges: {{every: 0.01 s, points: {{crest: [40 m, 42 m], middle: [60 m, 31 m]}}}}}}
"""


@dataclass(frozen=True)
class Scene:
    """A case (path below cases, or its text), its settings and the seismic program's options; gauges of waves (none: a slide).

    sweep: cells (m) of the default; papers: of the paper's method, where they are others; turned: cells that knobs are turned
    at; finest: cells of the converged reference, none where there is another one.
    """
    name: str
    case: str
    settings: tuple
    gauges: tuple
    sweep: tuple
    turned: float
    finest: float = None
    papers: tuple = ()
    static: bool = True
    record: tuple = ()
    own: dict = field(default_factory=dict)

    def case_file(self, folder):
        """The case file; one of a scene's own is written to the folder."""
        if "\n" not in self.case:
            return CASES / self.case / "case.yaml"
        folder.mkdir(parents=True, exist_ok=True)
        path = folder / "case.yaml"
        if not path.exists() or path.read_text() != self.case:
            path.write_text(self.case)
        return path

    def missing(self):
        """The record that is not there, or none."""
        return next((word for word in self.record if word.startswith(os.fspath(RECORDINGS)) and not Path(word).exists()), None)


def record(name, step):
    """Options of mpm-seismic for a column of values in g."""
    return "--motion", os.fspath(RECORDINGS / name), "--record-dt", step, "--record-unit", "g"


SHALLOW = {"5 m less rock": ("domain.bottom=5 m",)}
SLOPE = dict(case="slope", settings=("grid.particles_per_cell=2", "seismic.duration=24 s", "output.frames.every=4 s"), gauges=(),
             turned=1, papers=(1.25, 1, 0.8, 0.625),
             own={**SHALLOW, "40 m narrower": ("domain.x=[20 m, 180 m]", "output.gauges.points.left=[20 m, 40 m]",
                                              "output.gauges.points.right=[180 m, 20 m]")})
SCENES = [
    Scene("layers", "verification/two_layers",
          ("grid.particles_per_cell=2", "domain.x=[0 m, 12 m]", "output.gauges.every=0.005 s", "output.gauges.points.top=[6 m, 20 m]",
           "output.frames.every=6 s"), ("top",), (1.5, 1, 0.75, 0.5, 0.25), 0.75, static=False,
          own={"6 m narrower": ("domain.x=[0 m, 6 m]", "output.gauges.points.top=[3 m, 20 m]"), **SHALLOW}),
    Scene("hill", "verification/hill", ("grid.particles_per_cell=2", "output.frames.every=2.5 s"),
          ("left", "behind", "crest", "middle", "toe", "right"), (2, 1.4, 1, 0.7, 0.5), 1, static=False, own=SHALLOW),
    Scene("basin", BASIN, (), ("rock", "edge", "thick", "inside", "far"), (2, 1.4, 1, 0.7, 0.5), 1, 0.25, static=False,
          own=SHALLOW),
    Scene("imperial", **SLOPE, sweep=(1.25, 1, 0.8, 0.625, 0.5), finest=0.3125,
          record=record("ImperialValley1979_CHI-282.txt", "0.01")),
    Scene("loma", **SLOPE, sweep=(1.25, 1, 0.8, 0.625), finest=0.4, record=record("LomaPrieta1989_G06-090.txt", "0.005")),
    Scene("release", RELEASE, (), (), (1.25, 1, 0.85, 0.625), 1, 0.4,
          own={"4 m less rock": ("domain.bottom=4 m",)}, record=("--scale", "4")),
]
PAPER = ("seismic.transfer=apic", "grid.interfaces=sharp", "seismic.inertia=lumped", "grid.softening=local")
# what is turned, by its name; of slides alone where that is said
KNOBS = {
    "1 x 1 particles": ("grid.particles_per_cell=1",),
    "3 x 3 particles": ("grid.particles_per_cell=3",),
    "Courant number 0.7": ("time_step.courant_number=0.7",),
    "Courant number 0.25": ("time_step.courant_number=0.25",),
    "transfer apic": ("seismic.transfer=apic",),
    "filter time 1 s": ("seismic.filter.time=1 s",),
    "filter time 10 s": ("seismic.filter.time=10 s",),
    "interfaces sharp": ("grid.interfaces=sharp",),
    "inertia lumped": ("seismic.inertia=lumped",),
    "base without spring": ("seismic.base.spring=none",),
}
OF_SLIDES = {
    "filter strain 0": ("seismic.filter.strain=0",),
    "filter strain 0.003": ("seismic.filter.strain=0.003",),
    "filter strain 0.01": ("seismic.filter.strain=0.01",),
    "softening local": ("grid.softening=local",),
    "volumes averaged": ("grid.volume_average=cell",),
    "rest below 1 mm/s": ("seismic.rest_below=1 mm/s",),
}


def points(scene):
    """(knob, cells in m, settings) of a scene, in the order in which they are run: what all else is held against first."""
    if scene.finest:
        yield "default", scene.finest, ()
    yield from (("default", h, ()) for h in scene.sweep)
    papers = scene.papers or scene.sweep
    yield from (("paper's method", h, PAPER) for h in papers)
    knobs = KNOBS | ({} if scene.gauges else OF_SLIDES) | scene.own
    yield from ((name, scene.turned, settings) for name, settings in knobs.items())
    yield from (("paper's method, 3 x 3", h, (*PAPER, "grid.particles_per_cell=3")) for h in (scene.turned, papers[-1]))
