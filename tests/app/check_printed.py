# SPDX-License-Identifier: LGPL-2.1-or-later
"""What a run prints: a screen at most, in words, with the numbers of
summary.json; scenes of `abut new` and their exact values; `abut check`."""
import fcntl
import math
import os
import pty
import re
import struct
import termios

from program import Program, set_words

p = Program()
SCREEN = 25
QUICK = {"Output/Pictures": "false", "Output/Fields": "false"}

# Words of the printed tables, and the keys that they stand for.
OF_PAIRS = {"force x": "force[0]", "force y": "force[1]", "force z": "force[2]",
            "largest pressure": "pressure", "contact area": "contact_area",
            "contact width": "contact_area", "penetration": "penetration",
            "sum of |friction|": "friction_force", "slip": "slip",
            "friction ratio": "friction_ratio", "impulse x": "impulse[0]", "impulse y": "impulse[1]"}
OF_RUNS = {"contact force": "contact_force", "penetration": "max_penetration",
           "energy": "energy", "Lagrange multiplier": "lambda",
           "displacement": "displacement", "velocity": "velocity",
           "touches": "n_touches", "friction force": "friction_force",
           "contact impulse": "contact_impulse", "momentum x": "momentum[0]",
           "smallest gap": "smallest_gap",
           "nodes with a partner": "contact_elements",
           "error of the displacement, L2 norm": "l2_error",
           "search time per node [ns]": "ns_per_node"}


def value_of(summary, key):
    name, bracket, entry = key.partition("[")
    value = summary.get(name)
    return value[int(entry[:-1])] if bracket else value


def same(text, value):
    """Whether a text is a value of the summary, in six digits."""
    values = value if isinstance(value, list) else [value]
    words = text.split(", ")
    return len(words) == len(values) and all(
        isinstance(v, (int, float)) and f"{v + 0.:.6g}" == f"{float(w) + 0.:.6g}"
        for w, v in zip(words, values))


def cells(line):
    return re.split(r"\s{2,}", line.strip())


def check_pairs(what, lines, summary):
    """The table of pairs; returns how many numbers it has."""
    n = 0
    for i, line in enumerate(lines):
        head = cells(line)
        if not head[0].startswith("contact") or len(head) < 5:
            continue
        for row in lines[i + 1:]:
            pair = re.match(r"  (\d+): ", row)
            if not pair:
                break
            for word, text in zip(head[1:], cells(row)[1:]):
                if word == "sticking points":
                    closed, slipping = (summary.get(f"pair_{pair[1]}_{key}")
                                        for key in ("active", "slipping"))
                    p.expect(text == ("-" if slipping is None else
                                      f"{closed - slipping} of {closed}"),
                             f"{what}: {word} is {text}")
                    n += text != "-"
                    continue
                key = f"pair_{pair[1]}_{OF_PAIRS[word]}"
                p.expect(text == "-" or same(text, value_of(summary, key)),
                         f"{what}: {word} is {text}, {key} is "
                         f"{value_of(summary, key)}")
                n += text != "-"
    return n


def check_figures(what, lines, summary):
    """Lines `words  number`, with the exact value and the relative error."""
    n = 0
    for line in lines:
        row = cells(line)
        pair = re.match(r"pair (\d+): (.*)", row[0])
        key = (f"pair_{pair[1]}_{OF_PAIRS[pair[2]]}"
               if pair and pair[2] in OF_PAIRS else OF_RUNS.get(row[0]))
        point = re.match(r"point (\d+): displacement( [xyz])?$", row[0])
        if point:
            key = f"point_{point[1]}" + (
                f"[{'xyz'.index(point[2][1])}]" if point[2] else "")
        if key is None or len(row) < 2:
            continue
        n += 1
        value = value_of(summary, key)
        p.expect(same(row[1], value), f"{what}: {row}, {key} is {value}")
        if len(row) == 4:
            exact = summary["expected"][key]
            value = value[0] if isinstance(value, list) else value
            p.expect(same(row[2], exact), f"{what}: {row}, not {exact}")
            p.close(float(row[3]), abs(value - exact) / abs(exact), 0.06,
                    f"{what}: relative error of {key}")
    return n


