# SPDX-License-Identifier: LGPL-2.1-or-later
TITLE = "two cubes pressed together"
SOURCE = ("code_aster, `astest/ssnv167a.comm` and `.mail` "
          "(https://github.com/ralic/Code_Aster); its own values are -0.1 and "
          "1e4 to 1e-8")
QUICK = True
PROBLEM = r"""
Two cubes of edge 2, one hexahedron each, $E = 200000$, $\nu = 0$. The lower cube is clamped below, the upper end of the upper one moves down by
0.2. Closed form: the interface moves by half of it. The contact force is $0.05\, E \cdot 4 = 40000$, a quarter of it at each node.
"""
SKETCH = r"""
        -0.2
     +----v----+ z = 4
     |    2    |
     +---------+ z = 2    contact, no friction
     |    1    |
     +---------+ z = 0
     ///////////
"""
ELEMENTS = r"""
The same hexahedra. code_aster has constraints at nodes; Abut is run with nodes, dual mortar and mortar. Tolerance: 1e-8, that of the deck.
"""


def solve(deck):
    for method in ("node to segment", "dual mortar", "mortar"):
        result = deck.run(settings={"Method/Discretisation": method})
        nodes = [result.node(body, x, y, 2) for body in (1, 2)
                 for x in (0, 2) for y in (0, 2)]
        # The one of the eight nodes that is farthest from the value.
        for name, wanted, found in (
                ("u_z at the interface", -.1,
                 [row["displacement_z"] for row in nodes]),
                ("nodal force at the interface", 1e4,
                 [row["contact_z"] * (1 if row["body"] == 2 else -1)
                  for row in nodes])):
            deck.compare(f"{name}, {method}", wanted,
                         max(found, key=lambda v: abs(v - wanted)), 1e-8)
