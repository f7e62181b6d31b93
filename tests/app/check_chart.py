# SPDX-License-Identifier: LGPL-2.1-or-later
"""`abut chart`: its table against the runs themselves, the Pareto front by
brute force, resumption after a kill, and its errors; the long form has other
axes, errors and the shipped charts, too."""
import csv
import json
import os
import shutil
import signal
import statistics
import subprocess
import time

from program import Program

p = Program()
OUT = p.folder / "out"
EXACT = 3.980995758125676707  # energy of the flat obstacle's exact solution


def chart(head="", error="", curves="", scene="flat-obstacle.prm",
          head_axis=""):
    if head_axis:
        head += f"\nset Axis = {head_axis}"
    return p.write("chart.prm", f"""set Scene file = {p.source}/prm/{scene}
set Repeats = 1
{head}
subsection Error
{error}
end
{curves}
""")


def curve(name, settings, head=""):
    """A section; settings: {"Section/Name": value}."""
    lines = [f"subsection Curve {name}", head]
    for path, value in settings.items():
        section, entry = path.split("/")
        lines += [f"subsection {section}", f"set {entry} = {value}", "end"]
    return "\n".join(lines + ["end", ""])


def rows(folder=OUT):
    with open(folder / "runs.csv") as file:
        return list(csv.DictReader(file))


def finished(folder=OUT):
    """Finished runs with the times at which they were written. The folder of
    one that is going on is renamed between listing and looking."""
    return {path.parent.name: path.stat().st_mtime_ns
            for path in folder.glob("runs/*/record.json")
            if path.parent.suffix != ".part"}


def run(file, *words, code=0):
    result = p.call("chart", file, "--output", "out", *words, alone=True)
    p.expect(result.returncode == code,
             f"chart: exit code {result.returncode}\n{result.stderr}")
    return result


# A chart with everything: a list that is multiplied, an axis of a curve's own,
# a run without an answer, one that is refused, one that takes too long.
file = chart(
    "set Values = 2 | 3 | 4\nset Time limit = 5",
    f"set Quantity = energy\nset Reference = {EXACT!r}",
    curve("lagrange", {"Method/Enforcement": "lagrange"})
    + curve("soft", {"Method/Enforcement": "penalty",
                     "Refinement/Level": "2 | 3"},
            "set Axis = Method/Penalty factor\nset Values = 100 | 1e4")
    + curve("hasty", {"Method/Maximum linear systems": "1",
                      "Refinement/Nested iteration": "false"},
            "set Values = 4")
    + curve("saddle", {"Method/System": "saddle point",
                       "Method/Enforcement": "lagrange | penalty"},
            "set Values = 2")
    + curve("long", {"Method/Enforcement": "lagrange"}, "set Values = 11"))
result = run(file)
table = rows()
names = [(row["curve"], row["axis"], row["value"]) for row in table]
level = "Refinement/Level"
p.expect(names == [("lagrange", level, "2"), ("lagrange", level, "3"),
                   ("lagrange", level, "4"),
                   ("soft, 2", "Method/Penalty factor", "100"),
                   ("soft, 2", "Method/Penalty factor", "1e4"),
                   ("soft, 3", "Method/Penalty factor", "100"),
                   ("soft, 3", "Method/Penalty factor", "1e4"),
                   ("hasty", level, "4"), ("saddle, lagrange", level, "2"),
                   ("saddle, penalty", level, "2"), ("long", level, "11")],
         f"curves {names}")
ended = [row["ended"] for row in table]
p.expect(ended == ["ok"] * 7 + ["unusable", "ok", "refused", "out of time"],
         f"ended {ended}")
codes = [row["exit_code"] for row in table]
p.expect(codes[7] == "3" and codes[9] == "2", f"exit codes {codes}")
for row in table:
    p.expect(bool(row["reason"]) == (row["ended"] != "ok"),
             f"{row['curve']}: reason '{row['reason']}'")
