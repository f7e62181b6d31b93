#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Run a scene and compare its results with figures known beforehand.

    run_scene.py --abut build/release/abut tests/scenes/NAME.json [--keep DIR]
                 [--served build/release/abut]

An expectation file holds these keys; `cases` holds a list of objects with the
same keys, each of which is merged over the top ones and run by itself.

    scene     scene file, from the top of the repository
    comment   where the figures come from
    set       {"Section/Name": value}: overrides on the command line
    replace   {"old text": "new text"}: edit a copy of the scene file; each old
              text must occur once
    arguments what to run instead of a scene
    blocked   true: the output folder cannot be created (a file is in the way)
    ranks     [1, 2, 3]: numbers of MPI processes; default [1]
    exit      exit code; default 0
    stderr    regular expression that must match exactly one line of stderr
    stdout    regular expression that must be found in the output
    absent    {"stdout": ..., "stderr": ..., "files": [...]}: what must not be
              there
    files     names of files that must have been written and not be empty
    summary   {key: check} for summary.json
    tables    {file: {"where": {column: value}, "columns": {column: check},
              "rows": check}} for levels.csv and steps.csv; a column is
              compared as a list; or a list of such for a file
    agree     {key: relative tolerance}: summary of every number of ranks
              against that of the first
    orders    {key: {"min": a, "max": b}}: log2 of the ratio of consecutive
              cases' values of a summary key, all but the first `skip` of them;
              "of": v compares |value - v| instead of the value; "entry": i
              takes the i-th entry of a list
    extrapolated {key: check}: twice a summary key of the last case less that
              of the one before, where the increment is halved from case to
              case and the error is first order in it
    same      {"as": name of a case before, "keys": {key: relative tolerance}}:
              summary against that of the other case
    relations {key: {"of": other key, "factor": f, "relative": r}}: a value of
              summary.json is f times another one

A check is a value (must be equal), a list of values, or an object with some of
value, relative, absolute, min, max; "relative" and "absolute" without the
other leave that one 0. A list with one entry may stand for its entry, and null
in a list for any entry.
"""
import argparse
import csv
import json
import math
import os
import pathlib
import re
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
sys.path.insert(0, str(ROOT / "plugin/tools"))
from abut_tools.served import Served  # noqa: E402

RUN_SECONDS = 900


class Faults(list):
    """What is wrong, collected over all runs."""

    def expect(self, condition, text):
        if not condition:
            self.append(text)


def scalar(value):
    """The entry of a list of one."""
    while isinstance(value, list) and len(value) == 1:
        value = value[0]
    return value


def close(value, wanted, relative=0.0, absolute=0.0):
    """Whether value equals wanted within the tolerances."""
    value, wanted = scalar(value), scalar(wanted)
    if isinstance(wanted, list):
        return (isinstance(value, list) and len(value) == len(wanted)
                and all(w is None or close(v, w, relative, absolute)
                        for v, w in zip(value, wanted)))
    if isinstance(wanted, bool) or not isinstance(wanted, (int, float)):
        return value == wanted
    if isinstance(value, bool) or not isinstance(value, (int, float)):
        return False
    # Written so that NaN fails.
    return abs(value - wanted) <= max(absolute, relative * abs(wanted))


def check_value(name, value, check, faults):
    """Compare a value (or a list, entry by entry) with a check."""
    if not isinstance(check, dict):
        check = {"value": check}
    unknown = set(check) - {"value", "relative", "absolute", "min", "max"}
    if unknown or not check:
        raise SystemExit(f"{name}: no such check: {sorted(unknown)}")
    if "value" in check:
        faults.expect(close(value, check["value"], check.get("relative", 0.0),
                            check.get("absolute", 0.0)),
                      f"{name} is {value!r}, expected {check['value']!r}")
    entries = value if isinstance(value, list) else [value]
    for entry in entries:
        number = isinstance(entry, (int, float))
        if "min" in check:
            faults.expect(number and entry >= check["min"],
                          f"{name} is {entry!r}, expected at least "
                          f"{check['min']}")
        if "max" in check:
            faults.expect(number and entry <= check["max"],
                          f"{name} is {entry!r}, expected at most "
                          f"{check['max']}")


def check_relation(key, relation, summary, faults):
    """Whether a figure is a multiple of another one."""
    other = scalar(summary.get(relation["of"]))
    if not isinstance(other, (int, float)):
        faults.append(f"{relation['of']} is {other!r}")
        return
    check_value(key, summary.get(key), {"value": relation["factor"] * other,
                                        "relative": relation["relative"]},
                faults)


def number(text):
    """A cell of a table: integer, number, or text."""
    for kind in (int, float):
        try:
            return kind(text)
        except ValueError:
            pass
    return text


def check_table(path, table, faults):
    """Compare columns of a CSV file."""
    if not path.exists():
        faults.append(f"{path.name} was not written")
        return
    with open(path, newline="", encoding="utf-8") as file:
        rows = [{name: number(text) for name, text in row.items()}
                for row in csv.DictReader(file)]
    for name, value in table.get("where", {}).items():
        rows = [row for row in rows if row.get(name) == value]
    if "rows" in table:
        check_value(f"{path.name}: number of rows", len(rows), table["rows"],
                    faults)
    for name, check in table.get("columns", {}).items():
        faults.expect(len(rows) > 0, f"{path.name}: no such rows")
        check_value(f"{path.name}: {name}", [row.get(name) for row in rows],
                    check, faults)


def edited_scene(case, folder):
    """The scene file, or a copy with the replacements made."""
    scene = ROOT / case["scene"]
    if "replace" not in case:
        return scene
    text = scene.read_text(encoding="utf-8")
    for old, new in case["replace"].items():
        if text.count(old) != 1:
            raise SystemExit(f"{old!r} occurs {text.count(old)} times in "
                             f"{scene}")
        text = text.replace(old, new)
    copy = folder / scene.name
    copy.write_text(text, encoding="utf-8")
    return copy


def command_line(case, folder, output):
    """The words of a run, after the program's name."""
    if "arguments" in case:
        words = list(case["arguments"])
    else:
        words = ["run", edited_scene(case, folder), "--output", output]
    for name, value in case.get("set", {}).items():
        if isinstance(value, bool):
            value = "true" if value else "false"
        words += ["--set", f"{name}={value}"]
    return [str(word) for word in words]


