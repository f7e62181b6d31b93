#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Linearisations of a die that is pressed into a block and slides on it.

Prints, for each discretisation and way of sliding, the mean number of
linearisations of a load step and the largest one, in steps of .93 and 3.7 facets
and with and without friction. Ten more load steps, of the pressing, count, too.

    tests/bench/newton_counts.py build/release/abut
"""
import pathlib
import statistics
import subprocess
import sys
import tempfile

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "app"))
from program import Folder  # noqa: E402
from sliding_scenes import newton, press_and_slide  # noqa: E402

WAYS = {"dual mortar": [], "mortar": ["Method/Discretisation=mortar"],
        "dual mortar, saddle point": ["Method/System=saddle point"],
        "nodes": ["Method/Discretisation=node to segment"]}
# Where each lasts: steps of .93 and 3.7 facets.
SCENES = {"standard": (22, 5, {}), "hard, stiff die": (8, 2, {"hard": True}),
          "hard, soft die": (8, 2, {"hard": True, "die_young": 1})}


def counts(abut, folder, n, scene, words):
    """Linearisations by load step, with those of attempts that were given up,
    or why it ended."""
    name = press_and_slide(folder, n, **scene)
    run = subprocess.run(
        [abut, "run", name, "--output", "out", "--quiet",
         "--set", "Time stepping/Newton tolerance=1e-9",
         *(word for each in words for word in ("--set", each))],
        cwd=folder.folder, capture_output=True, text=True, check=False)
    if run.returncode != 0:
        return "; ".join(line[:60] for line in run.stderr.splitlines()
                         if line.startswith("abut: "))
    with open(folder.folder / "out/levels.csv", encoding="utf-8") as file:
        n_steps = len(file.readlines()) - 1
    return [len(newton(folder, step)) for step in range(1, 1 + n_steps)]


def main():
    if len(sys.argv) != 2:
        raise SystemExit(__doc__)
    abut = pathlib.Path(sys.argv[1]).resolve()
    with tempfile.TemporaryDirectory() as name:
        folder = Folder(name)
        for scene, (small, large, settings) in SCENES.items():
            for way, words in WAYS.items():
                for mu in (0., 0.3):
                    friction = [f"Pair 1/Friction={mu}"] if mu else []
                    for n in (small, large):
                        found = counts(abut, folder, n, settings,
                                       words + friction)
                        text = found if isinstance(found, str) else (
                            f"{statistics.mean(found):.1f}, at the most "
                            f"{max(found)}, in {len(found)} load steps")
                        print(f"{scene}; {way}; mu = {mu}; {n} steps: {text}",
                              flush=True)


if __name__ == "__main__":
    main()