p.expect("3 of 11 points" in result.stderr, "no warning of three failures")

# Each number against the run's own summary.
for row in table:
    if row["ended"] != "ok":
        p.expect(row["time"] == "" and row["time_front"] == "0",
                 f"{row['curve']}: a time without an answer")
        continue
    summary = json.loads(
        (OUT / "runs" / (row["run"] + "-0") / "summary.json").read_text())
    p.close(float(row["error"]), abs(summary["energy"] - EXACT) / EXACT, 1e-12,
            "error")
    for key in ("dofs", "matvecs", "constraints", "active",
                "linear_iterations", "peak_memory_mb"):
        p.expect(float(row[key]) == summary[key], f"{key} of {row['curve']}")
    apart = sum(summary["sections"].get(name, {}).get("processor_seconds", 0)
                for name in ("results", "output"))
    p.close(float(row["time"]), summary["processor_seconds"] - apart, 1e-12,
            "processor time")
    p.expect(0 < float(row["time"]) < 5, f"time {row['time']}")


# Levels 2, 3, 4 have the errors of the mesh; a soft penalty has more.
errors = [float(row["error"]) for row in table[:7]]
p.expect(errors[0] > 3 * errors[1] > 9 * errors[2], f"errors {errors}")
p.expect(errors[3] != errors[4], "the penalty changes nothing")


def front(table, cost):
    """By the definition, pair by pair."""
    points = [(float(row[cost]), float(f"{float(row['error']):.1e}"))
              if row["ended"] == "ok" else None for row in table]
    return ["1" if a and not any(
        b and b != a and b[0] <= a[0] and b[1] <= a[1] for b in points)
        else "0" for a in points]


for cost, mark in (("time", "time_front"), ("matvecs", "work_front")):
    p.expect([row[mark] for row in table] == front(table, cost),
             f"{mark}: {[row[mark] for row in table]}")
cheap = [row for row in table[:3] if float(row["error"]) <= 0.1]
best = min(cheap, key=lambda row: float(row["time"]))
line = [line for line in (OUT / "cheapest.md").read_text().splitlines()
        if line.startswith("| lagrange")][0]
p.expect(f"({best['value']})" in line.split("|")[2],
         f"cheapest.md: {line}")
for name in ("error-time", "error-work"):
    for ending in ("svg", "png"):
        p.expect((OUT / f"{name}.{ending}").exists(), f"no {name}.{ending}")

# Once more: nothing is run again. A whole run cut off in its last file is.
before = finished()
p.expect(len(before) == 10, f"{len(before)} runs")
run(file)
p.expect(finished() == before, "finished runs were made again")
victim = sorted(before)[0]
half = OUT / "runs" / victim / "record.json"
half.write_text(half.read_text()[:40])
run(file)
after = finished()
p.expect({name for name in before if after[name] != before[name]} == {victim},
         "a torn run was believed, or others made again")
p.expect(rows()[0]["error"] == table[0]["error"], "another result")

# Killed while runs are going on: what was finished stays, what was not leaves
# no trace, and the process of the run ends too.
shutil.rmtree(OUT)
file = chart("set Values = 2 | 3 | 4 | 5",
             f"set Quantity = energy\nset Reference = {EXACT!r}")
process = subprocess.Popen([p.abut, "chart", file, "--output", "out"],
                           cwd=p.folder, stdout=subprocess.DEVNULL)
for _ in range(3000):
    if len(finished()) >= 2 and list(OUT.glob("runs/*.part")):
        break
    time.sleep(0.01)
process.send_signal(signal.SIGKILL)
process.wait()
kept = finished()
part = OUT / "runs" / "0123456789abcdef-0.part"
part.mkdir()
(part / "summary.json").write_text('{ "energy": 1')


