#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""doc/develop/extend.md says which files an addition touches: it must be all that name
the example. And what tables are for is not asked by number elsewhere."""
import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]

# Who may name flags and outer iterations of laws: the laws themselves, the table
# of outer iterations, and the check of users' laws.
LAWS = re.compile(r"^(include/abut/(user_)?law\.h|plugin/core/law/.*"
                  r"|plugin/core/strategy/outer_table\.c|plugin/shim/user_law\.cc)$")
FLAG = re.compile(r"\bABUT_(OUTER_[A-Z]|LAW_(HARD|INTERIOR|SLACK|STRESS))")
# Comparisons with one entry of a table.
COMPARED = re.compile(r"[=!]=\s*ABUT_(DISCRETISATION|KINEMATICS|OUTER)_(?!N\b)[A-Z]"
                      r"|case ABUT_(DISCRETISATION|KINEMATICS|OUTER)_")


def sources():
    for folder in ("plugin", "include"):
        for path in sorted((ROOT / folder).rglob("*")):
            if path.suffix in (".c", ".h", ".cc"):
                yield str(path.relative_to(ROOT)), path.read_text()


def rows():
    """(what, files, expression) of each row of the table."""
    for line in (ROOT / "doc/develop/extend.md").read_text().splitlines():
        cells = [cell.strip() for cell in re.split(r"(?<!\\)\|", line)][1:-1]
        if len(cells) != 4 or not cells[3].startswith("`"):
            continue
        yield (cells[0], set(re.findall(r"`([^`]+)`", cells[2])),
               re.compile(cells[3].strip("`").replace("\\|", "|")))


def main():
    texts = dict(sources())
    good = True
    n = 0
    for what, files, expression in rows():
        n += 1
        found = {name for name, text in texts.items() if expression.search(text)}
        print(f"{what}: {len(found)} files")
        for name in sorted(found - files):
            print(f"FAILED: {name} knows it, too; doc/develop/extend.md does not say so")
        for name in sorted(files - found):
            print(f"FAILED: {name} does not know it; doc/develop/extend.md says so")
        good &= found == files and len(files) <= 5
    for name, text in texts.items():
        for k, line in enumerate(text.splitlines(), 1):
            if ((FLAG.search(line) and not LAWS.match(name))
                    or (COMPARED.search(line) and name != "include/abut/law.h"
                        and not LAWS.match(name))):
                print(f"FAILED: {name}:{k} asks for one entry: {line.strip()}")
                good = False
    if n < 6:
        print("FAILED: doc/develop/extend.md has no table")
    return 0 if good and n >= 6 else 1


if __name__ == "__main__":
    sys.exit(main())
