#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""What the documents tell a reader to run is there and can be run: programs of
tests/ and .ci/ at the beginning of a command, in the text or a block of code."""
import os
import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]

# With arguments in the text; by itself in a block, which is indented or fenced.
COMMANDS = [re.compile(r"`((?:tests|\.ci)/[\w./-]+) [^`]"),
            re.compile(r"^(?:    |[A-Z]=')?((?:tests|\.ci)/[\w./-]+)(?: |'|$)", re.M)]


def fault(name):
    path = ROOT / name
    if not path.is_file():
        return "there is no such file"
    if not os.access(path, os.X_OK):
        return "it is not executable"
    if path.read_bytes()[:2] != b"#!":
        return "it does not say which interpreter runs it"
    return None


def main():
    texts = [ROOT / "README.md", *sorted((ROOT / "doc").rglob("*.md"))]
    found = {(name, text.relative_to(ROOT)) for text in texts
             for pattern in COMMANDS
             for name in pattern.findall(text.read_text(encoding="utf-8"))}
    bad = [(name, text, why) for name, text in sorted(found)
           if (why := fault(name))]
    for name, text, why in bad:
        print(f"{text}: {name}: {why}")
    if len(found) < 20:
        print(f"only {len(found)} commands were found in the documents")
        return 1
    return 1 if bad else 0


if __name__ == "__main__":
    sys.exit(main())
