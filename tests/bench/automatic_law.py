#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Is `Method/Enforcement = auto` as good as the best law, on scenes that are not
in prm/charts?

Each scene is charted (`abut chart`) with auto and with single laws on one mesh:
the error of the mesh is then the same for all, and that of a law comes on top.
So it is strict to compare auto with the fastest law of all that end with an
answer. Printed are processor seconds and matrix-vector products of auto and of
the best law in each, and by how much the contact force of the fastest differs
from auto's. Passed: auto's time within 1.5 times the best, plus 20 milliseconds
of noise. Products are shown only: a law whose systems are factorised (Nitsche's
unsymmetric ones, bodies in the plane) has hardly any.

    tests/bench/automatic_law.py build/release/abut [SCENE...] [--output FOLDER]

The folder keeps the runs: started again, only missing ones are made.
"""
import csv
import os
import pathlib
import subprocess
import sys

import measured

LAWS = ["auto", "lagrange", "penalty", "augmented lagrangian",
        "interior point"]
COLD = {"Refinement/Nested iteration": "false"}
POINTS = {"Method/Discretisation": "quadrature point"}
LEVEL = "Refinement/Level"
CYCLES = "Refinement/Adaptive cycles"

# name: scene, settings
SCENES = {
    "signorini": ("signorini", {LEVEL: 8}),
    "string": ("string", {LEVEL: 8}),
    "flat-obstacle-3d": ("flat-obstacle-3d", {LEVEL: 5}),
    "height-map": ("height-map", {LEVEL: 8}),
    "curved-obstacle": ("curved-obstacle", {LEVEL: 8, CYCLES: 0}),
    "curved-obstacle, adaptive": ("curved-obstacle", {LEVEL: 5, CYCLES: 8}),
    "curved-obstacle, cold": ("curved-obstacle",
                              {LEVEL: 9, CYCLES: 0, **COLD}),
    "elastic-signorini": ("elastic-signorini", {LEVEL: 7}),
    "hertz-2d": ("hertz-2d", {CYCLES: 8}),
    "hertz-axisymmetric": ("hertz-axisymmetric", {CYCLES: 8}),
    "two-cylinders": ("two-cylinders", {CYCLES: 7}),
    "two-cylinders, points": ("two-cylinders", {CYCLES: 7, **POINTS}),
    "nafems-roller": ("nafems-roller", {CYCLES: 5}),
    "elastic-sphere": ("elastic-sphere", {LEVEL: 5}),
}


def sections(settings):
    lines = []
    for path, value in settings.items():
        section, name = path.split("/")
        lines += [f"subsection {section}", f"set {name} = {value}", "end"]
    return "\n".join(lines)


def chart_file(name, source, repeats):
    """The text of a chart for one of SCENES."""
    scene, settings = SCENES[name]
    laws = list(LAWS)
    with open(source / "prm" / (scene + ".prm")) as file:
        if "set Scene = solid" in file.read():
            laws.append("nitsche")
    axis = CYCLES if settings.get(CYCLES, 0) > 0 else LEVEL
    rest = {key: value for key, value in settings.items() if key != axis}
    method = "\n".join([
        f"subsection All curves\n{sections(rest)}\nend" if rest else "",
        "subsection Curve\nsubsection Method",
        "set Enforcement = " + " | ".join(laws), "end\nend"])
    # The reference only serves to have the force in the table of runs.
    return (f"set Scene file = {source}/prm/{scene}.prm\n"
            f"set Axis = {axis}\nset Values = {settings[axis]}\n"
            f"set Repeats = {repeats}\nset Repeat seconds = 3\n"
            "set Time limit = 100\nset Pictures =\n"
            "subsection Error\nset Quantity = contact_force\n"
            f"set Reference = 1\nend\n{method}\n")


def judge(folder):
    """({key: (auto's cost, best cost, best law)}, difference of the contact
    force, passed); None without an answer by auto."""
    with open(folder / "runs.csv") as file:
        laws = {row["curve"]: row for row in csv.DictReader(file)
                if row["ended"] == "ok"}
    if "auto" not in laws:
        return None
    auto = laws.pop("auto")
    costs = {}
    for key in ("time", "matvecs"):
        best = min(laws, key=lambda law: float(laws[law][key]))
        costs[key] = float(auto[key]), float(laws[best][key]), best
    mine, best, law = costs["time"]
    difference = abs(float(laws[law]["quantity"]) / float(auto["quantity"]) - 1)
    return costs, difference, mine <= 1.5 * best + 0.02


def main():
    parser = measured.options(__doc__)
    parser.add_argument("scenes", nargs="*", default=list(SCENES))
    parser.add_argument("--output", default="output/automatic-law")
    parser.add_argument("--repeats", type=int, default=3)
    arguments = parser.parse_args()
    source = pathlib.Path(__file__).resolve().parents[2]
    measured.head(["scene", "s", "fastest law, its s", "its force differs by",
                   "products", "least, by", "within 1.5"])
    passed = 0
    for name in arguments.scenes:
        folder = pathlib.Path(arguments.output) / name.replace(", ", "-")
        os.makedirs(folder, exist_ok=True)
        chart = folder / "chart.prm"
        chart.write_text(chart_file(name, source, arguments.repeats))
        result = subprocess.run(
            [arguments.abut, "chart", chart, "--output", folder, "--quiet"],
            capture_output=True, text=True)
        found = judge(folder) if result.returncode == 0 else None
        if found is None:
            print(f"| {name} | no answer by auto | " + result.stderr, flush=True)
            continue
        costs, difference, good = found
        passed += good
        print("| {} | {:.3g} | {}, {:.3g} | {:.1g} | {:.0f} | {:.0f}, {} | {} |"
              .format(name, costs["time"][0], costs["time"][2],
                      costs["time"][1], difference, costs["matvecs"][0],
                      costs["matvecs"][1], costs["matvecs"][2],
                      "yes" if good else "no"), flush=True)
    print(f"\n{passed} of {len(arguments.scenes)}")
    return 0 if passed >= 0.9 * len(arguments.scenes) else 1


if __name__ == "__main__":
    sys.exit(main())
