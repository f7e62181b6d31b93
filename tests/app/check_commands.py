# SPDX-License-Identifier: LGPL-2.1-or-later
"""What the commands print, and what a run writes."""
import re

from program import Program

p = Program()
scene = p.source / "prm/point-mass.prm"

version = p.call("--version").stdout
for name in ("abut", "deal.II", "Trilinos"):
    p.expect(re.search(rf"^{name} \d+\.\d+", version, re.M),
             f"no version of {name} in {version}")

for words in ([], ["--help"], ["help"]):
    p.expect("abut run SCENE.prm" in p.call(*words).stdout, f"help {words}")
p.expect("--output" in p.call("help", "run").stdout, "help run")
for command in ("run", "check", "search", "chart", "atlas", "draw", "report",
                "parameters"):
    p.expect(p.call(command, "--help").stdout == p.call("help", command).stdout
             and p.call(command, "--help").returncode == 0, f"{command} --help")

result = p.call("check", scene)
p.expect(result.returncode == 0 and "no errors found" in result.stdout,
         "check " + result.stdout + result.stderr)
p.expect(not (p.folder / "output").exists(), "check must not write")

# The default folder, and what is printed.
result = p.call("run", scene)
p.expect((p.folder / "output/point-mass/summary.json").exists(),
         "default output folder")
for text in ("contact_force", "lambda", "What was modelled", "What it cost"):
    p.expect(text in result.stdout, f"no '{text}' in the table")
p.expect("\x1b" not in result.stdout and "\r" not in result.stdout,
         "control characters where there is no terminal")
p.expect(p.call("run", scene, "--quiet").stdout == "", "--quiet prints")

summary, _ = p.solve("point-mass.prm")
for key in ("scene", "method", "discretisation", "dofs", "constraints",
            "active", "contact_force", "max_penetration",
            "max_complementarity", "energy", "nonlinear_iterations",
            "linear_iterations", "matvecs", "search_rebuilds", "pairs",
            "l2_error", "h1_error", "wall_seconds", "sections",
            "peak_memory_mb", "ranks", "converged"):
    p.expect(key in summary, f"summary.json has no {key}")
p.expect(summary["converged"] is True, "converged")
p.expect(summary["sections"]["solve"]["calls"] == 1, "section times")

# The last of two values counts, and lines may go on.
p.write("a.prm", "set Scene = point mass\nset Title = \\\n  long\n"
        "subsection Masses\n set Force = bad\n set Force = 3 # good\nend\n"
        "subsection Constraints\n set B = -1\n set Initial gap = 1\nend\n")
p.expect(p.call("run", "a.prm", "--output", "out").returncode == 0, "a.prm")
p.expect(p.results()[0]["title"] == "long", "continued line")

# A run that does not converge is told apart, and writes what it has.
result = p.call("run", scene, "--output", "out", "--set",
                "Method/Enforcement=augmented lagrangian", "--set",
                "Method/Maximum outer steps=2", "--set",
                "Method/Gap tolerance=1e-12")
p.expect(result.returncode == 3, f"exit code {result.returncode}, not 3")
p.expect("warning" in result.stderr, "no word about the failure")
p.expect(p.results()[0]["converged"] is False, "unconverged summary")

p.finish()
