# SPDX-License-Identifier: LGPL-2.1-or-later
import math
import pathlib

ROOT = pathlib.Path(__file__).resolve().parents[3]
TITLE = "NAFEMS' roller on a block"
SOURCE = ("code_aster, `astest/ssnp154a.comm` and `ssnp154b.comm` "
          "(https://github.com/ehmoussi/code_aster); NAFEMS R0094, problem 1")
QUICK = True
PROBLEM = r"""
A steel roller of radius 50 on an aluminium block of 200 x 200, in plane strain, $E = 210000$ and 70000, $\nu = 0.3$. The force is 35000 per
length; half of both is modelled. The values are the displacement $u_y$ of the block below the roller, and Cauchy's stress there.
"""
SKETCH = r"""
        17500
      |   v
      |---___
      |      \      R = 50
      |      |
      |   __/
      +-----------+ 0
      |           |
      |   block   |
      |           |
      +-----------+ -200
      /////////////
      0          100
"""
ELEMENTS = r"""
Large strain with St. Venant and Kirchhoff's law in both programs. Quadrilaterals of degree 1 (ssnp154a) and 2 (ssnp154b) there, adaptive meshes
of degree 1 and 2 here (`prm/nafems-roller.prm`); the force acts on a node there, on the upper half of the middle here. Tolerance for
$u_y$: 9.4e-4, the difference of ssnp154a and ssnp154b. The stress of coarse meshes is -3800.49 and -3513.60; tolerance 1 % of the latter.
"""
REMARKS = r"""
The pressure of Abut is per area of the reference configuration. The stress is the pressure divided by the stretch of the surface there. With
172160 unknowns of degree 1 Abut has -1.308259.
"""
# Degree 2 in code_aster's later version.
DISPLACEMENT, STRESS = -1.308132564, -3513.59670
SPREAD = 9.4e-4


def solve(deck):
    for degree in (1, 2):
        result = deck.run(str(ROOT / "prm/nafems-roller.prm"), {
            "Body 1/Material": "st venant-kirchhoff",
            "Body 2/Material": "st venant-kirchhoff", "Solid/Degree": degree,
            "Output/Nodal values": "true", "Output/Fields": "false"})
        deck.compare(f"u_y, degree {degree}", DISPLACEMENT,
                     result.moved(1, 0, 0)[1], SPREAD)
        # The first node beside the axis on the top of the block.
        row = min((row for row in result.nodes
                   if row["body"] == 1 and row["y"] == 0 and row["x"] > 0),
                  key=lambda row: row["x"])
        stretch = math.hypot(
            row["x"] + row["displacement_x"],
            row["displacement_y"] - result.moved(1, 0, 0)[1]) / row["x"]
        deck.compare(f"stress below the roller, degree {degree}", STRESS,
                     -result.summary["pair_1_pressure"] / stretch, .01)