def environment():
    """One thread per process; MPI may share cores, and may run as root where
    that is who we are."""
    result = dict(os.environ, DEAL_II_NUM_THREADS="1", OMP_NUM_THREADS="1")
    if os.geteuid() == 0:
        result["OMPI_ALLOW_RUN_AS_ROOT"] = "1"
        result["OMPI_ALLOW_RUN_AS_ROOT_CONFIRM"] = "1"
    return result


class Program:
    """The program; runs on one rank are by `abut serve` of one that is given."""

    def __init__(self, abut, served=None):
        self.abut = str(abut)
        self.served = served and Served(served, environment())

    def run(self, words, n_ranks, folder):
        if n_ranks == 1 and self.served:
            return self.served.run(words, folder, RUN_SECONDS)
        start = (["mpirun", "--oversubscribe", "-n", str(n_ranks)]
                 if n_ranks > 1 else [])
        return subprocess.run([*start, self.abut, *words], capture_output=True,
                              text=True, env=environment(),
                              timeout=RUN_SECONDS, cwd=folder)


def check_streams(case, done, faults):
    """Exit code and messages."""
    wanted = case.get("exit", 0)
    faults.expect(done.returncode == wanted,
                  f"exit code {done.returncode}, expected {wanted}; stderr:\n"
                  f"{done.stderr[-2000:]}")
    if "stderr" in case:
        lines = [line for line in done.stderr.splitlines()
                 if re.search(case["stderr"], line)]
        faults.expect(len(lines) == 1,
                      f"{len(lines)} lines of stderr match "
                      f"{case['stderr']!r}, expected 1; stderr:\n"
                      f"{done.stderr[-2000:]}")
    if "stdout" in case:
        faults.expect(re.search(case["stdout"], done.stdout) is not None,
                      f"nothing in the output matches {case['stdout']!r}")
    for stream in ("stdout", "stderr"):
        absent = case.get("absent", {}).get(stream)
        if absent:
            faults.expect(re.search(absent, getattr(done, stream)) is None,
                          f"{stream} matches {absent!r}")


def check_files(case, output, faults):
    """What was written."""
    for pattern in case.get("files", []):
        found = list(output.glob(pattern))
        faults.expect(found and all(f.stat().st_size > 0 for f in found),
                      f"{pattern} was not written")
    for pattern in case.get("absent", {}).get("files", []):
        faults.expect(not list(output.glob(pattern)),
                      f"{pattern} was written")


def run_once(program, case, n_ranks, folder):
    """Run and check; returns faults and summary."""
    faults = Faults()
    folder.mkdir(parents=True, exist_ok=True)
    output = folder / "output"
    if case.get("blocked"):
        output.write_text("in the way")
        output = output / "folder"
    words = command_line(case, folder, output)
    try:
        done = program.run(words, n_ranks, folder)
    except subprocess.TimeoutExpired:
        faults.append(f"not finished after {RUN_SECONDS} s")
        return faults, {}
    check_streams(case, done, faults)
    check_files(case, output, faults)
    summary = {}
    path = output / "summary.json"
    if path.is_file():
        summary = json.loads(path.read_text(encoding="utf-8"))
    else:
        faults.expect("summary" not in case, "summary.json was not written")
    for key, check in case.get("summary", {}).items():
        check_value(key, summary.get(key), check, faults)
    for key, relation in case.get("relations", {}).items():
        check_relation(key, relation, summary, faults)
    for name, tables in case.get("tables", {}).items():
        for table in tables if isinstance(tables, list) else [tables]:
            check_table(output / name, table, faults)
    return faults, summary


