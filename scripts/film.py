"""A film of a field of a run: scripts/film RUN_FOLDER [--field NAME] [--out FILE.webp].

All frames are on one scale, and of one size. Animated WebP plays in every browser and needs nothing more than the pictures do;
a name that ends with .mp4 needs ffmpeg. Also of a run that is under way: the frames so far.
"""
import itertools
import shutil
import subprocess
import sys
from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.cm import ScalarMappable
from PIL import Image

import plot_fields
import plot_sections
from options import Parser
from plot_common import Missing, frame_times
from settings import settings_of

PIXELS = 800  # across the section
WIDTH = 7.2  # inches
DPI = 120
SECONDS = 12.0  # that a film lasts by default
LONGEST = 150  # frames by default: more are thinned out
SAMPLE = 12  # frames that the scale is found from


def thinned(frames, most):
    """At most so many of the frames, evenly spread, the first and the last among them."""
    if len(frames) <= most:
        return frames
    return [frames[k] for k in np.unique(np.linspace(0, len(frames) - 1, most).round().astype(int))]


def scene_of(frames):
    """Left, right, low, high (m) of the ground in all frames."""
    corners = []
    for _, path in frames:
        particles = plot_sections.read_particles(path)
        plot_sections.add_sizes([particles])
        ends = np.array([particles["position"].min(0), particles["position"].max(0)])
        corners.append({"position": ends, "size": particles["size"].max(keepdims=True)})
    return plot_sections.common_extent(corners)


def drawn(frames, name, settings):
    """Yields an RGB image of the field at each of the frames, (time, path), all on one scale and of one size."""
    sample = [plot_fields.read(path, name, settings) for _, path in thinned(frames, SAMPLE)]
    norm = plot_fields.FIELDS[name].scale([particles["values"] for particles in sample])
    left, right, low, high = extent = scene_of(frames)
    height = 0.85 * WIDTH * (high - low) / (right - left) + 0.9
    figure, axis = plt.subplots(figsize=[2 * round(length * DPI / 2) / DPI for length in (WIDTH, height)], dpi=DPI,
                                layout="constrained")  # MP4 wants even numbers of pixels
    figure.colorbar(ScalarMappable(norm, plot_fields.FIELDS[name].colours), ax=axis, extend="max", fraction=0.04, pad=0.01,
                    label=plot_fields.FIELDS[name].label.split(" (grey")[0])
    for time, path in frames:
        particles = plot_fields.read(path, name, settings)
        plot_sections.add_sizes([particles])
        plot_sections.add_pixels(particles, extent, PIXELS)
        for image in list(axis.images):  # those of the frame before
            image.remove()
        panel = plot_fields.panels_of([*sample, particles], name, [f"t = {time:.2f} s"] * (len(sample) + 1), norm)[-1]
        plot_sections.draw_panel(axis, particles, panel, extent)
        axis.set_xlabel("x (m)")
        figure.canvas.draw()
        figure.set_layout_engine("none")  # all else stays where it is in the first
        yield Image.fromarray(np.asarray(figure.canvas.buffer_rgba())[..., :3].copy())
    plt.close(figure)


def webp(images, rate, out):
    """Writes an animated WebP of the images, `rate` of them in a second, to a path or a buffer. It plays for ever."""
    images = list(images)
    images[0].save(out, "WEBP", save_all=True, append_images=images[1:], duration=round(1000 / rate), loop=0, quality=60,
                   method=4)


def mp4(images, rate, out):
    """Writes an MP4 (H.264) of the images to a path, by ffmpeg."""
    images = iter(images)
    first = next(images)
    command = ["ffmpeg", "-loglevel", "error", "-y", "-f", "rawvideo", "-pix_fmt", "rgb24", "-s", "{}x{}".format(*first.size),
               "-r", f"{rate:g}", "-i", "-", "-pix_fmt", "yuv420p", "-movflags", "+faststart", "-f", "mp4", str(out)]
    with subprocess.Popen(command, stdin=subprocess.PIPE) as encoder:
        for image in itertools.chain([first], images):
            encoder.stdin.write(image.tobytes())
        encoder.stdin.close()
        if encoder.wait():
            raise OSError(f"ffmpeg ended with {encoder.returncode}")


def frames_of(folder, begin=None, end=None, most=LONGEST):
    """The frames of a run, (time in s, path), between two times, thinned to so many."""
    frames = [frame for frame in frame_times(folder)
              if (begin is None or frame[0] >= begin - 1e-9) and (end is None or frame[0] <= end + 1e-9)]
    if not frames:
        raise Missing("no frame lies between these times")
    return thinned(frames, most)


def rate_of(frames):
    """Frames in a second with which a film lasts about SECONDS, 2 to 25."""
    return min(25.0, max(2.0, len(frames) / SECONDS))


def parse_arguments():
    """The command line."""
    parser = Parser(prog="film", description=__doc__.splitlines()[0])
    parser.add_argument("folder", type=Path, metavar="RUN_FOLDER", help="output folder of mpm-seismic")
    parser.add_argument("--field", choices=plot_fields.FIELDS, default="plastic_strain", metavar="NAME",
                        help="one of " + ", ".join(plot_fields.FIELDS) + "; default plastic_strain")
    parser.add_argument("--from", dest="begin", type=float, metavar="S", help="begin at this time (s); default the first frame")
    parser.add_argument("--until", dest="end", type=float, metavar="S", help="end at this time (s); default the last frame")
    parser.add_argument("--frames", type=int, default=LONGEST, metavar="N", help=f"at most so many; default {LONGEST}")
    parser.add_argument("--rate", type=float, metavar="N", help=f"frames in a second; default such that it lasts {SECONDS:g} s")
    parser.add_argument("--out", type=Path, metavar="FILE", help="FILE.webp or FILE.mp4; default RUN_FOLDER/pictures/NAME.webp")
    parser.add_argument("--force", action="store_true", help="replace a film that is there")
    given = parser.parse_args()
    given.out = given.out or given.folder / "pictures" / f"{given.field}.webp"
    if given.out.suffix not in (".webp", ".mp4"):
        parser.error(f"--out {given.out}: give a name that ends with .webp or .mp4")
    if given.frames < 1 or given.rate is not None and not 0 < given.rate <= 100:
        parser.error("--frames takes 1 or more, --rate more than 0 and at most 100")
    return given


def main():
    """Draws and writes the film; returns the exit code."""
    given = parse_arguments()
    if given.out.exists() and not given.force:
        print(f"film: {given.out} is there already; give another --out, or --force to replace it", file=sys.stderr)
        return 73
    if given.out.suffix == ".mp4" and not shutil.which("ffmpeg"):
        print("film: an MP4 needs ffmpeg, which is not there; install it, or give a name that ends with .webp", file=sys.stderr)
        return 69
    part = given.out.with_name(given.out.name + ".part")
    try:
        frames = frames_of(given.folder, given.begin, given.end, given.frames)
        images = drawn(frames, given.field, settings_of(given.folder))
        given.out.parent.mkdir(parents=True, exist_ok=True)
        (webp if given.out.suffix == ".webp" else mp4)(images, given.rate or rate_of(frames), part)
        part.replace(given.out)
    except (Missing, OSError) as reason:
        part.unlink(missing_ok=True)
        print(f"film: {given.folder}: {reason}", file=sys.stderr)
        return 66
    print(f"{given.out}: {len(frames)} frames, {frames[0][0]:g} to {frames[-1][0]:g} s")
    return 0


if __name__ == "__main__":
    sys.exit(main())
