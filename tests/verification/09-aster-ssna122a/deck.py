# SPDX-License-Identifier: LGPL-2.1-or-later
import math

from cells import Cells, sides

TITLE = "NAFEMS' punch with a rounded edge"
SOURCE = ("code_aster, `astest/ssna122a.comm` "
          "(https://github.com/ralic/Code_Aster), `ssna122b.comm` "
          "(https://github.com/ehmoussi/code_aster); NAFEMS R0094, problem 2")
QUICK = True
OPEN = "stress not decided"
PROBLEM = r"""
A steel cylinder of radius 50 and height 100 with an edge of radius 10 stands on an aluminium cylinder of radius 100 and height 200,
axisymmetric, $E = 210000$ and 70000, $\nu = 0.3$. The load on its top is 100, $\mu = 0$ or 0.1. The value is the
displacement along the axis, in the middle M of the contact.
"""
SKETCH = r"""
      axis    100
       | v v v v v v
       +-----------+ 100
       |           |
       |   punch   |
       |          _|   edge: R = 10
     M +---------'----------+ 0
       |                    |
       |     foundation     |
       |                    |
       +--------------------+ -200
       //////////////////////
       0          50       100
"""
ELEMENTS = r"""
Large strain with St. Venant and Kirchhoff's law. Cells of 5 of degree 1 (ssna122a) and 2 (ssna122b) there, quadrilaterals of degree 1 and size 2.5
here. Tolerance: the spread of both. The punch is generated from the lengths; with cells of 5 its rounded edge has three cells.
"""
REMARKS = r"""
The contact ends in the rounded edge, and the meshes of the decks do not resolve it. With cells of 5, 2.5, 1.25 and 0.625 the displacement
is -0.12848, -0.13275, -0.13390 and -0.13442 without friction, and -0.13435 with degree 2 and cells of 2.5: 1.1 % beyond ssna122b. CalculiX 2.20 with
cells of 5, 2.5 and 1.25 has -0.12433, -0.12952 and -0.13223 with degree 1 and -0.12711, -0.13062 and -0.13239 with degree 2. Its degree 1,
extrapolated, has -0.1349, and so has Abut.

Not decided: the stress in M is -91.10 and -94.12 without friction and -88.67 and -95.47 with it in the decks, taken from the stress of the
foundation. The contact pressure of Abut in M is 85.87 and 87.04 with cells of 2.5 and 1.25, and 87.02 with friction; it is smooth along the radius.
The stress of CalculiX is disturbed on the axis (between -10 and -79 in one element) and cannot decide.
"""
# ssna122a, ssna122b
FREE = (-.13073410182805, -.132941255)
FRICTION = (-.12858017574262, -.130793547)


def punch():
    def place(a, s):
        # a: 0 to 8 along the flat part, to 11 around the edge
        turn = max(0., a - 8) / 3 * math.pi / 2
        x = 5. * min(a, 8) + 10 * math.sin(turn)
        y = 10 - 10 * math.cos(turn)
        return x, y + (100 - y) * s / 20
    cells = Cells(2).grid(range(12), range(21), change=place)
    return cells.gmsh(sides(
        lambda x, y: x == 0, lambda x, y: abs(y - 100) < 1e-9,
        lambda x, y: y == 0,
        lambda x, y: abs(math.hypot(x - 40, y - 10) - 10) < 1e-9))


def solve(deck):
    deck.write("punch.msh", punch())
    for mu, others in ((0, FREE), (.1, FRICTION)):
        result = deck.run(settings={"Refinement/Level": 1,
                                    "Pair 1/Friction": mu})
        deck.within(f"u_y in M, mu = {mu}, cells of 2.5", others,
                    result.summary["point_1"][1])
