#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Solve decks of other programs and compare with the values that these print.

    tests/verification/verify.py [NAME...] [--abut build/release/abut]
        [--quick] [--report doc/verification.md] [--check doc/verification.md]
        [--keep DIR]

A NAME is a folder of this one, or the beginning of its name or of the part
after the number. Without any, all are solved; with --quick those of a second
or two. --report writes the page, with the other decks as they were; --check
compares the page with the comments of the scenes' tests and with what the solved
decks give: words and reference values must be the same, values found may differ by
their tolerance. --keep leaves scenes, meshes and results in DIR/NAME.

A folder has scene files and deck.py with
    TITLE, SOURCE, PROBLEM, SKETCH   texts of the page
    ELEMENTS    what is the same as in the other program, and what is not
    QUICK       whether it is solved with --quick
    REMARKS     what else is to be said (may be left out)
    OPEN        what was not reached, for the overview (may be left out)
    solve(deck) runs scenes and compares values, see class Deck
Mesh files are written by deck.py, from lengths and numbers of cells (cells.py);
laws in C are in law.c.
"""
import argparse
import csv
import importlib.util
import json
import math
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parent.parent
RUN_SECONDS = 1800
# Differences below this are round-off.
ROUND_OFF = 1e-9


class Result:
    """What a run has written."""

    def __init__(self, folder):
        self.summary = json.loads((folder / "summary.json").read_text())
        self.folder = folder
        file = folder / "nodal.csv"
        self.nodes = self.table("nodal.csv") if file.exists() else []

    def table(self, name):
        with open(self.folder / name, newline="", encoding="utf-8") as file:
            return [{key: float(value) if value else math.nan
                     for key, value in row.items()}
                    for row in csv.DictReader(file)]

    def node(self, body, *place):
        """Row of nodal.csv of the node at a place of the undeformed body."""
        def distance(row):
            return math.dist(place, [row[x] for x in "xyz"[:len(place)]])
        row = min((row for row in self.nodes if row["body"] == body),
                  key=distance)
        if distance(row) > 1e-6 * (1 + max(map(abs, place))):
            raise ValueError(f"body {body} has no node at {place}")
        return row

    def moved(self, body, *place):
        """Displacement of that node."""
        row = self.node(body, *place)
        return [row["displacement_" + x] for x in "xyz"[:len(place)]]

    def free_norm(self):
        """Root of the sum of the squares of all displacements that supports
        do not prescribe."""
        return math.sqrt(sum(
            row["displacement_" + x] ** 2 for row in self.nodes for x in "xyz"
            if "held_" + x in row and row["held_" + x] == 0))

    def strain_energy(self, body):
        """Half the work of all forces on a body, of small strain."""
        return sum(row[force + x] * row["displacement_" + x] / 2
                   for row in self.nodes if row["body"] == body for x in "xyz"
                   for force in ("load_", "contact_", "reaction_")
                   if force + x in row)


class Row:
    """A value of another program and the one found here."""

    def __init__(self, quantity, reference, found, difference, bound, good,
                 verdict):
        self.quantity = quantity
        self.reference = reference
        self.found = found
        self.difference = difference
        self.bound = bound
        self.good = good
        self.verdict = verdict if good else "FAILED"

    def cells(self):
        difference = ("below 1e-9" if self.difference < ROUND_OFF
                      else f"{self.difference:.1e}")
        return [self.quantity, self.reference, f"{self.found:.7g}",
                difference, self.bound, self.verdict]


class Deck:
    """A folder: its texts, its runs, and values compared."""

    def __init__(self, folder):
        self.folder = folder
        self.name = folder.name
        specification = importlib.util.spec_from_file_location(
            "deck_" + re.sub(r"\W", "_", folder.name), folder / "deck.py")
        self.text = importlib.util.module_from_spec(specification)
        specification.loader.exec_module(self.text)
        self.rows = []

    def solve(self, abut, work):
        """Solve it in the folder `work`."""
        self.abut, self.work = abut, work
        work.mkdir(parents=True, exist_ok=True)
        for file in self.folder.iterdir():
            if file.suffix == ".prm":
                shutil.copy(file, work)
        self.text.solve(self)

    def write(self, name, text):
        (self.work / name).write_text(text)

    def compile(self, law):
        """Make the shared object of a law of law.c."""
        subprocess.run(
            ["cc", "-shared", "-fPIC", "-O1", "-I", str(ROOT / "include"),
             f"-DLAW={law.upper()}", str(HERE / "law.c"), "-o", law + ".so", "-lm"],
            cwd=self.work, check=True)

    def run(self, scene="scene.prm", settings=None, codes=(0,), more=()):
        output = "output"
        command = [self.abut, "run", scene, "--output", output, "--quiet",
                   *more]
        for key, value in (settings or {}).items():
            command += ["--set", f"{key}={value}"]
        done = subprocess.run(command, cwd=self.work, text=True,
                              capture_output=True, timeout=RUN_SECONDS)
        if done.returncode not in codes:
            raise RuntimeError(f"{self.name}: {scene} {settings or ''}: exit "
                               f"code {done.returncode}\n{done.stderr}")
        return Result(self.work / output)

    def compare(self, quantity, reference, found, tolerance, scale=None,
                verdict="agrees"):
        """A value that is to be met but for a part `tolerance` of it, or of
        `scale`."""
        scale = abs(reference) if scale is None else scale
        difference = abs(found - reference) / scale
        bound = f"{tolerance:g}"
        if scale != abs(reference):
            bound += f" of {scale:g}"
        self.rows.append(Row(quantity, f"{reference:.10g}", found, difference,
                             bound, difference <= tolerance, verdict))

    def within(self, quantity, others, found, verdict="inside"):
        """A value inside the spread of other programs or methods, the first of
        which is the deck's own, widened by 1e-5. The difference is that to the
        first."""
        low, high = min(others), max(others)
        more = 1e-5 * max(abs(low), abs(high))
        self.rows.append(Row(
            quantity, f"{others[0]:.10g}", found,
            abs(found - others[0]) / abs(others[0]),
            f"{low:.7g} to {high:.7g}", low - more <= found <= high + more, verdict))

    def differs(self, quantity, reference, found, third, tolerance, name):
        """A value that is not met, where a third one, a closed form or another
        program's, decides."""
        difference = abs(found - reference) / abs(reference)
        error = abs(found - third) / abs(third)
        self.rows.append(Row(
            quantity, f"{reference:.10g}", found, difference,
            f"{tolerance:g} of {third:.10g}", error <= tolerance,
            f"differs; {name} decides"))

    def good(self):
        return bool(self.rows) and all(row.good for row in self.rows)

    def verdict(self):
        """Of the whole deck, in some words."""
        verdicts = [row.verdict for row in self.rows]
        words = ("FAILED" if not self.good()
                 else "differs in part, see there"
                 if any(v.startswith("differs") for v in verdicts)
                 else "inside the spread" if "inside" in verdicts
                 else "agrees")
        rest = getattr(self.text, "OPEN", "")
        return f"{words}; {rest}" if rest else words

    def page(self):
        """Its part of the page."""
        text = self.text
        lines = [f"## {self.name.replace('-', ' ', 1)}: {text.TITLE}", "",
                 text.PROBLEM.strip(), "", "```text {show}", text.SKETCH.strip("\n"),
                 "```", "", f"- Source: {text.SOURCE}.",
                 "- Elements and law: "
                 + text.ELEMENTS.strip().replace("\n", "\n  "),
                 f"- Command: `tests/verification/verify.py {self.name}`",
                 "", *table(["value", "reference", "found", "difference",
                             "tolerance", ""],
                            [row.cells() for row in self.rows]), ""]
        remarks = getattr(text, "REMARKS", "").strip()
        return lines + ([remarks, ""] if remarks else [])


