# SPDX-License-Identifier: LGPL-2.1-or-later
import math

TITLE = "pad that sticks, and slides against a spring"
SOURCE = ("code_aster, `astest/ssnv503b.comm` "
          "(https://github.com/ralic/Code_Aster); geometry of its document "
          "V6.04.503")
QUICK = True
PROBLEM = r"""
A pad of 40 x 20 with 8 x 4 cells, $E = 210000$, $\nu = 0$, in plane strain, 2 above a rigid plane, $\mu = 0.3$. A pressure of 300 presses
it on the plane: (1). Then a pressure $q$ acts on its left side, (2) $q = 178.2$, 0.99 of the limit, and (3) $q = 181.8$, 1.01 of it. Springs of 4
on the right side stop it: rigid, it slides by 36/4 = 9. The plane is inclined by 30 degrees in the deck; in the scene it is horizontal, and
displacements are rotated.
"""
SKETCH = r"""
            300
       v v v v v v v
      +-------------+
   q ->|            |
     ->|    pad     |--/\/\/--|  4
     ->|            |
      A+------------+B
              2                    mu = 0.3
      ////////////////////////
"""
ELEMENTS = r"""
The same quadrilaterals and constraints at nodes, Coulomb's law. The springs of the deck are at two nodes, here a soft bar is tied to the right side:
their places are in a file that is not available as text. The top has springs of 0.005 along the normal in the deck and none here. Tolerance:
1e-5, and 1e-3 for the displacements of (3), which depend on the places of the springs. The deck has 1e-2 from 8.794, 2.768.
"""
# Displacements of A and B, resultant along the plane and along its normal.
LOADS = (
    ("(1)", "0", ((.999999999, -1.732050806), (.999999999, -1.732050805)),
     (None, 11999.9798), 1e-5),
    ("(2)", "178.2", ((1.021344406, -1.719727608),
                      (.999999999, -1.732050806)),
     (-3563.96164, 11999.9799), 1e-5),
    ("(3)", "181.8", ((8.809533445, 2.776785431),
                      (8.786943822, 2.763743307)),
     (-3599.99392, 11999.9796), 1e-3))


def solve(deck):
    c, s = math.cos(math.pi / 6), math.sin(math.pi / 6)
    for name, side, points, forces, tolerance in LOADS:
        result = deck.run(settings={
            "Body 1/Pressure": f"3: 300*min(t, 1); 0: {side}*max(0, t - 1)"})
        for letter, x, values in zip("AB", (0, 40), points):
            along, normal = result.moved(1, x, 2)
            found = c * along - s * normal, s * along + c * normal
            for d, value, u in zip("xy", values, found):
                deck.compare(f"{name} u_{d} of {letter}", value, u, tolerance,
                             scale=math.hypot(*values))
        for text, value, force in zip(
                ("along the plane", "along its normal"), forces,
                result.summary["pair_1_force"]):
            if value is not None:
                deck.compare(f"{name} contact force {text}", value, force, 1e-5)
