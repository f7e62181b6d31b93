# SPDX-License-Identifier: LGPL-2.1-or-later
TITLE = "two cubes with a linear law; crossed tubes; a hollow sphere"
SOURCE = ("FEBio TestSuite (https://github.com/febiosoftware/TestSuite), "
          "`Verify/co01.feb`; values of `code/linuxGoldStandards.py`")
QUICK = True
PROBLEM = r"""
(a) co01: two cubes of neo-Hooke's law, $E = 1$, $\nu = 0$, that keep their width, are pressed together by 0.2 in 10 steps. The law of contact is
$p = 100 \langle -g \rangle$. The value is the root of the sum of squares of all displacements that are not prescribed.
"""
SKETCH = r"""
   (a)   -0.2
        +--v--+
        |  2  |
        +-----+
        |  1  |
        +-----+
        ///////
"""
ELEMENTS = r"""
(a) The same elements and law: 1e-5.
"""


def solve(deck):
    deck.compile("linear_law")
    deck.compare("(a) co01, norm of the displacement", .282846613634,
                 deck.run("co01.prm").free_norm(), 1e-5)