def run_case(program, case, folder):
    """One case on all its numbers of ranks; returns faults and the summary on
    the first number."""
    all_faults, first = [], None
    for n_ranks in case.get("ranks", [1]):
        faults, summary = run_once(program, case, n_ranks,
                                   folder / f"{n_ranks}-ranks")
        if first is None:
            first = summary
        for key, tolerance in case.get("agree", {}).items():
            faults.expect(key in first and close(summary.get(key), first[key],
                                                 tolerance),
                          f"{key} is {summary.get(key)!r}, on the first "
                          f"number of ranks {first.get(key)!r}")
        all_faults += [f"{n_ranks} ranks: {fault}" for fault in faults]
    return all_faults, first


def check_extrapolated(limits, summaries):
    """First order errors taken out of the last two cases."""
    faults = Faults()
    for key, check in limits.items():
        before, last = (summary.get(key) for summary in summaries[-2:])
        if last is None or before is None:
            faults.append(f"{key} is missing")
            continue
        pairs = zip(*(v if isinstance(v, list) else [v]
                      for v in (before, last)))
        value = [2. * fine - coarse for coarse, fine in pairs]
        check_value(f"{key}, extrapolated,", value, check, faults)
    return faults


def check_orders(orders, summaries):
    """Orders of convergence over the cases."""
    faults = Faults()
    for key, check in orders.items():
        check = dict(check)
        limit, skip = check.pop("of", 0.0), check.pop("skip", 0)
        entry = check.pop("entry", None)
        values = [scalar(summary.get(key)) for summary in summaries]
        if entry is not None:
            values = [value[entry] for value in values]
        if not all(isinstance(v, (int, float)) for v in values):
            faults.append(f"order of {key}: values are {values}")
            continue
        errors = [abs(v - limit) for v in values]
        observed = [math.log2(a / b) for a, b in zip(errors, errors[1:])]
        text = ", ".join(f"{order:.3f}" for order in observed)
        print(f"  orders of {key}: {text}")
        check_value(f"order of {key}", observed[skip:], check, faults)
    return faults


def check_same(same, summary, others):
    """A case's summary against that of one before."""
    faults = Faults()
    if same:
        other = others[same["as"]]
        for key, tolerance in same["keys"].items():
            faults.expect(key in other and close(summary.get(key), other[key],
                                                 tolerance),
                          f"{key} is {summary.get(key)!r}, in case "
                          f"'{same['as']}' {other.get(key)!r}")
    return faults


def case_label(case, index):
    settings = ", ".join(f"{k.split('/')[-1]}={v}"
                         for k, v in case.get("set", {}).items())
    return case.get("name", settings or f"case {index + 1}")


def cases_of(expectation, part):
    """All cases; or what they do on one rank; or those on several ranks."""
    result = []
    for own in expectation.pop("cases", [{}]):
        case = {**expectation, **own}
        for key in ("set", "summary"):
            if key in expectation and key in own:
                case[key] = {**expectation[key], **own[key]}
        ranks = case.get("ranks", [1])
        if part == "one":
            case["ranks"] = [n for n in ranks if n == 1]
        elif part == "several" and max(ranks) == 1:
            case["ranks"] = []
        if part == "several":
            case.pop("same", None)
        if case.get("ranks", [1]):
            result.append(case)
    if not result:
        raise SystemExit(f"nothing to run on {part} ranks")
    return result


def run_file(program, path, folder, part="all"):
    """The cases of an expectation file; returns faults."""
    expectation = json.loads(path.read_text(encoding="utf-8"))
    orders = expectation.pop("orders", {}) if part != "several" else {}
    limits = expectation.pop("extrapolated", {}) if part != "several" else {}
    faults, summaries, others = [], [], {}
    for index, case in enumerate(cases_of(expectation, part)):
        found, summary = run_case(program, case, folder / str(index + 1))
        label = case_label(case, index)
        found += check_same(case.get("same"), summary or {}, others)
        others[label] = summary or {}
        print(f"{'ok    ' if not found else 'FAILED'} {label}", flush=True)
        faults += [f"{label}: {fault}" for fault in found]
        summaries.append(summary or {})
    return (faults + check_orders(orders, summaries)
            + check_extrapolated(limits, summaries))


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("expectation", type=pathlib.Path)
    parser.add_argument("--abut", type=pathlib.Path,
                        default=ROOT / "build/release/abut")
    parser.add_argument("--served", type=pathlib.Path,
                        help="the program for many runs")
    parser.add_argument("--part", choices=("all", "one", "several"),
                        default="all", help="what runs on so many ranks; "
                        "cases on several also run on one")
    parser.add_argument("--keep", type=pathlib.Path,
                        help="keep the output folders in this folder")
    options = parser.parse_args()
    program = Program(options.abut.resolve(),
                      options.served and options.served.resolve())
    if options.keep:
        faults = run_file(program, options.expectation, options.keep.resolve(),
                          options.part)
    else:
        with tempfile.TemporaryDirectory(prefix="abut-scene-") as folder:
            faults = run_file(program, options.expectation,
                              pathlib.Path(folder), options.part)
    for fault in faults:
        print(f"FAILED {fault}", file=sys.stderr)
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
