# SPDX-License-Identifier: LGPL-2.1-or-later
"""One look for all pictures: colours for every kind of colour vision, markers and
dashes with them, fonts of 8 pt, and widths of a column or a page. Equal data give
equal files."""
import io
import itertools
import math
import re

import matplotlib
import numpy

matplotlib.use("Agg")
from matplotlib import pyplot, ticker  # noqa: E402

COLUMN, PAGE = 84, 174  # mm
MM = 1 / 25.4           # inches

# Okabe and Ito (2008); the pale ones are for areas.
BLUE, VERMILION, GREEN, PURPLE, ORANGE, SKY, BLACK, YELLOW = COLOURS = (
    "#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9",
    "#000000", "#f0e442")
GREY, PALE = "#7f7f7f", "#e8e8e8"
MARKERS = ("o", "s", "^", "D", "v", "P", "X", "*")
DASHES = ("-", (0, (5, 1.5)), (0, (1, 1.2)), (0, (6, 1.5, 1, 1.5)),
          (0, (3, 1)), (0, (8, 2, 2, 2)), (0, (1, 2.5)), (0, (4, 1, 1, 1, 1, 1)))

# States of contact points, as in the field `status`: colour, word.
OPEN, STICK, SLIP = PALE, BLUE, VERMILION
FIELD_MAP = "viridis"

matplotlib.rcParams.update({
    "font.family": "DejaVu Sans", "font.size": 8, "axes.titlesize": 8,
    "axes.labelsize": 8, "xtick.labelsize": 7, "ytick.labelsize": 7,
    "legend.fontsize": 7, "figure.titlesize": 9, "mathtext.fontset": "dejavusans",
    "axes.linewidth": 0.6, "axes.edgecolor": "#404040",
    "axes.spines.top": False, "axes.spines.right": False,
    "axes.grid": True, "grid.color": "#dcdcdc", "grid.linewidth": 0.4,
    "axes.axisbelow": True, "xtick.major.width": 0.6, "ytick.major.width": 0.6,
    "xtick.minor.width": 0.4, "ytick.minor.width": 0.4,
    "lines.linewidth": 1.2, "lines.markersize": 3.2, "lines.markeredgewidth": 0.6,
    "legend.frameon": False, "legend.handlelength": 2.6,
    "axes.formatter.use_mathtext": True, "axes.formatter.limits": (-3, 4),
    "axes.formatter.useoffset": False,
    "savefig.dpi": 200, "figure.dpi": 100, "figure.constrained_layout.use": True,
    "svg.hashsalt": "abut", "svg.fonttype": "path", "figure.facecolor": "white"})


def curve_style(number):
    """Colour, marker and dashes of curve 0, 1, ... of a picture."""
    return {"color": COLOURS[number % 7], "marker": MARKERS[number % 8],
            "linestyle": DASHES[number % 8]}


def line_style(number):
    """The same for curves with too many points for markers."""
    return {"color": COLOURS[number % 7], "linestyle": DASHES[number % 8]}


def is_narrow(width):
    """Whether a width is that of a column; colour bars are below there."""
    return width < 1.2 * COLUMN


def figure(width, aspect=0.62, rows=1, columns=1, **more):
    """Figure and axes, `width` mm wide, each row `aspect` of it high; in a
    column rows are higher, as letters are not smaller there."""
    if is_narrow(width):
        aspect = max(aspect, 0.5 if rows > 1 else 0.72)
    made, all_axes = pyplot.subplots(rows, columns, squeeze=False, figsize=(
        width * MM, width * aspect * rows * MM), **more)
    for axes in all_axes.flat if is_narrow(width) else ():
        axes.xaxis.set_major_locator(FewTicks())
    return made, all_axes


def named(artist, name):
    """Give a curve or field a name, by which drawn_data() and the SVG know
    it."""
    artist.set_gid(name)
    return artist


def drawn_data(of_figure):
    """The numbers that are drawn, by name: rows x, y of curves, and corners
    and values of fields."""
    result = {}
    for artist in of_figure.findobj(lambda each: each.get_gid()):
        if hasattr(artist, "get_xydata"):
            result[artist.get_gid()] = numpy.asarray(artist.get_xydata())
        elif hasattr(artist, "drawn_values"):
            result[artist.get_gid()] = artist.drawn_values
        elif hasattr(artist, "get_segments"):
            result[artist.get_gid()] = artist.get_segments()
        elif hasattr(artist, "get_array"):
            result[artist.get_gid()] = (
                [path.vertices for path in artist.get_paths()],
                artist.get_array())
    return result


def _columns(of_figure, handles):
    """Columns of a legend: the fewest rows that fit into the width."""
    room = of_figure.get_size_inches()[0] / MM - 10
    sizes = [1.3 * len(re.sub(r"\\[a-z]+|[$\\{}^_]", "", handle.get_label())) + 14
             for handle in handles]
    for rows in range(1, len(sizes)):
        columns = math.ceil(len(sizes) / rows)
        if sum(map(max, numpy.array_split(sizes, columns))) <= room:
            return columns
    return 1


def legend(axes, handles=None, **more):
    """A legend where it hides no data: above the axes, in columns."""
    handles = handles or axes.get_legend_handles_labels()[0]
    if not handles:
        return None
    return axes.legend(handles=handles, loc="lower center",
                       bbox_to_anchor=(0.5, 1.0), borderaxespad=0.3,
                       ncol=_columns(axes.get_figure(), handles), **more)