def check_run(scene, settings=(), least=3, code=0):
    """A run prints a screen, and what it prints is in the summary."""
    result = p.call("run", scene, "--output", "out", *set_words(settings))
    lines = result.stdout.splitlines() + result.stderr.splitlines()
    what = str(scene).rsplit("/", 1)[-1]
    p.expect(result.returncode == code, f"{what}: {result.returncode} {lines}")
    p.expect(len(lines) <= SCREEN,
             f"{what}: {len(lines)} lines:\n" + "\n".join(lines))
    p.expect(not any(re.search(r"\b(?!summary)[a-z0-9]+_[a-z_0-9]+\b", line)
                     for line in result.stdout.splitlines()
                     if "results in" not in line
                     and "generator" not in line),
             f"{what} prints keys:\n{result.stdout}")
    p.expect("\x1b" not in result.stdout and "\r" not in result.stdout,
             f"{what}: control characters where there is no terminal")
    p.expect("results in out: " in result.stdout, f"{what}: files")
    words = "solved: " if code == 0 else "NO ANSWER TO RELY ON (exit code 3): "
    p.expect(words in result.stdout, f"{what}: no verdict")
    n_warnings = sum(line.startswith("abut: warning: ")
                     for line in result.stderr.splitlines())
    p.expect((f" {n_warnings} warning" if n_warnings else "no warnings")
             in result.stdout, f"{what}: number of warnings")
    summary = p.summary()
    n = (check_pairs(what, result.stdout.splitlines(), summary)
         + check_figures(what, result.stdout.splitlines(), summary))
    p.expect(n >= least, f"{what}: {n} numbers in\n{result.stdout}")
    return summary, result


# All kinds of scenes, with and without contact, steps, friction, time, exact
# values, obstacles that forces drive, and without an answer.
PRM = p.source / "prm"
for name, settings, *more in (
        ("point-mass", {"Output/Pictures": "false"}),
        ("friction-block", {}), ("dynamics-bouncing-ball",
                                 {"Output/Pictures": "false"}),
        ("dynamics-bar-on-a-wall", {"Output/Pictures": "false"}),
        ("flat-obstacle", {"Refinement/Level": 5, **QUICK}),
        ("search-flat", {}, 2), ("pipe", {"Refinement/Level": 2, **QUICK}, 1),
        ("patch-2d", QUICK), ("rigid-plate", QUICK), ("dragged-block", QUICK),
        ("two-cylinders", {"Refinement/Adaptive cycles": 1, **QUICK}),
        ("failures/floating-pulled", QUICK, 0, 3)):
    check_run(PRM / f"{name}.prm", settings, *more)

# All there is, in words of the summary; and nothing.
result = p.call("run", PRM / "rigid-plate.prm", "--output", "out", "--verbose")
for key in p.summary():
    p.expect(key in result.stdout or key in (
        "warnings", "codes", "not_used", "could_be_left_out", "modelled",
        "sections", "expected", "title", "examination", "failures", "findings")
             or value_of(p.summary(), key) in (None, [], ""),
             f"--verbose prints no {key}")
for words in ("\n  Model\n", "\n  Cost "):
    p.expect(words in result.stdout, f"no '{words}' with --verbose")
p.expect_error(p.call("run", PRM / "rigid-plate.prm", "--quiet", "--verbose"),
               "--quiet and --verbose")

# Figures that are expected, and are none.
summary, result = check_run(PRM / "point-mass.prm", {
    "Output/Pictures": "false", "Output/Expected": "contact_forse: 2"})
p.expect("no number 'contact_forse'" in result.stderr
         and "contact_force" in result.stderr, "expected figure without result")
for text, words in (("energy", "a colon"), ("energy: 2*x", "depends on"),
                    ("energy: 2+", "2+")):
    p.expect_error(p.call("check", PRM / "point-mass.prm", "--set",
                          f"Output/Expected={text}"), "Output/Expected", words)

# On a terminal one line of progress is written over.
SIZE = struct.pack("HHHH", SCREEN, 80, 0, 0)
pid, terminal = pty.fork()
if pid == 0:
    fcntl.ioctl(1, termios.TIOCSWINSZ, SIZE)
    os.chdir(p.folder)
    os.execv(p.abut, [p.abut, "run", str(PRM / "rigid-plate.prm"),
                      *set_words(QUICK)])
text = b""
try:
    while part := os.read(terminal, 4096):
        text += part
except OSError:
    pass
p.expect(os.waitstatus_to_exitcode(os.waitpid(pid, 0)[1]) == 0, "terminal")
p.expect(text.count(b"\x1b[K") >= 2 and b"solved: " in text
         and len(text.decode().split("\n")) <= SCREEN, f"terminal: {text}")

# mpirun has a terminal without a size between a rank and its own output.
result = p.call("run", PRM / "rigid-plate.prm", *set_words(QUICK), ranks=1)
p.expect(result.returncode == 0 and "solved: " in result.stdout
         and not {"\r", "\033"} & set(result.stdout), f"ranks: {result.stdout!r}")

