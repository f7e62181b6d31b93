# SPDX-License-Identifier: LGPL-2.1-or-later
"""The failure atlas: its page is complete, and what does not hold is found
out."""
import json
import re

from program import Program

p = Program()
failures = p.source / "prm/failures"

# The page names all files, and in its first table the entries of each code.
page = (p.source / "doc/failures.md").read_text()
rows = dict(re.findall(r"^\| (ABUT-F\d\d) (.*)$", page, re.M))
p.expect(set(re.findall(r"`([\w-]+(?:\.cure)?\.prm)`", page))
         >= {file.name for file in failures.glob("*.prm")},
         "doc/failures.md does not name all files: write it by abut atlas")
for file in failures.glob("*.prm"):
    for code in re.findall(r"^# (?:failure|avoids): (ABUT-F\d\d)",
                           file.read_text(), re.M):
        p.expect(f" {file.stem}" in rows.get(code, ""),
                 f"doc/failures.md: {file.stem} does not stand at {code}")
p.expect("Not as expected" not in page, "doc/failures.md has a failure")

# One entry, which is run; all are by check_failures.py.
result = p.call("atlas", failures / "penalty-small.prm", "--output", "atlas")
p.expect(result.returncode == 0, "penalty-small:\n" + result.stdout)
text = (p.folder / "atlas/failures.md").read_text()
for words in ("## ABUT-F06: penalty too small", "**Cure.**",
              "warning: ABUT-F06: Pair 1: the bodies penetrate", "`max_penetration`"):
    p.expect(words in text, f"'{words}' is not on the page:\n{text}")

# The warning is in the summary with its code.
summary = json.loads((p.folder
                      / "atlas/penalty-small/failing/summary.json").read_text())
p.expect(any(line.startswith("ABUT-F06: ") for line in summary["warnings"]),
         f"warnings: {summary['warnings']}")
found = [finding for finding in summary["findings"].values()
         if "penetration" in finding["numbers"]]
p.expect(len(found) == 1 and found[0]["code"] == "ABUT-F06"
         and found[0]["pair"] == "Pair 1"
         and abs(found[0]["numbers"]["penetration"] - summary["max_penetration"])
         <= 1e-12 * summary["max_penetration"],
         f"findings: {summary['findings']}")

# Wrong expectations, one after the other, of an entry that is right.
MASS = """set Scene = point mass
subsection Masses
  set Stiffness = 4 1 0; 1 9 1; 0 1 7
  set Force = -2, -1, 3
end
subsection Constraints
  set B = -1 0 0; 0 -1 0; 0 0 -1
  set Initial gap = 0, 0, 0
end
"""
CURE = ("# cure: no sets\n# symptom: energy = cure\ninclude e.prm\n"
        "subsection Method\n  set Enforcement = interior point\nend\n")


def entry(head, cure=CURE):
    p.write("e.prm", "# title: t\n# done: d\n" + head + MASS)
    p.write("e.cure.prm", cure)
    return p.call("atlas", "e.prm", "--output", "e")


result = entry("# failure: none\n# symptom: energy = cure\n")
p.expect(result.returncode == 0, "right entry:\n" + result.stdout)
for head, words in (
        ("# failure: ABUT-F06\n", "does not say ABUT-F06"),
        ("# failure: none\n# exit: 3\n", "exit code 0 instead of 3"),
        ("# failure: none\n# symptom: energy > 0.5 * cure\n",
         "does not hold: energy"),
        ("# failure: none\n# symptom: no_such_number > 0\n",
         "does not hold: no_such_number")):
    result = entry(head)
    p.expect(result.returncode == 3 and words in result.stdout,
             f"{words}: {result.returncode}\n{result.stdout}")
result = entry("# failure: none\n", "# cure: c\n# exit: 3\ninclude e.prm\n")
p.expect(result.returncode == 3, "a cure that ends otherwise")

# What is written wrongly.
for head, word in (("", "failure"), ("# failure: ABUT-F99\n", "ABUT-F99"),
                   ("# failure: none\n# avoids: ABUT-F98\n", "ABUT-F98"),
                   ("# failure: ABUT-F06\n# avoids: ABUT-F06\n", "avoids"),
                   ("# failure: none\n# symptm: energy > 0\n", "symptom"),
                   ("# failure: none\n# symptom: energy 0\n", "energy 0"),
                   ("# failure: none\n# exit: three\n", "three"),
                   ("# failure: none\n# vary: Penalty\n", "vary")):
    p.expect_error(entry(head), word)
p.expect_error(p.call("atlas", "nowhere"), "nowhere")
p.expect_error(p.call("atlas", "--otput", "x"), "--output")
p.write("lonely.prm", MASS)
p.expect_error(p.call("atlas", "lonely.prm"), "lonely.prm")
p.expect_error(p.call("atlas", p.folder / "e"), ".cure.prm")

p.finish()
