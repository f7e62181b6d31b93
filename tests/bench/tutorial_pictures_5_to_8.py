#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""The pictures of the tutorials impact, deal-ii-program, law-in-c and tetrahedra, from
runs of the scenes that stand in the pages. The field of step-8 needs the .vtk file
that the program of that page writes:

    tests/bench/tutorial_pictures_5_to_8.py build/release/abut [--vtk solution-4.vtk]"""
import argparse
import csv
import json
import pathlib
import shutil
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path[:0] = [str(ROOT / "plugin/tools"), str(ROOT / "tests/docs")]

import numpy  # noqa: E402
from matplotlib import patches  # noqa: E402
from matplotlib.collections import PolyCollection  # noqa: E402

from abut_tools import geometry, style  # noqa: E402
from abut_tools.run_folder import RunFolder  # noqa: E402
from run_page import steps  # noqa: E402


def blocks(page, folder):
    """Write the named blocks of a page into the folder."""
    text = (ROOT / "doc/tutorials" / page).read_text(encoding="utf-8")
    for _, intent, _, name, body in steps(text):
        if intent in ("check", "show", "compile") and name:
            (folder / name).write_text(body, encoding="utf-8")


def run(abut, scene, output, *settings):
    """The table of steps of a run, whatever its exit code, by columns."""
    command = [abut, "run", scene, "--quiet", "--output", output]
    for setting in ("Output/Fields=false", *settings):
        command += ["--set", setting]
    subprocess.run(command, cwd=scene.parent, check=False, stderr=subprocess.DEVNULL)
    with open(output / "levels.csv", encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    return {key: numpy.array([float(row[key] or 0) for row in rows]) for key in rows[0]}


def wall(axes, x, low, high, depth, **more):
    """A rigid wall to the left of x."""
    axes.add_patch(patches.Rectangle((x - depth, low), depth, high - low, facecolor=style.PALE,
                                     edgecolor=style.GREY, hatch="////", linewidth=0.6,
                                     **more))


def arrow(axes, start, end, **more):
    axes.annotate("", end, start, arrowprops={"arrowstyle": "-|>", "linewidth": 1.0,
                                              "color": style.BLACK, **more})


def impact_sketch(folder):
    figure, [(left, right)] = style.figure(style.PAGE, 0.36, columns=2)
    left.set_axis_off()
    left.grid(False)
    wall(left, 0, -0.3, 0.5, 0.12)
    left.add_patch(patches.Rectangle((0.25, 0), 1, 0.2, facecolor=style.SKY,
                                     edgecolor=style.BLACK, linewidth=0.8))
    arrow(left, (1.05, 0.1), (0.8, 0.1))
    left.text(0.72, 0.1, "$v$", va="center")
    left.text(0.35, 0.25, r"$E,\ \rho,\ A$")
    for low, high, text, y in ((0, 0.25, "gap", -0.12), (0.25, 1.25, "$L$", -0.12)):
        left.annotate("", (high, y), (low, y),
                      arrowprops={"arrowstyle": "<->", "linewidth": 0.7})
        left.text((low + high) / 2, y - 0.04, text, ha="center", va="top")
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
    style.save(figure, folder, "tutorial-impact-sketch")


def impact(abut, folder):
    impact_sketch(folder)
    with tempfile.TemporaryDirectory() as work:
        work = pathlib.Path(work)
        blocks("impact.md", work)
        series = [("trapezoid, consistent mass", "trapezoid", "consistent",
                   {"color": style.VERMILION, "linewidth": 0.5}),
                  ("hht", "hht", "auto", style.line_style(0)),
                  ("contact stabilised", "contact stabilised", "auto", style.line_style(2))]
        figure, [all_axes] = style.figure(style.PAGE, 0.34, columns=3)
        force, energy, close = all_axes
        for name, scheme, mass, look in series:
            table = run(abut, work / "bar.prm", work / name.replace(" ", "-"),
                        f"Time stepping/Scheme={scheme}",
                        f"Time stepping/Mass matrix={mass}")
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
        style.legend_above(figure, force.get_legend_handles_labels()[0], 4)
        style.save(figure, folder, "tutorial-impact")


def law(abut, folder):
    figure, [(sketch, chart)] = style.figure(style.PAGE, 0.42, columns=2)
    sketch.set_axis_off()
    sketch.add_patch(patches.Rectangle((0, 0), 2, 1, facecolor=style.PALE,
                                       edgecolor=style.BLACK, linewidth=0.8))
    sketch.add_patch(patches.Rectangle((0, 1), 2, 0.12, facecolor=style.ORANGE,
                                       edgecolor=style.BLACK, linewidth=0.8))
    sketch.add_patch(patches.Rectangle((-0.25, 1.25), 2.5, 0.2, facecolor=style.PALE,
                                       edgecolor=style.GREY, hatch="////", linewidth=0.6))
    for x in numpy.linspace(0.1, 1.9, 10):
        sketch.add_patch(patches.Polygon([(x, 0), (x - 0.07, -0.12), (x + 0.07, -0.12)],
                                         facecolor="white", edgecolor=style.BLACK,
                                         linewidth=0.6))
    arrow(sketch, (1, 1.8), (1, 1.45))
    for x, y, text in ((1.08, 1.62, "$d$"), (1, 0.5, "block: $E$"),
                       (2.08, 1.02, "coating: $k,\\ c$")):
        sketch.text(x, y, text)
    sketch.set_xlim(-0.4, 2.9)
    sketch.set_ylim(-0.3, 1.9)
    sketch.set_aspect("equal")
    young, depth, thickness = 1000.0, 0.01, 0.001
    gap = numpy.linspace(-0.001, 0.0012, 200)
    with tempfile.TemporaryDirectory() as work:
        work = pathlib.Path(work)
        blocks("law-in-c.md", work)
        subprocess.run(["cc", "-shared", "-fPIC", f"-I{ROOT}/include", "power_law.c", "-o",
                        "power_law.so", "-lm"], cwd=work, check=True)
        for look, (k, m) in enumerate(((5e3, 1), (5e6, 2))):
            chart.plot(1e3 * gap, k * numpy.maximum(thickness - gap, 0) ** m,
                       label=f"law, $m$ = {m}", **style.line_style(look))
            run(abut, work / "coating.prm", work / f"{m}",
                f"Method/Law parameters=stiffness: {k}, thickness: {thickness}, power: {m}",
                "Output/Expected=pair_1_force[1]: -20")
            summary = json.loads((work / f"{m}/summary.json").read_text())
            force = -summary["pair_1_force"][1]
            chart.plot(1e3 * -summary["max_penetration"], force / 2, color=style.BLACK,
                       marker=style.MARKERS[look], linestyle="", markersize=5,
                       label=f"run, $m$ = {m}")
    chart.plot(1e3 * gap, young * (depth + gap), color=style.GREY, linewidth=0.9,
               label="block, $E(d + g)$")
    chart.set_xlabel("gap $10^3\\, g$")
    chart.set_ylabel("pressure")
    chart.set_ylim(-0.5, 19)
    style.letters((sketch, chart))
    style.legend_above(figure, chart.get_legend_handles_labels()[0], 5)
    style.save(figure, folder, "tutorial-law")


def finger_shape(axes, folder):
    """The finger from the side, before and after, coloured by the stress."""
    mesh = RunFolder(folder).last_field("fields")
    faces = sorted(geometry.surface(mesh),
                   key=lambda face: -mesh.points[face][:, 1].mean())
    stress = mesh.fields["von_mises_stress"].astype(float).ravel()
    moved = mesh.points + mesh.fields["displacement"]
    axes.add_collection(PolyCollection([mesh.points[face][:, [0, 2]] for face in faces],
                                       facecolors=style.PALE, edgecolors="none"))
    shown = PolyCollection([moved[face][:, [0, 2]] for face in faces],
                           array=numpy.array([stress[face].mean() for face in faces]),
                           cmap=style.FIELD_MAP, edgecolors="#00000060", linewidths=0.2,
                           rasterized=True)
    axes.add_collection(shown)
    axes.get_figure().colorbar(shown, ax=axes, shrink=0.7, aspect=30, pad=0.02,
                               label="von Mises stress [MPa]", location="bottom")
    wall(axes, 0, -0.6, 1.1, 0.5)
    axes.add_patch(patches.Rectangle((7.6, -0.6), 2.8, 0.5, facecolor=style.PALE,
                                     edgecolor=style.GREY, hatch="////", linewidth=0.6))
    arrow(axes, (9, -1.6), (9, -0.65))
    axes.text(9.2, -1.3, "$d$")
    axes.annotate("", (9, 1.25), (0, 1.25),
                  arrowprops={"arrowstyle": "<->", "linewidth": 0.7})
    axes.text(4.5, 1.35, "$L$", ha="center")
    axes.set_xlim(-0.7, 10.6)
    axes.set_ylim(-1.8, 2.0)
    axes.set_aspect("equal")
    axes.set_axis_off()


def finger(abut, folder):
    beam = 0.9408
    figure, [(shape, chart)] = style.figure(style.PAGE, 0.4, columns=2,
                                            width_ratios=(3, 2))
    with tempfile.TemporaryDirectory() as work:
        work = pathlib.Path(work)
        blocks("tetrahedra.md", work)
        shutil.copy(ROOT / "doc/tutorials/finger.msh", work)
        for degree, levels in ((1, (0, 1, 2)), (2, (0, 1))):
            points = []
            for level in levels:
                table = run(abut, work / "finger.prm", work / f"{degree}-{level}",
                            f"Solid/Degree={degree}", f"Refinement/Level={level}")
                points.append((table["dofs"][-1], table["contact_force"][-1]))
            chart.plot(*zip(*points), label=f"tetrahedra of degree {degree}",
                       **style.curve_style(degree - 1))
        run(abut, work / "finger.prm", work / "shape", "Output/Fields=true")
        finger_shape(shape, work / "shape")
    chart.axhline(beam, color=style.BLACK, linewidth=0.8, label="beam")
    style.logarithmic(chart.xaxis)
    chart.set_ylim(0, 3.2)
    chart.set_xlabel("unknowns")
    chart.set_ylabel("contact force [N]")
    chart.legend()
    style.letters((shape, chart))
    style.save(figure, folder, "tutorial-finger")


def step_8_sketch(axes):
    axes.add_patch(patches.Rectangle((-1, -1), 2, 2, facecolor=style.SKY, alpha=0.5,
                                     edgecolor=style.BLACK, linewidth=0.8))
    wall(axes, -1, -1.2, 1.2, 0.2)
    axes.text(-1.1, 1.28, "clamped", ha="center", fontsize=7)
    wall(axes, 1.2, -1.2, 1.2, 0.2)
    axes.text(1.1, 1.28, "wall", ha="center", fontsize=7)
    for x, (right, up) in ((-0.5, (0.35, 0)), (0.5, (0.35, 0)), (0, (0, 0.35))):
        axes.add_patch(patches.Circle((x, 0), 0.2, facecolor=style.ORANGE, linewidth=0.6,
                                      edgecolor=style.BLACK))
        arrow(axes, (x, 0), (x + right, up))
    for y in (1.06, -1.06):
        for x in numpy.linspace(-0.8, 0.8, 5):
            axes.add_patch(patches.Circle((x, y), 0.06, facecolor="white", linewidth=0.6,
                                          edgecolor=style.BLACK))
    axes.text(0, 1.28, "guides", ha="center", fontsize=7)
    axes.set_xlim(-1.4, 1.4)
    axes.set_ylim(-1.35, 1.5)
    axes.set_aspect("equal")
    axes.set_axis_off()


def step_8(vtk, folder):
    """The displacement in x of a file that DataOut has written."""
    words = vtk.read_text(encoding="utf-8").split()
    begin = words.index("POINTS") + 3
    points = numpy.array(words[begin:begin + 3 * int(words[begin - 2])], float)
    points = points.reshape(-1, 3)
    begin = words.index("CELLS") + 3
    cells = numpy.array(words[begin:begin + 5 * int(words[begin - 2])], int)
    cells = cells.reshape(-1, 5)[:, 1:]
    begin = words.index("x_displacement") + 5
    values = numpy.array(words[begin:begin + len(points)], float)
    figure, [(sketch, field)] = style.figure(style.PAGE, 0.45, columns=2)
    step_8_sketch(sketch)
    shown = PolyCollection(points[cells][:, :, :2], array=values[cells].mean(axis=1),
                           cmap=style.FIELD_MAP, edgecolors="#00000060", linewidths=0.15,
                           rasterized=True)
    field.add_collection(shown)
    style.plane_map(field)
    field.set_xlim(-1, 1)
    field.set_ylim(-1, 1)
    field.set_xlabel("$x$")
    field.set_ylabel("$y$")
    figure.colorbar(shown, ax=field, label="displacement $u_x$", shrink=0.9)
    style.letters((sketch, field))
    style.save(figure, folder, "tutorial-step-8")


def main():
    arguments = argparse.ArgumentParser(description=__doc__)
    arguments.add_argument("abut", type=pathlib.Path)
    arguments.add_argument("--vtk", type=pathlib.Path)
    arguments.add_argument("--folder", type=pathlib.Path, default=ROOT / "doc/pictures")
    arguments = arguments.parse_args()
    abut = arguments.abut.resolve()
    impact(abut, arguments.folder)
    law(abut, arguments.folder)
    finger(abut, arguments.folder)
    if arguments.vtk:
        step_8(arguments.vtk, arguments.folder)


if __name__ == "__main__":
    main()
