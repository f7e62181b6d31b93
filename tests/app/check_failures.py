# SPDX-License-Identifier: LGPL-2.1-or-later
"""Entries of the failure atlas show what their files expect, and the page
doc/failures.md has the numbers that they show: each third of them is a test of
its own (--part 1, 2 or 3); a short run takes every other one of a part."""
import math
import re

from program import Program

p = Program()
failures = p.source / "prm/failures"


def numbers(page):
    """What is measured, by title of the entry and name: failing and cured."""
    result = {}
    for part in re.split(r"^## ", page, flags=re.M)[1:]:
        title = part.split("\n", 1)[0]
        for name, *values in re.findall(
                r"^\| `(.*?)` \| (.*?) \|.*?\| (\S*) \|[^|]*\|$", part, re.M):
            result[title, name] = values
    return result


# What depends on the multigrid of the Trilinos stack, too.
OF_MULTIGRID = {"condition", "linear_iterations"}


def same(name, one, other):
    """Three digits are printed, and small numbers are round-off."""
    try:
        a, b = float(one), float(other)
    except ValueError:
        return one == other
    return (math.isclose(a, b, rel_tol=0.1 if name in OF_MULTIGRID else 0.02)
            or max(abs(a), abs(b)) < 1e-8)


# What is not determined is decided by round-off, and so by the processor: only
# what its file expects.
UNDETERMINED = "ABUT-F01"

names = sorted(file.name.replace(".cure.prm", "")
               for file in failures.glob("*.cure.prm"))
p.expect(len(names) >= 20, f"{len(names)} entries only")
written = numbers((p.source / "doc/failures.md").read_text())
for name in names[p.part - 1::3 * (2 if p.short else 1)]:
    result = p.call("atlas", failures / f"{name}.prm", "--output", name,
                    "--no-pictures",
                    timeout=900)
    p.expect(result.returncode == 0,
             f"{name}: {result.stdout}{result.stderr}")
    found = numbers((p.folder / name / "failures.md").read_text())
    p.expect(found, f"{name}: no numbers on its page")
    for key, values in found.items():
        first = 1 if key[0].startswith(UNDETERMINED) else 0
        p.expect(all(same(key[1], *pair) for pair in
                     zip(values[first:],
                         written.get(key, ["", ""])[first:])),
                 f"doc/failures.md: {key}: {written.get(key)} is {values}: "
                 "write it by abut atlas")
p.finish()
