#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Work to a target error beside the habit: uniform meshes, tight tolerances.

For each scene `Refinement/Target error` is set and the run's meshes, steps and
tolerances are left to the program. The habit is one solve from displacement 0 on
the coarsest uniform mesh whose true error is within the same target (so that
nothing is counted for finding this mesh), with all tolerances at 1e-10. Both
solve by conjugate gradients with ML, and write nothing.

Work is the sum of unknowns times matrix-vector products over all meshes; beside
it processor seconds without output and error norms. The true error, in the norm
of the strain energy, is that against the exact solution; where there is none, it
follows from the energy J of a much finer run, sqrt((J - J0) / J0), for scenes
without loads.

    tests/bench/economy.py build/release/abut [SCENE...]
"""
import math
import pathlib
import sys

import measured

ITERATIVE = {"Solver/Linear solver": "iterative"}
HABIT = {"Refinement/Nested iteration": "false",
         "Refinement/Adaptive cycles": "0", "Method/Linear tolerance": "1e-10",
         "Method/Final linear tolerance": "1e-10"}
LEVEL = "Refinement/Level"

# scene: target, first level of the habit, settings of the finer run (none:
# exact solution), times less work asked for
SCENES = {
    "flat-obstacle": (0.02, 5, None, 1.5),
    "curved-obstacle": (0.01, 5, {LEVEL: "5", "Refinement/Adaptive cycles": "14"},
                        5),
    "hertz-2d": (0.02, 5, {"Solid/Degree": "2",
                           "Refinement/Adaptive cycles": "12"}, 5),
    "two-blocks-3d": (0.05, 1, {"Solid/Degree": "2", LEVEL: "1",
                                "Refinement/Adaptive cycles": "5"}, 5),
}


class Run(measured.Run):
    """One run of a scene, and what it cost."""

    def __init__(self, abut, scene, settings):
        super().__init__(abut, scene, {**measured.SILENT, **settings})
        self.work = sum(float(mesh["dofs"]) * float(mesh["matvecs"])
                        for mesh in self.levels)
        self.dofs = self.summary["dofs"]
        self.energy = self.summary["energy"]
        self.cost = self.summary["processor_seconds"] - sum(
            self.seconds(name, "processor_seconds")
            for name in ("results", "output"))

    def error(self, reference):
        """Relative error, from the run itself or a finer run's energy."""
        if reference is not None:
            return math.sqrt(abs(self.energy / reference - 1))
        # The norm of the flat obstacle's exact solution.
        return self.summary["h1_error"] / 1.85777049


def compare(abut, scene, name):
    """A row of the table: does the target, by how much less work."""
    target, level, finer, wanted = SCENES[name]
    reference = Run(abut, scene, finer).energy if finer else None
    economy = Run(abut, scene, {**ITERATIVE,
                                "Refinement/Target error": str(target)})
    while True:
        habit = Run(abut, scene, {**ITERATIVE, **HABIT, LEVEL: str(level)})
        if habit.error(reference) <= target:
            break
        level += 1
    error = economy.error(reference)
    times = habit.work / economy.work
    good = error <= target and times >= wanted
    print(f"| {name} | {target} | {error:.2g} | {economy.dofs} | "
          f"{economy.work / 1e6:.3g} | {economy.cost:.2g} | "
          f"{habit.error(reference):.2g} | {habit.dofs} | "
          f"{habit.work / 1e6:.3g} | {habit.cost:.2g} | {times:.1f} | "
          f"{habit.cost / economy.cost:.1f} | "
          f"{'yes' if good else 'no'}, {wanted} |", flush=True)
    return good


def main():
    parser = measured.options(__doc__)
    parser.add_argument("scenes", nargs="*", default=list(SCENES))
    arguments = parser.parse_args()
    folder = pathlib.Path(__file__).resolve().parents[2] / "prm"
    columns = ["scene", "target", "error", "unknowns", "work, 1e6", "s",
               "habit: error", "unknowns", "work, 1e6", "s", "times less work",
               "times less s", "as wanted"]
    measured.head(columns)
    good = [compare(arguments.abut, str(folder / (name + ".prm")), name)
            for name in arguments.scenes]
    return 0 if all(good) else 1


if __name__ == "__main__":
    sys.exit(main())
