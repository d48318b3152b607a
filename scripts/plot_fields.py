"""What can be drawn of a section: fields by name, with labels, scales and how each is computed from the particles."""
from dataclasses import dataclass
from typing import Callable

import numpy as np
from matplotlib.colors import Normalize

import plot_sections
from plot_common import Missing, frame_times, titled
from settings import quantity, settings_of

ANGLE_OF = {"mc": lambda mu: mu / np.sqrt(1 + mu**2), "plane": lambda mu: mu}  # sin(phi) of a coefficient of friction


@dataclass(frozen=True)
class Field:
    """A field of a section."""

    label: str  # with its unit
    needs: str  # the dataset of a frame that it is computed from
    values: Callable  # of the particles and the run's settings
    colours: str = "viridis_r"
    scale: Callable = lambda values: Normalize(0.0, plot_sections.top_of(values, 99.5))  # of the values of all sections


def between(values):
    """A scale from the lowest to the highest value, but for 0.5 % at both ends."""
    found = np.concatenate([part[np.isfinite(part)] for part in values])
    return Normalize(*np.percentile(found, (0.5, 99.5))) if found.size else Normalize(0, 1)


def about_zero(values):
    """A scale as far below zero as above."""
    most = plot_sections.top_of([np.abs(part[np.isfinite(part)]) for part in values], 99.5)
    return Normalize(-most, most)


def of_strain(values):
    """A scale of plastic strain, whose top is at most that of the pictures."""
    return Normalize(0.0, min(plot_sections.MOST_STRAIN, plot_sections.top_of(values, 99.0)))


def length(name, component=None):
    """Length of a vector of the particles, or one of its components."""
    if component is None:
        return lambda particles, settings: np.linalg.norm(particles[name][:, :2], axis=1)
    return lambda particles, settings: particles[name][:, component]


def p_of(stress):
    """Mean pressure, compression positive, of stresses xx, yy, zz, xy."""
    return -stress[:, :3].sum(axis=1) / 3


def q_of(stress):
    """Mises stress sqrt(3 J2)."""
    xx, yy, zz, xy = np.asarray(stress, dtype=float).T
    return np.sqrt(0.5 * ((xx - yy) ** 2 + (yy - zz) ** 2 + (zz - xx) ** 2) + 3.0 * xy**2)


def principal(stress):
    """Greatest and least principal stress, zz among them."""
    xx, yy, zz, xy = np.asarray(stress, dtype=float).T
    middle, radius = 0.5 * (xx + yy), np.hypot(0.5 * (xx - yy), xy)
    return np.maximum(middle + radius, zz), np.minimum(middle - radius, zz)


def softened(settings, key, name, strain):
    """A strength that falls linearly from its peak to its residual value with plastic strain."""
    peak, residual = quantity(settings, f"{key}.{name}.peak"), quantity(settings, f"{key}.{name}.residual")
    over, slip, width = (quantity(settings, f"{key}.softening.{part}") for part in ("strain", "displacement", "band_width"))
    if over is None and slip is not None:
        over = slip / np.sqrt(3) / width
    if residual is None or over is None:
        return np.full(len(strain), peak)
    return peak + (residual - peak) * np.minimum(strain / over, 1.0)


def used_of_material(settings, name, stress, strain):
    """Share of the strength that the stress uses, as the material's law has it; NaN where it has none.

    von_mises: q over the strength as softened. mohr_coulomb: 2 c cos(phi) - (s1 + s3) sin(phi) is what s1 - s3 may be.
    slip_weakening: sqrt(J2) over sin(phi) p.
    """
    key = f"materials.{name}"
    model = settings.get(f"{key}.model")
    if model == "von_mises":
        used, most = q_of(stress), softened(settings, key, "strength", strain)
    elif model == "mohr_coulomb":
        phi, cohesion = (softened(settings, key, part, strain) for part in ("friction_angle", "cohesion"))
        greatest, least = principal(stress)
        used, most = greatest - least, 2 * cohesion * np.cos(phi) - (greatest + least) * np.sin(phi)
    elif model == "slip_weakening":
        peak, residual = (quantity(settings, f"{key}.friction.{part}") for part in ("peak", "residual"))
        slip = np.sqrt(3) * strain * quantity(settings, f"{key}.thickness")
        critical = quantity(settings, f"{key}.critical_slip")
        falls = residual is not None and critical is not None
        mu = residual + (peak - residual) * np.exp(np.log(0.05) * slip / critical) if falls else np.full(len(slip), peak)
        used, most = q_of(stress) / np.sqrt(3), ANGLE_OF[settings.get(f"{key}.match", "mc")](mu) * p_of(stress)
    else:
        return np.full(len(stress), np.nan)
    with np.errstate(divide="ignore", invalid="ignore"):
        return np.where(most > 0, np.minimum(used / most, 1.0), 1.0)


