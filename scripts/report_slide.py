"""Of a report: what the slide has come to, sections at key times, a film, the energy balance."""
import io

import numpy as np

import film
import newmark
import plot_energy
import plot_fields
import plot_page
import plot_sections
import report_html as html
from plot_common import AREAS, Missing, array, frame_times, group_of, open_history
from plot_histories import read_outline

FILM_FRAMES = 61
FIELDS = ("displacement", "plastic_strain", "p", "q", "strength_used")


def trigger_of(file):
    """Trigger time (s), None where nothing has slid."""
    time = float(np.ravel(group_of(file, "slide").attrs.get("trigger_time", np.nan))[0])
    return time if np.isfinite(time) else None


def measures(run):
    """The measures of the run-out, as summary.json has them, each with its numerical uncertainty where that is beside the run."""
    if "slide" not in run.summary:
        raise Missing("there is no summary.json with a slide yet: it is written when the run ends or is interrupted")
    sure = plot_page.uncertainty_of(run.folder)
    bars = "± tells the numerical uncertainty at 95 %" if sure else "How sure they are is not known yet: scripts/uncertainty tells it"
    return html.words(plot_page.measures(run.summary, sure)) + html.paragraph(bars + ".")


def outline(run):
    """The free surface before and after, and how much it has risen or fallen."""
    with open_history(run.folder) as file:
        x, start, end = read_outline(file)

    change = np.nan_to_num(end - start)

    def draw(axes):
        axes[0].plot(x, start, "k--", lw=1.0, label="before")
        axes[0].plot(x, end, "C0-", lw=1.2, label="after")
        axes[0].set_ylabel("y (m)")
        axes[1].fill_between(x, 0, np.maximum(change, 0), color="C0", lw=0, label="deposit")
        axes[1].fill_between(x, 0, np.minimum(change, 0), color="C1", lw=0, label="lost")
        axes[1].axhline(0, color="k", lw=0.6)
        axes[1].set(ylabel="thickness (m)", xlabel="x (m)")
        for axis in axes:
            axis.legend()

    width = x[1] - x[0]
    gained, lost = (float((sign * change)[sign * change > 0].sum() * width) for sign in (1, -1))
    told = (f"The free surface before and after, and its rise: {html.number(gained)} m² of section were laid down (at most "
            f"{html.number(change.max())} m thick) and {html.number(lost)} m² lost (at most {html.number(-change.min())} m).")
    return html.panel(draw, told, (6.5, 3.6), 2, "wide")


def series(run):
    """Moved area and its displacement, speed, toe over time."""
    with open_history(run.folder) as file:
        trigger, slide, sure = trigger_of(file), group_of(file, "slide"), plot_page.uncertainty_of(run.folder)
        time, toe, advance = array(slide, "time"), array(slide, "toe"), array(slide, "toe_advance")

        def draw_toe(axis):
            there = np.where(array(slide, "moved_area") > 0, toe, np.nan)
            axis.plot(time, there, "C0-", lw=1.0)
            axis.set_title("toe of the moved ground: place (full), advance (dashed)")
            axis.set_ylabel("x (m)", color="C0")
            other = axis.twinx()
            other.plot(time, advance, "C1--", lw=1.0)
            other.set_ylabel("advance (m)", color="C1")
            other.grid(False)
            plot_page.mark_trigger(axis, trigger)

        draws = {"Moved area and mean displacement": lambda axis: plot_page.draw_slide(axis, file, trigger, sure),
                 "Speed of the moved ground": lambda axis: plot_page.draw_speed(axis, file, trigger, sure), "Toe": draw_toe}

        return html.grid([html.panel(timed(draw), f"{name}; dotted: trigger.", (4.2, 3.2)) for name, draw in draws.items()], True)


def timed(draw):
    """The same picture with the time below it and a legend that can be read."""
    def drawn(axis):
        draw(axis)
        axis.set_xlabel("time (s)")
        if axis.get_legend():
            axis.legend()
    return drawn


def rigid_block(run):
    """The rigid block of newmark.json beside the run."""
    result = newmark.stored(run.folder)
    if result is None:
        raise Missing("there is no newmark.json of this run: scripts/newmark RUN_FOLDER makes it")
    return html.paragraph("; ".join(newmark.lines_of(result)) + ".") + html.grid([
        html.panel(timed(lambda axis: newmark.draw(axis, run.folder, result)), "Rigid block (Newmark) beside the run.")])


