# SPDX-License-Identifier: LGPL-2.1-or-later
TITLE = "contact patch test, pressure 25"
SOURCE = ("code_aster, `astest/ssnp170a.comm` "
          "(https://github.com/ehmoussi/code_aster)")
QUICK = True
PROBLEM = r"""
Two blocks on each other in plane strain, $E = 2000$, $\nu = 0.3$, under the pressure 25, free to widen. Their cells do not match. For any
mesh the stress is -25 at all nodes and the contact pressure 25.
"""
SKETCH = r"""
       25
      v v v v v
     +-+-+-+-+-+
   o | | | | | |
   o +-+-+-+-+-+  contact of meshes that do not match
   o |  |   |  |
     +--+---+--+
      o o o o o
"""
ELEMENTS = r"""
Quadrilaterals of degree 1. The mesh of the deck is not available: the public repositories store a pointer in its place. The result does not
depend on it. code_aster has multipliers that are constant in macro cells; Abut is run with dual mortar, mortar and Nitsche's method.
Tolerance: 1e-10.
"""


def solve(deck):
    for settings in ({"Method/Discretisation": "dual mortar"},
                     {"Method/Discretisation": "mortar"},
                     {"Method/Enforcement": "nitsche",
                      "Method/Discretisation": "quadrature point"}):
        result = deck.run(settings=settings).summary
        name = (", nitsche" if len(settings) > 1
                else ", " + settings["Method/Discretisation"])
        deck.compare("least pressure" + name, 25,
                     result["pair_1_least_pressure"], 1e-10)
        deck.compare("largest pressure" + name, 25, result["pair_1_pressure"],
                     1e-10)
        deck.compare("error of the displacement (H1)" + name, 0,
                     result["h1_error"], 1e-10, scale=25 / 2000)
