# SPDX-License-Identifier: LGPL-2.1-or-later
"""Entries of the failure atlas show what their files expect: each third of
them is a test of its own (--part 1, 2 or 3)."""
from program import Program

p = Program()
failures = p.source / "prm/failures"
names = sorted(file.name.replace(".cure.prm", "")
               for file in failures.glob("*.cure.prm"))
p.expect(len(names) >= 20, f"{len(names)} entries only")
for name in names[p.part - 1::3]:
    result = p.call("atlas", failures / f"{name}.prm", "--output", name,
                    timeout=250)
    p.expect(result.returncode == 0,
             f"{name}: {result.stdout}{result.stderr}")
p.finish()
