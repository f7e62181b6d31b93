#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""What a thousand load steps cost besides what they solve.

Two blocks whose meshes do not match (prm/patch-2d.prm) are pressed together in
many load steps, once in ten and once in a thousand. Printed are the parts of
the processor time, the part of contact outside linear systems (its section
`contact rows`) in all of it and in what a step solves, and how much larger the peak of memory is after a
thousand steps than after ten.

With --slide it is a die that slides to and fro on a block
(tests/bench/sliding-block.prm), and printed is what its detection takes, too.

    thousand_steps.py ABUT [--slide] [--steps N] [--set SECTION/NAME=VALUE]
"""
import measured

SCENE = "prm/patch-2d.prm"
# Without the errors against its exact solution, which nobody asks of such a run.
MESH = {"Refinement/Level": 4, "Exact solution/Displacement": ""}


SLIDING = "tests/bench/sliding-block.prm"


def run(abut, slide, steps, more):
    settings = {"Time stepping/Number of steps": steps}
    settings |= {"Time stepping/End time": steps} if slide else MESH
    return measured.Run(abut, SLIDING if slide else SCENE,
                        {**measured.SILENT, **settings}, more)


def print_detection(summary, seconds):
    print(f"\ndetection {summary['detection_seconds']:.3f} s, "
          f"{100 * summary['detection_seconds'] / seconds:.1f} % of what steps "
          f"take; lists made anew for {summary['searches']} of "
          f"{summary['searches'] + summary['search_reuses']} questions, in "
          f"{summary['linearisations']} linearisations; contact elements "
          f"gained {summary['elements_gained']}, lost "
          f"{summary['elements_lost']}, exchanged "
          f"{summary['elements_exchanged']}")


def main():
    parser = measured.options(__doc__)
    parser.add_argument("--steps", type=int, default=1000)
    parser.add_argument("--slide", action="store_true")
    measured.add_set(parser)
    options = parser.parse_args()
    few = run(options.abut, options.slide, 10, options.set)
    many = run(options.abut, options.slide, options.steps, options.set)
    total = many.summary["processor_seconds"]
    measured.head(["part", "processor seconds", "share"])
    for name in many.summary["sections"]:
        seconds = many.seconds(name, "processor_seconds")
        measured.row([name, f"{seconds:.3f}", f"{100 * seconds / total:.1f} %"])
    measured.row(["all", f"{total:.3f}", "100 %"])
    contact, *rest = (many.seconds(name, "processor_seconds")
                      for name in ("contact rows", "assembly", "solve"))
    memory = [r.summary["peak_memory_mb"] for r in (few, many)]
    print(f"\n{many.summary['dofs']} unknowns, {options.steps} steps: contact "
          f"outside linear systems {100 * contact / total:.1f} % of the time, "
          f"{100 * contact / (contact + sum(rest)):.1f} % without mesh and "
          f"results; peak memory {memory[0]:.1f} MB after 10 steps, {memory[1]:.1f} MB after "
          f"{options.steps}, "
          f"{1e6 * (memory[1] - memory[0]) / options.steps:.0f} bytes a step")
    if options.slide:
        print_detection(many.summary, contact + sum(rest))


if __name__ == "__main__":
    main()
