# SPDX-License-Identifier: LGPL-2.1-or-later
TITLE = "sticking friction with a stick slope"
SOURCE = ("CalculiX (https://github.com/Dhondtguido/CalculiX), "
          "`test/friction1.inp` and `.dat.ref`")
QUICK = True
PROBLEM = r"""
A cube of edge 0.5 is pressed by 100 on a cube of edge 1; 4 x 4 x 4 cells each, $E = 210000$, $\nu = 0.3$. The bottom is clamped, the top may only
move along $z$. All nodes of the interface stick, with springs of the stick slope 47000 along it. The pressure is
$p = 10^7 d\, (1/2 + \arctan(d/e)/\pi)$ with $d = -g$ and $e = 3 \pi / 10^7$: CalculiX smooths its linear law so at nodes.
"""
SKETCH = r"""
                100
             v v v v v
            +---------+ 1.5       quarter of the interface:
            |    2    |
            |         |           (0.5, 0.75) +----+----+ corner
        +---+---------+---+ 1                 |    |    |
        |                 |                   +----+----+
        |        1        |                   |    |    |
        |                 |           centre  +----+----+ (0.75, 0.5)
        +-----------------+ 0
        ///////////////////
"""
ELEMENTS = r"""
The same hexahedra, contact at nodes, large strain, the same law in C (`tests/verification/law.c`). The springs of stick in
Abut are a multiple of the local stiffness (`Method/Penalty factor`); a first run measures the stiffness, the second one has 47000. Tolerance: 1e-3 for
pressures and 2e-3 for tractions, the accuracy of the deck. Its pressures times the areas of the nodes are smaller than the load by 3.4e-4.
Its tractions at nodes that are equal by symmetry differ by up to 9e-4, and the traction in the centre is 1e-3 in place of 0.
"""
REMARKS = r"""
The friction of the deck, $\mu = 0.2$, is nowhere reached. A regularised stick slope as a parameter, in force per length cubed, does not exist
in Abut.
"""
SLOPE = 47000.
NODES = (("corner", .75, .75, 133.3483, 2.252051, 2.250385),
         ("(0.75, 0.625)", .75, .625, 119.9761, 2.180166, 1.122593),
         ("(0.625, 0.625)", .625, .625, 102.3619, 1.137862, 1.136841),
         ("(0.75, 0.5)", .75, .5, 101.3077, 2.041710, 1.865280e-4),
         ("(0.625, 0.5)", .625, .5, 79.91957, 1.099578, -1.026922e-3),
         ("centre", .5, .5, 54.45570, 1.001115e-3, -1.001116e-3))


def area(*place):
    a = 1.
    for x in place:
        a *= .125 if .25 < x < .75 else .0625
    return a


def solve(deck):
    deck.compile("smooth_linear")
    penalty = .05
    row = deck.run(settings={"Method/Penalty factor": penalty}).node(2, .75, .75, 1)
    found = -row["contact_x"] / area(.75, .75) / row["slip_x"]
    result = deck.run(settings={"Method/Penalty factor": penalty * SLOPE / found})
    for name, x, y, pressure, *traction in NODES:
        row = result.node(2, x, y, 1)
        deck.compare("pressure, " + name, pressure,
                     row["contact_z"] / area(x, y), 1e-3)
        for d, value in zip("xy", traction):
            if value > .01:
                deck.compare(f"traction along {d}, {name}", value,
                             -row["contact_" + d] / area(x, y), 2e-3)