def key_times(run):
    """Names and times (s) of trigger, fastest slide and end; of a run without a slide of its begin, middle and end."""
    frames = frame_times(run.folder)
    try:
        with open_history(run.folder) as file:
            trigger, slide = trigger_of(file), group_of(file, "slide")
            speed = array(slide, "peak_velocity")
            fastest = float(array(slide, "time")[int(np.nanargmax(speed))]) if np.nanmax(speed, initial=0) > 0 else None
    except Missing:
        trigger = fastest = None
    if trigger is None or fastest is None:
        return {"begin": frames[0][0], "middle": frames[len(frames) // 2][0], "last": frames[-1][0]}
    return {"trigger": trigger, "fastest": fastest, "last": frames[-1][0]}


def sections(run):
    """Fields at the key times, each on one scale; what a field needs and the frames lack is said."""
    frames = frame_times(run.folder)
    chosen, titles = [], {}
    for name, time in key_times(run).items():
        frame = plot_sections.choose(frames, [time])[0]
        titles[frame] = f"{titles[frame]}, {name}" if frame in titles else f"t = {frame[0]:.2f} s: {name}"
        chosen += [frame] if frame not in chosen else []
    parts, pixels = [], {}
    for name in FIELDS:
        label = plot_fields.FIELDS[name].label
        try:
            drawn = [plot_fields.read(path, name, run.settings) for _, path in chosen]
            for (_, path), particles in zip(chosen, drawn):
                particles |= pixels.get(path, {})
            panels = plot_fields.panels_of(drawn, name, [titles[frame] for frame in chosen])
            figure, axes = plot_sections.stack(drawn, panels, html.PANEL[0])
            plot_sections.colour_bar(figure, axes, panels, label, aspect=20 * len(panels))
            pixels |= {path: {"pixels": particles["pixels"]} for (_, path), particles in zip(chosen, drawn)}
            parts.append(html.picture(figure, label[0].upper() + label[1:] + ", at the frames nearest to these times.", "png"))
        except Missing as reason:
            parts.append(html.paragraph(f"{name.replace('_', ' ')}: not shown: {reason}", "note"))
    return html.grid(parts)


def moving(run):
    """A film of the plastic strain, or of the displacement where nothing yields."""
    frames = film.frames_of(run.folder, most=FILM_FRAMES)
    try:
        last = plot_fields.read(frames[-1][1], "plastic_strain", {})["values"]
        name = "plastic_strain" if np.nanmax(last, initial=0.0) > 0 else "displacement"
    except Missing:
        name = "displacement"
    data = io.BytesIO()
    film.webp(film.drawn(frames, name, run.settings), film.rate_of(frames), data)
    return html.embedded(data.getvalue(), "image/webp", f"Film: {plot_fields.FIELDS[name].label}, {len(frames)} frames from "
                         f"{frames[0][0]:g} to {frames[-1][0]:g} s (in the HTML file, not on paper).", "wide film")


def energy(run):
    """The energy balance: a ledger at the end and over time."""
    with open_history(run.folder) as file:
        time, terms, unit = plot_energy.read_energy_balance(file)
    brought = plot_energy.sources(terms)
    become = {name: terms[name] for name in plot_energy.BECOME if name in terms and np.any(terms[name])}
    whole = sum(values[-1] for values in brought.values())
    share = lambda value: html.number(100 * value / whole) if whole else "–"
    rows = [[name.replace("_", " "), html.number(values[-1], 4), "", ""] for name, values in brought.items()]
    rows += [["all that came in", html.number(whole, 4), "", "100" if whole else "–"]]
    rows += [[name.replace("_", " "), "", html.number(values[-1], 4), share(values[-1])] for name, values in become.items()]
    rows += [["residual", "", html.number(terms["residual"][-1], 3), share(terms["residual"][-1])]]

    def draw(axis):
        plot_energy.stacked(axis, time, become, AREAS)
        axis.plot(time, sum(brought.values()), "k-", lw=1.0, label="all that came in")
        axis.set(xlabel="time (s)", ylabel=f"energy ({unit})")
        axis.legend()

    ledger = html.table(["", f"came in ({unit})", f"became ({unit})", "share (%)"], rows, f"The ledger at t = {time[-1]:.2f} s")
    return ledger + html.grid([html.panel(draw, "What became of the energy that came in.")])
