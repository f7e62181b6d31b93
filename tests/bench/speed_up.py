#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Seconds of a scene on one rank and on several, part by part.

Runs the scene alternately on each number of ranks, and
writes the medians: seconds on the wall, and how many times as fast as on
the first number of ranks. Before each run it waits until other programs have
left the cores; the last line says how idle they were.

    tests/bench/speed_up.py build/release/abut prm/two-blocks-3d.prm \
        --set Refinement/Level=4
"""
import os
import statistics
import time

import measured

SECTIONS = ["mesh", "unknowns and pattern", "assembly", "contact rows",
            "solve", "transfer"]
IDLE = 0.97
SECONDS_TO_WAIT = 60


def idle_share(seconds=1.0):
    """Share of the time of all cores in which nothing ran."""

    def ticks():
        with open("/proc/stat") as file:
            words = [int(word) for word in file.readline().split()[1:9]]
        return words[3] + words[4], sum(words)

    idle, total = ticks()
    time.sleep(seconds)
    idle_after, total_after = ticks()
    return (idle_after - idle) / max(total_after - total, 1)


def wait_for_cores():
    """How idle the cores are once they are, or after a minute."""
    end = time.monotonic() + SECONDS_TO_WAIT
    share = idle_share()
    while share < IDLE and time.monotonic() < end:
        share = idle_share()
    return share


def run(arguments, ranks):
    one = measured.Run(arguments.abut, arguments.scene, measured.SILENT,
                       arguments.set, ranks)
    seconds = {name: one.seconds(name) for name in SECTIONS}
    seconds["all of these"] = sum(seconds.values())
    seconds["iterations"] = sum(int(step["linear_iterations"])
                                for step in one.steps)
    return seconds


def main():
    parser = measured.options(__doc__)
    parser.add_argument("scene")
    parser.add_argument("--ranks", type=int, nargs="+", default=[1, 2])
    parser.add_argument("--repeats", type=int, default=5)
    measured.add_set(parser)
    arguments = parser.parse_args()

    runs = {ranks: [] for ranks in arguments.ranks}
    idle = []
    for _ in range(arguments.repeats):
        for ranks in arguments.ranks:
            idle.append(wait_for_cores())
            runs[ranks].append(run(arguments, ranks))

    first = arguments.ranks[0]
    measured.head(["part"] + [f"{ranks} ranks, s" for ranks in arguments.ranks]
                  + [f"times as fast on {ranks}"
                     for ranks in arguments.ranks[1:]])
    for name in runs[first][0]:
        middle = [statistics.median(one[name] for one in runs[ranks])
                  for ranks in arguments.ranks]
        if name == "iterations":
            measured.row([name] + [f"{n:.0f}" for n in middle]
                         + [""] * (len(middle) - 1))
        else:
            measured.row([name] + [f"{s:.2f}" for s in middle]
                         + [f"{middle[0] / max(s, 1e-9):.2f}"
                            for s in middle[1:]])
    print(f"\n{os.cpu_count()} cores, idle before each run for at least "
          f"{100 * min(idle):.0f} % of a second")


if __name__ == "__main__":
    main()
