# SPDX-License-Identifier: LGPL-2.1-or-later
"""On several ranks: errors are printed once, no rank is left waiting, results
are the same."""
from program import Program

p = Program()
scene = p.source / "prm/point-mass.prm"
for ranks in (2, 3):
    p.expect_error(p.call("run", "nowhere.prm", ranks=ranks), "nowhere.prm")
    p.expect_error(p.call("run", scene, "--set", "Method/Penalty factor=x",
                          ranks=ranks), "Method/Penalty factor", "a number")
    p.write("file", "")
    p.expect_error(p.call("run", scene, "--output", "file/x", ranks=ranks),
                   "file/x")
    summary, _ = p.solve("point-mass.prm", ranks=ranks)
    p.expect(summary["ranks"] == ranks, "number of ranks")
    p.close(summary["contact_force"][0], 2, 1e-12, f"force on {ranks} ranks")
    version = p.call("--version", ranks=ranks).stdout
    p.expect(version.count("deal.II") == 1, "printed once: " + version)

# A formula that is not a number on some ranks only.
blocks = p.source / "prm/two-blocks-3d.prm"
for name, formula in (("Pressure", "0: sqrt(0.6-y)"),
                      ("Support", "5: 0, 0, -0.02*sqrt(0.6-y)"),
                      ("Body force", "0, 0, sqrt(0.6-y)")):
    p.expect_error(p.call("run", blocks, "--set", "Refinement/Level=0", "--set",
                          f"Body 2/{name}={formula}", ranks=3),
                   f"Body 2/{name}", "not a number")
p.finish()
