# SPDX-License-Identifier: LGPL-2.1-or-later
TITLE = "two blocks with a linear contact law"
SOURCE = ("CalculiX (https://github.com/Dhondtguido/CalculiX), "
          "`test/contactenergy.inp` and `.dat.ref`")
QUICK = True
PROBLEM = r"""
A cube of edge 1 is clamped below. A block of 0.2 x 0.2 x 0.2, rotated by 45 degrees, stands in the middle of its upper face. Four
unit loads press on the corners of the block; its foot is fixed in the plane. $E = 210000$, $\nu = 0$. The law of contact is
$p = 10^7 \langle -g \rangle$.

Closed form: $4/E = 1.904762 \cdot 10^{-5}$ for the cube, a penetration of $4/(0.04 \cdot 10^7) = 10^{-5}$, and $4 \cdot 0.2/(0.04 E)$ for
the block.
"""
SKETCH = r"""
            4 x 1
           | | | |
          _v_v_v_v_
         |  block  | 0.2      top view:  +-------+
     +---+---------+---+                 |   .   |
     |                 |                 | .   . |  0.2 x 0.2,
     |      cube       | 1               |   .   |  turned by 45 degrees
     |                 |                 +-------+
     +-----------------+
     ///////////////////
"""
ELEMENTS = r"""
The same hexahedra. CalculiX integrates the pressure over the surfaces, Abut uses dual mortar and the same law in C
(`tests/verification/law.c`). The pressure is uniform, so that both are the same. Tolerance: 1e-5.
"""


def solve(deck):
    deck.compile("linear")
    # The foot is smaller than the facet of the cube, which is said.
    result = deck.run()
    for name, body, place, value in (
            ("u_z, top of the cube", 1, (0, 0, 1), -1.904762e-5),
            ("u_z, foot of the block", 2, (0.5, 0.5 - 0.02 ** 0.5, 1),
             -2.904767e-5),
            ("u_z, top of the block", 2, (0.5, 0.5 - 0.02 ** 0.5, 1.2),
             -1.242862e-4)):
        deck.compare(name, value, result.moved(body, *place)[2], 1e-5)
    deck.compare("energy of the cube", 3.809524e-5, result.strain_energy(1),
                 1e-5)
    deck.compare("energy of the block", 1.904772e-4, result.strain_energy(2),
                 1e-5)
    deck.compare("energy of the contact", 2.000010e-5,
                 result.summary["pair_1_penetration"]
                 * result.summary["contact_force"] / 2, 1e-5)
