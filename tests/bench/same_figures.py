#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Whether two programs give the same figures on all scenes of tests/scenes.

    same_figures.py ABUT --record FILE     run all cases, keep their figures
    same_figures.py ABUT --against FILE    run them and compare with a record

Compared are exit codes, every figure of summary.json, and every row of levels.csv
and steps.csv, but for seconds, memory and bytes. Counts and words must be equal,
numbers agree to --relative of the largest number of the same list; what is
round-off in both (below --noise, for figures such as imbalances and errors of
exact solutions) is equal. A difference is one line: case, figure, both values;
the exit code is then 1.
"""
import argparse
import concurrent.futures
import csv
import fnmatch
import json
import pathlib
import sys
import tempfile

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent / "scenes"))
import run_scene  # noqa: E402

# Not figures: what depends on the machine, what a run that goes on has to do
# once more, and what is new in a later program.
UNLIKE = ("searches", "reuses", "bucket_", "gatherings",
          "second", "memory", "bytes", "sections", "version", "command",
          "output", "share", "ratio_to", "messages", "could_be_left_out",
          "modelled")


def cases(pattern):
    """Name, case and number of ranks of every run of the scene tests."""
    for path in sorted(run_scene.ROOT.glob("tests/scenes/*.json")):
        expectation = json.loads(path.read_text(encoding="utf-8"))
        expectation.pop("orders", None)
        for index, own in enumerate(expectation.pop("cases", [{}])):
            case = {**expectation, **own}
            if "set" in expectation and "set" in own:
                case["set"] = {**expectation["set"], **own["set"]}
            for ranks in case.get("ranks", [1]):
                name = f"{path.stem}/{index + 1}/{ranks}"
                if not case.get("blocked") and fnmatch.fnmatch(name, pattern):
                    yield name, case, ranks


def is_figure(key):
    return not any(word in key for word in UNLIKE)


def table(path):
    if not path.exists():
        return None
    with open(path, newline="", encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    return {name: [run_scene.number(row[name]) for row in rows]
            for name in (rows[0] if rows else ()) if is_figure(name)}


def figures(abut, case, ranks):
    """What a run leaves: exit code, summary, tables."""
    with tempfile.TemporaryDirectory(prefix="abut-same-") as name:
        folder = pathlib.Path(name)
        output = folder / "output"
        words = run_scene.command_line(case, folder, output)
        done = run_scene.Program(abut).run(words, ranks, folder)
        result = {"exit": done.returncode}
        if (output / "summary.json").is_file():
            summary = json.loads((output / "summary.json").read_text())
            result["summary"] = {key: value for key, value in summary.items()
                                 if is_figure(key)}
        for part in ("levels.csv", "steps.csv"):
            result[part] = table(output / part)
    return json.loads(json.dumps(result))


def is_number(value):
    return isinstance(value, (int, float)) and not isinstance(value, bool)


def differences(name, old, new, limits, lines):
    """Lines that name what differs."""
    if isinstance(old, dict) and isinstance(new, dict):
        for key, value in old.items():
            if key not in new:
                lines.append(f"{name}: {key} is gone")
            else:
                differences(f"{name}: {key}", value, new[key], limits, lines)
        return
    if isinstance(old, list) and isinstance(new, list):
        if len(old) != len(new):
            lines.append(f"{name}: {len(old)} entries, now {len(new)}")
            return
        largest = max([abs(v) for v in old if is_number(v)], default=0.0)
        for index, (a, b) in enumerate(zip(old, new)):
            if is_number(a) and is_number(b):
                compare(f"{name}[{index}]", a, b, largest, limits, lines)
            else:
                differences(f"{name}[{index}]", a, b, limits, lines)
        return
    if is_number(old) and is_number(new):
        compare(name, old, new, abs(old), limits, lines)
    elif old != new:
        lines.append(f"{name}: {str(old)[:80]!r}, now {str(new)[:80]!r}")


def compare(name, old, new, scale, limits, lines):
    relative, noise = limits
    if isinstance(old, int) and isinstance(new, int):
        same = old == new
    else:
        same = (abs(new - old) <= relative * scale
                or max(abs(old), abs(new)) <= noise)
    if not same:
        lines.append(f"{name}: {old!r}, now {new!r}")


def main():
    parser = argparse.ArgumentParser(
        description=__doc__,
        formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("abut", type=pathlib.Path)
    what = parser.add_mutually_exclusive_group(required=True)
    what.add_argument("--record", type=pathlib.Path)
    what.add_argument("--against", type=pathlib.Path)
    parser.add_argument("--only", default="*", metavar="PATTERN",
                        help="of NAME/CASE/RANKS, for example 'hertz/*'")
    parser.add_argument("--jobs", type=int, default=1)
    parser.add_argument("--relative", type=float, default=1e-12)
    parser.add_argument("--noise", type=float, default=1e-10)
    options = parser.parse_args()
    abut = options.abut.resolve()
    runs = list(cases(options.only))
    with concurrent.futures.ThreadPoolExecutor(options.jobs) as pool:
        found = dict(zip(
            (name for name, _, _ in runs),
            pool.map(lambda run: figures(abut, run[1], run[2]), runs)))
    if options.record:
        options.record.write_text(json.dumps(found, indent=1))
        print(f"{len(found)} runs recorded")
        return 0
    before = json.loads(options.against.read_text())
    lines = []
    for name, new in found.items():
        if name not in before:
            lines.append(f"{name}: not in the record")
        else:
            differences(name, before[name], new,
                        (options.relative, options.noise), lines)
    print("\n".join(lines))
    print(f"{len(found)} runs compared, {len(lines)} differences")
    return 1 if lines else 0


if __name__ == "__main__":
    sys.exit(main())
