"""Pictures of sections: particles on pixels, panels at one scale; stresses of a static state."""
import h5py
import matplotlib.pyplot as plt
import numpy as np
from matplotlib.cm import ScalarMappable
from matplotlib.colors import Normalize
from scipy.ndimage import distance_transform_edt, label, maximum
from scipy.spatial import cKDTree

from plot_common import WIDTH, Missing, array, text, titled
from settings import settings_of

PIXELS = 1400  # across a section
MOST_STRAIN = 0.3  # top of the colour scale of plastic strain
MOST_LOOSE = 2.0  # side of the square that a particle is drawn as, over the median


def read_particles(path, *fields):
    """Particles of a frame or a state: position (m) [n,2], size (m) where volumes are stored, the wanted fields."""
    with h5py.File(path, "r") as file:
        particles = {"position": array(file, "particles/position", "VTKHDF/Points")[:, :2]}
        for field in fields:
            particles[field] = array(file, f"particles/{field}", f"VTKHDF/PointData/{field}")
        if "particles/volume" in file:
            size = np.sqrt(file["particles/volume"][...])
            # Debris that has come loose spreads in flight; it is still but a particle of debris.
            particles["size"] = np.minimum(size, MOST_LOOSE * np.median(size))
        if "particles/material" in file:
            particles["material"] = file["particles/material"][...]
            if "material_names" in file:
                particles["material_names"] = [text(name) for name in file["material_names"][...]]
                particles["elastic"] = np.isin(particles["material"], elastic(path.parent, particles["material_names"]))
        elif isinstance(file.get("materials"), h5py.Group):
            add_materials(particles, file["materials"])
    return particles


def elastic(folder, names):
    """Indices of the materials that a run's case calls elastic; none where the folder does not tell."""
    try:
        settings = settings_of(folder)
    except OSError:
        return []
    return [k for k, name in enumerate(names) if settings.get(f"materials.{name}.model") == "elastic"]


def add_materials(particles, group):
    """Gives particles of a state, whose materials lie one after the other, their material."""
    parts = [part.attrs for part in group.values()]
    names = particles["material_names"] = sorted({text(part["material"]) for part in parts})
    particles["material"] = np.full(len(particles["position"]), -1)
    for part in parts:
        particles["material"][int(part["begin"]):int(part["end"])] = names.index(text(part["material"]))


def choose(frames, wanted, count=6):
    """The frames nearest to the wanted times (s), or count of them evenly spread from the first to the last."""
    if wanted is None:
        picked = np.linspace(0, len(frames) - 1, min(count, len(frames))).round().astype(int)
    else:
        picked = [int(np.argmin([abs(time - want) for time, _ in frames])) for want in wanted]
    return [frames[k] for k in sorted(set(picked))]


def add_sizes(sections):
    """Gives particles stored without volume the typical distance between neighbours in the first section (m)."""
    spacing = None
    for particles in sections:
        if "size" not in particles:
            if spacing is None:
                position = sections[0]["position"]
                spacing = np.median(cKDTree(position).query(position, k=2)[0][:, 1])
            particles["size"] = np.full(len(particles["position"]), spacing)


def common_extent(sections):
    """Left, right, low, high (m) of all sections together, with a small margin."""
    corners = np.concatenate([[p["position"].min(0), p["position"].max(0)] for p in sections])
    margin = 0.01 * np.ptp(corners[:, 0]) + max(p["size"].max() for p in sections)
    (left, low), (right, high) = corners.min(0) - margin, corners.max(0) + margin
    return left, right, low, high


def add_pixels(particles, extent, across=PIXELS):
    """Stores for every pixel, so many of them across, its nearest particle, -1 where there is no ground.

    A particle covers a square of its volume. Where slip has stretched a band, its particles lie farther apart
    along it; gaps of up to two particles, about a cell, are closed, and holes of up to four with ground all around.
    """
    left, right, low, high = extent
    pixel = (right - left) / across
    rows = max(1, round((high - low) / pixel))
    x = left + (np.arange(across) + 0.5) * pixel
    y = low + (np.arange(rows) + 0.5) * (high - low) / rows
    size = np.append(particles["size"], 0.0)  # the last is that of no particle within reach
    distance, nearest = cKDTree(particles["position"]).query(np.stack(np.meshgrid(x, y), axis=-1), p=np.inf, workers=-1,
                                                             distance_upper_bound=2.0 * size.max())
    reach = np.median(size[:-1]) / pixel
    widened = distance_transform_edt(distance > 0.5 * size[nearest] + 0.5 * pixel) <= reach
    ground = without_holes(distance_transform_edt(widened) > reach, 2.0 * reach)
    particles["pixels"] = np.where(ground & (nearest < len(size) - 1), nearest, -1)


