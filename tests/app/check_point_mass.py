# SPDX-License-Identifier: LGPL-2.1-or-later
"""The point mass (k = h = 1, mg = 3) and the method of multipliers against
their closed forms.

Minimise k u^2 / 2 - mg u with u <= h: u = h, p = mg - k h.
Penalty eps: u = (mg + eps h) / (k + eps), p = eps (mg - k h) / (k + eps).
Augmented Lagrangian: the error in p shrinks by k / (k + eps) a step.
Barrier mu: s = h - u solves k s^2 + (mg - k h) s = mu, p = mu / s."""
import math
import re

from program import Program, set_words

p = Program()
K, H, MG = 1, 1, 3
EXACT = MG - K * H


def method(name, *settings):
    words = ["--set", f"Method/Enforcement={name}", "--set",
             "Output/Pictures=false"]
    for setting in settings:
        words += ["--set", "Method/" + setting]
    return words


def solution(name, *settings):
    summary, rows = p.solve("point-mass.prm", *method(name, *settings))
    return summary["displacement"][0], summary["contact_force"][0], rows


# Exact methods, to the accuracy that their end parameter allows.
u, force, _ = solution("lagrange")
p.close(u, H, 1e-12, "lagrange u")
p.close(force, EXACT, 1e-12, "lagrange p")
u, force, _ = solution("augmented lagrangian", "Gap tolerance=1e-14",
                       "Pressure tolerance=1e-14")
p.close(u, H, 1e-12, "augmented lagrangian u")
p.close(force, EXACT, 1e-12, "augmented lagrangian p")
for name, tolerance in (("interior point", 1e-6), ("barrier", 1e-6),
                        ("quadratic penalty", 1e-5)):
    u, force, _ = solution(name)
    p.close(u, H, tolerance, name + " u")
    p.close(force, EXACT, tolerance, name + " p")
summary, _ = p.solve("point-mass.prm")
p.close(summary["lambda"][0], -EXACT, 1e-12, "lambda is minus p")
p.close(summary["energy"], K * H * H / 2 - MG * H, 1e-12, "energy")

# Penalty: solution and sweep.
for eps in (1, 10, 1e3, 1e6):
    u, force, _ = solution("penalty", f"Penalty={eps}")
    p.close(u, (MG + eps * H) / (K + eps), 1e-12, f"penalty {eps} u")
    p.close(force, eps * EXACT / (K + eps), 1e-9, f"penalty {eps} p")
p.solve("point-mass.prm")
sweep = p.table("sweep.csv")
p.expect([row["penalty"] for row in sweep] == [1, 10, 1e3, 1e6], "sweep")
for row in sweep:
    p.close(row["u"], (MG + row["penalty"] * H) / (K + row["penalty"]), 1e-12,
            f"sweep {row['penalty']}")
# 1e-12 of the published digits.
p.close(sweep[1]["u"], 1.181818181818181818, 1e-12, "eps = 10")
p.close(sweep[3]["u"], 1.000001999998, 1e-12, "eps = 1e6")

# Augmented Lagrangian with eps = 10, step by step.
_, _, rows = solution("augmented lagrangian", "Penalty=10",
                      "Adaptive penalty=false")
steps = [row for row in rows if row["p"] > 0]
error = EXACT
for i in range(4):
    error *= K / (K + 10)
    p.close(steps[i]["p"], EXACT - error, 1e-12, f"multiplier {i}")
    p.close(steps[i]["lambda"], error - EXACT, 1e-12, f"lambda {i}")
    p.close(steps[i]["u"], H + error / K, 1e-12, f"augmented u {i}")
# Each outer iteration ends with multipliers that are updated or accepted.
result = p.call("run", p.source / "prm/point-mass.prm", "--output", "out",
                *method("augmented lagrangian", "Penalty=10",
                        "Adaptive penalty=false"))
n_outer = int(max(row["outer"] for row in rows))
p.expect(n_outer >= 4 and re.search(rf"outer iterations +{n_outer}\n",
                                    result.stdout),
         f"outer iterations {n_outer}: {result.stdout}")

# Barrier at a fixed mu.
for mu in (1, 0.1, 1e-4):
    u, force, rows = solution("barrier", f"Barrier parameter={mu}")
    s = (-EXACT + math.sqrt(EXACT**2 + 4 * K * mu)) / (2 * K)
    p.close(u, H - s, 1e-12, f"barrier {mu} u")
    p.close(force, mu / s, 1e-12 if mu > 1e-3 else 1e-10, f"barrier {mu} p")

# Gaps of few digits: 5e-13 and 5e-15 in coordinates of 1.
for mu in (1e-12, 1e-14):
    u, force, _ = solution("barrier", f"Barrier parameter={mu}")
    p.close(u, H, mu, f"barrier {mu} u")
    p.close(force, EXACT, mu, f"barrier {mu} p")

# The barrier's first step is cut at 0.995 of the way from u = 0, s = 1 and p = mu
# = 0.9 to the support. In full, (1 + 0.9) du = 3 - 0.9 and dp = 0.9 du.
_, _, rows = solution("barrier")
full = (MG - 0.9) / (K + 0.9)
part = 0.995 / full
p.close(rows[0]["u"], 0.995, 1e-12, "barrier: cut step")
p.close(rows[0]["p"], 0.9 + part * 0.9 * full, 1e-12, "barrier: its force")

# A start below the support: the constraint, its gap and the parameter.
for command, code in (("run", 3), ("check", 2)):
    result = p.call(command, p.source / "prm/point-mass.prm", *method("barrier"),
                    "--set", "Masses/Start=2")
    p.expect(result.returncode == code and "Masses/Start" in result.stderr
             and "1 with gap -1" in result.stderr
             and ("ABUT-F10" in result.stderr) == (code == 3),
             f"{command} from a closed start: {result.returncode} {result.stderr}")