def table(head, rows):
    return ["| " + " | ".join(head) + " |", "|" + "---|" * len(head),
            *("| " + " | ".join(row) + " |" for row in rows)]


def folders():
    return sorted(file.parent for file in HERE.glob("[0-9][0-9]-*/deck.py"))


def chosen(names):
    """Folders of these names, or all."""
    result = []
    for name in names:
        some = [folder for folder in folders()
                if folder.name.startswith(name)
                or folder.name.split("-", 1)[1].startswith(name)]
        if not some:
            raise SystemExit(f"There is no deck {name}; there are "
                             + ", ".join(f.name for f in folders()))
        result += some
    return sorted(set(result)) or folders()


def closed_forms():
    """Scenes of the tests with where their figures come from."""
    rows = []
    for file in sorted((ROOT / "tests/scenes").glob("*.json")):
        test = json.loads(file.read_text())
        scene = test.get("scene", "")
        if not scene or "bad-input" in file.stem or not test.get("comment"):
            continue
        comment = " ".join(test["comment"].split()).replace("|", "\\|")
        rows.append([f"`{scene}`", f"`tests/scenes/{file.name}`", comment])
    return rows


HEAD = """# Verification: decks of other programs

Written by `tests/verification/verify.py --report doc/verification.md`; do not edit.

This page compares Abut with values that other programs print for problems of their own. Each problem is a *deck*. Geometry, loads
and values are those of the deck, and the mesh is generated from the geometry. A folder of `tests/verification` has the scene, the
source and the values of each deck. [Closed forms](#closed-forms) are at the end of the page.

| verdict | meaning |
|---|---|
| agrees | the difference is at most the tolerance: 1e-5 for the same element and law of contact, more where the deck states why |
| inside the spread | another element or a soft penalty: the value is within the spread of the methods of other programs |
| differs | the value is not met; a third program or a closed form decides, and the deck has the reason |

`tests/verification/verify.py DECK` solves a deck. The test `verification` solves the quick decks and compares them with this page,
`verification-long` solves the others.
"""