def without_holes(ground, reach):
    """The ground with its holes filled, unless they touch the border or have a pixel that is farther than `reach` from ground."""
    holes, count = label(~ground)
    deepest = maximum(distance_transform_edt(~ground), holes, np.arange(count + 1))
    filled = deepest <= reach
    filled[np.unique(np.concatenate([holes[0], holes[-1], holes[:, 0], holes[:, -1]]))] = False
    return ground | filled[holes]


def image(particles, values):
    """The values on the pixels, NaN outside the ground."""
    return np.where(particles["pixels"] < 0, np.nan, values[particles["pixels"]])


def draw_panel(axis, particles, panel, extent):
    """One section, its grey part below the coloured one."""
    where = {"extent": extent, "origin": "lower", "aspect": "equal", "interpolation": "nearest"}
    values, grey = panel["values"], panel.get("grey")
    if grey is not None:
        axis.imshow(image(particles, np.where(grey, 1.0, np.nan)), cmap="Greys", vmin=0.0, vmax=4.0, **where)
        values = np.where(grey, np.nan, values)
    axis.imshow(image(particles, values), cmap=panel["colours"], norm=panel["norm"], **where)
    axis.set_title(panel["title"], fontsize=10)
    axis.grid(False)
    axis.set_ylabel("y (m)")


def stack(sections, panels, width=WIDTH):
    """Figure of stacked sections at one scale, one panel each; returns it and its axes."""
    add_sizes(sections)
    left, right, low, high = extent = common_extent(sections)
    height = len(panels) * (0.83 * width * (high - low) / (right - left) + 0.4) + 0.7
    figure, axes = plt.subplots(len(panels), 1, figsize=(width, height), sharex=True, squeeze=False,
                                layout="constrained")
    for axis, particles, panel in zip(axes[:, 0], sections, panels):
        if "pixels" not in particles:
            add_pixels(particles, extent)
        draw_panel(axis, particles, panel, extent)
    axes[-1, 0].set_xlabel("x (m)")
    return figure, axes[:, 0]


def colour_bar(figure, axes, panels, label, aspect):
    """Colour bar beside the axes, with an arrow where a panel's values pass its end."""
    norm, colours = panels[0]["norm"], panels[0]["colours"]
    over = any(np.nanmax(panel["values"], initial=-np.inf) > norm.vmax for panel in panels)
    under = any(np.nanmin(panel["values"], initial=np.inf) < norm.vmin for panel in panels)
    extend = {(True, True): "both", (True, False): "max", (False, True): "min", (False, False): "neither"}
    figure.colorbar(ScalarMappable(norm, colours), ax=axes, label=label, extend=extend[over, under],
                    extendfrac=1.0 / aspect, fraction=0.03, pad=0.01, aspect=aspect)


def without_strain(sections):
    """Per section, the particles of materials that have no plastic strain in any of the sections.

    Elastic ground has the law of softer ground that it borders on, within a cell, and there it may have strain.
    """
    if "material" not in sections[0]:
        return [~np.isfinite(p["plastic_strain"]) for p in sections]
    strained = {m for p in sections for m in np.unique(p["material"][np.nan_to_num(p["plastic_strain"]) > 0.0])}
    return [~np.isin(p["material"], list(strained)) | p.get("elastic", False) & (np.nan_to_num(p["plastic_strain"]) <= 0.0)
            for p in sections]


def top_of(fields, percentile):
    """Upper end of a colour scale: the percentile of the positive values, 1e-6 where there are none."""
    positive = np.concatenate([values[values > 0.0] for values in fields])
    return max(1e-6, float(np.percentile(positive, percentile))) if positive.size else 1e-6


def static_stress(folder, heading, width=WIDTH):
    """Stresses (kPa, tension positive) at the end of the static stage."""
    path = folder / "final.h5"
    if not path.exists():
        raise Missing("no final.h5: the static stage has not ended well yet")
    particles = read_particles(path, "stress")
    xx, yy, zz, xy = particles["stress"].T / 1e3
    q = np.sqrt(0.5 * ((xx - yy) ** 2 + (yy - zz) ** 2 + (zz - xx) ** 2) + 3.0 * xy**2)
    shear = float(np.percentile(np.abs(xy), 99.5)) or 1.0
    low_yy, low_xx, top_q = np.percentile(yy, 0.2), np.percentile(xx, 0.2), np.percentile(q, 99.8)
    panels = [{"title": title, "values": values, "colours": colours, "norm": norm} for title, values, colours, norm in (
        ("σyy", yy, "viridis", Normalize(min(low_yy, -1e-6), 0.0)),
        ("σxx", xx, "viridis", Normalize(min(low_xx, -1e-6), 0.0)),
        ("τxy", xy, "RdBu_r", Normalize(-shear, shear)),
        ("q = √(3 J₂)", q, "inferno_r", Normalize(0.0, max(top_q, 1e-6))))]
    figure, axes = stack([particles] * len(panels), panels, width)
    for axis, panel in zip(axes, panels):
        colour_bar(figure, axis, [panel], "kPa", aspect=15)
    return titled(figure, heading + ", static state (tension positive)")
