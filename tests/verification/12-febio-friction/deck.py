# SPDX-License-Identifier: LGPL-2.1-or-later
TITLE = "blocks of rubber dragged with friction"
SOURCE = ("FEBio TestSuite (https://github.com/febiosoftware/TestSuite), "
          "`Verify/co16.feb`, `co44.feb`, `co18.feb`, `co46.feb`; values of "
          "`code/linuxGoldStandards.py`")
QUICK = True
PROBLEM = r"""
Neo-Hooke's law with $E = 1$, $\nu = 0$. The values are the root of the sum of squares of all displacements that are not prescribed, at the end.

- (a) co16: half a cube on a cube, $\mu = 0.99$. The top of the upper one moves down by 0.1 in 25 steps and then by 0.3 along $x$ in 25 steps.
- (b) co18: a cube on a rigid plate, $\mu = 0.5$, pressed by 0.1 in 20 steps and then dragged by 3 in 80 steps.
"""
SKETCH = r"""
   (a)        0.1 | , then 0.3 ->        (b)   0.1 | , then 3 ->
            +-----v----+ 1.5                 +-----v----+ 1
            |          |                     |          |
        +---+----------+---+ 1               |          |
        |                  |                 |          |
        |                  |               --+----------+------------ 0
        +------------------+ 0               ///////////////////////
        ////////////////////
"""
ELEMENTS = r"""
The same hexahedra and material. co16 and co18 have nodes against facets with augmented Lagrangian to 0.01 and 0.001. co44 and co46 are the same
problems with FEBio's other method, `sliding-elastic`; co46 has a soft penalty of 5. Tolerance: 1e-5 for co18. For co16, augmented to 0.01
only, it is the spread of co16 and co44. For (b) with linear laws of stiffness 50 and 500 it is the spread of co18 and co46.
"""
FRICTION = (0.462720012397, 0.452988729346)
SLIDING = (5.78902446855, 5.80189184994)


def solve(deck):
    deck.within("(a) co16, norm of the displacement", FRICTION,
                deck.run("co16.prm").free_norm())
    deck.compare("(b) co18, norm of the displacement", SLIDING[0],
                 deck.run("co18.prm").free_norm(), 1e-5)
    deck.compile("linear")
    for stiffness in (50, 500):
        result = deck.run("co18.prm", {
            "Method/Enforcement": "user", "Method/Law file": "linear.so",
            "Method/Law parameters": f"stiffness: {stiffness}"})
        deck.within(f"(b) the same, linear law of stiffness {stiffness}",
                    SLIDING, result.free_norm())
