# SPDX-License-Identifier: LGPL-2.1-or-later
"""Bodies that do not touch exert no force, whichever way they are turned: some of
the scenes of tests/bench/false_contact.py. Where points follow, a force is
reported."""
import apart_scenes
from program import Program, set_words

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
n_reported = 0
for seed in range(8):
    file, kind, clearance = apart_scenes.make_coming(p, seed)
    strain = list(apart_scenes.LARGE)[seed // 2 % 2]
    for way in ("dual mortar", "mortar"):
        what = f"{kind} {seed}, {strain}, {way}, at {clearance} facets"
        force, errors = force_of(file, what, *set_words(
            apart_scenes.LARGE[strain] + [f"Method/Discretisation={way}"]))
        reported = "ABUT-F36" in errors and "surfaces are apart" in errors
        n_reported += reported
        p.expect(reported or force == 0., f"{what}: force {force}")
        p.expect(way != "mortar" or force == 0., f"{what}: force {force}")
        p.expect(force > 0. or not reported, f"{what}: {errors}")
p.expect(n_reported > 0, "no scene has a force to report")
p.finish()
