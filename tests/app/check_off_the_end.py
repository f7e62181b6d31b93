# SPDX-License-Identifier: LGPL-2.1-or-later
"""Dies that slide over the end of a body, over its corner and off it: where the
border of a surface cuts facets of the other one, in the plane and in space."""
from program import Program, set_words
from sliding_scenes import THICKNESS, newton, over_the_end

p = Program()
QUIET = ["Output/Fields=false", "Output/Pictures=false"]
STANDARD = ["Method/Discretisation=mortar"]


def solved(scene, *settings):
    result = p.call("run", scene, "--output", "out", "--quiet",
                    *set_words(settings))
    p.expect(result.returncode == 0, f"{scene} {settings}: exit code "
             f"{result.returncode}\n{result.stderr}")
    return p.results()


def check_end(what, summary, rows, most):
    """Few linearisations, forces in balance, and nothing left of contact."""
    n = [len(newton(p, step)) for step in range(1, len(rows) + 1)]
    print(what, "linearisations", n)
    p.expect(max(n) <= most, f"{what}: {n} linearisations")
    p.expect(summary["force_imbalance"] < 1e-12,
             f"{what}: forces {summary['force_imbalance']}")
    last = rows[-1]
    p.expect(last["active"] == 0 and last["contact_force"] == 0.,
             f"{what}: {last['active']} in contact at the end")


# A strip in plane strain has the forces of the plane by its thickness; facets
# there meet along their own normals, in the plane along those of the nodes.
def check_strip(secondary, *words, most=9):
    rows = {}
    for dimension in (2, 3):
        summary, rows[dimension] = solved(
            over_the_end(p, dimension, secondary), *words)
        check_end(f"over the end, {dimension}D, {secondary} {words}", summary,
                  rows[dimension], most)
    p.expect(len(rows[2]) == len(rows[3]), f"{secondary} {words}: load steps")
    scale = max(row["contact_force"] for row in rows[2])
    for flat, strip in zip(rows[2], rows[3]):
        for axis in "xy":
            key = f"pair_1_force_{axis}"
            force = strip[key] / THICKNESS
            p.expect(abs(force - flat[key]) < 1e-3 * scale,
                     f"{secondary} {words}: {key} at {flat['time']}: {force} in "
                     f"space, {flat[key]} in the plane")


check_strip(1)
if not p.short:
    check_strip(2)
    check_strip(1, *STANDARD, most=12)

# A round die comes over the corner of a block, across all its facets.
scene = (p.source / "prm/ironing-3d.prm").read_text()
(p.folder / "ironing-3d-die.inp").write_text(
    (p.source / "prm/ironing-3d-die.inp").read_text())
p.write("corner.prm", scene.replace(
    "if(t > 1, 2*(t - 1), 0), 0,",
    "if(t > 1, -1.6*(t - 1), 0), if(t > 1, -1.6*(t - 1), 0),"))
check_end("over the corner", *solved("corner.prm", *QUIET), 10)

# It is pressed in until its border is in contact, and slides on.
p.write("deep.prm", scene.replace("-0.1", "-0.25"))
summary, rows = solved("deep.prm", *QUIET, "Pair 1/Friction=0",
                       "Time stepping/End time=1.25", "Time stepping/Number of steps=15")
p.expect(len(rows) == 15, f"pressed in to its border: {len(rows)} load steps")

p.finish()
