"""Problems whose answers are known without the solver, to hold numerical uncertainties against.

- layer, two_layers, layer_p: layered ground over a compliant base, by Thomson and Haskell's recursion for vertical waves
  (Kramer 1996, Geotechnical Earthquake Engineering, section 7.2.1);
- yielding: an elastic column on a perfectly plastic layer under a strong pulse, by finite differences in one dimension;
- hill: an elastic slope, by finite elements (cases/verification/hill).
"""
import csv
import os
import sys
from pathlib import Path

import numpy as np

ROOT = Path(__file__).resolve().parent.parent.parent
sys.path.insert(0, os.fspath(ROOT / "scripts"))
import run_measures
import verification_references as references

VERIFICATION = ROOT / "cases" / "verification"
DENSITY, SPEED, STRENGTH = 2400.0, 400.0, 80e3  # of the yielding column: kg/m3, m/s, Pa
HEIGHT, LAYER, SCALE = 24.0, (4.0, 8.0), 30.0   # m above the base; of the pulse
YIELDING = f"""schema: seismpm-case/1
name: yielding
grid: {{spacing: 0.5 m, particles_per_cell: 2}}
domain: {{x: [0 m, 12 m], bottom: 0 m}}
surfaces:
  floor: {{points: [[0 m, {LAYER[0]} m], [12 m, {LAYER[0]} m]]}}
  sole: {{points: [[0 m, {LAYER[1]} m], [12 m, {LAYER[1]} m]]}}
  ground: {{points: [[0 m, {HEIGHT} m], [12 m, {HEIGHT} m]]}}
regions:
  - {{material: rock, below: floor}}
  - {{material: clay, below: sole}}
  - {{material: rock, below: ground}}
materials:
  rock: {{model: elastic, density: {DENSITY} kg/m3, young_modulus: {DENSITY * SPEED**2 * 2.6} Pa, poisson_ratio: 0.3}}
  clay:
    model: von_mises
    density: {DENSITY} kg/m3
    young_modulus: {DENSITY * SPEED**2 * 2.6} Pa
    poisson_ratio: 0.3
    strength: {{peak: {STRENGTH * 3**0.5} Pa}}
static: {{gravity: 0 m/s2}}
seismic:
  duration: 3 s
  motion:
    recorded_as: upgoing
    baseline: none
    horizontal: {{file: {VERIFICATION / "pulse.txt"}, format: two_column, unit: m/s, scale: {SCALE}}}
output:
  frames: {{every: 3 s}}
  gauges: {{points: {{top: [6 m, {HEIGHT} m], middle: [6 m, 16 m], below: [6 m, 2 m]}}}}
"""


def measured(gauges, time, component):
    """Measures {name: value} of gauges {name: (displacement, velocity)} at the given times (s), moved in one direction."""
    found = {}
    for name, histories in gauges.items():
        both = [np.zeros((len(time), 2)) for _ in histories]
        for array, history in zip(both, histories):
            array[:, component] = history
        found |= run_measures.of_gauge(name, time, *both, [run_measures.DIRECTIONS[component]])
    return {measure.name: value for measure, value in found.items()}


def layered_waves(layers, speed, time):
    """Displacements (m) and velocities (m/s) {name: (u, v)} at surface and rockhead of layers [(thickness m, material)].

    Surface first, on 10 m of rock over the base.
    """
    step, count = 5e-4, 2**17
    t = np.arange(count) * step
    omega = 2 * np.pi * np.fft.rfftfreq(count, step)
    up = down = np.ones(len(omega), dtype=complex)  # amplitudes at the top of a layer, equal at the surface
    below = [material for _, material in layers[1:]] + [references.ROCK]
    for (thickness, material), next_one in zip(layers, below):
        turn = np.exp(1j * omega * thickness / speed(material))
        ratio = material[0] * speed(material) / (next_one[0] * speed(next_one))
        up, down = (0.5 * (up * (1 + ratio) * turn + down * (1 - ratio) / turn),
                    0.5 * (up * (1 - ratio) * turn + down * (1 + ratio) / turn))
    source = np.fft.rfft(references.pulse(t)) / (up * np.exp(1j * omega * 10.0 / speed(references.ROCK)))
    gauges = {}
    for name, response in {"top": 2 * source, "rockhead": (up + down) * source}.items():
        velocity = np.fft.irfft(response, count)
        way = np.concatenate([[0.0], np.cumsum(0.5 * step * (velocity[1:] + velocity[:-1]))])
        gauges[name] = np.interp(time, t, way), np.interp(time, t, velocity)
    return gauges


