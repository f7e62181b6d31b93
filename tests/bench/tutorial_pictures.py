#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""The pictures of the tutorials (doc/tutorials): sketches of the problems, and
results of the scenes that are printed in the pages. That of the page deal-ii-program
is made alone, of the file that its program writes.

    tests/bench/tutorial_pictures.py build/release/abut [--folder doc/pictures]
        [--page block ... | --vtk solution-4.vtk]"""
import base64
import functools
import io
import math
import pathlib
import re
import shutil
import subprocess
import sys

import numpy
from matplotlib import patches
from matplotlib.collections import PolyCollection
from PIL import Image

import pictures
from pictures import ROOT, bare, field, style
from abut_tools import geometry

sys.path.insert(0, str(ROOT / "tests/docs"))
import run_page  # noqa: E402

BODY, OTHER, LOAD, SUPPORT = "#dfe9f3", "#f6ead8", style.VERMILION, "#404040"


def fewer_colours(image):
    """An image in an SVG with a palette of 128 colours, which is a fifth as large."""
    file = io.BytesIO()
    Image.open(io.BytesIO(base64.b64decode(image[0]))).quantize(128).save(
        file, "png", optimize=True)
    return base64.b64encode(file.getvalue()).decode()


class Page:
    """Runs of the scenes of a page, and the folder for its pictures."""

    def __init__(self, name, abut, folder):
        self.abut, self.folder, self.work = abut, folder, folder / name
        self.work.mkdir()
        text = (ROOT / f"doc/tutorials/{name}.md").read_text(encoding="utf-8")
        for _, intent, _, file, body in run_page.steps(text):
            if intent in ("check", "show", "compile") and file:
                (self.work / file).write_text(body, encoding="utf-8")

    def run(self, scene, output, *settings, check=True):
        return pictures.run(self.abut, self.work / f"{scene}.prm", self.work / output,
                            *settings, check=check)

    def draw(self, run, picture, name):
        subprocess.run([self.abut, "draw", run.path, "--picture", picture, "--quiet"],
                       check=True)
        text = (run.path / f"{picture}.svg").read_text(encoding="utf-8")
        text = re.sub(r"(?<=data:image/png;base64,)[^\"]+", fewer_colours, text)
        # Lines to a hundredth of a point.
        text = re.sub(r' d="[^"]+', lambda path: re.sub(r"(\.\d\d)\d+", r"\1",
                                                      path[0]), text)
        (self.folder / f"tutorial-{name}.svg").write_text(text, encoding="utf-8")

    def save(self, figure, name):
        style.save(figure, self.folder, f"tutorial-{name}")


# Sketches: lengths are those of the scene, `s` the length of a symbol.

def sheet(width, x, y):
    """Axes without frame that show x[0] to x[1] and y[0] to y[1]."""
    figure, ((axes,),) = style.figure(width, (y[1] - y[0]) / (x[1] - x[0]))
    bare(axes, x, y)
    return figure, axes


arrow = functools.partial(pictures.arrow, colour=LOAD, kind="-|>", head=7)
# Of sketches beside curves.
motion = functools.partial(pictures.arrow, kind="-|>", linewidth=1, shrink=2)
length = functools.partial(pictures.arrow, kind="<->", linewidth=0.7, shrink=2)


def dimension(axes, begin, end, text, offset):
    """A dimension line with its text `offset` from the middle."""
    pictures.arrow(axes, begin, end, style.GREY, "<|-|>", 0.6, head=5)
    axes.text((begin[0] + end[0]) / 2 + offset[0], (begin[1] + end[1]) / 2 + offset[1],
              text, ha="center", va="center", color="#505050")


def label(axes, at, text, **more):
    axes.text(*at, text, ha="center", va="center", **more)


def boundaries(axes, places):
    """The ids of boundaries in circles."""
    for number, at in places.items():
        label(axes, at, str(number), fontsize=7,
              bbox={"boxstyle": "circle,pad=0.2", "facecolor": "white",
                    "edgecolor": SUPPORT, "linewidth": 0.6})


def box(axes, at, width, height, colour=BODY, **more):
    axes.add_patch(patches.Rectangle(at, width, height, facecolor=colour, **{
        "edgecolor": style.BLACK, "linewidth": 0.8, **more}))


def wall(axes, at, width, height):
    box(axes, at, width, height, style.PALE, edgecolor=style.GREY, hatch="////",
        linewidth=0.6)


def ground(axes, left, right, y, depth):
    """Hatched below the line y."""
    box(axes, (left, y - depth), right - left, depth, "none", edgecolor=style.GREY,
        hatch="//////", linewidth=0)
    axes.plot([left, right], [y, y], color=style.BLACK, linewidth=1.4)


def round_body(axes, centre, radius, begin, colour=OTHER):
    """The lower half of a disc from an angle on."""
    axes.add_patch(patches.Wedge(centre, radius, begin, 360, facecolor=colour,
                                 edgecolor=style.BLACK, linewidth=1))


DASHED = {"color": style.GREY, "linewidth": 0.7, "linestyle": (0, (5, 3))}


def dashed_arc(axes, centre, radius, end):
    axes.add_patch(patches.Arc(centre, 2 * radius, 2 * radius, theta1=180, theta2=end,
                               **DASHED))


def circle(axes, at, radius, colour="white", edge=style.BLACK, width=0.6):
    axes.add_patch(patches.Circle(at, radius, facecolor=colour, edgecolor=edge,
                                  linewidth=width))


def rollers(axes, x, ys, s):
    """Supports at the left that leave the motion along y."""
    for y in ys:
        axes.add_patch(patches.Polygon([(x, y), (x - s, y - 0.6 * s),
                                        (x - s, y + 0.6 * s)], closed=True,
                                       facecolor="white", edgecolor=SUPPORT,
                                       linewidth=0.8))
        for part in (-0.35, 0.35):
            circle(axes, (x - 1.22 * s, y + part * s), 0.2 * s, edge=SUPPORT, width=0.8)
    axes.plot([x - 1.45 * s] * 2, [min(ys) - s, max(ys) + s], color=SUPPORT,
              linewidth=1)


def pressure(axes, left, right, y, s, n=9):
    for x in numpy.linspace(left, right, n):
        arrow(axes, (x, y + s), (x, y))
    axes.plot([left, right], [y + s] * 2, color=LOAD, linewidth=0.8)


def sketch_block():
    figure, axes = sheet(120, (-52, 262), (-34, 146))
    box(axes, (0, 0), 200, 100, linewidth=1)
    ground(axes, -30, 232, 0, 10)
    rollers(axes, 0, (20, 50, 80), 11)
    pressure(axes, 0, 200, 101, 18)
    label(axes, (100, 128), "pressure 100 N/mm²", color=LOAD)
    label(axes, (100, 58), "block\n$E$ = 210000 N/mm², $\\nu$ = 0.3")
    label(axes, (100, -18), "rigid plane: obstacle 1")
    boundaries(axes, {0: (14, 35), 1: (186, 35), 2: (100, 11), 3: (100, 89)})
    dimension(axes, (214, 0), (214, 100), "100 mm", (22, 0))
    dimension(axes, (0, -27), (200, -27), "200 mm", (0, -4.5))
    arrow(axes, (-44, -26), (-20, -26), colour=style.BLACK)
    arrow(axes, (-44, -26), (-44, -2), colour=style.BLACK)
    label(axes, (-15, -26), "$x$")
    label(axes, (-44, 3), "$y$")
    return figure


def sketch_roller():
    figure, axes = sheet(110, (-5.2, 14.2), (-1.7, 14.3))
    round_body(axes, (0, 10), 10, 270, BODY)
    dashed_arc(axes, (0, 10), 10, 270)
    ground(axes, -5.2, 12.5, 0, 0.7)
    rollers(axes, 0, (3.2, 6, 8.8), 0.75)
    pressure(axes, 0, 10, 10.1, 1.4)
    label(axes, (5, 12.4), "$P/2$ as pressure 50 N/mm²", color=LOAD)
    label(axes, (5.4, 8), "quarter of the roller\n$E$ = 210000 N/mm², $\\nu$ = 0.3")
    label(axes, (9.4, -1.2), "rigid plane: obstacle 1")
    boundaries(axes, {0: (6.2, 3.2), 1: (0.65, 4.6), 2: (2, 9.35)})
    dimension(axes, (0, 10), (10 * math.cos(-1.2), 10 + 10 * math.sin(-1.2)),
              "$R$ = 10 mm", (2.6, 0.4))
    return figure


def sketch_pulled():
    figure, axes = sheet(110, (-14.5, 14.5), (-12.8, 14.6))
    box(axes, (-10, -10), 20, 10, linewidth=1)
    round_body(axes, (0, 10), 10, 180)
    ground(axes, -12, 12, -10, 1)
    for x in numpy.linspace(-9, 9, 7):
        arrow(axes, (x, 12.2), (x, 10.2))
    label(axes, (-6.4, 13.4), "down 0.03 mm, $t \\leq 1$", color=LOAD)
    arrow(axes, (1.2, 13.4), (4.2, 13.4))
    label(axes, (9.3, 13.4), "aside 0.01 mm, $t > 1$", color=LOAD)
    label(axes, (0, 6.2), "roller, $R$ = 10 mm")
    label(axes, (0, -4.7), "block, 20 mm by 10 mm")
    label(axes, (9.2, 1.6), "friction $\\mu$ = 0.3")
    boundaries(axes, {1: (0, 8.9), 0: (-6, 3.6), 3: (-6, -1.2), 2: (-6, -8.8)})
    label(axes, (0, -12), "fixed", color=SUPPORT)
    return figure


def sketch_die():
    figure, axes = sheet(150, (-1.2, 13.2), (-1.1, 6.4))
    box(axes, (0, 0), 12, 3, linewidth=1)
    round_body(axes, (3, 4.5), 1.5, 180)
    dashed_arc(axes, (9, 3.9), 1.5, 360)
    axes.plot([7.5, 10.5], [3.9] * 2, **DASHED)
    ground(axes, -0.5, 12.5, 0, 0.35)
    for x in (2, 3, 4):
        arrow(axes, (x, 5.3), (x, 4.6))
    label(axes, (2.6, 5.9), "1. down 0.6 mm", color=LOAD)
    arrow(axes, (4.9, 4.5), (6.6, 4.5))
    label(axes, (5.8, 5.1), "2. aside 6 mm", color=LOAD)
    label(axes, (2.9, 3.9), "die")
    label(axes, (9.2, 5.9), "die: $R$ = 1.5 mm, $E$ = 7000 N/mm²")
    label(axes, (7, 1.3), "block, 12 mm by 3 mm, $E$ = 700 N/mm², $\\nu$ = 0.32\n"
                          "friction $\\mu$ = 0.3")
    boundaries(axes, {1: (3.7, 4.25), 0: (2.05, 3.75), 3: (0.8, 2.65), 2: (0.8, 0.35)})
    label(axes, (6, -0.75), "fixed", color=SUPPORT)
    return figure


def sketch_impact():
    figure, [(left, right)] = style.figure(style.PAGE, 0.36, columns=2)
    left.set_axis_off()
    wall(left, (-0.12, -0.3), 0.12, 0.8)
    box(left, (0.25, 0), 1, 0.2, style.SKY)
    motion(left, (1.05, 0.1), (0.8, 0.1))
    left.text(0.72, 0.1, "$v$", va="center")
    left.text(0.35, 0.25, r"$E,\ \rho,\ A$")
    for low, high, text in ((0, 0.25, "gap"), (0.25, 1.25, "$L$")):
        length(left, (low, -0.12), (high, -0.12))
        left.text((low + high) / 2, -0.16, text, ha="center", va="top")
    left.set_xlim(-0.15, 1.35)
    left.set_ylim(-0.4, 0.6)
    right.add_patch(patches.Polygon([(0, 0), (1, 1), (0, 2)], facecolor=style.SKY,
                                    edgecolor=style.BLUE))
    right.text(0.25, 1, r"at rest, stress $-\rho c v$", va="center", fontsize=7)
    right.text(0.97, 0.25, "$-v$", ha="right")
    right.text(0.97, 1.7, "$+v$", ha="right")
    right.set_xlim(0, 1.02)
    right.set_ylim(-0.3, 2.4)
    right.set_xlabel("place in the bar / $L$")
    right.set_ylabel("time since impact / $(L/c)$")
    return figure


def sketch_coating(axes):
    box(axes, (0, 0), 2, 1, style.PALE)
    box(axes, (0, 1), 2, 0.12, style.ORANGE)
    wall(axes, (-0.25, 1.25), 2.5, 0.2)
    for x in numpy.linspace(0.1, 1.9, 10):
        axes.add_patch(patches.Polygon([(x, 0), (x - 0.07, -0.12), (x + 0.07, -0.12)],
                                       facecolor="white", edgecolor=style.BLACK,
                                       linewidth=0.6))
    motion(axes, (1, 1.8), (1, 1.45))
    for x, y, text in ((1.08, 1.62, "$d$"), (1, 0.5, "block: $E$"),
                       (2.08, 1.02, "coating: $k,\\ c$")):
        axes.text(x, y, text)
    bare(axes, (-0.4, 2.9), (-0.3, 1.9))


def sketch_step_8(axes):
    box(axes, (-1, -1), 2, 2, style.SKY, alpha=0.5)
    wall(axes, (-1.2, -1.2), 0.2, 2.4)
    wall(axes, (1, -1.2), 0.2, 2.4)
    for x, text in ((-1.1, "clamped"), (1.1, "wall"), (0, "guides")):
        axes.text(x, 1.28, text, ha="center", fontsize=7)
    for x, end in ((-0.5, (-0.15, 0)), (0.5, (0.85, 0)), (0, (0, 0.35))):
        circle(axes, (x, 0), 0.2, style.ORANGE)
        motion(axes, (x, 0), end)
    for y in (1.06, -1.06):
        for x in numpy.linspace(-0.8, 0.8, 5):
            circle(axes, (x, y), 0.06)
    bare(axes, (-1.4, 1.4), (-1.35, 1.5))


# The pages.

def block(page):
    page.save(sketch_block(), "block-setup")
    page.draw(page.run("block", "block"), "bodies", "block")


def profile_error(run, half_width, largest):
    """Size of the first facet relative to the half width, and the error of the
    pressure in the mean square, as errors.py of the page computes it."""
    table = run.table("pair_1.csv")
    x, p = table["x"], table["pressure"]
    square = whole = 0
    for s in (0.1, 0.3, 0.5, 0.7, 0.9):
        at = x[:-1] + s * numpy.diff(x)
        exact = largest * numpy.sqrt(numpy.maximum(0, 1 - (at / half_width)**2))
        square += ((p[:-1] + s * numpy.diff(p) - exact)**2 * numpy.diff(x)).sum()
        whole += (exact**2 * numpy.diff(x)).sum()
    return (x[1] - x[0]) / half_width, math.sqrt(square / whole)


def hertz(page):
    page.save(sketch_roller(), "hertz-setup")
    run = page.run("roller", "roller")
    page.draw(run, "bodies", "hertz-bodies")
    page.draw(run, "tractions", "hertz-pressure")
    half_width, largest = 0.234891, 2710.28
    series = {"adaptive": [[f"Refinement/Adaptive cycles={n}"] for n in range(4, 8)],
              "uniform": [[f"Refinement/Level={n}", "Refinement/Adaptive cycles=0"]
                          for n in range(5, 8)]}
    figure, ((left, right),) = style.figure(style.PAGE, 0.36, 1, 2)
    handles = []
    for i, (name, meshes) in enumerate(series.items()):
        points = []
        for n, settings in enumerate(meshes):
            one = page.run("roller", f"{name}-{n}", *settings)
            h, profile = profile_error(one, half_width, largest)
            points.append((h, profile, one.summary["dofs"],
                           abs(one.summary["pair_1_contact_area"] / half_width - 1)))
        h, profile, unknowns, width = numpy.array(points).T
        look = style.curve_style(i)
        handles += left.plot(h, profile, label=f"profile, {name}", **look)
        handles += left.plot(h, width, label=f"width, {name}", markerfacecolor="white",
                             **(look | {"linestyle": ":"}))
        right.plot(unknowns, profile, **look)
    style.slope_triangle(left, 0.25, 0.012, 1)
    left.set_xlabel("facet / half width $h/a$")
    right.set_xlabel("unknowns")
    left.set_ylabel("relative error")
    right.set_ylabel("relative error of the profile")
    for axes in (left, right):
        style.logarithmic(axes.xaxis)
        style.logarithmic(axes.yaxis)
    style.letters((left, right))
    style.legend_above(figure, handles)
    page.save(figure, "hertz-error")


def stick(run, coefficient):
    """Q/(mu P), and |x| of the last sticking and the first slipping node relative
    to the half width of the contact."""
    pull, press = (abs(force) for force in run.summary["pair_1_force"])
    half_width = math.sqrt(4 * press * 10 / (math.pi * 210000 / (2 * (1 - 0.3**2))))
    table = run.table("pair_1.csv")
    x, status = abs(table["x"]) / half_width, table["status"]
    pressed = table["pressure"] > 0
    return (pull / (coefficient * press), max(x[pressed & (status == 1)], default=0),
            min(x[pressed & (status == 2)], default=1))


def friction(page):
    page.save(sketch_pulled(), "friction-setup")
    run = page.run("pulled", "pulled")
    page.draw(run, "tractions", "friction-tractions")
    points = [stick(run, 0.3)] + [
        stick(page.run("pulled", f"end-{end}", f"Time stepping/End time={end}",
                       f"Time stepping/Number of steps={steps}"), 0.3)
        for end, steps in ((1.25, 5), (1.5, 3), (2, 2))] + [
        stick(page.run("pulled", f"mu-{mu}", f"Pair 1/Friction=(t > 1 ? {mu} : 0)"), mu)
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
    page.save(figure, "friction-stick")


def ironing(page):
    page.save(sketch_die(), "ironing-setup")
    run = page.run("die", "die", "Time stepping/Number of steps=80")
    page.draw(run, "bodies", "ironing-bodies")
    fine = {name: numpy.insert(column, 0, 0)
            for name, column in run.table("levels.csv").items()}
    coarse = page.run("die", "coarse", "Time stepping/Number of steps=10").table(
        "levels.csv")
    figure, ((axes,),) = style.figure(style.PAGE, 0.42)
    for i, (name, column, sign) in enumerate((("vertical $V$", "pair_1_force_y", -1),
                                              ("horizontal $H$", "pair_1_force_x", 1))):
        axes.plot(fine["time"], sign * fine[column], color=style.COLOURS[i], label=name)
        if i == 0:
            axes.plot(fine["time"], -0.3 * fine[column], color=style.GREY,
                      linestyle="--", label="$0.3\\,V$")
        axes.plot(coarse["time"], sign * coarse[column], color=style.COLOURS[i],
                  linestyle="", marker=style.MARKERS[i])
    axes.set_xlabel("time $t$")
    axes.set_ylabel("force on the block [N/mm]")
    style.legend(axes)
    page.save(figure, "ironing-forces")


def impact(page):
    page.save(sketch_impact(), "impact-sketch")
    series = {"trapezoid, consistent mass": ("trapezoid", "consistent", {
                  "color": style.VERMILION, "linewidth": 0.5}),
              "hht": ("hht", "auto", style.line_style(0)),
              "contact stabilised": ("contact stabilised", "auto", style.line_style(2))}
    figure, [all_axes] = style.figure(style.PAGE, 0.34, columns=3)
    force, energy, close = all_axes
    for name, (scheme, mass, look) in series.items():
        # The first gains energy and ends with exit code 3.
        table = page.run("bar", scheme.replace(" ", "-"), "Output/Fields=false",
                         f"Time stepping/Scheme={scheme}",
                         f"Time stepping/Mass matrix={mass}",
                         check=False).table("levels.csv")
        force.plot(1e3 * table["time"], 1e-6 * table["pair_1_force_x"], label=name,
                   **look)
        for axes in (energy, close):
            axes.plot(1e3 * table["time"], table["balance"] / 1962.5,
                      **{**look, "linewidth": 1.2})
    force.plot([0, 0.1, 0.1, 0.4866831, 0.4866831, 0.6],
               [0, 0, 4.06017, 4.06017, 0, 0], color=style.BLACK, linewidth=0.8,
               label="closed form")
    force.set_ylabel("contact force [MN]")
    energy.set_ylabel("energy / energy at the start")
    close.set_ylim(0.988, 1.002)
    for axes in all_axes:
        axes.set_xlabel("time [ms]")
    style.letters(all_axes)
    style.legend_above(figure, force.get_legend_handles_labels()[0])
    page.save(figure, "impact")


def law_in_c(page):
    figure, [(sketch, chart)] = style.figure(style.PAGE, 0.42, columns=2)
    sketch_coating(sketch)
    young, depth, thickness = 1000.0, 0.01, 0.001
    gap = numpy.linspace(-0.001, 0.0012, 200)
    subprocess.run(["cc", "-shared", "-fPIC", f"-I{ROOT}/include", "power_law.c", "-o",
                    "power_law.so", "-lm"], cwd=page.work, check=True)
    for look, (k, m) in enumerate(((5e3, 1), (5e6, 2))):
        chart.plot(1e3 * gap, k * numpy.maximum(thickness - gap, 0) ** m,
                   label=f"law, $m$ = {m}", **style.line_style(look))
        summary = page.run(
            "coating", f"{m}", "Output/Expected=pair_1_force[1]: -20",
            f"Method/Law parameters=stiffness: {k}, thickness: {thickness}, power: {m}"
        ).summary
        chart.plot(1e3 * -summary["max_penetration"], -summary["pair_1_force"][1] / 2,
                   color=style.BLACK, marker=style.MARKERS[look], linestyle="",
                   markersize=5, label=f"run, $m$ = {m}")
    chart.plot(1e3 * gap, young * (depth + gap), color=style.GREY, linewidth=0.9,
               label="block, $E(d + g)$")
    chart.set_xlabel("gap $10^3\\, g$")
    chart.set_ylabel("pressure")
    chart.set_ylim(-0.5, 19)
    style.letters((sketch, chart))
    style.legend_above(figure, chart.get_legend_handles_labels()[0])
    page.save(figure, "law")


def finger_shape(axes, mesh):
    """The finger from the side, before and after, coloured by the stress."""
    faces = sorted(geometry.surface(mesh),
                   key=lambda face: -mesh.points[face][:, 1].mean())
    stress = mesh.fields["von_mises_stress"].astype(float).ravel()
    moved = mesh.points + mesh.fields["displacement"]
    axes.add_collection(PolyCollection([mesh.points[face][:, [0, 2]] for face in faces],
                                       facecolors=style.PALE, edgecolors="none"))
    field(axes, [moved[face][:, [0, 2]] for face in faces],
          numpy.array([stress[face].mean() for face in faces]), 0.2,
          "von Mises stress [MPa]", shrink=0.7, aspect=30, pad=0.02, location="bottom")
    wall(axes, (-0.5, -0.6), 0.5, 1.7)
    wall(axes, (7.6, -0.6), 2.8, 0.5)
    motion(axes, (9, -1.6), (9, -0.65))
    axes.text(9.2, -1.3, "$d$")
    length(axes, (0, 1.25), (9, 1.25))
    axes.text(4.5, 1.35, "$L$", ha="center")
    bare(axes, (-0.7, 10.6), (-1.8, 2.0))


def tetrahedra(page):
    beam = 0.9408
    figure, [(shape, chart)] = style.figure(style.PAGE, 0.4, columns=2,
                                            width_ratios=(3, 2))
    shutil.copy(ROOT / "doc/tutorials/finger.msh", page.work)
    for degree, levels in ((1, (0, 1, 2)), (2, (0, 1))):
        tables = [page.run("finger", f"{degree}-{level}", "Output/Fields=false",
                           f"Solid/Degree={degree}", f"Refinement/Level={level}"
                           ).table("levels.csv") for level in levels]
        chart.plot(*([table[name][-1] for table in tables]
                     for name in ("dofs", "contact_force")),
                   label=f"tetrahedra of degree {degree}", **style.curve_style(degree - 1))
    finger_shape(shape, page.run("finger", "shape").last_field("fields"))
    chart.axhline(beam, color=style.BLACK, linewidth=0.8, label="beam")
    style.logarithmic(chart.xaxis)
    chart.set_ylim(0, 3.2)
    chart.set_xlabel("unknowns")
    chart.set_ylabel("contact force [N]")
    chart.legend()
    style.letters((shape, chart))
    page.save(figure, "finger")


def deal_ii_program(page, vtk):
    """The displacement in x of a file that DataOut has written."""
    words = vtk.read_text(encoding="utf-8").split()

    def numbers(name, after, columns, n=None):
        begin = words.index(name) + after
        n = n or int(words[begin - after + 1])
        return numpy.array(words[begin:begin + columns * n], float).reshape(n, columns)

    points = numbers("POINTS", 3, 3)
    cells = numbers("CELLS", 3, 5)[:, 1:].astype(int)
    values = numbers("x_displacement", 5, 1, len(points))[:, 0]
    figure, [(sketch, map_)] = style.figure(style.PAGE, 0.45, columns=2)
    sketch_step_8(sketch)
    style.plane_map(map_)
    field(map_, points[cells][:, :, :2], values[cells].mean(axis=1), 0.15,
          "displacement $u_x$", shrink=0.9)
    map_.set_xlim(-1, 1)
    map_.set_ylim(-1, 1)
    map_.set_xlabel("$x$")
    map_.set_ylabel("$y$")
    style.letters((sketch, map_))
    page.save(figure, "step-8")


PAGES = {each.__name__.replace("_", "-"): each for each in (
    block, hertz, friction, ironing, impact, law_in_c, tetrahedra)}


def main():
    parser = pictures.parser(__doc__)
    parser.add_argument("--page", choices=PAGES, action="append")
    parser.add_argument("--vtk", type=pathlib.Path)
    arguments = parser.parse_args()

    def draw(abut, folder):
        if arguments.vtk:
            deal_ii_program(Page("deal-ii-program", abut, folder), arguments.vtk)
            return
        for name in arguments.page or PAGES:
            PAGES[name](Page(name, abut, folder))

    pictures.write(arguments, draw)


if __name__ == "__main__":
    main()