CLOSED = """## Closed forms

The tests of the scenes in `prm` compare with closed forms and with programs that share no code with Abut. Each row is the comment
of a test: where its figures come from, or what is compared.
"""


def report(decks, page):
    """The page, with the parts of decks that were not solved as they were."""
    parts = {part.split(":")[0].replace(" ", "-"): part.rstrip("\n")
             for part in page.split("\n## ")[1:]}
    rows = {line.split("]")[0][3:]: line for line in page.split("\n")
            if line.startswith("| [")}
    for deck in decks:
        parts[deck.name] = "\n".join(deck.page())[3:].rstrip("\n")
        rows[deck.name] = table([], [[
            f"[{deck.name}](#{anchor(deck)})", deck.text.TITLE,
            str(len(deck.rows)), largest(deck), deck.verdict()]])[-1]
    names = [folder.name for folder in folders() if folder.name in parts]
    lines = [HEAD, *table(["deck", "problem", "values", "largest difference",
                           ""], []), *(rows[name] for name in names), ""]
    for name in names:
        lines += ["## " + parts[name], ""]
    lines += [CLOSED, *table(["scene", "test", "figures"], closed_forms())]
    return "\n".join(lines) + "\n"


def anchor(deck):
    title = f"{deck.name.replace('-', ' ', 1)}: {deck.text.TITLE}".lower()
    return re.sub(r"[^\w\- ]", "", title).replace(" ", "-")


def largest(deck):
    worst = max(row.difference for row in deck.rows)
    return "below 1e-9" if worst < ROUND_OFF else f"{worst:.1e}"


def stale(decks, page):
    """Comments of tests, and words and reference values of these decks, that the
    page does not have. Numbers found are compared with their tolerance when they
    are solved."""
    def words(lines):
        # The third and fourth cell of a row of values are those found.
        return [re.sub(r"^(\| .*? \| .*? \|) .*? \| .*? \|", r"\1", line)
                for line in lines]
    text = page.split("\n")
    result = [f"the page has not the comment of {row[1]}" for row in closed_forms()
              if table([], [row])[-1] not in text]
    for deck in decks:
        part = deck.page()
        head = part[0]
        if head not in text:
            result.append(f"{deck.name} is not in the page")
            continue
        begin = text.index(head)
        part = "\n".join(part).split("\n")
        if words(text[begin:begin + len(part)]) != words(part):
            result.append(f"the page of {deck.name} is not what its deck.py "
                          "gives")
    return result


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n")[0])
    parser.add_argument("names", nargs="*", metavar="NAME")
    parser.add_argument("--abut", default=str(ROOT / "build/release/abut"))
    parser.add_argument("--quick", action="store_true")
    parser.add_argument("--long", action="store_true",
                        help="those that --quick leaves out")
    parser.add_argument("--report")
    parser.add_argument("--check")
    parser.add_argument("--keep")
    arguments = parser.parse_args()
    decks = [Deck(folder) for folder in chosen(arguments.names)]
    if arguments.quick or arguments.long:
        decks = [deck for deck in decks if deck.text.QUICK == arguments.quick]
    abut = str(pathlib.Path(arguments.abut).resolve())
    with tempfile.TemporaryDirectory(prefix="abut-verify-") as folder:
        base = pathlib.Path(arguments.keep or folder).resolve()
        for deck in decks:
            deck.solve(abut, base / deck.name)
            print(f"{deck.name}: {deck.verdict()}", flush=True)
            for row in deck.rows:
                print("  " + " | ".join(row.cells()), flush=True)
    failures = [deck.name for deck in decks if not deck.good()]
    if arguments.report:
        page = pathlib.Path(arguments.report)
        page.write_text(report(decks,
                               page.read_text() if page.exists() else ""))
    if arguments.check:
        page = pathlib.Path(arguments.check).read_text()
        failures += stale(decks, page)
    for failure in failures:
        print("FAILED:", failure, file=sys.stderr)
    sys.exit(1 if failures else 0)


if __name__ == "__main__":
    main()
