#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Calls of the core that may ask a context for memory, which are those that get
a context or an object to change: each is in tests/core/test_scarce_memory.c,
where every request for memory is refused in turn."""
import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
OBJECT = re.compile(r"(?<!const )\babut_(context|surface|search|pairs|detection"
                    r"|coupling|interface|points|obstacle|history|strategy|multigrid) \*")
CALL = re.compile(r"ABUT_API\s+abut_status\s+(abut_\w+?)(?:_sized)?\(([^;]*)\);")


def calls():
    for header in sorted((ROOT / "include/abut").glob("*.h")):
        for name, arguments in CALL.findall(header.read_text()):
            if OBJECT.search(" ".join(arguments.split())):
                yield header.name, name


def main():
    test = (ROOT / "tests/core/test_scarce_memory.c").read_text()
    found = list(calls())
    missing = [f"{name} ({header})" for header, name in found
               if not re.search(rf"\b{name}\(", test)]
    for each in missing:
        print(f"tests/core/test_scarce_memory.c does not call {each}")
    print(f"{len(found)} calls may ask for memory")
    # What is looked for is there at all.
    return 1 if missing or len(found) < 40 else 0


if __name__ == "__main__":
    sys.exit(main())