def strength_used(particles, settings):
    """Share of the strength that is used, 0 to 1, by each particle's material."""
    if "material" not in particles or "material_names" not in particles:
        raise Missing("the frames do not tell the materials")
    share = np.full(len(particles["position"]), np.nan)
    strain = np.nan_to_num(particles.get("plastic_strain", np.zeros(len(share))))
    for k, name in enumerate(particles["material_names"]):
        own = particles["material"] == k
        share[own] = used_of_material(settings, name, particles["stress"][own], strain[own])
    return share


def stress(k):
    """A component of the stress (kPa), tension positive."""
    return lambda particles, settings: particles["stress"][:, k] / 1e3


FIELDS = {
    "displacement": Field("displacement (m)", "displacement", length("displacement")),
    "displacement_x": Field("displacement, x (m)", "displacement", length("displacement", 0), "RdBu_r", about_zero),
    "displacement_y": Field("displacement, y (m)", "displacement", length("displacement", 1), "RdBu_r", about_zero),
    "velocity": Field("speed (m/s)", "velocity", length("velocity")),
    "plastic_strain": Field("plastic strain (grey: material that has none)", "plastic_strain",
                            lambda particles, settings: particles["plastic_strain"], "inferno_r", of_strain),
    "p": Field("mean pressure p (kPa)", "stress", lambda particles, settings: p_of(particles["stress"]) / 1e3, scale=between),
    "q": Field("Mises stress q (kPa)", "stress", lambda particles, settings: q_of(particles["stress"]) / 1e3, "inferno_r"),
    "strength_used": Field("strength used (grey: elastic)", "stress", strength_used, "inferno_r", lambda values: Normalize(0, 1)),
    "stress_xx": Field("σxx (kPa, tension positive)", "stress", stress(0), scale=between),
    "stress_yy": Field("σyy (kPa, tension positive)", "stress", stress(1), scale=between),
    "stress_zz": Field("σzz (kPa, tension positive)", "stress", stress(2), scale=between),
    "stress_xy": Field("τxy (kPa)", "stress", stress(3), "RdBu_r", about_zero),
}


def read(path, name, settings):
    """Particles of a frame or a state with the values of a field."""
    field = FIELDS[name]
    particles = plot_sections.read_particles(path, field.needs)
    if name == "strength_used":
        try:
            particles |= plot_sections.read_particles(path, "plastic_strain")
        except Missing:  # no material of the run yields
            pass
    particles["values"] = field.values(particles, settings)
    return particles


def panels_of(sections, name, titles, norm=None):
    """A panel for each section, all on one scale, that of all their values unless it is given."""
    field = FIELDS[name]
    values = [particles["values"] for particles in sections]
    norm = norm or field.scale(values)
    grey = plot_sections.without_strain(sections) if name == "plastic_strain" else [~np.isfinite(part) for part in values]
    return [{"title": title, "values": part, "colours": field.colours, "norm": norm, "grey": g if g.any() else None}
            for title, part, g in zip(titles, values, grey)]


def section(folder, heading, times, name, width=plot_sections.WIDTH):
    """A field at the chosen times (s), the nearest frames, on one scale."""
    frames = plot_sections.choose(frame_times(folder), times)
    needed = settings_of(folder) if name == "strength_used" else {}
    sections = [read(path, name, needed) for _, path in frames]
    if name == "plastic_strain" and not any(np.nanmax(p["values"], initial=0.0) > 0.0 for p in sections):
        raise Missing("no plastic strain in the chosen frames")
    panels = panels_of(sections, name, [f"t = {time:.2f} s" for time, _ in frames])
    figure, axes = plot_sections.stack(sections, panels, width)
    plot_sections.colour_bar(figure, axes, panels, FIELDS[name].label, aspect=20 * len(panels))
    return titled(figure, heading)
