# SPDX-License-Identifier: LGPL-2.1-or-later
import math

TITLE = "two blocks with an exponential contact law"
SOURCE = ("CalculiX (https://github.com/Dhondtguido/CalculiX), "
          "`test/contact1.inp` and `.dat.ref`")
QUICK = True
PROBLEM = r"""
The cube and the block of [01](#01-calculix-contactenergy-two-blocks-with-a-linear-contact-law) with $\nu = 0.3$. No node moves in the
plane. The top of the block is fixed and its foot pulled down by the force 1. All nodes of a surface move by the same displacement. The law
of contact is $p(g) = 6.66666 \exp(-\ln(100)\, g / (1.5351 \cdot 10^{-7}))$ at nodes.

Closed form with the displacement $u$ of the foot, downwards, and $M = E (1 - \nu) / ((1 + \nu)(1 - 2 \nu))$: the root of
$0.03\, p(g) + 0.2 M u = 1$, where $g = 0.03\, p / M - u$.
"""
SKETCH = r"""
      /////////
      |  block  | 0.2
      |    v 1  |
     ++---------+-------+
     |                  |
     |       cube       | 1
     |                  |
     +------------------+
     ////////////////////
"""
ELEMENTS = r"""
The same hexahedra, contact at nodes, the same law in C (`tests/verification/law.c`). The strains of 3e-6 are large strain
in CalculiX. Tolerance: 1e-5.
"""
REMARKS = r"""
A surface given by nodes has no area in the deck. Its reactions below the cube are 4 x 0.2077733; the pressure of the law at its gap is
27.703. The quotient is an area of 0.03. The foot of the scene has the area 0.04, and its touch pressure is 5, with the same force.
"""
E, NU = 210000., 0.3
M = E * (1 - NU) / ((1 + NU) * (1 - 2 * NU))


def closed_form():
    """Displacements of cube and foot, by bisection on the contact force."""
    def rest(force):
        foot = (1 - force) / (0.04 * M / 0.2)
        gap = force / M - foot
        return 0.03 * 6.66666 * math.exp(-math.log(100) * gap / 1.5351e-7) \
            - force
    low, high = 0., 1.
    for _ in range(200):
        middle = (low + high) / 2
        low, high = (middle, high) if rest(middle) > 0 else (low, middle)
    return -low / M, -(1 - low) / (0.04 * M / 0.2)


def solve(deck):
    deck.compile("exponential")
    result = deck.run(settings={"Method/Discretisation": "node to segment"})
    foot = (0.5, 0.5 - 0.02 ** 0.5, 1)
    cube, block = closed_form()
    for quantity, body, place, value, exact in (
            ("u_z, top of the cube", 1, (0, 0, 1), -2.939934e-6, cube),
            ("u_z, foot of the block", 2, foot, -2.987416e-6, block)):
        found = result.moved(body, *place)[2]
        deck.compare(quantity, value, found, 1e-5)
        deck.compare(quantity + ", closed form", exact, found, 1e-5)
    deck.compare("reaction below the cube", 4 * 0.2077733,
                 result.summary["reaction_1"][2], 1e-5)
