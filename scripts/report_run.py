"""Of a report: the run as a whole: numbers first, scene and materials, what the grid carries, warnings, case, versions."""
from dataclasses import dataclass, field
from functools import cached_property
from pathlib import Path

import numpy as np
from matplotlib.colors import ListedColormap, Normalize
from matplotlib.patches import Patch

import plot_page
import plot_sections
import report_html as html
from plot_common import AREAS, Missing, frame_times, heading_of, read_summary, stage_of, state_of, text
from settings import gauge_positions, names_below, quantity, settings_of


PALE_FIRST = (*AREAS[3:6], AREAS[7], *AREAS[:3], AREAS[6])  # large areas are not loud


@dataclass
class Run:
    """A run's folder, and what is read of it once."""

    folder: Path
    summary: dict = field(default_factory=dict)

    def __post_init__(self):
        self.summary = read_summary(self.folder)

    @cached_property
    def settings(self):
        """The settings by key path."""
        return settings_of(self.folder)

    @cached_property
    def stage(self):
        """"static" or "seismic"."""
        return stage_of(self.folder, self.summary)

    @property
    def title(self):
        """Names of case and motion, and that a run is not done."""
        return heading_of(self.folder, self.summary)

    def sides(self):
        """x of the left and the right side (m)."""
        return quantity(self.settings, "domain.x[0]"), quantity(self.settings, "domain.x[1]")

    def state(self):
        """The state at the end, or the newest checkpoint."""
        states = [*sorted(self.folder.glob("checkpoint-*.h5")), *self.folder.glob("final.h5")]
        if not states:
            raise Missing("no final.h5 and no checkpoint yet")
        return states[-1]


def lead(run):
    """What the run has come to, in a few numbers."""
    parts, state = [], state_of(run.summary)
    if state:
        last = f", the last frame is that of t = {frame_times(run.folder)[-1][0]:.2f} s" if run.stage == "seismic" and any(
            run.folder.glob("frame-*.hdf")) else ""
        parts.append(html.paragraph(f"This run has {state if state.startswith(('ended', 'not')) else 'been ' + state}{last}: "
                                    "the report shows it as far as it is.", "note warning"))
    cards = []
    if "slide" in run.summary:
        slide = run.summary["slide"]
        cards = [("trigger", plot_page.value(slide["trigger_time"], "s")),
                 ("moved area", f"{html.number(slide['moved_area'])} m²"),
                 ("moved mass", f"{html.number(slide['moved_mass'] / 1e3)} t/m"),
                 ("mean displacement", f"{html.number(float(np.hypot(*slide['centre_of_mass_displacement'])))} m"),
                 ("toe advance", plot_page.value(slide["toe_advance"], "m")),
                 ("greatest velocity", f"{html.number(slide['peak_velocity']['value'])} m/s")]
    for name, motion in run.summary.get("motion", {}).items():
        cards += [(f"{name} PGA, {motion.get('recorded_as', 'outcrop')}", f"{html.number(motion['applied']['pga'] / 9.80665)} g")]
    if run.stage == "static" and "unbalanced" in run.summary:
        cards = [(name, f"{run.summary[name]:.2g}") for name in ("unbalanced", "kinetic")]
        cards += [("yielded area", f"{html.number(run.summary['yielded_area'])} m²")]
    warnings = len(run.summary.get("warnings", []))
    cards += [("warnings", str(warnings))] if run.summary else []
    return "".join(parts) + '<div class="cards">' + "".join(
        f"<div><span>{html.escaped(name)}</span><b>{html.escaped(value)}</b></div>" for name, value in cards) + "</div>"


def scene(run):
    """Where the materials stand at the start, with the gauges."""
    path = frame_times(run.folder)[0][1] if run.stage == "seismic" else run.state()
    particles = plot_sections.read_particles(path)
    if "material_names" not in particles:
        raise Missing(f"{path.name} does not tell the materials")
    names = particles["material_names"]
    colours = [PALE_FIRST[k % len(PALE_FIRST)] for k in range(len(names))]
    panel = {"title": "", "values": particles["material"].astype(float), "colours": ListedColormap(colours),
             "norm": Normalize(-0.5, len(names) - 0.5)}
    figure, axes = plot_sections.stack([particles], [panel], 6.5)
    left, right = run.sides()
    for name, (x, y) in gauge_positions(run.settings).items():
        axes[0].plot(x, y, "kv", ms=6, mfc="w", clip_on=False)
        aside = "left" if x < left + 0.05 * (right - left) else "right" if x > right - 0.05 * (right - left) else "center"
        axes[0].annotate(name, (x, y), (0, 5), textcoords="offset points", ha=aside, fontsize=8)
    axes[0].set_ylim(top=axes[0].get_ylim()[1] + 0.06 * np.ptp(axes[0].get_xlim()))
    axes[0].legend(handles=[Patch(color=colour, label=name) for colour, name in zip(colours, names)], loc="upper right")
    area = [float(np.sum(particles["size"][particles["material"] == k] ** 2)) for k in range(len(names))]
    rows = [[name, run.settings.get(f"materials.{name}.model", "–"), *moduli(run.settings, f"materials.{name}"),
             html.number(area[k]), bounds(particles, k)] for k, name in enumerate(names)]
    head = ["material", "model", "ρ (kg/m³)", "E (MPa)", "ν", "c_s (m/s)", "c_p (m/s)", "area (m²)", "x, y (m)"]
    told = "The ground at the start, its materials, and the gauges (triangles)."
    return html.picture(figure, told, "png", "wide") + html.table(head, rows) + laws(run)


