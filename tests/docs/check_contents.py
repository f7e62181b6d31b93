#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Each page of doc is in one tree of doc/contents.md, without which the site fails,
and each entry there is a page. Development notes are in the tree of their index."""
import pathlib
import re
import sys

DOC = pathlib.Path(__file__).resolve().parents[2] / "doc"


def main():
    text = (DOC / "contents.md").read_text(encoding="utf-8")
    entries = [re.sub(r".*<(.*)>$", r"\1", line)
               for tree in re.findall(r"^```\{toctree\}$(.*?)^```$", text, re.M | re.S)
               for line in tree.split("\n") if line and not line.startswith(":")]
    pages = [str(page.relative_to(DOC))[:-3] for page in DOC.rglob("*.md")
             if page.relative_to(DOC).parts[0] not in ("develop", "examples", "contents.md")]
    pages.append("develop/index")
    faults = [f"{page}.md is in no tree of doc/contents.md"
              for page in sorted(set(pages) - set(entries))]
    faults += [f"doc/contents.md: there is no page {entry}"
               for entry in sorted(set(entries) - set(pages))]
    faults += [f"doc/contents.md: {entry} is there twice"
               for entry in sorted(set(entries)) if entries.count(entry) > 1]
    index = (DOC / "develop/index.md").read_text(encoding="utf-8")
    faults += [f"doc/develop/index.md does not list {page.name}"
               for page in sorted((DOC / "develop").glob("*.md"))
               if f"]({page.name})" not in index and page.name != "index.md"]
    print(*faults, sep="\n")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
