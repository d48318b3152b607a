"""The pieces of a report: one HTML page that holds its pictures, loads nothing and runs nothing.

It reads on a phone (tables scroll within themselves, pictures stand below each other) and prints on A4.
"""
import base64
import html
import io
import math

import matplotlib.pyplot as plt

from plot_common import laid_out

MARK = '<meta name="generator" content="seismpm report">'  # by which a report is known
POLICY = "default-src 'none'; img-src data:; style-src 'unsafe-inline'"  # a browser that obeys loads and runs nothing
PANEL = (5.2, 3.2)  # inches: letters of 9 pt stay readable where a phone shows the picture 9 cm wide
STYLE = {"font.size": 9, "axes.titlesize": 9, "axes.labelsize": 9, "legend.fontsize": 8, "xtick.labelsize": 8,
         "ytick.labelsize": 8, "axes.grid": True, "grid.alpha": 0.3}
CSS = """
:root{color-scheme:light}
*{box-sizing:border-box}
body{margin:0;background:#fff;color:#1a1a1a;font:16px/1.5 system-ui,-apple-system,"Segoe UI",sans-serif;overflow-wrap:anywhere}
main{max-width:76rem;margin:0 auto;padding:1rem}
h1{font-size:1.7rem;line-height:1.2;margin:.5rem 0}
h2{font-size:1.3rem;margin:2.2rem 0 .6rem;padding-bottom:.2rem;border-bottom:2px solid #0072B2;break-after:avoid}
h3{font-size:1.05rem;margin:1.4rem 0 .4rem;break-after:avoid}
p{margin:.5rem 0;max-width:52rem}
a{color:#0060a0}
nav ul{display:flex;flex-wrap:wrap;gap:.2rem 1rem;list-style:none;margin:.5rem 0;padding:0}
.cards{display:grid;grid-template-columns:repeat(auto-fill,minmax(9.5rem,1fr));gap:.6rem;margin:1rem 0}
.cards div{border:1px solid #d0d7de;border-radius:.4rem;padding:.5rem .7rem;break-inside:avoid}
.cards span{display:block;font-size:.85rem;color:#505050}
.cards b{font-size:1.15rem}
.grid{display:grid;grid-template-columns:repeat(auto-fill,minmax(min(100%,26rem),1fr));gap:1rem;margin:.6rem 0}
figure{margin:.6rem 0;min-width:0;break-inside:avoid}
.grid figure{margin:0}
.narrow{grid-template-columns:repeat(auto-fill,minmax(min(100%,19rem),1fr))}
.wide{max-width:52rem}
figure img{display:block;width:100%;height:auto}
figcaption{font-size:.875rem;color:#404040}
.scroll{overflow-x:auto;margin:.6rem 0}
table{border-collapse:collapse;font-size:.875rem;font-variant-numeric:tabular-nums}
caption{text-align:left;font-size:.875rem;color:#404040;padding-bottom:.3rem}
th,td{padding:.2rem .7rem;border-bottom:1px solid #ddd;text-align:right;white-space:nowrap;vertical-align:top}
th:first-child,td:first-child{text-align:left;padding-left:0}
thead th{border-bottom:2px solid #888}
table.words{width:100%;max-width:52rem}
table.words td{text-align:left;white-space:normal}
table.words td:first-child{width:38%;min-width:7rem;color:#505050}
.note{border-left:.3rem solid #888;background:#f4f4f4;padding:.3rem .8rem;max-width:52rem}
.warning{border-left-color:#D55E00;background:#fdf1ea}
pre{white-space:pre-wrap;font-size:.8rem;line-height:1.35;background:#f6f8fa;padding:.7rem}
@page{size:A4;margin:14mm}
@media print{
html{font-size:9.5pt}body{font-size:1rem}main{max-width:none;padding:0}nav,.film img{display:none}
.narrow,.grid{grid-template-columns:1fr 1fr}.narrow{grid-template-columns:1fr 1fr 1fr}.wide{max-width:14cm}.scroll{overflow:visible;break-inside:avoid}
table{font-size:7.5pt}th,td{padding:.1rem .35rem}tr{break-inside:avoid}
pre{font-size:7pt;background:none;padding:0;columns:2}.cards{grid-template-columns:repeat(4,1fr)}}
"""


