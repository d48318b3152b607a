"""A case of a section as a readable file, and the picture of it."""
import textwrap

import numpy as np
import yaml
from matplotlib.colors import ListedColormap, Normalize
from matplotlib.patches import Patch

import plot_sections
from plot_common import AREAS, label, save

WIDTH = 118  # of a line of text
MOST_INLINE = 20  # points: a longer surface has a file of its own
MOTION = {"recorded_as": "outcrop", "horizontal": "built_in", "baseline": "none", "high_pass": "0.1 Hz"}


def number(value):
    """A number as text, without the noise of its last bits."""
    return f"{value:.10g}"


def length(value):
    """A length of a case, m."""
    return f"{number(value)} m"


def flow(value):
    """A value of YAML in one line."""
    return yaml.safe_dump([value], default_flow_style=True, sort_keys=False, allow_unicode=True, width=10**6).strip()[1:-1]


def lines_of(tree, depth=0):
    """Lines of YAML of a map: what fits stands in one line."""
    found = []
    for key, value in tree.items():
        head = "  " * depth + flow(key) + ":"
        one = f"{head} {flow(value)}"
        if isinstance(value, dict) and value and len(one) > WIDTH:
            found += [head, *lines_of(value, depth + 1)]
        elif len(one) > WIDTH and isinstance(value, list):
            parts = textwrap.wrap(one.replace("], [", "],\0[").replace(" ", "\1").replace("\0", " "), WIDTH, break_long_words=False,
                                  break_on_hyphens=False, subsequent_indent="  " * depth + "    ")
            found += [part.replace("\1", " ") for part in parts]
        else:
            found.append(one)
    return found


def surface(line):
    """The value of a surface, and the name and text of its file, where it has one."""
    if len(line.x) <= MOST_INLINE:
        return {"points": [[length(x), length(y)] for x, y in zip(line.x, line.y)]}, {}
    name = f"{line.name}.csv"
    rows = "".join(f"{number(x)},{number(y)}\n" for x, y in zip(line.x, line.y))
    return {"file": name}, {name: "x (m),y (m)\n" + rows}


def region(found):
    """The value of a region."""
    above = {"above": found.above.name} if found.above is not None else {}
    return {"material": found.material, **above, "below": found.below.name} | ({"x": [length(x) for x in found.sides]} if found.sides else {})


def files_of(name, section, materials, rest, spacing, gauges, origin):
    """{name of file: text} of a case.

    materials: maps by name; rest: grid, static, seismic, time_step, output of the case that it is to be like, or none;
    spacing: of the grid, None leaves it to a profile; gauges: {name: x in m}, on the ground; origin: lines that say where it comes from.
    """
    files, text = {}, ["schema: seismpm-case/1", *lines_of({"name": name}), *(f"# {line}" for line in origin), ""]
    grid = {"particles_per_cell": 2, **rest.get("grid", {})}
    grid = ({"spacing": length(spacing)} if spacing else {}) | {key: value for key, value in grid.items() if key != "spacing"}
    text += lines_of({"grid": grid, "domain": {"x": [length(section.left), length(section.right)], "bottom": length(section.bottom)}})
    text += ["", "surfaces:  # lines y(x), straight between points"]
    for line in section.lines():
        value, file = surface(line)
        files |= file
        text += [*textwrap.wrap(line.where, WIDTH, initial_indent="  # ", subsequent_indent="  # "), *lines_of({line.name: value}, 1)]
    text.append("regions:  # the first that holds a point has it")
    text += [f"  - {flow(region(found))}  # {found.area:.6g} m2" for found in section.regions]
    text += ["", "materials:", *lines_of(materials, 1), ""]
    settings = {"static": {"gravity": "9.81 m/s2"}, "seismic": {"duration": "record + 10 s", "motion": MOTION}}
    settings |= {key: rest[key] for key in ("static", "seismic", "time_step") if key in rest}
    output = {key: value for key, value in rest.get("output", {}).items() if key != "gauges"}
    if gauges:
        sampling = rest.get("output", {}).get("gauges", {})
        points = {key: [length(x), length(section.ground(x))] for key, x in gauges.items()}
        output["gauges"] = {key: value for key, value in sampling.items() if key != "points"} | {"points": points}
    text += lines_of({**settings, **({"output": output} if output else {})})
    return {**files, "case.yaml": "\n".join(text) + "\n"}


def draw(state, section, gauges, path, heading):
    """The particles of a state by material, as squares of their volume, with the lines of the section and its gauges."""
    particles = plot_sections.read_particles(state)
    used = list(dict.fromkeys(region.material for region in section.regions))
    colour_of = [used.index(name) for name in particles["material_names"]]
    values = np.array(colour_of)[particles["material"]].astype(float)
    colours = [AREAS[k % len(AREAS)] for k in range(len(used))]
    panel = {"title": "", "values": values, "norm": Normalize(-0.5, len(used) - 0.5), "colours": ListedColormap(colours)}
    figure, (axis,) = plot_sections.stack([particles], [panel])
    for region in section.regions:
        x = np.unique(np.concatenate([region.below.x, region.sides or (section.left, section.right)]))
        for line in (region.below, region.above):
            if line is not None:
                inside = (x >= region.sides[0]) & (x <= region.sides[1]) if region.sides else slice(None)
                axis.plot(x[inside], line.height(x[inside]), color="k", ls="-", lw=0.8)
    for name, x in gauges.items():
        axis.plot(x, section.ground(x), "kv", ms=6, clip_on=False)
        axis.annotate(label(name), (x, section.ground(x)), xytext=(0, 6), textcoords="offset points", ha="center", fontsize=8)
    low, high = axis.get_ylim()
    axis.set_ylim(low, high + 0.08 * (high - low))  # room for the gauges' names
    figure.legend(handles=[Patch(color=colour, label=label(name)) for colour, name in zip(colours, used)], fontsize=8, loc="upper center",
                  bbox_to_anchor=(0.5, 0.0), ncol=6, frameon=False)
    save(figure, path, heading)
