#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""The pictures of the tutorials (doc/tutorials): sketches of the problems, and
results of the scenes that are printed in the pages.

    tests/bench/tutorial_pictures.py build/release/abut [--folder doc/pictures]
        [--page block]"""
import argparse
import base64
import csv
import io
import json
import math
import pathlib
import re
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path[:0] = [str(ROOT / "plugin/tools"), str(ROOT / "tests/docs")]

import numpy  # noqa: E402
from matplotlib import patches  # noqa: E402
from PIL import Image  # noqa: E402

import run_page  # noqa: E402
from abut_tools import style  # noqa: E402

BODY, OTHER, LOAD, SUPPORT = "#dfe9f3", "#f6ead8", style.VERMILION, "#404040"


def scenes(page, folder):
    """Write the scenes of a page into the folder."""
    text = (ROOT / f"doc/tutorials/{page}.md").read_text(encoding="utf-8")
    for _, intent, _, name, body in run_page.steps(text):
        if intent == "check" and name:
            (folder / name).write_text(body, encoding="utf-8")


def fewer_colours(image):
    """An image in an SVG with a palette of 128 colours, which is a fifth as large."""
    file = io.BytesIO()
    Image.open(io.BytesIO(base64.b64decode(image[0]))).quantize(128).save(
        file, "png", optimize=True)
    return base64.b64encode(file.getvalue()).decode()


class Runs:
    """Runs of the scenes of a page."""

    def __init__(self, abut, page, folder):
        self.abut, self.folder = abut, folder
        scenes(page, folder)

    def run(self, scene, output, *settings):
        command = [self.abut, "run", f"{scene}.prm", "--quiet", "--output", output]
        for setting in settings:
            command += ["--set", setting]
        subprocess.run(command, cwd=self.folder, check=True)
        return self.folder / output

    def draw(self, run, picture, name, to):
        subprocess.run([self.abut, "draw", run, "--picture", picture], check=True,
                       stdout=subprocess.DEVNULL)
        text = (run / f"{picture}.svg").read_text(encoding="utf-8")
        text = re.sub(r"(?<=data:image/png;base64,)[^\"]+", fewer_colours, text)
        # Lines to a hundredth of a point.
        text = re.sub(r' d="[^"]+', lambda path: re.sub(r"(\.\d\d)\d+", r"\1",
                                                      path[0]), text)
        (to / f"{name}.svg").write_text(text, encoding="utf-8")


def table(path):
    with open(path, encoding="utf-8") as file:
        return list(csv.DictReader(file))


def summary(run):
    return json.loads((run / "summary.json").read_text(encoding="utf-8"))


# Sketches: lengths are those of the scene, `s` the length of a symbol.

def sheet(width, x, y):
    """Axes without frame that show x[0] to x[1] and y[0] to y[1]."""
    figure, ((axes,),) = style.figure(width, (y[1] - y[0]) / (x[1] - x[0]))
    axes.set_aspect("equal")
    axes.set_xlim(*x)
    axes.set_ylim(*y)
    axes.axis("off")
    return figure, axes


def arrow(axes, begin, end, colour=LOAD):
    axes.annotate("", end, begin, arrowprops={
        "arrowstyle": "-|>", "color": colour, "linewidth": 0.9,
        "shrinkA": 0, "shrinkB": 0, "mutation_scale": 7})


def dimension(axes, begin, end, text, offset):
    """A dimension line with its text `offset` from the middle."""
    axes.annotate("", end, begin, arrowprops={
        "arrowstyle": "<|-|>", "color": style.GREY, "linewidth": 0.6,
        "shrinkA": 0, "shrinkB": 0, "mutation_scale": 5})
    axes.text((begin[0] + end[0]) / 2 + offset[0], (begin[1] + end[1]) / 2 + offset[1],
              text, ha="center", va="center", color="#505050")


def label(axes, at, text, **more):
    axes.text(*at, text, ha="center", va="center", **more)


def boundary(axes, at, number):
    """The id of a boundary in a circle."""
    axes.text(*at, str(number), ha="center", va="center", fontsize=7,
              bbox={"boxstyle": "circle,pad=0.2", "facecolor": "white",
                    "edgecolor": SUPPORT, "linewidth": 0.6})


def hatch(axes, left, right, y, depth):
    """Ground below the line y."""
    axes.add_patch(patches.Rectangle((left, y - depth), right - left, depth,
                                     facecolor="none", edgecolor=style.GREY,
                                     hatch="//////", linewidth=0))
    axes.plot([left, right], [y, y], color=style.BLACK, linewidth=1.4)


def rollers(axes, x, ys, s):
    """Supports at the left that leave the motion along y."""
    for y in ys:
        axes.add_patch(patches.Polygon([(x, y), (x - s, y - 0.6 * s),
                                        (x - s, y + 0.6 * s)], closed=True,
                                       facecolor="white", edgecolor=SUPPORT,
                                       linewidth=0.8))
        for part in (-0.35, 0.35):
            axes.add_patch(patches.Circle((x - 1.22 * s, y + part * s), 0.2 * s,
                                          facecolor="white", edgecolor=SUPPORT,
                                          linewidth=0.8))
    axes.plot([x - 1.45 * s] * 2, [min(ys) - s, max(ys) + s], color=SUPPORT,
              linewidth=1)


def pressure(axes, left, right, y, s, n=9):
    for x in numpy.linspace(left, right, n):
        arrow(axes, (x, y + s), (x, y))
    axes.plot([left, right], [y + s] * 2, color=LOAD, linewidth=0.8)


def sketch_block(folder):
    figure, axes = sheet(120, (-52, 262), (-34, 146))
    axes.add_patch(patches.Rectangle((0, 0), 200, 100, facecolor=BODY,
                                     edgecolor=style.BLACK, linewidth=1))
    hatch(axes, -30, 232, 0, 10)
    rollers(axes, 0, (20, 50, 80), 11)
    pressure(axes, 0, 200, 101, 18)
    label(axes, (100, 128), "pressure 100 N/mm²", color=LOAD)
    label(axes, (100, 58), "block\n$E$ = 210000 N/mm², $\\nu$ = 0.3")
    label(axes, (100, -18), "rigid plane: obstacle 1")
    for at, number in (((14, 35), 0), ((186, 35), 1), ((100, 11), 2),
                       ((100, 89), 3)):
        boundary(axes, at, number)
    dimension(axes, (214, 0), (214, 100), "100 mm", (22, 0))
    dimension(axes, (0, -27), (200, -27), "200 mm", (0, -4.5))
    arrow(axes, (-44, -26), (-20, -26), style.BLACK)
    arrow(axes, (-44, -26), (-44, -2), style.BLACK)
    label(axes, (-15, -26), "$x$")
    label(axes, (-44, 3), "$y$")
    style.save(figure, folder, "tutorial-block-setup")


def sketch_roller(folder):
    figure, axes = sheet(110, (-5.2, 14.2), (-1.7, 14.3))
    axes.add_patch(patches.Wedge((0, 10), 10, 270, 360, facecolor=BODY,
                                 edgecolor=style.BLACK, linewidth=1))
    axes.add_patch(patches.Arc((0, 10), 20, 20, theta1=180, theta2=270,
                               edgecolor=style.GREY, linewidth=0.7,
                               linestyle=(0, (5, 3))))
    hatch(axes, -5.2, 12.5, 0, 0.7)
    rollers(axes, 0, (3.2, 6, 8.8), 0.75)
    pressure(axes, 0, 10, 10.1, 1.4)
    label(axes, (5, 12.4), "$P/2$ as pressure 50 N/mm²", color=LOAD)
    label(axes, (5.4, 8), "quarter of the roller\n$E$ = 210000 N/mm², $\\nu$ = 0.3")
    label(axes, (9.4, -1.2), "rigid plane: obstacle 1")
    for at, number in (((6.2, 3.2), 0), ((0.65, 4.6), 1), ((2, 9.35), 2)):
        boundary(axes, at, number)
    dimension(axes, (0, 10), (10 * math.cos(-1.2), 10 + 10 * math.sin(-1.2)),
              "$R$ = 10 mm", (2.6, 0.4))
    style.save(figure, folder, "tutorial-hertz-setup")


def sketch_pulled(folder):
    figure, axes = sheet(110, (-14.5, 14.5), (-12.8, 14.6))
    axes.add_patch(patches.Rectangle((-10, -10), 20, 10, facecolor=BODY,
                                     edgecolor=style.BLACK, linewidth=1))
    axes.add_patch(patches.Wedge((0, 10), 10, 180, 360, facecolor=OTHER,
                                 edgecolor=style.BLACK, linewidth=1))
    hatch(axes, -12, 12, -10, 1)
    for x in numpy.linspace(-9, 9, 7):
        arrow(axes, (x, 12.2), (x, 10.2))
    label(axes, (-6.4, 13.4), "down 0.03 mm, $t \\leq 1$", color=LOAD)
    arrow(axes, (1.2, 13.4), (4.2, 13.4))
    label(axes, (9.3, 13.4), "aside 0.01 mm, $t > 1$", color=LOAD)
    label(axes, (0, 6.2), "roller, $R$ = 10 mm")
    label(axes, (0, -4.7), "block, 20 mm by 10 mm")
    label(axes, (9.2, 1.6), "friction $\\mu$ = 0.3")
    for at, number in (((0, 8.9), 1), ((-6, 3.6), 0), ((-6, -1.2), 3), ((-6, -8.8), 2)):
        boundary(axes, at, number)
    label(axes, (0, -12), "fixed", color=SUPPORT)
    style.save(figure, folder, "tutorial-friction-setup")


def sketch_die(folder):
    figure, axes = sheet(150, (-1.2, 13.2), (-1.1, 6.4))
    axes.add_patch(patches.Rectangle((0, 0), 12, 3, facecolor=BODY,
                                     edgecolor=style.BLACK, linewidth=1))
    axes.add_patch(patches.Wedge((3, 4.5), 1.5, 180, 360, facecolor=OTHER,
                                 edgecolor=style.BLACK, linewidth=1))
    axes.add_patch(patches.Arc((9, 3.9), 3, 3, theta1=180, theta2=360,
                               edgecolor=style.GREY, linewidth=0.7,
                               linestyle=(0, (5, 3))))
    axes.plot([7.5, 10.5], [3.9] * 2, color=style.GREY, linewidth=0.7,
              linestyle=(0, (5, 3)))
    hatch(axes, -0.5, 12.5, 0, 0.35)
    for x in (2, 3, 4):
        arrow(axes, (x, 5.3), (x, 4.6))
    label(axes, (2.6, 5.9), "1. down 0.6 mm", color=LOAD)
    arrow(axes, (4.9, 4.5), (6.6, 4.5))
    label(axes, (5.8, 5.1), "2. aside 6 mm", color=LOAD)
    label(axes, (2.9, 3.9), "die")
    label(axes, (9.2, 5.9), "die: $R$ = 1.5 mm, $E$ = 7000 N/mm²")
    label(axes, (7, 1.3), "block, 12 mm by 3 mm, $E$ = 700 N/mm², $\\nu$ = 0.32\n"
                          "friction $\\mu$ = 0.3")
    for at, number in (((3.7, 4.25), 1), ((2.05, 3.75), 0), ((0.8, 2.65), 3),
                       ((0.8, 0.35), 2)):
        boundary(axes, at, number)
    label(axes, (6, -0.75), "fixed", color=SUPPORT)
    style.save(figure, folder, "tutorial-ironing-setup")


def block(runs, folder):
    sketch_block(folder)
    runs.draw(runs.run("block", "block"), "bodies", "tutorial-block", folder)


def profile_error(run, half_width, largest):
    """Size of the first facet relative to the half width, and the error of the
    pressure in the mean square, as errors.py of the page computes it."""
    rows = table(run / "pair_1.csv")
    x = numpy.array([float(row["x"]) for row in rows])
    p = numpy.array([float(row["pressure"]) for row in rows])
    square = whole = 0
    for s in (0.1, 0.3, 0.5, 0.7, 0.9):
        at = x[:-1] + s * numpy.diff(x)
        exact = largest * numpy.sqrt(numpy.maximum(0, 1 - (at / half_width)**2))
        square += ((p[:-1] + s * numpy.diff(p) - exact)**2 * numpy.diff(x)).sum()
        whole += (exact**2 * numpy.diff(x)).sum()
    return (x[1] - x[0]) / half_width, math.sqrt(square / whole)


def hertz(runs, folder):
    sketch_roller(folder)
    run = runs.run("roller", "roller")
    runs.draw(run, "bodies", "tutorial-hertz-bodies", folder)
    runs.draw(run, "tractions", "tutorial-hertz-pressure", folder)
    half_width, largest = 0.234891, 2710.28
    series = {"adaptive": [("Refinement/Adaptive cycles", n) for n in range(4, 8)],
              "uniform": [("Refinement/Level", n) for n in range(5, 8)]}
    figure, ((left, right),) = style.figure(style.PAGE, 0.36, 1, 2)
    handles = []
    for i, (name, meshes) in enumerate(series.items()):
        points = []
        for parameter, number in meshes:
            settings = [f"{parameter}={number}"]
            if name == "uniform":
                settings.append("Refinement/Adaptive cycles=0")
            one = runs.run("roller", f"{name}-{number}", *settings)
            results = summary(one)
            h, profile = profile_error(one, half_width, largest)
            points.append((h, profile, results["dofs"],
                           abs(results["pair_1_contact_area"] / half_width - 1)))
        h, profile, unknowns, width = numpy.array(points).T
        look = style.curve_style(i)
        handles += left.plot(h, profile, label=f"profile, {name}", **look)
        handles += left.plot(h, width, label=f"width, {name}", markerfacecolor="white",
                             **(look | {"linestyle": ":"}))
        right.plot(unknowns, profile, **look)
    style.slope_triangle(left, 0.25, 0.012, 1)
    left.set_xlabel("facet / half width $h/a$")
    right.set_xlabel("unknowns")
    for axes in (left, right):
        axes.set_ylabel("relative error")
        style.logarithmic(axes.xaxis)
        style.logarithmic(axes.yaxis)
    right.set_ylabel("relative error of the profile")
    style.letters((left, right))
    style.legend_above(figure, handles, 4)
    style.save(figure, folder, "tutorial-hertz-error")


def stick(run, coefficient):
    """Q/(mu P), and |x| of the last sticking and the first slipping node relative
    to the half width of the contact."""
    pull, press = (abs(force) for force in summary(run)["pair_1_force"])
    half_width = math.sqrt(4 * press * 10 / (math.pi * 210000 / (2 * (1 - 0.3**2))))
    points = [(abs(float(row["x"])) / half_width, row["status"])
              for row in table(run / "pair_1.csv") if float(row["pressure"]) > 0]
    return (pull / (coefficient * press),
            max((x for x, status in points if status == "1"), default=0),
            min((x for x, status in points if status == "2"), default=1))


def friction(runs, folder):
    sketch_pulled(folder)
    run = runs.run("pulled", "pulled")
    runs.draw(run, "tractions", "tutorial-friction-tractions", folder)
    points = [stick(run, 0.3)] + [
        stick(runs.run("pulled", f"end-{end}", f"Time stepping/End time={end}",
                       f"Time stepping/Number of steps={steps}"), 0.3)
        for end, steps in ((1.25, 5), (1.5, 3), (2, 2))] + [
        stick(runs.run("pulled", f"mu-{mu}", f"Pair 1/Friction=(t > 1 ? {mu} : 0)"), mu)
        for mu in (0.25, 0.22, 0.2)]
    pull, low, high = numpy.array(points).T
    figure, ((axes,),) = style.figure(style.COLUMN, 0.72)
    at = numpy.linspace(0, 1, 400)
    axes.plot(at, numpy.sqrt(1 - at), color=style.BLACK,
              label=r"$c/a = \sqrt{1 - Q/(\mu P)}$")
    axes.errorbar(pull, (low + high) / 2, (high - low) / 2, color=style.VERMILION,
                  linestyle="", marker="", capsize=2.5, elinewidth=1.2, label="Abut")
    axes.set_xlabel(r"pull / limit $Q/(\mu P)$")
    axes.set_ylabel("stick / contact $c/a$")
    axes.set_ylim(0, 1.05)
    style.legend(axes)
    style.save(figure, folder, "tutorial-friction-stick")


def ironing(runs, folder):
    sketch_die(folder)
    run = runs.run("die", "die", "Time stepping/Number of steps=80")
    runs.draw(run, "bodies", "tutorial-ironing-bodies", folder)
    coarse = runs.run("die", "coarse", "Time stepping/Number of steps=10")
    figure, ((axes,),) = style.figure(style.PAGE, 0.42)
    for i, (name, column, sign) in enumerate((("vertical $V$", "pair_1_force_y", -1),
                                              ("horizontal $H$", "pair_1_force_x", 1))):
        time, force = (numpy.array([0] + [float(row[key]) for row in
                                          table(run / "levels.csv")])
                       for key in ("time", column))
        axes.plot(time, sign * force, color=style.COLOURS[i], label=name)
        if i == 0:
            axes.plot(time, -0.3 * force, color=style.GREY, linestyle="--",
                      label="$0.3\\,V$")
        axes.plot([float(row["time"]) for row in table(coarse / "levels.csv")],
                  [sign * float(row[column]) for row in table(coarse / "levels.csv")],
                  color=style.COLOURS[i], linestyle="", marker=style.MARKERS[i])
    axes.set_xlabel("time $t$")
    axes.set_ylabel("force on the block [N/mm]")
    style.legend(axes)
    style.save(figure, folder, "tutorial-ironing-forces")


PAGES = {each.__name__: each for each in (block, hertz, friction, ironing)}


def main():
    arguments = argparse.ArgumentParser(description=__doc__)
    arguments.add_argument("abut", type=pathlib.Path)
    arguments.add_argument("--folder", type=pathlib.Path, default=ROOT / "doc/pictures")
    arguments.add_argument("--page", choices=PAGES, action="append")
    arguments = arguments.parse_args()
    for page in arguments.page or PAGES:
        with tempfile.TemporaryDirectory() as folder:
            PAGES[page](Runs(arguments.abut.resolve(), page, pathlib.Path(folder)),
                        arguments.folder)
    if arguments.folder.name == "pictures":
        for each in arguments.folder.glob("tutorial-*.png"):
            each.unlink()


if __name__ == "__main__":
    main()
