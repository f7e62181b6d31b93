# SPDX-License-Identifier: LGPL-2.1-or-later
from cells import Cells, sides

TITLE = "two squares, and Taylor's patch test"
SOURCE = ("Kratos (https://github.com/KratosMultiphysics/Kratos), "
          "`applications/ContactStructuralMechanicsApplication/tests/"
          "ALM_frictionless_contact_test_2D`: `hyper_simple_patch_test*`, "
          "`taylor_patch_test*`; `contact_test_2D/taylor_patch_test_results`")
QUICK = True
PROBLEM = r"""
(a) Two squares of one cell each, 0.001 apart, in plane strain, $E = 2.069 \cdot 10^{11}$, $\nu = 0.29$. The lower one is clamped below, the
upper end of the upper one moves by (0, -0.01).

(b) A punch on a wider foundation, with cells that do not match, $E = 1000$, $\nu = 0.4$. The load is 10 downwards on all of the upper side. One node
of the foundation is fixed, and one of the punch along $x$. Contact is that of the deformed bodies. The punch slides on the foundation while both
widen, so that the stress is not quite uniform.
"""
SKETCH = r"""
   (a)    -0.01           (b)            10
        +---v---+                      v v v v
        |       |                     x+--+--+--+ 7.0002
        |   2   |                      +--+--+--+
        |       |                10    +--+--+--+     10
        +-------+ 1.001         v v v  |  |  |  |   v v v
        +-------+ 1            +-------+--+-++--+-------+ 5
        |   1   |              |       |    |   |   |   |
        +-------+              +-------+----+---+---+---+
        /////////              x o     o    o   o   o   o 0
                               0       4    5   6   7   8
"""
ELEMENTS = r"""
(a) The same element and law: 1e-5. (b) The parameters name elements of small strain, but the values are those of St. Venant and Kirchhoff's
law: the uniform stress has $u_y = -0.0425414$ with it, and -0.042 with small strain. Each program makes its pairs of facets at another
configuration. Tolerance: the spread of two versions of Kratos and of CalculiX 2.20 on the same mesh.
"""
REMARKS = r"""
CalculiX was run with large strain in 100 steps, elements C3D8I and C3D8 of one layer in plane strain, and contact `SURFACE TO SURFACE` with 1e6
and 1e7, and `MORTAR`. It makes pairs at the beginning of a step: in one step it finds the uniform stress. Kratos stops at a residual of 1e-4.

A node is fixed by an additional cell that shares only this node with the body.
"""
# Kratos; Kratos, another version; CalculiX: penalty 1e6, 1e7, mortar.
TAYLOR = {
    "u_x, right edge of the punch (node 6)": (
        2, 6, 0, (.011834703262714142, .011939456202008106, .01188404,
                  .0117589, .01189396)),
    "u_y, right edge of the punch (node 6)": (
        2, 6, 1, (-.04225148523004462, -.0422337444555267, -.04221809,
                  -.04227141, -.04239909)),
    "u_y, left edge of the punch (node 5)": (
        2, 4, 1, (-.042798323114117555, -.042804104263796675, -.04285859,
                  -.04277936, -.04304829)),
    "u_x, foundation at the right edge (node 12)": (
        1, 6, 0, (.033756735950855106, .03378954, .03377608, .03379092)),
    "u_y, foundation at the right edge (node 12)": (
        1, 6, 1, (-.04224619418323703, -.0422012, -.04226485, -.04219261)),
    "u_y, foundation at the left edge (node 11)": (
        1, 4, 1, (-.042792215036493955, -.04284232, -.04277325, -.04284314)),
}


def meshes(deck):
    foundation = Cells(2).grid([0, 2, 4, 5, 6, 7, 8], [0, 2.5, 5])
    foundation.grid([-1, 0], [-1, 0])
    deck.write("foundation.msh", foundation.gmsh(sides(
        lambda x, y: y == 5 and 4 <= x <= 6,
        lambda x, y: x <= 0 and y <= 0,
        lambda x, y: y == 0,
        lambda x, y: y == 5)))
    punch = Cells(2).grid([4, 4.66667, 5.33333, 6],
                          [5, 5.66687, 6.33353, 7.0002])
    punch.grid([3, 4], [7.0002, 8])
    deck.write("punch.msh", punch.gmsh(sides(
        lambda x, y: y == 5,
        lambda x, y: x <= 4 and y >= 7.0002,
        lambda x, y: False, lambda x, y: False,
        lambda x, y: y == 7.0002)))


def solve(deck):
    result = deck.run("hyper-simple.prm")
    for name, body, place, wanted in (
            ("4", 1, (0, 1), (-.0012842603523971455, -.004502292040013044)),
            ("6", 2, (1, 1.001), (.0012840599124051342, -.005502292040013026))):
        for d, found, value in zip("xy", result.moved(body, *place), wanted):
            deck.compare(f"(a) u_{d}, node {name}", value, found, 1e-5)
    meshes(deck)
    result = deck.run("taylor.prm")
    for name, (body, x, direction, others) in TAYLOR.items():
        deck.within("(b) " + name, others,
                    result.moved(body, x, 5)[direction])
