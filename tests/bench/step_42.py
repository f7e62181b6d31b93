#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""deal.II's step-42 beside the example elasto-plastic: the same material, mesh
and load, contact and nonlinear iteration by the program itself and by Abut.

step-42 is built from the installed documentation of deal.II (Debian:
libdeal.ii-doc), in release mode. In a copy of it processor time is printed
instead of wall time, the contact force with more digits, the two tolerances
(of Newton's method, 1e-10, and of linear systems, 1e-8) can be given, and
errors of cells are rounded to three digits, so that symmetric cells are refined
together and all runs have the same meshes. Times are processor seconds of one rank and one thread, without
graphical output, medians over repeated runs.

    tests/bench/step_42.py --build build/release [--cycles 5] [--runs 3]
"""
import argparse
import gzip
import json
import os
import pathlib
import re
import statistics
import subprocess
import sys
import tempfile

EXAMPLES = pathlib.Path("/usr/share/doc/libdeal.ii-doc/examples/step-42")
EDITS = [
    ("TimerOutput::wall_times", "TimerOutput::cpu_times"),
    ('pcout << "Contact force = "',
     'pcout << std::setprecision(10) << "Contact force = "'),
    ("residual_norm < 1e-10", 'residual_norm < std::atof(getenv("NEWTON"))'),
    ("relative_accuracy = 1e-8",
     'relative_accuracy = std::atof(getenv("LINEAR"))'),
    ("        parallel::distributed::GridRefinement ::",
     "        for (float &e : estimated_error_per_cell)\n"
     "          {\n"
     "            const double digit =\n"
     "              std::pow(10., std::floor(std::log10(e)) - 2.);\n"
     "            e = static_cast<float>(std::round(e / digit) * digit);\n"
     "          }\n"
     "        parallel::distributed::GridRefinement ::"),
    ("#include <fstream>", "#include <cstdlib>\n#include <iomanip>\n"
                           "#include <fstream>"),
]
# Sections of step-42 that contain others are left out.
PARTS = {"Assembling": "assembly", "Residual and lambda": "residual",
         "Setup": "mesh and unknowns", "Solve: iterate": "linear iteration",
         "Solve: setup preconditioner": "preconditioner",
         "update active set": "active set"}


def build_step_42(folder):
    """The path of the program."""
    source = EXAMPLES / "step-42.cc"
    if source.exists():
        text = source.read_text()
    elif source.with_suffix(".cc.gz").exists():
        text = gzip.open(source.with_suffix(".cc.gz"), "rt").read()
    else:
        sys.exit("step-42 is not installed; on Debian: apt install "
                 "libdeal.ii-doc")
    for old, new in EDITS:
        if text.count(old) != 1:
            sys.exit(f"This is not the step-42 that we know: '{old}' occurs "
                     f"{text.count(old)} times.")
        text = text.replace(old, new)
    folder.mkdir(parents=True, exist_ok=True)
    target = folder / "step-42.cc"
    if not target.exists() or target.read_text() != text:
        target.write_text(text)
    (folder / "CMakeLists.txt").write_text(
        "cmake_minimum_required(VERSION 3.13)\n"
        "find_package(deal.II REQUIRED)\ndeal_ii_initialize_cached_variables()"
        "\nproject(step-42)\nadd_executable(step-42 step-42.cc)\n"
        "deal_ii_setup_target(step-42)\n")
    for command in (["cmake", "-DCMAKE_BUILD_TYPE=Release", "-S", ".", "-B",
                     "."], ["cmake", "--build", "."]):
        subprocess.run(command, cwd=folder, check=True,
                       stdout=subprocess.DEVNULL)
    return folder / "step-42"


def environment(**more):
    return dict(os.environ, DEAL_II_NUM_THREADS="1", OMP_NUM_THREADS="1",
                **more)


def run_step_42(program, cycles, warm, newton, linear):
    """Figures of each cycle."""
    with tempfile.TemporaryDirectory() as folder:
        prm = pathlib.Path(folder) / "p.prm"
        prm.write_text("set polynomial degree = 1\n"
                       "set number of initial refinements = 3\n"
                       f"set number of cycles = {cycles}\n"
                       "set refinement strategy = percentage\n"
                       "set obstacle = sphere\nset output directory = out\n"
                       f"set transfer solution = {'true' if warm else 'false'}"
                       "\n")
        text = subprocess.run(
            [program, prm], cwd=folder, text=True, check=True,
            capture_output=True,
            env=environment(NEWTON=str(newton), LINEAR=str(linear))).stdout
    result = []
    for part in re.split(r"^Cycle \d+:$", text, flags=re.M)[1:]:
        row = {"cells": int(re.search(r"active cells: (\d+)", part)[1]),
               "dofs": int(re.search(r"degrees of freedom: (\d+)", part)[1]),
               "force": float(re.search(r"Contact force = (\S+)", part)[1]),
               "steps": len(re.findall(r"Newton iteration \d+", part)),
               "linear_iterations": sum(
                   map(int, re.findall(r"in (\d+) Bicgstab", part))),
               "residual": float(re.findall(r"system: (\S+)", part)[-1])}
        for name, calls, seconds in re.findall(
                r"^\| (.+?) *\| *(\d+) \| *(\S+?)s \|", part, flags=re.M):
            if name in PARTS:
                row[PARTS[name]] = float(seconds)
                row[PARTS[name] + " calls"] = int(calls)
        row["seconds"] = sum(row.get(p, 0) for p in PARTS.values())
        result.append(row)
    return result


def run_abut(build, cycles, words):
    """Figures of each cycle."""
    plugin = next(build.glob("libabut_plugin*.so"))
    text = subprocess.run([build / "elasto-plastic", plugin, str(cycles),
                           *words], text=True, check=True, capture_output=True,
                          env=environment()).stdout
    result = []
    for line in text.splitlines():
        row = json.loads(line)
        inner = row.pop("solve")
        row["assembly"] = row.pop("tangent")
        # Told as wall time; the whole is processor time.
        linear = inner - row["assembly"] - row["residual seconds"]
        setup, solve = row["setup_seconds"], row["solve_seconds"]
        row["preconditioner"] = linear * setup / (setup + solve)
        row["linear iteration"] = linear * solve / (setup + solve)
        # The refinement contains the numbering of the new unknowns.
        row["mesh and unknowns"] = row.pop("refinement",
                                           row["unknowns and pattern"])
        row["residual norm"] = row.pop("residual")
        row["residual"] = row.pop("residual seconds")
        row["assembly calls"] = row["steps"]
        row["seconds"] = inner + row["mesh and unknowns"]
        result.append(row)
    return result


def median(runs):
    """Runs of the same thing as one, times by their medians."""
    result = [dict(row) for row in runs[0]]
    for cycle, row in enumerate(result):
        for name, value in row.items():
            if isinstance(value, float):
                row[name] = statistics.median(r[cycle][name] for r in runs)
    return result


def show(name, rows, reference, shipped):
    print(f"\n{name}")
    print("cycle  cells   dofs     force       error    steps  systems  "
          "iterations  seconds  faster by")
    for cycle, row in enumerate(rows):
        error = abs(row["force"] / reference[cycle]["force"] - 1)
        print(f"{cycle:5d} {row['cells']:7d} {row['dofs']:7d} "
              f"{row['force']:10.5f}  {error:9.1e} {row['steps']:6d} "
              f"{row.get('systems', row['steps']):8d} "
              f"{row['linear_iterations']:11d} {row['seconds']:8.2f} "
              f"{shipped[cycle]['seconds'] / row['seconds']:8.1f}")
    total = sum(row["seconds"] for row in rows)
    print(f"all cycles: {total:.2f} s, faster by "
          f"{sum(row['seconds'] for row in shipped) / total:.1f}")
    last = rows[-1]
    print("last cycle: " + ", ".join(
        f"{part} {last.get(part, 0):.2f} s" for part in PARTS.values())
        + f"; one assembly {last['assembly'] / last['assembly calls']:.3f} s")


def main():
    parser = argparse.ArgumentParser(
        description=__doc__,
        formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--build", type=pathlib.Path, required=True,
                        help="build folder with elasto-plastic and the plugin")
    parser.add_argument("--cycles", type=int, default=5)
    parser.add_argument("--runs", type=int, default=3)
    parser.add_argument("--tolerance", default="1e-4",
                        help="of Newton's method, for the fast runs of Abut")
    arguments = parser.parse_args()
    build = arguments.build.resolve()
    program = build_step_42(build / "step-42")

    def repeat(function, *words):
        return median([function(*words) for _ in range(arguments.runs)])

    def step_42(warm, newton, linear):
        return repeat(run_step_42, program, arguments.cycles, warm, newton,
                      linear)

    def abut(*words):
        return repeat(run_abut, build, arguments.cycles, words)

    shipped = step_42(False, 1e-10, 1e-8)
    fast = ["--tolerance", arguments.tolerance]
    tables = [
        ("step-42 as shipped: from zero on each mesh, residual 1e-10, "
         "linear systems to 1e-8", shipped),
        ("step-42 started from the last mesh", step_42(True, 1e-10, 1e-8)),
        ("step-42 with loose tolerances: residual 1e-2, linear systems 1e-2",
         step_42(False, 1e-2, 1e-2)),
        ("step-42 with both", step_42(True, 1e-2, 1e-2)),
        (f"Abut, error {arguments.tolerance}", abut(*fast)),
        ("Abut from zero on each mesh", abut(*fast, "--cold")),
        ("Abut, linear systems to 1e-8", abut(*fast, "--tight")),
        ("Abut, a preconditioner for each linear system",
         abut(*fast, "--fresh")),
        ("Abut without any of these",
         abut("--tolerance", "1e-12", "--cold", "--tight", "--fresh"))]
    reference = run_abut(build, arguments.cycles, ["--tolerance", "1e-12"])
    for name, rows in tables:
        show(name, rows, reference, shipped)


if __name__ == "__main__":
    main()
