# SPDX-License-Identifier: LGPL-2.1-or-later
TITLE = "block on a cube, in time"
SOURCE = ("CalculiX (https://github.com/Dhondtguido/CalculiX), "
          "`test/contact16.inp` and `.dat.ref`")
QUICK = True
PROBLEM = r"""
A block of edge 0.5 on a cube of edge 1, one hexahedron each, $E = 210000$, $\nu = 0$, $\rho = 7.8 \cdot 10^{-9}$, $\mu = 0.2$. From $t = 0$ on the
pressure 100 acts on the top, and forces along $x$ at two upper corners that grow to 1 each at $t = 5 \cdot 10^{-6}$. The block bounces some
ten times. The values are those of the node (0.75, 0.25, 1.5).
"""
SKETCH = r"""
              100
           v v v v v
     t -> +---------+ 1.5     (node: upper right)
          |         |
          |    2    |
      +---+---------+---+ 1
      |        1        |     mu = 0.2
      +-----------------+ 0
      ///////////////////
"""
ELEMENTS = r"""
The same hexahedra, another treatment of mass and contact: explicit with contact nodes without mass in the deck. On one element per body the result
depends on the place of the mass. CalculiX's implicit scheme on the same mesh decides, which has the discretisation of the scene: consistent mass, HHT
with $\alpha = -0.05$, contact at nodes, $p = 10^6 d\, (1/2 + \arctan(d/e)/\pi)$, stick slope $10^5$. Tolerance: 5e-3, the changes when steps of
CalculiX and Abut are halved.
"""
REMARKS = r"""
At $t = 5 \cdot 10^{-6}$ the deck has (8.995637e-4, -4.897187e-4) along $x$ and $z$, and CalculiX's implicit scheme with steps of 2.5e-8
(5.692255e-4, -7.385842e-4): after ten bounces its two schemes differ by 37 % and 51 %. The explicit scheme of Abut has
(1.954e-4, -4.827e-4): 1.4 % in $z$, no agreement in $x$. So the values at the end are not compared.
"""
# Time, direction, the deck's value, that of CalculiX's implicit scheme with
# steps of 2.5e-9.
VALUES = (("2.5e-7", 0, 2.812290e-06, 1.643695e-06),
          ("2.5e-7", 2, -6.304125e-04, -6.239633e-04),
          ("5e-7", 0, 1.836420e-05, 1.078094e-05),
          ("5e-7", 2, -2.528417e-04, -6.997050e-04))


def solve(deck):
    deck.compile("smooth_linear")
    # Springs of stick are a multiple of the local stiffness: traction by slip of
    # a step, with nodes that stick.
    penalty = .1
    rows = [deck.run(settings={"Method/Penalty factor": penalty, "Time stepping/End time": end})
            .node(2, .25, .25, 1) for end in ("1.95e-7", "2e-7")]
    slope = (rows[0]["contact_x"] - rows[1]["contact_x"]) \
        / .0625 / rows[1]["slip_x"]
    settings = {"Method/Penalty factor": penalty * 1e5 / slope}
    for end in ("2.5e-7", "5e-7"):
        found = deck.run(settings={**settings, "Time stepping/End time": end}
                         ).summary["point_1"]
        for time, d, value, third in VALUES:
            if time == end:
                deck.differs(f"u_{'xyz'[d]} at t = {time}", value, found[d],
                             third, 5e-3, "CalculiX, implicit,")
