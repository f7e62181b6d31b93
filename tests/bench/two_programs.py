#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Processor time of scenes, by two programs in turn.

Each program runs the scene of its own source tree, in pairs; writes the median
ratio of the second program to the first, the range of it, and the medians of
both in seconds.

    tests/bench/two_programs.py OLD/build/release/abut build/release/abut \
        ironing ironing-3d two-balls
"""
import os
import pathlib
import statistics
import tempfile

import measured


def seconds(program, scene, settings):
    """User and system time of one run."""
    source = program.resolve().parents[2]
    with tempfile.TemporaryDirectory() as folder:
        before = os.times()
        measured.call(program, ["run", "--quiet", "--output", folder],
                      source / "prm" / f"{scene}.prm", settings)
        after = os.times()
    return (after.children_user - before.children_user
            + after.children_system - before.children_system)


def main():
    parser = measured.options(__doc__)
    parser.add_argument("other", type=pathlib.Path, help="the second program")
    parser.add_argument("scenes", nargs="+", help="names in prm/")
    parser.add_argument("--pairs", type=int, default=5)
    measured.add_set(parser)
    arguments = parser.parse_args()
    programs = [pathlib.Path(arguments.abut), arguments.other]
    measured.head(["scene", "ratio", "range", "first, s", "second, s"])
    for scene in arguments.scenes:
        times = [[seconds(
            program, scene, ["Output/Pictures=false", *arguments.set])
                  for program in programs] for _ in range(arguments.pairs)]
        ratios = [second / first for first, second in times]
        measured.row([scene, f"{statistics.median(ratios):.3f}",
                      f"{min(ratios):.3f} to {max(ratios):.3f}"]
                     + [f"{statistics.median(column):.2f}"
                        for column in zip(*times)])


main()
