#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""What contact costs a motion in 3D.

A cube is thrown on another one that is held below, a step being the time that a
wave needs for an element. Three runs on each mesh: the cubes have no pair, they
have one but are not in reach of each other, and they touch all the time. Processor
seconds are those of a step; shares are parts of all that is done in steps, files
and pictures left out: `contact rows` are searches, pairs, normals, gaps
and weights, `assembly` is that of bodies and loads.

    tests/bench/motion_cost.py build/release/abut
"""
import pathlib
import tempfile

import measured

SCENE = """set Scene = solid
set Dimension = 3
subsection Solid
  set Bodies = 2
{pairs}
end
subsection Body 1
  subsection Mesh
    set Generator = subdivided_hyper_rectangle
    set Arguments = {cells} : 0, 0, {gap} : 1, 1, {top} : true
  end
  set Density = 1
  set Initial velocity = 0, 0, -0.01
end
subsection Body 2
  subsection Mesh
    set Generator = subdivided_hyper_rectangle
    set Arguments = {other} : 0, 0, -1 : 1, 1, 0 : true
  end
  set Density = 1
  set Support = 4: 0, 0, 0
end
{pair}subsection Time
  set Scheme = {scheme}
  set Step = {step}
  set End = {end}
end
subsection Refinement
  set Level = 0
end
"""
PAIR = """subsection Pair 1
  set Secondary = 1: 4
  set Primary = 2: 5
end
"""
CASES = (("no pair", False, 0.), ("out of reach", True, 2.), ("touch", True, 0.))
WORK = ("assembly", "contact rows", "solve", "results")


def run(arguments, cells, scheme, has_pair, gap):
    step = 1. / cells
    text = SCENE.format(
        cells=", ".join([str(cells)] * 3), other=", ".join([str(cells + 1)] * 3),
        gap=gap, top=gap + 1, step=step, end=step * arguments.steps,
        scheme=scheme, pairs="  set Pairs = 1" if has_pair else "",
        pair=PAIR if has_pair else "")
    with tempfile.TemporaryDirectory() as folder:
        scene = pathlib.Path(folder) / "cubes.prm"
        scene.write_text(text)
        return measured.Run(arguments.abut, scene, measured.SILENT,
                            arguments.set)


def main():
    parser = measured.options(__doc__)
    parser.add_argument("--cells", default="6,10,16",
                        help="of the edge of the cube that is thrown")
    parser.add_argument("--steps", type=int, default=10)
    parser.add_argument("--schemes", default="hht,contact stabilised")
    measured.add_set(parser)
    arguments = parser.parse_args()
    measured.head(["scheme", "unknowns", "case", "s per step", "systems per step",
                   "contact rows", "assembly", "both", "force at the end"])
    for scheme in arguments.schemes.split(","):
        for cells in [int(word) for word in arguments.cells.split(",")]:
            for name, has_pair, gap in CASES:
                one = run(arguments, cells, scheme, has_pair, gap)
                steps = one.summary["load_steps"]
                seconds = {part: one.seconds(part, "processor_seconds")
                           for part in WORK}
                whole = sum(seconds.values())
                systems = sum(float(row["steps"] or 0) for row in one.levels)
                rows, assembly = seconds["contact rows"], seconds["assembly"]
                measured.row([scheme, one.summary["dofs"], name,
                              f"{whole / steps:.3g}", f"{systems / steps:.2f}",
                              f"{100 * rows / whole:.1f} %",
                              f"{100 * assembly / whole:.1f} %",
                              f"{100 * (rows + assembly) / whole:.1f} %",
                              f"{one.summary['contact_force'] or 0:.3g}"])


if __name__ == "__main__":
    main()
