#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Parameters and sections that the pages of the manual name are in the reference,
doc/parameters.md: `Section/Name = value`, `Name` with a capital letter, and
--set "Section/Name=value"."""
import pathlib
import re
import sys

DOC = pathlib.Path(__file__).resolve().parents[2] / "doc"
NAMES = re.compile(
    r"`(?:[A-Z][\w ]*/)?(?P<word>[A-Z][a-z]+(?: [a-z]+)*)(?: = [^`]*)?`"
    r"|--set \"?[A-Z][\w ]*/(?P<set>[^=\"\n]+)="
    r"|^\s*set (?P<line>[A-Z][a-z]+(?: [a-z]+)*) *= ", re.M)


def main():
    reference = (DOC / "parameters.md").read_text(encoding="utf-8")
    known = set(re.findall(r"^- (?:<a id=.*?</a>)?\*\*([^*]+)\*\*", reference, re.M))
    known |= {word for title in re.findall(r"^### (.*?)(?: \(.*)?$", reference, re.M)
              for word in title.split("/")}
    pages = [page for folder in ("theory", "lecture", "howto")
             for page in sorted((DOC / folder).glob("*.md"))]
    found, faults = 0, []
    for page in pages:
        # Files of charts have parameters of their own.
        text = re.sub(r"^```prm[^\n]*\n(?=(?:(?!```).*\n)*?set Scene file)"
                      r"(?:(?!```).*\n)*```", "",
                      page.read_text(encoding="utf-8"), flags=re.M)
        for name in NAMES.finditer(text):
            word = (name["word"] or name["set"] or name["line"]).strip()
            found += 1
            if word not in known:
                faults.append(f"{page.relative_to(DOC)}: no parameter {word}")
    print(*faults, sep="\n")
    print(f"{found} names, {len(known)} parameters")
    return 1 if faults or found < 100 or len(known) < 100 else 0


if __name__ == "__main__":
    sys.exit(main())
