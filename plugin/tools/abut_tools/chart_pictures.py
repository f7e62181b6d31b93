# SPDX-License-Identifier: LGPL-2.1-or-later
"""Pictures of a chart: errors and times over costs and parameters."""
import math
from typing import NamedTuple

import numpy

from . import labels, style
from .errors import warn

# Parameters of scenes along an axis, in words.
AXES = {"Refinement/Level": "level of the mesh",
        "Refinement/Adaptive cycles": "adaptive cycles",
        "Refinement/Target error": "target of the relative error",
        "Method/Penalty": "penalty", "Method/Penalty factor": "penalty",
        "Method/Barrier end": "barrier end",
        "Search/Bucket size": "edge of a bucket / median facet"}


class Axes(NamedTuple):
    """One picture: what is drawn over what."""
    x: str
    y: str
    x_label: str
    y_label: str
    front: str = ""  # of the rows on the Pareto front


def error_label(chart):
    if chart.error_label:
        return chart.error_label
    relative = "relative " if chart.scale > 0 or not chart.is_error else ""
    of = "" if chart.is_error else "error of the "
    return relative + of + labels.words(chart.quantity)


def axis_words(curve):
    return ", ".join(dict.fromkeys(
        AXES.get(path, path.split("/")[-1].lower()) for path in curve.axis))


def axis_label(chart):
    if chart.axis_label or chart.axis_quantity:
        return chart.axis_label or labels.label(chart.axis_quantity)
    names = set(map(axis_words, chart.curves))
    return names.pop() if len(names) == 1 else "parameter"


def all_axes(chart):
    """The pictures that a chart may have, by name."""
    error, time = error_label(chart), labels.label(chart.time)
    axis = axis_label(chart)
    return {
        "error-time": Axes("time", "error", time, error, "time_front"),
        "error-work": Axes("matvecs", "error",
                           "matrix-vector products, on all meshes", error,
                           "work_front"),
        "error-axis": Axes("x", "error", axis, error),
        "time-axis": Axes("x", "time", axis, time),
        "memory-axis": Axes("x", "peak_memory_mb", axis,
                            labels.label("peak_memory_mb"))}


def is_wide(values, factor):
    """Whether values are all positive and differ by more than a factor."""
    values = values[numpy.isfinite(values)]
    return values.size > 0 and values.min() > 0 and (
        values.max() > factor * values.min())


class ChartPicture:
    def __init__(self, chart, rows, axes):
        self._chart, self._axes = chart, axes
        self._rows = [row for row in rows if row.ok]
        # Factorised systems take no products, which no logarithm can show.
        self.n_left_out = 0
        if axes.x == "matvecs":
            shown = [row for row in self._rows if row.matvecs > 0]
            self.n_left_out = len(self._rows) - len(shown)
            self._rows = shown
        self._log = is_wide(self._points(self._rows)[:, 0], 20.)

    def _points(self, rows):
        """Rows x, y; what a logarithm cannot show is a gap."""
        points = numpy.array([(getattr(row, self._axes.x),
                               getattr(row, self._axes.y)) for row in rows],
                             dtype=float).reshape(-1, 2)
        points[~(points[:, 1] > 0), 1] = math.nan
        return points

    def curves(self):
        """Number, label and points of each curve that has any."""
        several = len(set(map(axis_words, self._chart.curves))) > 1
        with_axis = (several and self._axes.x == "x"
                     and not self._chart.axis_quantity)
        for number, curve in enumerate(self._chart.curves):
            points = self._points([row for row in self._rows
                                   if row.curve == number])
            if numpy.isfinite(points.sum(axis=1)).any():
                yield number, curve.name + (
                    f" ({axis_words(curve)})" if with_axis else ""), points

    def draw(self, folder, name):
        """False where there is nothing to draw."""
        curves = list(self.curves())
        if not curves:
            return False
        figure, (row,) = style.figure(style.PAGE, 0.48)
        axes = row[0]
        self._draw_front(axes)
        for number, label, points in curves:
            style.named(axes.plot(*points.T, label=label,
                                  **style.curve_style(number))[0],
                        f"curve {number}")
        axes.set_xlabel(self._axes.x_label)
        axes.set_ylabel(self._axes.y_label)
        axes.set_title(self._chart.title, loc="left")
        style.logarithmic(axes.yaxis)
        if self._log:
            style.logarithmic(axes.xaxis)
            self._draw_slope(axes, [points for _, _, points in curves])
        elif all(x == int(x) for _, _, points in curves
                 for x in points[:, 0] if math.isfinite(x)):
            style.whole_numbers(axes.xaxis)
        if self.n_left_out:
            axes.text(1, 1, "factorised, without products, and not shown: "
                      f"{self.n_left_out}", transform=axes.transAxes,
                      ha="right", va="bottom", fontsize=7, color=style.GREY)
        axes.legend(loc="upper left", bbox_to_anchor=(1.01, 1.0),
                    borderaxespad=0.)
        style.save(figure, folder, name)
        return True

    def _draw_front(self, axes):
        """The steps below which no run lies, and rings on the runs of the
        Pareto front."""
        if not self._axes.front:
            return
        front = self._points([row for row in self._rows
                              if getattr(row, self._axes.front)])
        front = front[numpy.argsort(front[:, 0])]
        if not len(front):
            return
        axes.step(*front.T, where="post", color="#d0d0d0", linewidth=4,
                  zorder=1)
        style.named(axes.plot(*front.T, linestyle="", marker="o", markersize=7,
                              markerfacecolor="none", zorder=4,
                              markeredgecolor=style.BLACK,
                              label="Pareto front")[0], "front")

    def _draw_slope(self, axes, curves):
        """A triangle of the order that most curves have at their end, if they
        agree."""
        slopes = []
        for points in curves:
            points = points[numpy.isfinite(points.sum(axis=1))]
            if len(points) > 1 and points[-1, 0] != points[-2, 0]:
                (x, y), (next_x, next_y) = numpy.log(points[-2:])
                slopes.append((next_y - y) / (next_x - x))
        if not slopes:
            return
        slope = round(2 * float(numpy.median(slopes))) / 2
        near = sum(abs(each - slope) <= 0.25 for each in slopes)
        if slope == 0 or 2 * near < len(slopes):
            return
        # In the corner that falling or rising curves leave empty.
        width = 2.
        (left, right), (low, high) = axes.get_xlim(), axes.get_ylim()
        across, up = math.log(right / left), math.log(high / low)
        x = left * math.exp(across * (0.06 if slope < 0 else 0.94)) / (
            1 if slope < 0 else width)
        height = width ** abs(slope)
        y = low * math.exp(0.06 * up) * (height if slope < 0 else 1.)
        style.slope_triangle(axes, x, y, slope, width)


def draw_chart(folder, chart, rows):
    """The pictures that the chart asks for."""
    for name, axes in all_axes(chart).items():
        if name in chart.pictures:
            if not ChartPicture(chart, rows, axes).draw(folder, name):
                warn(f"picture {name} was not drawn: no run has both "
                     f"{axes.x_label} and {axes.y_label}.")