p.expect(p.call("check", p.source / "prm/point-mass.prm", *method("interior point"),
                "--set", "Masses/Start=2").returncode == 0,
         "interior point starts anywhere")

# A floor under the start: u stays 0 and p is 8, and each outer step has its row,
# whose product p s falls.
summary, rows = p.solve("point-mass.prm", *method("interior point"), "--set",
                        "Masses/Stiffness=2", "--set", "Masses/Force=-8", "--set",
                        "Constraints/B=1", "--set", "Constraints/Initial gap=0")
p.close(summary["contact_force"][0], 8, 1e-6, "floor p")
p.expect([row["outer"] for row in rows] == list(range(1, len(rows) + 1))
         and len(rows) > 1, f"outer steps on a floor: {rows}")
p.expect(all(a["barrier"] > b["barrier"] for a, b in zip(rows, rows[1:])),
         "products on a floor")

# 0 has no sign.
p.solve("point-mass.prm", "--set", "Masses/Force=0.5")
for name in ("summary.json", "levels.csv"):
    p.expect(not re.search(r"-0(?![.\d])", (p.folder / "out" / name).read_text()),
             f"-0 in {name}")

# A mass that does not reach its support.
summary, _ = p.solve("point-mass.prm", "--set", "Masses/Force=0.5")
p.close(summary["displacement"][0], 0.5, 1e-12, "no contact u")
p.expect(summary["contact_force"][0] == 0 and summary["active"] == 0,
         "no contact p")

# Units divide out: the same mass in other units, each method.
LENGTH, FORCE = 1e3, 1e-4
for name in ("lagrange", "penalty", "quadratic penalty",
             "augmented lagrangian", "barrier", "interior point"):
    here, _ = p.solve("point-mass.prm", *method(name))
    there, _ = p.solve("point-mass.prm", *method(name), "--set",
                       f"Masses/Stiffness={K * FORCE / LENGTH}", "--set",
                       f"Masses/Force={MG * FORCE}", "--set",
                       f"Constraints/Initial gap={H * LENGTH}")
    p.close(there["displacement"][0] / LENGTH, here["displacement"][0], 1e-10,
            name + " in other units, u")
    p.close(there["contact_force"][0] / FORCE, here["contact_force"][0], 1e-10,
            name + " in other units, p")
    p.expect(there["nonlinear_iterations"] == here["nonlinear_iterations"],
             name + " in other units, steps")

# Method of multipliers: the error shrinks by 1 / (1 + c).
for c, count in ((1, 20), (10, 8)):
    summary, rows = p.solve("method-of-multipliers.prm", "--set",
                            f"Method/Penalty factor={c}")
    for i in range(count):
        error = (1 / (1 + c)) ** (i + 1)
        for name in ("u_1", "u_2"):
            p.close(rows[i][name], 0.5 * (1 - error), 1e-12,
                    f"multipliers c={c} {name} {i}")
        p.close(rows[i]["lambda"], error - 1, 1e-12,
                f"multipliers c={c} lambda {i}")

# Two masses between two walls, from the outside of both.
p.write("two.prm", """set Scene = point mass
subsection Masses
  set Stiffness = 2 -1; -1 2
  set Force = 4 -4
end
subsection Constraints
  set B = -1 0; 0 1
  set Initial gap = 0.5 0.25
end
""")
p.expect(p.call("run", "two.prm", "--output", "out").returncode == 0, "two")
summary, _ = p.results()
# u = (1/2, -1/4): p_1 = 4 - 2 u_1 + u_2, p_2 = 4 - u_1 + 2 u_2 (both pushed).
p.close(summary["displacement"][0], 0.5, 1e-12, "two u_1")
p.close(summary["displacement"][1], -0.25, 1e-12, "two u_2")
p.close(summary["contact_force"][0], 2.75, 1e-12, "two p_1")
p.close(summary["contact_force"][1], 3.0, 1e-12, "two p_2")

# A penalty that is not felt, a barrier below round-off, a number without effect.
result = p.call("run", "two.prm", "--output", "out",
                *set_words(["Method/Enforcement=penalty",
                            "Method/Penalty factor=1e-6"]))
p.expect(result.returncode == 0 and "ABUT-F06: Method/Penalty factor is 1e-06"
         in result.stderr, f"soft: {result.stderr}")
result = p.call("run", p.source / "prm/point-mass.prm", "--output", "out",
                *method("penalty", "Penalty factor=1e-20"))
p.expect(result.returncode == 3
         and set(re.findall(r"ABUT-F\d+", result.stderr)) == {"ABUT-F06"},
         f"penalty of 1e-20: {result.stderr}")
p.expect_error(p.call("run", p.source / "prm/point-mass.prm", "--set",
                      "Masses/Stiffness=0"),
               "Masses/Stiffness", "constraint 1", "spring")
p.write("open.prm", """set Scene = point mass
subsection Masses
  set Stiffness = 40
  set Force = 14.715
end
subsection Constraints
  set B = -1
  set Initial gap = 0.2
end
""")
result = p.call("run", "open.prm", "--output", "out",
                *set_words(["Method/Enforcement=barrier",
                            "Method/Barrier parameter=1e-20"]))
p.expect(result.returncode == 3 and "by round-off" in result.stderr,
         f"barrier of 1e-20: {result.stderr}")
p.expect_error(p.call("run", "open.prm",
                      *set_words(["Method/Enforcement=interior point",
                                  "Method/Barrier parameter=0.1"])),
               "Barrier parameter", "Method/Enforcement = barrier.")

p.finish()
