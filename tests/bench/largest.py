#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""The largest scene that the machine holds, and what its memory is made of.

Runs a scene on finer and finer meshes, on one rank, until the next one would
need more memory than is free (eight times as many unknowns in space, four times
in the plane), or a run takes too long. Printed are unknowns, contact points,
seconds on the wall, the peak of memory, and bytes per unknown: in all, and by
part, as far as it raised the peak (what a part takes out of what others gave
back does not show).

    tests/bench/largest.py build/release/abut prm/two-blocks-3d.prm \\
        --from 2 --to 5 --seconds 600
"""
import measured

PARTS = ["mesh", "unknowns and pattern", "assembly", "contact rows", "solve",
         "transfer", "results"]


def free_bytes():
    """What Linux says that a new program can have."""
    with open("/proc/meminfo", encoding="ascii") as file:
        for line in file:
            if line.startswith("MemAvailable:"):
                return 1024 * int(line.split()[1])
    raise RuntimeError("no MemAvailable in /proc/meminfo")


def row_of(level, summary):
    n = summary["dofs"]
    mib = {name: section.get("memory_mb", 0.)
           for name, section in summary["sections"].items()
           if "/" not in name}
    parts = {name: mib.pop(name, 0.) for name in PARTS}
    rest = summary["peak_memory_mb"] - sum(parts.values())
    cells = [level, n, summary["constraints"],
             f"{summary['wall_seconds']:.1f}",
             f"{summary['peak_memory_mb']:.0f}"]
    return cells + [f"{2**20 * value / n:.0f}" for value in (
        summary["peak_memory_mb"], *parts.values(), rest)]


def main():
    parser = measured.options(__doc__)
    parser.add_argument("scene")
    parser.add_argument("--from", type=int, default=2, dest="first")
    parser.add_argument("--to", type=int, default=9)
    parser.add_argument("--seconds", type=float, default=3600,
                        help="no larger one after a run that took so long")
    measured.add_set(parser)
    options = parser.parse_args()
    measured.head(["level", "unknowns", "points", "s", "peak, MiB", "bytes per "
                   "unknown", *PARTS, "program and others"])
    for level in range(options.first, options.to + 1):
        summary = measured.Run(options.abut, options.scene, {
            **measured.SILENT, "Refinement/Level": level}, options.set).summary
        measured.row(row_of(level, summary))
        next_bytes = (2**summary["dimension"] * 2**20
                      * summary["peak_memory_mb"])
        if summary["wall_seconds"] > options.seconds:
            print("The next one would take too long.")
            return
        if next_bytes > free_bytes():
            print(f"The next one needs some {next_bytes / 1e9:.0f} GB, of "
                  f"which {free_bytes() / 1e9:.0f} are free.")
            return


if __name__ == "__main__":
    main()