def escaped(words):
    """Text as HTML shows it."""
    return html.escape(str(words))


def number(value, digits=3):
    """A number with so many significant digits, a dash where there is none."""
    if value is None or not math.isfinite(value):
        return "–"
    if value == 0:
        return "0"
    places = digits - 1 - math.floor(math.log10(abs(value)))
    if not -4 < places < 6:
        return f"{value:.{digits - 1}e}"
    return f"{value:,.{max(0, places)}f}".replace(",", "\u202f").replace("-", "−")


def paragraph(words, kind=""):
    """A paragraph; kind: note, or note warning."""
    return f"<p{f' class={chr(34)}{kind}{chr(34)}' if kind else ''}>{escaped(words)}</p>"


def table(head, rows, caption=""):
    """A table of numbers, as strings, under a head of names with units; it scrolls where it is too wide."""
    line = lambda cells, tag: "<tr>" + "".join(f"<{tag}>{escaped(cell)}</{tag}>" for cell in cells) + "</tr>"
    told = f"<caption>{escaped(caption)}</caption>" if caption else ""
    return (f'<div class="scroll"><table>{told}<thead>{line(head, "th")}</thead><tbody>'
            + "".join(line(row, "td") for row in rows) + "</tbody></table></div>")


def words(rows):
    """A table of names and what is to be said of each."""
    lines = "".join(f"<tr><td>{escaped(name)}</td><td>{escaped(text)}</td></tr>" for name, text in rows)
    return f'<table class="words"><tbody>{lines}</tbody></table>'


def embedded(data, kind, caption, name=""):
    """A picture within the page, of bytes of a type such as image/png; its caption tells it to those who do not see it."""
    uri = f"data:{kind};base64,{base64.b64encode(data).decode()}"
    named = f' class="{name}"' if name else ""
    return f'<figure{named}><img alt="{escaped(caption)}" src="{uri}"><figcaption>{escaped(caption)}</figcaption></figure>'


def picture(figure, caption, kind="svg", name=""):
    """A figure within the page: lines as svg, sections as png."""
    data = io.BytesIO()
    laid_out(figure).savefig(data, format=kind, dpi=160, metadata={"Date": None} if kind == "svg" else None)
    plt.close(figure)
    return embedded(data.getvalue(), {"svg": "image/svg+xml", "png": "image/png"}[kind], caption, name)


def legend(axis):
    """A legend within the axes, or above them where it has many lines."""
    many = len(axis.get_legend_handles_labels()[0]) > 5
    axis.legend(**({"loc": "lower center", "bbox_to_anchor": (0.5, 1.0), "ncols": 3, "frameon": False} if many else {}))


def panel(draw, caption, size=PANEL, rows=1, name=""):
    """A small picture of lines: `draw` is given its axes, a list where there are several rows."""
    figure, axes = plt.subplots(rows, 1, figsize=size, sharex=True, layout="constrained")
    draw(axes)
    return picture(figure, caption, name=name)


def grid(parts, narrow=False):
    """Pictures side by side, as many as there is room for: two, or three narrow ones, on a large screen."""
    return f'<div class="{"narrow grid" if narrow else "grid"}">{"".join(parts)}</div>'


def page(title, lead, sections):
    """The whole page: heading, what stands before the contents, and (title, HTML) of each section."""
    contents = "".join(f'<li><a href="#s{k}">{escaped(name)}</a></li>' for k, (name, _) in enumerate(sections))
    body = "".join(f'<section id="s{k}"><h2>{escaped(name)}</h2>{part}</section>' for k, (name, part) in enumerate(sections))
    return ('<!DOCTYPE html>\n<html lang="en"><head><meta charset="utf-8">'
            '<meta name="viewport" content="width=device-width, initial-scale=1">'
            f'<meta http-equiv="Content-Security-Policy" content="{POLICY}">{MARK}<link rel="icon" href="data:,">'
            f"<title>{escaped(title)}</title><style>{CSS}</style></head><body><main>"
            f"<h1>{escaped(title)}</h1>{lead}<nav><ul>{contents}</ul></nav>{body}</main></body></html>\n")