def children():
    """Processes that work in the folder of the chart: `abut serve`, and the
    run that is forked from it."""
    found = []
    for folder in os.listdir("/proc"):
        try:
            words = open(f"/proc/{folder}/cmdline", "rb").read().split(b"\0")
            state = open(f"/proc/{folder}/stat").read().rsplit(")")[1].split()
            if (os.readlink(f"/proc/{folder}/cwd") == str(p.folder)
                    and b"serve" in words and state[0] != "Z"):
                found.append(folder)
        except (OSError, ValueError):
            pass
    return found


for _ in range(500):
    if not children():
        break
    time.sleep(0.01)
p.expect(not children(), "the killed chart's run goes on")
p.expect(2 <= len(kept) < 4, f"{len(kept)} runs before the kill")
run(file)
after = finished()
p.expect(len(after) == 4 and all(after[name] == kept[name] for name in kept),
         "finished runs were made again after the kill")
p.expect(not list(OUT.glob("runs/*.part")), "remains of interrupted runs")
p.expect([row["ended"] for row in rows()] == ["ok"] * 4, "resumed chart")


# Errors, before the first run.
def wrong(file, *texts, words=()):
    result = p.call("chart", file, "--output", "never", *words)
    p.expect_error(result, *texts)
    p.expect(not (p.folder / "never/runs").exists(),
             f"{texts}: found only after runs had begun")


GOOD = "set Quantity = energy\nset Reference = 4"
VALUES = "set Values = 2"
wrong("nowhere.prm", "nowhere.prm")
wrong(chart(VALUES, GOOD, scene="flat.prm"), "chart.prm:1: Scene file",
      "flat.prm")
wrong(chart("", GOOD), "Values", "no values")
wrong(chart(VALUES + "\nset Repeat = 1", GOOD), "chart.prm:4", "'Repeats'")
wrong(chart(VALUES, GOOD, curve("a", {"Method/Enforcment": "penalty"})),
      "chart.prm:11: Method/Enforcment", "Enforcement")
wrong(chart(VALUES, GOOD, curve("a", {"Method/Enforcement": "penalti"})),
      "chart.prm:11: Method/Enforcement", "'penalty'")
twice = [curve("a", {"Method/Enforcement": law})
         for law in ("lagrange", "penalty")]
wrong(chart(VALUES, GOOD, "".join(twice)), "chart.prm:17", "second section",
      "'Curve a'")
wrong(chart(VALUES, GOOD, twice[0] + curve("b", {"Refinement/Level": 2})
            + curve("a", {"Refinement/Level": 3})), "second section",
      "'Curve a'")
wrong(chart(VALUES + "\nset Axis = Refinement/Levels", GOOD),
      "chart.prm:3: Refinement/Levels", "'Level'")
wrong(chart("set Values = 2 | two", GOOD), "chart.prm:3: Refinement/Level",
      "'two'")
wrong(chart(VALUES, GOOD, curve("a", {"Method/System": "saddle point",
                                      "Method/Enforcement": "penalty"})),
      "saddle point goes with", "'Curve a'")
wrong(chart(VALUES, "set Quantity = h1_error", scene="step-41.prm"),
      "chart.prm:5: Error/Quantity", "h1_error", "Exact solution")
wrong(chart(VALUES, "set Quantity = h2_error"), "Error/Quantity", "Did you mean")
wrong(chart(VALUES, "set Quantity = energy"), "Error/Quantity", "Reference")
wrong(chart(VALUES + "\nset Pictures = error-time", ""),
      "chart.prm:4: Pictures", "needs an error")
wrong(chart(VALUES, GOOD + "\nsubsection Finer run\nsubsection Refinement\n"
            "set Level = 5\nend\nend"), "Error/Reference", "two references")
wrong(chart(VALUES, GOOD), "--plam", words=("--plam",))
p.expect_error(p.call("chart", chart(VALUES, GOOD), ranks=2), "without mpirun")
result = p.call("chart", chart(VALUES, "set Quantity = contact_forc\n"
                               "set Reference = 6"), "--output", "out",
                alone=True)