def moduli(settings, key):
    """Density, Young's modulus, Poisson's ratio and wave speeds of a material, as text."""
    density, young, poisson = (quantity(settings, f"{key}.{part}") for part in ("density", "young_modulus", "poisson_ratio"))
    shear = young / (2 * (1 + poisson))
    constrained = shear * (2 - 2 * poisson) / (1 - 2 * poisson)
    speeds = (np.sqrt(shear / density), np.sqrt(constrained / density))
    return [html.number(density, 4), html.number(young / 1e6), html.number(poisson), *map(html.number, speeds)]


def bounds(particles, k):
    """Where a material stands: its left and right, lowest and highest point."""
    place = particles["position"][particles["material"] == k]
    if not len(place):
        return "–"
    (left, low), (right, high) = place.min(0), place.max(0)
    return f"{left:.1f} to {right:.1f}, {low:.1f} to {high:.1f}"


def laws(run):
    """What the laws are given besides moduli, as the case says it."""
    common = {"model", "density", "young_modulus", "poisson_ratio"}
    rows = []
    for name in names_below(run.settings, "materials"):
        key = f"materials.{name}."
        rows += [(f"{name}: {path[len(key):].replace('.', ', ').replace('_', ' ')}", usual(value)) for path, value in
                 run.settings.items() if path.startswith(key) and path[len(key):] not in common]
    return html.words(rows) if rows else ""


def usual(value):
    """A setting in the units that are usual: degrees and kPa."""
    for unit, factor, shown in ((" rad", np.degrees(1), "deg"), (" Pa", 1e-3, "kPa")):
        if value.endswith(unit):
            return f"{float(value.removesuffix(unit)) * factor:.6g} {shown}"
    return value


def static_stress(run):
    """The stresses of the static state."""
    return html.picture(plot_sections.static_stress(run.folder, "", 6.5), "Stresses at the end of the static stage.", "png", "wide")


def resolution(run):
    """What the grid carries, and what it cost."""
    if "resolution" not in run.summary:
        raise Missing("there is no summary.json yet")
    materials = run.summary["resolution"].get("materials", {})
    share = lambda waves: html.number(100 * waves["arias_share_above"]) if "arias_share_above" in waves else "–"
    rows = [[f"{name}, {kind}", html.number(waves["speed"]), html.number(waves["carried_to"]), share(waves)]
            for name, material in materials.items() for kind, waves in material.items()]
    table = html.table(["waves", "speed (m/s)", "carried within 1 % up to (Hz)", "Arias intensity above (%)"], rows)
    lines = [line for line in plot_page.carried(run.summary) if ": S waves" not in line]
    return table + html.words([("discretised", lines[0]), ("computed", lines[1])])


def warnings(run):
    """All warnings of the run."""
    told = [text(warning) for warning in run.summary.get("warnings", [])]
    if not run.summary:
        raise Missing("there is no summary.json yet; log.txt has the warnings so far")
    return "".join(html.paragraph(warning, "note warning") for warning in told) or html.paragraph("None.")


def case(run):
    """Command, versions, and the case with every default."""
    summary = run.summary
    rows = [("command", summary.get("command", "–")), ("seismpm", f"{summary.get('version', '–')} ({summary.get('git', '–')})"),
            ("build", summary.get("build", "–")), ("case, sha256", summary.get("case_sha256", "–")),
            ("profile", summary.get("profile") or "none"),
            ("overrides", ", ".join(map(text, summary.get("overrides", []))) or "none")]
    rows += [(f"digest of {name}", value) for name, value in summary.get("digests", {}).items()]
    path = run.folder / "case-resolved.yaml"
    if not path.exists():
        return html.words(rows) + html.paragraph("There is no case-resolved.yaml.", "note")
    resolved = html.escaped(path.read_text(errors="replace"))
    return html.words(rows) + f"<h3>The case, every default written out</h3><pre>{resolved}</pre>"
