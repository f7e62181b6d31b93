# SPDX-License-Identifier: LGPL-2.1-or-later
"""Bodies that do not touch exert no force, whichever way they are turned: twelve of
the scenes of tests/bench/false_contact.py."""
import apart_scenes
from program import Program

p = Program()
for seed in range(12):
    file, kind, clearance = apart_scenes.make(p, seed)
    result = p.call("run", file, "--output", "out", "--quiet")
    p.expect(result.returncode == 0,
             f"{kind} {seed}: exit code {result.returncode}\n{result.stderr}")
    if result.returncode == 0:
        force = p.results()[0]["contact_force"]
        p.expect(force == 0., f"{kind} {seed}: force {force} at a clearance of "
                              f"{clearance} facets")
p.finish()
