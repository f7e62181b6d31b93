# SPDX-License-Identifier: LGPL-2.1-or-later
"""Bodies that do not touch exert no force, whichever way they are turned, and come
there: some of the scenes of tests/bench/false_contact.py."""
import apart_scenes
from program import Program, set_words
from ucd import ucd_volume

p = Program()


def force_of(file, what, *words):
    result = p.call("run", file, "--output", "out", "--quiet", *words)
    p.expect(result.returncode == 0,
             f"{what}: exit code {result.returncode}\n{result.stderr}")
    force = p.results()[0]["contact_force"] if result.returncode == 0 else 0.
    return force, result.stderr


for seed in range(12):
    file, kind, clearance = apart_scenes.make(p, seed)
    what = f"{kind} {seed} at {clearance} facets"
    force, _ = force_of(file, what)
    p.expect(force == 0., f"{what}: force {force}")
for seed in (*range(8), 81, 108, 114, 127):
    file, kind, clearance = apart_scenes.make_coming(p, seed)
    strain = list(apart_scenes.LARGE)[seed // 2 % 2]
    what = f"{kind} {seed}, {strain}, at {clearance} facets"
    force, errors = force_of(file, what, *set_words(apart_scenes.LARGE[strain]))
    p.expect(force == 0., f"{what}: force {force}")
    p.expect("surfaces are apart" not in errors, f"{what}: {errors}")

# A ball that the block alone carries, by a constraint that presses where the two
# are apart at first.
WEIGHT = 1e-3
file, kind, _ = apart_scenes.make_coming(p, 25)
force, errors = force_of(file, "ball on a block", *set_words(
    ["Method/Contact geometry=current", "Body 2/Prescribed displacement=2: 0, 0, free",
     f"Body 2/Body force=0, 0, -{WEIGHT}"]))
weight = WEIGHT * ucd_volume((p.folder / "coming-25-b3.inp").read_text())
p.expect(abs(force / weight - 1.) < 1e-4, f"force {force}, weight {weight}")
p.finish()
