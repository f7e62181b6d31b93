# SPDX-License-Identifier: LGPL-2.1-or-later
"""Parameters: what the reference states of each, and names that have changed."""
import re

from program import Program

p = Program()
reference = p.call("parameters").stdout
scenes = reference.split("\n## Old names\n")[0]
ENTRY = re.compile(r'^- <a id="(.*?)"></a>\*\*(.*?)\*\* = (.*?) \(([^;]*)(?:; '
                   r"(.*?))?; (basic|advanced|expert)\)\. (.*)$")

# Each has a type, a level and a text; numbers have a unit, and all but words and
# truth values an example.
entries = [line for line in scenes.split("\n") if line.startswith("- <a")]
anchors = []
for line in entries:
    found = ENTRY.match(line)
    p.expect(found, f"not an entry: {line}")
    if not found:
        continue
    anchor, name, _, kind, unit, _, text = found.groups()
    anchors.append(anchor)
    is_number = re.match(r"a (whole )?number|a formula|a vector|a list of numbers",
                         kind)
    p.expect(kind != "text", f"{anchor} has no type")
    p.expect(unit or not is_number or "by boundary id" in kind
             or "by" in anchor, f"{anchor}: no unit: {line}")
    if not re.match("one of|true or false", kind):
        p.expect("Example: `" in text, f"{anchor}: no example")
p.expect(len(entries) > 200, f"{len(entries)} entries")
p.expect(len(anchors) == len(set(anchors)), "an anchor twice")
p.expect(len(entries) == len({line.split("</a>")[1] for line in entries}),
         "an entry is printed twice")
links = set(re.findall(r"\]\(#(.*?)\)", reference))
headings = {re.sub(r"[^a-z0-9_ -]", "", heading.lower()).replace(" ", "-")
            for heading in re.findall(r"^##+ (.*)$", reference, re.M)}
p.expect(links <= headings, f"links: {links - headings}")

# By kind of scene and level.
counts = []
for level in ("basic", "advanced", "expert"):
    text = p.call("parameters", "--scene", "solid", "--level", level).stdout
    counts.append(len(re.findall(r"^- \*\*", text, re.M)))
print("entries of solid:", *counts)
p.expect(30 <= counts[0] <= 45 < counts[1] < counts[2], f"entries: {counts}")
solid = p.call("parameters", "--scene", "solid").stdout
for name in ("Self contact", "Extension", "Conductivity", "Restitution"):
    p.expect(f"**{name}**" not in solid, f"{name} in solid")
masses = p.call("parameters", "--scene", "point mass").stdout
for name in ("Discretisation", "Contact geometry", "Friction file"):
    p.expect(f"**{name}**" not in masses, f"{name} of point masses")
p.expect_error(p.call("parameters", "--scene", "solids"), "solid")
p.expect_error(p.call("parameters", "--level", "easy"), "basic")
p.expect_error(p.call("parameters", "solid"), "takes no")

# The same block with old names and with those of today.
BLOCK = """set Scene = solid
subsection Solid
  set Obstacles = 1
  set Pairs = 1
end
subsection Body 1
  set {support} = 3: 0, -0.01*t
  subsection Mesh
    set Generator = hyper_rectangle
    set Arguments = 0, 0 : 1, 1 : true
  end
end
subsection Pair 1
  set Secondary = 1: 2
  set Obstacle = 1
  set {gap} = true
  set Reach = {reach}
end
subsection Method
  set Enforcement = penalty
  set {penalty} = {auto}
  set {geometry} = {reference}
end
subsection {steps}
  set {number} = 2
end
subsection Refinement
  set Level = 1
  set Target error = {none}
end
subsection Output
  set Fields = false
end
"""
OLD = {"support": "Support", "gap": "Mesh gap", "reach": "0",
       "penalty": "Penalty", "auto": "0", "geometry": "Sliding",
       "reference": "small", "steps": "Load steps", "number": "Steps",
       "none": "0"}
NEW = {"support": "Prescribed displacement", "gap": "Use mesh gap",
       "reach": "auto", "penalty": "Penalty factor", "auto": "auto",
       "geometry": "Contact geometry", "reference": "reference",
       "steps": "Time stepping", "number": "Number of steps", "none": "none"}
p.write("old.prm", BLOCK.format(**OLD))
p.write("new.prm", BLOCK.format(**NEW))


def run(scene, *words):
    result = p.call("run", scene, "--output", "out", *words)
    p.expect(result.returncode == 0, f"{scene}: {result.stderr}")
    return result.stdout, p.results()


words, (old, _) = run("old.prm")
for names in ("'Body 1/Support' is now 'Body 1/Prescribed displacement'",
              "'Pair 1/Mesh gap' is now 'Pair 1/Use mesh gap'",
              "'Method/Penalty' is now 'Method/Penalty factor'",
              "'Method/Penalty factor = 0' is now 'auto'",
              "'Method/Contact geometry = small' is now 'reference'",
              "'Load steps/Steps' is now 'Time stepping/Number of steps'",
              "'Pair 1/Reach = 0' is now 'auto'",
              "'Refinement/Target error = 0' is now 'none'"):
    p.expect(names in words, f"no {names} in {words}")
p.expect(sum("old names" in line for line in words.split("\n")) == 1,
         "more than one line about old names")
words, (new, _) = run("new.prm")
p.expect("old name" not in words, f"names of today are old: {words}")
for key in ("contact_force", "energy", "dofs", "nonlinear_iterations"):
    p.expect(old[key] == new[key], f"{key}: {old[key]}, {new[key]}")

# Options count more, by either name; two names in one place are an error.
for scene in ("old.prm", "new.prm"):
    for name in ("Load steps/Steps", "Time stepping/Number of steps"):
        _, (_, rows) = run(scene, "--set", f"{name}=3")
        p.expect(len(rows) == len(p.results()[1]) and "time" in rows[-1],
                 "a table of steps")
        p.expect(len({row["time"] for row in rows}) == 3,
                 f"{scene}, {name}: {len(rows)} rows")
p.write("both.prm", BLOCK.format(**NEW).replace(
    "  set Number of steps = 2\n", "  set Number of steps = 2\nend\n"
    "subsection Load steps\n  set Steps = 2\n"))
p.expect_error(p.call("check", "both.prm"), "both.prm:", "'Load steps/Steps'",
               "'Time stepping/Number of steps'")
p.expect_error(p.call("check", "new.prm", "--set", "Time/End=1", "--set",
                      "Time stepping/End time=1"), "'Time/End'",
               "'Time stepping/End time'")
p.finish()