p.expect_error(result, "chart.prm:5: Error/Quantity", "'contact_force'")

# Lists and numbers: what to write is what works.
def quantity(name):
    return p.call("chart", chart("set Values = 20", f"set Quantity = {name}\n"
                                 "set Reference = 200\nset Scale = 1\n",
                                 scene="dynamics-bar-on-a-wall.prm",
                                 head_axis="Bar/Elements"),
                  "--output", "lists", alone=True)


for name, *texts in (
        ("contact_impulse", "'contact_impulse' is a list of 1",
         "write 'contact_impulse[0]'"),
        ("contact_impulse[1]", "is a list of 1", "'contact_impulse[0]'"),
        ("energy_gain[0]", "'energy_gain' is one number", "write 'energy_gain'"),
        ("scene", "'scene' is there, but is no number"),
        ("contact_impuls", "'contact_impulse[0]'"),
        ("contact_impuls[0]", "'contact_impulse[0]'")):
    p.expect_error(quantity(name), "Error/Quantity", *texts)
for name in ("contact_impulse[0]", "energy_gain"):
    result = quantity(name)
    p.expect(result.returncode == 0, f"quantity {name}: {result.stderr}")

# The page has the parameters that the command prints.
result = p.call("chart", "--parameters")
p.expect(result.returncode == 0 and "**Error/Quantity**" in result.stdout
         and result.stdout in (p.source / "doc/commands.md").read_text(),
         "doc/commands.md is not what abut chart --parameters prints")

# Time is the median of the repeats, of processor time without what a run
# measures and writes.
run(chart("set Values = 3\nset Repeats = 4", GOOD), "--set", "Repeats=3")
row, = rows()
times = []
for repeat in range(3):
    summary = json.loads((OUT / "runs" / f"{row['run']}-{repeat}"
                          / "summary.json").read_text())
    times.append(summary["processor_seconds"] - sum(
        summary["sections"].get(name, {}).get("processor_seconds", 0)
        for name in ("results", "output")))
p.expect(row["repeats"] == "3", f"repeats {row['repeats']}")
for key, value in (("time", statistics.median(times)),
                   ("fastest", min(times)), ("slowest", max(times))):
    p.close(float(row[key]), value, 1e-12, key)

if p.short:
    p.finish()
    raise SystemExit

# Errors in norms: measured apart, timed without the exact solution. A finer
# run as reference, made once.
run(chart("set Values = 4", "set Quantity = h1_error\nset Scale = 1.85777049"))
p.close(float(rows()[0]["error"]), 1.9929e-1 / 1.85777049, 1e-2, "H1 error")
p.expect(rows()[0]["run"] + "-0" in finished() and len(finished()) == 5,
         "a run of its own for the error, none for the time")
run(chart("set Values = 2 | 3", "set Quantity = contact_force\n"
          "subsection Finer run\nsubsection Refinement\nset Level = 4\nend\n"
          "end"))
p.close(float(rows()[1]["quantity"]) / 6.23796658, 1, 0.1, "contact force")
p.close(float(rows()[1]["error"]),
        abs(float(rows()[1]["quantity"]) - 6.23796658) / 6.23796658, 1e-7,
        "error against the finer run")

# Numbers of columns of levels.csv: a die slides on a block without friction, and
# what its force does as facets pass is spurious. That to the side is at most 2e-4
# of the vertical one with mortar, and a tenth of that by nodes.
def of_rows(quantity, *curves):
    """Quantities by curve, and the levels.csv of the runs."""
    run(chart("set Values = 1", f"set Quantity = {quantity}\nset Reference = 0",
              "subsection All curves\nsubsection Load steps\nset Steps = 24\n"
              "set End time = 24\nend\nend\n"
              + curve("", {"Method/Discretisation": " | ".join(curves)}),
              scene="sliding-die.prm"))
    found = {}
    for row in rows():
        p.close(float(row["error"]), abs(float(row["quantity"])), 1e-12,
                "an error without scale")
        with open(OUT / "runs" / (row["run"] + "-0") / "levels.csv") as file:
            found[row["curve"]] = float(row["quantity"]), [
                {key: float(value or "nan") for key, value in step.items()}
                for step in csv.DictReader(file)]
    return found


