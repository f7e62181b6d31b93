#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Lines of the core that its tests have run, from what gcov counted: a table by
folder, and the others by name. See .ci/coverage.

    coverage.py BUILD [LEAST]
"""
import collections
import json
import pathlib
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]


def counted(build):
    """How often each line of each source ran."""
    lines = collections.defaultdict(collections.Counter)
    for data in sorted((build / "plugin/core").rglob("*.gcda")):
        text = subprocess.run(["gcov", "--json-format", "--stdout", data],
                              cwd=build, check=True, capture_output=True,
                              text=True).stdout
        for unit in filter(None, text.splitlines()):
            for file in json.loads(unit)["files"]:
                path = (build / file["file"]).resolve()
                if ROOT / "plugin/core" not in path.parents:
                    continue
                name = str(path.relative_to(ROOT / "plugin/core"))
                # A function of several versions counts once.
                for line in file["lines"]:
                    lines[name][line["line_number"]] += line["count"]
    return lines


def ranges(numbers):
    """1-3, 7"""
    parts = []
    for n in sorted(numbers):
        if parts and n == parts[-1][1] + 1:
            parts[-1][1] = n
        else:
            parts.append([n, n])
    return ", ".join(f"{a}-{b}" if b > a else str(a) for a, b in parts)


def main():
    build = pathlib.Path(sys.argv[1]).resolve()
    least = float(sys.argv[2]) if len(sys.argv) > 2 else 95.
    lines = counted(build)
    table = collections.defaultdict(lambda: [0, 0])
    for name, counts in lines.items():
        for row in (name.split("/")[0], "all"):
            table[row][0] += len(counts)
            table[row][1] += sum(n > 0 for n in counts.values())
    print("| folder | lines | run | |\n|---|---|---|---|")
    for row in [*sorted(set(table) - {"all"}), "all"]:
        n, run = table[row]
        print(f"| {row} | {n} | {run} | {100 * run / n:.1f} % |")
    for name, counts in sorted(lines.items()):
        missing = [line for line, n in counts.items() if n == 0]
        if missing:
            print(f"{name}: {ranges(missing)}")
    n, run = table["all"]
    return 0 if n > 3000 and run >= least / 100 * n else 1


if __name__ == "__main__":
    sys.exit(main())