def layered(layers, speed, component, time):
    """Measures of layered_waves(), which move along the component."""
    return measured(layered_waves(layers, speed, time), time, component)


def yielding(time, cells=480):
    """The yielding column: velocities at nodes, stresses between them; dashpots at the base, eq. rho c (2 v_up - v)."""
    size = HEIGHT / cells
    step = 0.01 / np.ceil(0.01 / (0.5 * size / SPEED))
    middle = (np.arange(cells) + 0.5) * size
    clay = (middle > LAYER[0]) & (middle < LAYER[1])
    mass = np.full(cells + 1, DENSITY * size)
    mass[[0, -1]] /= 2
    impedance, modulus = DENSITY * SPEED, DENSITY * SPEED**2
    nodes = {"top": cells, "middle": round(16 / size), "below": round(2 / size)}
    stress, velocity, way = np.zeros(cells), np.zeros(cells + 1), np.zeros(cells + 1)
    kept = {name: [(0.0, 0.0, 0.0)] for name in nodes}
    for k in range(int(round(time[-1] / step)) + 1):
        force = np.append(stress, 0.0)
        force[1:] -= stress
        force[0] += 2 * impedance * SCALE * references.pulse((k + 0.5) * step)
        velocity[1:] += step * force[1:] / mass[1:]
        half = 0.5 * step * impedance / mass[0]
        velocity[0] = ((1 - half) * velocity[0] + step * force[0] / mass[0]) / (1 + half)
        way += step * velocity
        stress += step * modulus * np.diff(velocity) / size
        stress[clay] = np.clip(stress[clay], -STRENGTH, STRENGTH)
        for name, node in nodes.items():
            kept[name].append(((k + 1) * step, way[node], velocity[node]))
    gauges = {}
    for name, rows in kept.items():
        t, x, v = np.array(rows).T
        gauges[name] = np.interp(time, t, x), np.interp(time, t - 0.5 * step, v)
    return measured(gauges, time, 0)


def hill_waves(time):
    """Velocities (m/s) of the reference of cases/verification/hill {name: (0, v)}; it has no displacements worth a measure."""
    with open(VERIFICATION / "hill" / "reference.csv", encoding="utf-8") as file:
        rows = list(csv.reader(line for line in file if not line.startswith("#")))
    table = dict(zip(rows[0], np.array(rows[1:], dtype=float).T))
    names = [name[:-2] for name in rows[0] if name.endswith("_x")]
    return {name: (0 * time, np.interp(time, table["time"], table[f"{name}_x"])) for name in names}


def hill(time):
    """Measures of hill_waves()."""
    return {name: value for name, value in measured(hill_waves(time), time, 0).items() if not name.endswith(".displacement")}


SITE = ["--set", "domain.x=[0 m, 12 m]", "--set", "output.frames.every=2 s",
        "--set", "output.gauges.points.top=[6 m, 20 m]", "--set", "output.gauges.points.rockhead=[6 m, 10 m]"]
SITES = {"layer": ([(10.0, references.SOIL)], references.shear_speed, 0),
         "two_layers": ([(5.0, references.SOIL), (5.0, references.STIFF)], references.shear_speed, 0),
         "layer_p": ([(10.0, references.SOIL)], references.pressure_speed, 1)}


def problem(name, folder):
    """Case file, options and answers (a function of the gauges' times) of a problem; a case of its own goes to folder."""
    if name in SITES:
        return VERIFICATION / name / "case.yaml", SITE, lambda time: layered(*SITES[name], time)
    if name == "hill":
        return VERIFICATION / name / "case.yaml", [], hill
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "yielding.yaml").write_text(YIELDING)
    return folder / "yielding.yaml", [], yielding
