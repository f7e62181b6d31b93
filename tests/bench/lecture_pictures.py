#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""The pictures of the lecture (doc/lecture): paths of four methods on the point mass,
from runs of prm/point-mass.prm, and drawings of the contact search. Ranges and labels
are for the numbers of the shipped scene only; `abut draw` draws paths of other
numbers.

    tests/bench/lecture_pictures.py build/release/abut [--folder doc/pictures]"""
import sys

import numpy
from matplotlib import patches

import pictures
from pictures import arrow, bare, style

# The point mass: k u = f - p, gap 1 - u.
SHIPPED = {"Masses/Stiffness": 1, "Masses/Force": 3, "Constraints/Initial gap": 1}
STIFFNESS, FORCE, HEIGHT = (float(value) for value in SHIPPED.values())
# Displacements that are drawn.
RANGES = {"augmented lagrangian": (0.55, 2.2), "quadratic penalty": (0.55, 2.2),
          "barrier": (0.6, 1.3), "interior point": (0.99, 1.003)}
METHODS = {
    "augmented lagrangian": ["Method/Penalty factor=1", "Method/Adaptive penalty=false",
                             "Method/Gap tolerance=1e-8",
                             "Method/Pressure tolerance=1e-8"],
    "quadratic penalty": ["Method/Penalty growth=4"],
    "barrier": ["Method/Barrier start=0.2", "Method/Barrier factor=0.25",
                "Masses/Start=0"],
    "interior point": [],
}


def path(abut, folder, method, settings):
    """Rows (u, p, penalty, barrier) of the outer steps of a run."""
    given = pictures.run(abut, "point-mass.prm", folder,
                         f"Method/Enforcement={method}", *settings)
    table = given.table("levels.csv")
    for name, value in SHIPPED.items():
        if given.numbers(name) != [value]:
            sys.exit(f"prm/point-mass.prm has {name} = {given.parameter(name)}: "
                     f"these pictures are for {value} only.")
    return list(zip(*(table[name] for name in ("u", "p", "penalty",
                                               "barrier"))))


def laws(axes, method, rows, u):
    """The law of each outer step as a curve p(u)."""
    last = 0.0
    for i, (at, pressure, penalty, barrier) in enumerate(rows[:6]):
        look = {"color": style.SKY, "linewidth": 0.8, "zorder": 1}
        if method == "augmented lagrangian":
            curve = numpy.maximum(last + penalty * (u - HEIGHT), 0)
            last = pressure
        elif method == "quadratic penalty":
            curve = numpy.maximum(pressure / max(at - HEIGHT, 1e-30)
                                  * (u - HEIGHT), 0)
        else:
            if not barrier:
                continue
            with numpy.errstate(divide="ignore", invalid="ignore"):
                curve = numpy.where(u < HEIGHT, pressure * (HEIGHT - at)
                                    / (HEIGHT - u), numpy.nan)
        axes.plot(u, curve, **look,
                  label="law of each step" if i == 0 else None)


def draw_paths(paths, folder):
    figure, axes = style.figure(style.PAGE, 0.29, 2, 2)
    for letter, one, (method, rows) in zip("abcd", axes.flat, paths.items()):
        low, high = RANGES[method]
        u = numpy.linspace(low, high, 1200)
        one.axvspan(HEIGHT, high, color=style.PALE, linewidth=0, zorder=0)
        one.plot(u, FORCE - STIFFNESS * u, color=style.GREY, linestyle="--",
                 label="equilibrium $p = mg - ku$")
        laws(one, method, rows, u)
        one.plot([row[0] for row in rows], [row[1] for row in rows], "o-",
                 color=style.VERMILION, linewidth=0.7, label="iterates")
        one.plot([HEIGHT], [FORCE - STIFFNESS * HEIGHT], "*", markersize=9,
                 color=style.BLACK, label="solution", zorder=5)
        one.set_xlim(low, high)
        one.set_ylim(FORCE - high - 0.8 * (high - low), FORCE - low)
        one.set_title(f"({letter}) {method}")
        one.set_xlabel("displacement $u$")
        one.set_ylabel("contact force $p$")
    style.legend_above(figure, axes[0][0].get_legend_handles_labels()[0])
    style.save(figure, folder, "lecture-paths")


def draw_errors(paths, folder):
    figure, [[axes]] = style.figure(style.COLUMN, 0.7)
    exact = FORCE - STIFFNESS * HEIGHT
    for i, (method, rows) in enumerate(paths.items()):
        errors = [abs(row[1] - exact) for row in rows]
        axes.plot(range(1, len(errors) + 1), errors, label=method,
                  **style.curve_style(i))
    style.logarithmic(axes.yaxis)
    style.whole_numbers(axes.xaxis)
    axes.set_xlabel("outer step")
    axes.set_ylabel("error of the contact force $|p - 2|$")
    style.legend(axes)
    style.save(figure, folder, "lecture-errors")


def surfaces():
    """A primary line with facets of graded size, and nodes above it."""
    x = numpy.cumsum([0] + [0.08 * 1.13 ** i for i in range(24)])
    x = x / x[-1] * 6
    y = 0.25 * numpy.sin(1.1 * x)
    nodes = numpy.linspace(0.15, 5.8, 19)
    return x, y, nodes, 0.25 * numpy.sin(1.1 * nodes) + 0.15


def draw_buckets(folder):
    figure, axes = style.figure(style.PAGE, 0.27, 3, 1)
    x, y, node_x, node_y = surfaces()
    size, reach = 0.75, 0.2
    for one, title in zip(axes.flat, ("all pairs", "grid cells of one size",
                                      "adaptive buckets")):
        bare(one, (-0.1, 6.1), (-0.78, 0.78))
        picked = 2
        near = numpy.ones(len(x) - 1, bool)
        if title.startswith("grid"):
            for cell in numpy.arange(0, 6, size):
                for row in (-0.75, 0.0):
                    one.add_patch(patches.Rectangle(
                        (cell, row), size, size, fill=False, linewidth=0.5,
                        edgecolor=style.GREY))
            cell = numpy.floor(node_x[picked] / size)
            one.add_patch(patches.Rectangle(
                ((cell - 1) * size, -0.75), 3 * size, 2 * size, linewidth=0,
                facecolor=style.YELLOW, alpha=0.5))
            middle = (x[1:] + x[:-1]) / 2
            near = abs(numpy.floor(middle / size) - cell) <= 1
        elif title.startswith("adaptive"):
            near[:] = False
            for first in range(0, len(x) - 1, 4):
                last = min(first + 4, len(x) - 1)
                low, high = y[first:last + 1].min(), y[first:last + 1].max()
                hit = (x[first] - reach <= node_x[picked] <= x[last] + reach
                       and node_y[picked] <= high + reach)
                near[first:last] |= hit
                one.add_patch(patches.Rectangle(
                    (x[first], low - 0.05), x[last] - x[first], high - low + 0.1,
                    linewidth=0.6, edgecolor=style.GREY,
                    facecolor=style.YELLOW if hit else "none",
                    alpha=0.5 if hit else 1))
        for i in range(len(x) - 1):
            one.plot(x[i:i + 2], y[i:i + 2], color=style.BLUE if near[i]
                     else style.GREY, linewidth=2 if near[i] else 1,
                     marker="|", markersize=5)
            if near[i]:
                one.plot([node_x[picked], (x[i] + x[i + 1]) / 2],
                         [node_y[picked], (y[i] + y[i + 1]) / 2],
                         color=style.SKY, linewidth=0.4)
        one.plot(node_x, node_y, "o", color=style.GREY)
        one.plot(node_x[picked], node_y[picked], "o", color=style.VERMILION,
                 markersize=5)
        one.set_title(f"{title}: {near.sum()} of {len(near)} facets are tested")
    style.save(figure, folder, "lecture-buckets")


def draw_detection(folder):
    figure, axes = style.figure(style.PAGE, 0.29, 1, 3)
    radii, projection, ranking = axes.flat
    # Steps 6, 10 and 11.
    bare(radii, (-1.3, 3.3), (-1.4, 2.3))
    radii.set_title("steps 6, 10, 11: radii")
    node, centre = numpy.array([0.2, 1.0]), numpy.array([1.9, 0.0])
    radii.plot([1.1, 2.7], [0.1, -0.1], color=style.BLUE, linewidth=2.5,
               marker="|", markersize=8)
    for at, radius, colour, name, turn in (
            (node, 1.1, style.VERMILION, "$R_r$", 2.2),
            (centre, 0.85, style.BLUE, "$R_s$", -1.0)):
        radii.add_patch(patches.Circle(at, radius, fill=False, linestyle="--",
                                       edgecolor=colour, linewidth=0.9))
        rim = at + radius * numpy.array([numpy.cos(turn), numpy.sin(turn)])
        arrow(radii, at, rim, colour, linewidth=0.8, shrink=2)
        radii.text(*((at + rim) / 2 + [0.08, 0.08]), name, color=colour)
    radii.plot(*zip(node, centre), color=style.GREY, linewidth=0.8)
    radii.text(1.35, 0.5, "$d_{rs}$", color=style.GREY)
    radii.plot(*node, "o", color=style.VERMILION, markersize=5)
    radii.plot(*centre, "x", color=style.BLUE, markersize=5)
    radii.text(1.0, -1.3, "candidate if $d_{rs} \\leq R_r + R_s$", ha="center")
    # Steps 12 and 13.
    bare(projection, (-1.7, 2.9), (-1.4, 2.3))
    projection.set_title("steps 12, 13: projection and cost")
    projection.plot([-1, 1.2], [0, 0], color=style.BLUE, linewidth=2.5,
                    marker="|", markersize=8)
    projection.text(-1, -0.38, "$\\xi = -1$", ha="center", fontsize=7)
    projection.text(1.2, -0.38, "$\\xi = 1$", ha="center", fontsize=7)
    for at, foot in (((-0.2, 1.3), (-0.2, 0)), ((1.9, 1.3), (1.9, 0))):
        projection.plot(*zip(at, foot), color=style.VERMILION, linewidth=0.9,
                        linestyle="--")
        projection.plot(*at, "o", color=style.VERMILION, markersize=5)
    projection.plot([1.2, 1.9], [0, 0], color=style.ORANGE, linewidth=1.5)
    projection.plot([1.9, 1.2], [1.3, 0], color=style.GREY, linewidth=0.9)
    projection.text(-0.1, 0.6, "gap $g$", color=style.VERMILION)
    projection.text(2.0, 0.6, "$g$", color=style.VERMILION)
    projection.text(1.62, -0.33, "violation $v$", color=style.ORANGE, ha="left",
                    fontsize=7)
    projection.text(0.75, 0.75, "cost", color=style.GREY)
    projection.text(0.6, -1.3, "cost$^2$ = $g^2 + v^2$", ha="center")
    # Step 14.
    bare(ranking, (-1.7, 2.9), (-1.4, 2.3))
    ranking.set_title("step 14: ranking")
    corner = [(-1.4, 0.1), (-0.2, -0.4), (1.1, 0.1), (2.4, 0.2)]
    node = numpy.array([0.3, 1.3])
    best = None
    for i, (a, b) in enumerate(zip(corner, corner[1:])):
        a, b = numpy.array(a), numpy.array(b)
        s = numpy.clip((node - a) @ (b - a) / ((b - a) @ (b - a)), 0, 1)
        foot = a + s * (b - a)
        cost = numpy.linalg.norm(node - foot)
        if best is None or cost < best[0]:
            best = cost, i, foot
    for i, (a, b) in enumerate(zip(corner, corner[1:])):
        ranking.plot(*zip(a, b), linewidth=2.5, marker="|", markersize=8,
                     color=style.GREEN if i == best[1] else style.GREY)
        a, b = numpy.array(a), numpy.array(b)
        s = numpy.clip((node - a) @ (b - a) / ((b - a) @ (b - a)), 0, 1)
        foot = a + s * (b - a)
        ranking.plot(*zip(node, foot), linewidth=0.9,
                     linestyle="-" if i == best[1] else "--",
                     color=style.GREEN if i == best[1] else style.GREY)
        place = {0: (-0.75, 0.5), 1: (-0.08, 0.2), 2: (0.85, 0.75)}[i]
        ranking.text(*place, f"{numpy.linalg.norm(node - foot):.2f}", fontsize=7,
                     color=style.GREEN if i == best[1] else style.GREY)
    ranking.plot(*node, "o", color=style.VERMILION, markersize=5)
    ranking.text(0.6, -1.3, "the cheapest facet is the partner", ha="center")
    style.letters(axes.flat)
    style.save(figure, folder, "lecture-detection")


def draw_sliding(folder):
    figure, axes = style.figure(style.PAGE, 0.2, 1, 2)
    for one, large in zip(axes.flat, (False, True)):
        bare(one, (-0.5, 5.5), (-0.6, 1.9))
        one.set_title("large deformation: search again, new partner" if large
                      else "small deformation: the partner stays")
        one.plot([0, 1.25, 2.5, 3.75, 5], [0.2, 0, 0, 0.2, 0.5],
                 color=style.BLUE, marker="|", markersize=8, linewidth=2)
        facet = ([2.5, 3.75], [0, 0.2]) if large else ([0, 1.25], [0.2, 0])
        one.plot(*facet, color=style.GREEN, linewidth=3.5)
        one.plot([0.7, 3.0], [0.9, 0.7], "o", color=style.VERMILION,
                 markersize=5)
        one.annotate("", (2.9, 0.72), (0.8, 0.9), arrowprops={
            "arrowstyle": "->", "color": style.VERMILION, "linestyle": "--",
            "lw": 0.9})
        one.text(1.9, 1.0, "$u$", color=style.VERMILION, ha="center")
        if large:
            one.plot([3.0, 3.08], [0.7, 0.09], color=style.GREY, linewidth=0.9)
            one.text(3.15, 0.4, "$g(u)$", color=style.GREY)
        else:
            one.plot([-0.3, 4.0], [0.24, -0.448], color=style.GREEN,
                     linestyle=":", linewidth=1)
            one.plot([3.0, 2.84], [0.7, -0.26], color=style.GREY, linewidth=0.9)
            one.text(3.1, 0.55, "$g_0 + B u$", color=style.GREY)
    style.letters(axes.flat)
    style.save(figure, folder, "lecture-sliding")


def draw(abut, folder):
    paths = {method: path(abut, folder / "run", method, how)
             for method, how in METHODS.items()}
    draw_paths(paths, folder)
    draw_errors(paths, folder)
    for each in (draw_buckets, draw_detection, draw_sliding):
        each(folder)


if __name__ == "__main__":
    pictures.main(__doc__, draw)