# Scenes to begin with, against formulas of their own.
NU, HERTZ = 0.3, 2 * math.sqrt(10 * 8 / 2 / (200 / 2 / (1 - 0.3**2)) / math.pi)
EXACT = {
    "block": {"pair_1_pressure": (10, 1e-9), "pair_1_force[1]": (20, 1e-9),
              "point_1[1]": (-10 * (1 - NU**2) / 1000, 1e-9)},
    "hertz": {"pair_1_pressure": (2 * 10 / math.pi / HERTZ, 0.01),
              # made of whole facets
              "pair_1_contact_area": (HERTZ, 0.03),
              "pair_1_force[1]": (5, 1e-4)},
    "two-bodies": {"pair_1_pressure": (10, 1e-8), "pair_1_force[1]": (20, 1e-8),
                   "point_1[1]": (-10 * (1 - NU**2) / 1000
                                  - 10 * (1 - 0.2**2) / 500, 1e-8)},
    "friction": {"pair_1_friction_ratio": (0.25, 1e-8)},
    "sliding": {"pair_1_friction_ratio": (0.3, 0.01),
                "pair_1_force[1]": (0.05, 1e-5)},
    "impact": {"pair_1_impulse[0]": (2 * 1 * 0.1, 0.02),
               "momentum[0]": (0.1, 0.02)},
    "obstacle": {"contact_force": (2 * math.pi, 0.01)},
    "masses": {"displacement[0]": (1, 1e-12), "contact_force[0]": (2, 1e-12),
               "lambda[0]": (-2, 1e-12)}}
for kind, exact in EXACT.items():
    result = p.call("new", kind)
    file = p.folder / f"{kind}.prm"
    p.expect(result.returncode == 0 and file.read_text()
             == (PRM / f"templates/{kind}.prm").read_text(), f"new {kind}")
    p.expect("# Exact:" in file.read_text(), f"{kind}: no exact values")
    summary, result = check_run(file)
    p.expect("expected" in result.stdout, f"{kind}: nothing to compare with")
    p.expect(not result.stderr, f"{kind}: {result.stderr}")
    for key, (value, tolerance) in exact.items():
        p.close(value_of(summary, key), value, tolerance, f"{kind}: {key}")
for words, *texts in ((["block"], "block.prm", "not overwritten"),
                      (["hertzz", "x.prm"], "'hertz'?", "two-bodies, friction"),
                      ([], "needs a kind", "masses"),
                      (["block", "x.prm", "y"], "takes no 'y'"),
                      (["block", "-o"], "no option '-o'", "[FILE.prm]")):
    p.expect_error(p.call("new", *words), *texts)
result = p.call("new", "block", "--help")
p.expect(result.returncode == 0 and "Write a scene" in result.stdout
         and not (p.folder / "--help").exists(), "new block --help")
p.expect(p.call("new", "masses", "other.prm").returncode == 0
         and (p.folder / "other.prm").exists(), "new masses other.prm")

# `abut check`: surfaces with areas and normals, motions, pairs, sizes.
result = p.call("check", "two-bodies.prm")
for words in ("body 2, boundary 3: ", ", y = 2, normal (0, 1)",
              "body 1: its supports leave no rigid motion",
              "body 2: its supports leave a translation along y",
              "pair 1: body 2 on body 1, ", "length 2, of which 2 has a partner",
              "unknowns: ", "memory: about "):
    p.expect(words in result.stdout, f"check: no '{words}' in {result.stdout}")
result = p.call("check", "hertz.prm")
# A quarter of a circle has the mean normal 2/pi (1, 1) on its arc; its chords
# have less length.
normal = re.search(r"body 1, boundary 0: .*length ([\d.]+).*mean normal "
                   r"\(([\d.]+), ([\d.]+)\)", result.stdout)
p.expect(normal is not None, result.stdout)
if normal:
    for found in normal[2], normal[3]:
        p.close(float(found), 8 / float(normal[1]), 2e-3, "mean normal")
p.expect("adaptive meshes" in result.stdout, "adaptive meshes: " + result.stdout)
result = p.call("check", PRM / "rigid-plate.prm", "--verbose")
found = dict(re.findall(r"^ *(\w+) +([\d.e+]+)$", result.stdout, re.M))
p.expect("obstacle 1: plane" in result.stdout, "obstacle")
summary, _ = p.solve_with("rigid-plate.prm", QUICK)
p.close(float(found["expected_dofs"]), summary["dofs"], 0.15, "unknowns")

# Tables of pairs are no fields: they are there without them.
summary, _ = p.solve_with(p.folder / "two-bodies.prm", QUICK)
p.expect(not list((p.folder / "out").glob("*.vtu")), "fields of no fields")
pressures = [row["pressure"] for row in p.table("pair_1.csv")]
p.expect(len(pressures) == 11 and all(abs(q - 10) < 1e-6 for q in pressures),
         f"pressures without fields: {pressures}")

# Without a number about 100 sets of fields: every second of 150 steps of 0.002.
result = p.call("run", "impact.prm", "--output", "sets", *set_words(
    {"Output/Every": "auto", "Output/Pictures": "false",
     "Body 1/Mesh/Arguments": "5, 1 : 0, 0 : 1, 1 : true"}))
times = [float(t) for t in re.findall(
    r'timestep="([^"]+)"', (p.folder / "sets/fields.pvd").read_text())]
p.expect("fields of one step in 2 (Output/Every)" in result.stdout,
         f"sets of fields: {result.stdout}")
p.expect(len(times) == 75 and all(abs(t - 0.004 * (i + 1)) < 1e-9
                                  for i, t in enumerate(times)),
         f"times of fields: {times}")

p.finish()
