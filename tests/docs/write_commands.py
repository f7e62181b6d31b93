#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Writes doc/commands.md from `abut help` and `abut chart --parameters`; with --check
compares it.

    tests/docs/write_commands.py --abut build/release/abut [--check]"""
import argparse
import pathlib
import re
import subprocess
import sys

PAGE = pathlib.Path(__file__).resolve().parents[2] / "doc/commands.md"
HEAD = """# Commands

Written by `tests/docs/write_commands.py` from `abut help`; do not edit. Below are the
[parameters of chart files](#parameters-of-a-chart-file).

Each command is `abut COMMAND`. All commands have the same exit codes:

| exit code | meaning |
|---|---|
| 0 | done; of `abut run`: solved |
| 1 | internal error |
| 2 | error in the input, which names file, line and parameter |
| 3 | no reliable result; `abut draw`: nothing to draw |
| 4 | stopped by SIGTERM or SIGINT, go on with `--resume` |

The environment variable `ABUT_PYTHON` names the Python interpreter of `draw`, `report`, `chart` and `atlas`.

"""


CHART = """
## Parameters of a chart file

A chart file also has sections `All curves` and `Curve NAME`, one for each curve. They hold settings of the scene, in
sections as in the scene file. Values separated by ` | ` make a curve each, several such lists are multiplied, and
NAME may then be left out. `Error/Finer run` holds settings in the same way.

"""


def page(abut):
    def print_of(*words):
        return subprocess.run([abut, *words], check=True, text=True,
                              stdout=subprocess.PIPE).stdout

    def help_of(*words):
        return print_of("help", *words)

    names = re.findall(r"^  abut ([a-z]+)", help_of(), re.M)
    if len(names) < 9:
        raise SystemExit(f"'abut help' lists {len(names)} commands only")
    return HEAD + "\n".join(f"## abut {name}\n\n```text {{show}}\n"
                            f"{help_of(name).strip()}\n```\n"
                            for name in names if name != "help") \
        + CHART + print_of("chart", "--parameters")


def main():
    arguments = argparse.ArgumentParser(description=__doc__)
    arguments.add_argument("--abut", type=pathlib.Path, required=True)
    arguments.add_argument("--check", action="store_true", help="compare the page only")
    arguments = arguments.parse_args()
    text = page(arguments.abut.resolve())
    if not arguments.check:
        PAGE.write_text(text, encoding="utf-8")
        return 0
    if PAGE.read_text(encoding="utf-8") == text:
        return 0
    print("doc/commands.md is not what 'abut help' prints: "
          "tests/docs/write_commands.py --abut ABUT")
    return 1


if __name__ == "__main__":
    sys.exit(main())