WAYS = ["dual mortar", "node to segment"]
side = of_rows("largest(pair_1_force_x / pair_1_force_y, 8, 24)", *WAYS)
for way, (value, steps) in side.items():
    p.close(value, max(abs(step["pair_1_force_x"] / step["pair_1_force_y"])
                       for step in steps if step["time"] > 8.5), 1e-9, way)
mortar, nodes = (side[way][0] for way in WAYS)
p.expect(mortar < 2e-4 and mortar < 0.1 * nodes,
         f"force to the side: {mortar}, by nodes {nodes}")
for quantity, expected in (
        ("ripple(pair_1_force_y, 8, 24)",
         lambda v: statistics.pstdev(v) / abs(statistics.mean(v))),
        ("mean(pair_1_force_y, 8, 24)", statistics.mean)):
    for value, steps in of_rows(quantity, WAYS[0]).values():
        p.close(value, expected([step["pair_1_force_y"] for step in steps
                                 if step["time"] > 8.5]), 1e-9, quantity)
for quantity, *texts in (
        ("mean(pair_1_force_z, 8, 24)", "no column 'pair_1_force_z'",
         "pair_1_force_"),
        ("mean(pair_1_force_y, 24, 25)", "No row of levels.csv"),
        ("mean(pair_1_force_y, 8)", "No row of levels.csv",
         "'mean(contact_force, 1, 2)'"),
        ("middle(pair_1_force_y)", "order, growth, starts, mean")):
    p.expect_error(p.call("chart", p.folder / "chart.prm", "--output", "out",
                          "--set", f"Error/Quantity={quantity}", alone=True),
                   "Error/Quantity", *texts)

# The search: no error, time over the number of facets.
run(chart("set Axis = Secondary/Refinements, Primary/Refinements\n"
          "set Values = 0 | 1\nset Time = ns_per_node\n"
          "set Axis quantity = facets\nset Pictures = time-axis", "",
          "subsection All curves\nsubsection Sweep\nset Bucket sizes =\n"
          "set Repeats = 1\nend\nend\n"
          + curve("", {"Search/Algorithm":
                       "uniform buckets | adaptive buckets"}),
          "search-flat.prm"))
table = rows()
p.expect([row["curve"] for row in table] == ["uniform buckets"] * 2
         + ["adaptive buckets"] * 2, "curves of the search")
p.expect([float(row["x"]) for row in table] == [48**2, 96**2] * 2,
         "facets of the search")
p.expect(all(float(row["time"]) > 0 for row in table), "times of the search")

# The shipped charts fit the scenes.
for path in sorted((p.source / "prm/charts").glob("*.prm")):
    result = p.call("chart", path, "--plan")
    p.expect(result.returncode == 0 and " points, " in result.stdout
             and not (p.folder / "output").exists(),
             f"{path.name}: {result.stderr}")

# One of them on its coarsest mesh: all ways come near Lame's displacement, and
# quadratic elements nearer than all others.
run(p.source / "prm/charts/press-fit.prm", "--set", "Values=1", "--set",
    "Curve dual mortar, degree 2/Values=1", "--set", "Repeats=1")
table = {row["curve"]: row for row in rows()}
p.expect(len(table) == 8 and all(row["ended"] == "ok"
                                 for row in table.values()),
         f"press fit: {[row['ended'] for row in table.values()]}")
errors = {name: float(row["error"]) for name, row in table.items()}
p.expect(max(errors.values()) < 0.1, f"press fit: errors {errors}")
best = errors.pop("dual mortar, degree 2")
p.expect(best < 0.2 * min(errors.values()), f"press fit: degree 2 has {best}")

p.finish()