def legend_above(of_figure, handles, title=None, columns=None):
    """One legend for all axes, above them; there is room left for it."""
    columns = columns or _columns(of_figure, handles)
    rows = math.ceil(len(handles) / columns) + (1 if title else 0)
    if rows == 0:
        return
    of_figure.legend(handles=handles, loc="upper center", ncol=columns,
                     bbox_to_anchor=(0.5, 1.0), borderaxespad=0.2, title=title,
                     title_fontsize=8)
    of_figure.get_layout_engine().set(rect=(0, 0, 1, 1 - (
        4.2 * rows + 1) * MM / of_figure.get_size_inches()[1]))


def logarithmic(axis):
    """A logarithmic axis with powers of ten; on a short one also 2 and 5
    times them, and plain numbers."""
    name = axis.axis_name
    getattr(axis.axes, f"set_{name}scale")("log")
    low, high = getattr(axis.axes, f"get_{name}lim")()
    decades = math.log10(high / low)
    if decades <= 2:
        axis.set_major_locator(ticker.LogLocator(subs=(1, 2, 5)))
        is_plain = 5e-5 < low and high < 1e6
        axis.set_major_formatter(ticker.FuncFormatter(
            lambda value, _: f"{value:g}" if is_plain else number(value)))
        axis.set_minor_formatter(ticker.NullFormatter())
    else:
        step = max(1, math.ceil(decades / 8))
        axis.set_major_locator(ticker.LogLocator(base=10 ** step, numticks=12))
        axis.set_minor_locator(ticker.LogLocator(
            subs=range(2, 10), numticks=100) if step == 1
            else ticker.LogLocator(numticks=100))
        axis.set_minor_formatter(ticker.NullFormatter())


def colour_bar(of_figure, mapped, axes, text, is_below=None, **more):
    """A colour bar beside the axes, or below them."""
    if is_below is None:
        is_below = is_narrow(of_figure.get_size_inches()[0] / MM)
    place = ({"location": "bottom", "aspect": 40} if is_below
             else {"aspect": 30})
    return of_figure.colorbar(mapped, ax=axes, label=text, **{**place, **more})


class FewTicks(ticker.MaxNLocator):
    """At most five intervals, and as many as there is room for; no number
    sticks out at the right end of an axis."""

    def __call__(self):
        axes = self.axis.axes
        size, least = ((axes.bbox.width, 28) if self.axis.axis_name == "x"
                       else (axes.bbox.height, 12))
        points = 72 * size / axes.get_figure().dpi
        self.set_params(nbins=min(5, max(1, int(points / least))))
        found = super().__call__()
        low, high = sorted(self.axis.get_view_interval())
        return (found[found < high - 0.04 * (high - low)]
                if self.axis.axis_name == "x" else found)


def whole_numbers(axis):
    axis.set_major_locator(ticker.MaxNLocator(integer=True))


def number(value, digits=3):
    """A number for people: 0.02, 1500, 3·10⁻⁶ as mathematics."""
    if value == 0 or not math.isfinite(value):
        return f"{value:g}"
    power = math.floor(math.log10(abs(value)) + 1e-12)
    if -4 < power < 5:
        return f"{value:.{digits}g}" if power < digits else f"{value:.0f}"
    mantissa = f"{value / 10.0 ** power:.{digits}g}"
    return (f"$10^{{{power}}}$" if mantissa == "1"
            else f"${mantissa}\\cdot10^{{{power}}}$")


def slope_triangle(axes, x, y, slope, width=2.0, text=None):
    """A triangle with one side of the slope `slope` on logarithmic axes; its
    lower left corner is (x, y)."""
    xs = numpy.array([x, x * width, x * width, x])
    ys = numpy.array([y, y, y * width ** slope, y])
    axes.plot(xs, ys, color=GREY, linewidth=0.7, linestyle="-", marker="")
    axes.annotate(text or f"{slope:g}", (x * width, y * width ** (slope / 2)),
                  textcoords="offset points", xytext=(3, 0), fontsize=7,
                  va="center", color=GREY)


def plane_map(axes):
    """Axes of a map in space: equal scales, no grid, few ticks."""
    axes.set_aspect("equal")
    axes.margins(0)
    axes.grid(False)
    axes.set_xlabel("$x$ [length]")
    axes.set_ylabel("$y$ [length]")
    for axis in (axes.xaxis, axes.yaxis):
        axis.set_major_locator(FewTicks())


def letters(all_axes):
    """(a), (b), ... at the axes of a figure with several."""
    if len(all_axes) > 1:
        for axes, letter in zip(all_axes, itertools.count()):
            axes.annotate(f"({chr(97 + letter)})", (0, 1), (0, 4),
                          xycoords="axes fraction",
                          textcoords="offset points", fontweight="bold",
                          ha="right", va="bottom")


def svg_element(of_figure, prefix):
    """A figure as an <svg> element of a page, in which ids must be its own. The
    figure is closed."""
    file = io.StringIO()
    of_figure.savefig(file, format="svg",
                      metadata={"Date": None, "Creator": None})
    pyplot.close(of_figure)
    svg = file.getvalue()
    svg = svg[svg.index("<svg"):].strip()
    svg = re.sub(r"<metadata>.*?</metadata>", "", svg, flags=re.S)
    svg = re.sub(r' xmlns(:xlink)?="[^"]*"', "", svg).replace("xlink:href",
                                                             "href")
    for before in ('id="', 'href="#', "url(#"):
        svg = svg.replace(before, before + prefix + "-")
    return svg


def save(of_figure, folder, name):
    """Write NAME.svg and NAME.png; returns the paths. The figure is closed."""
    paths = [folder / f"{name}.svg", folder / f"{name}.png"]
    # Fields are images in it, which grow with their resolution.
    of_figure.savefig(paths[0], dpi=110,
                      metadata={"Date": None, "Creator": None})
    of_figure.savefig(paths[1], metadata={"Software": None})
    pyplot.close(of_figure)
    return paths
