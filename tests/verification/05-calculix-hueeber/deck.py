# SPDX-License-Identifier: LGPL-2.1-or-later
TITLE = "two squares under tractions on their sides"
SOURCE = ("CalculiX (https://github.com/Dhondtguido/CalculiX), "
          "`test/hueeber2.inp`, `hueeber3.inp`, `hueeber4.inp` and `.dat.ref`, "
          "after examples of S. Hüeber's thesis")
QUICK = True
PROBLEM = r"""
Two squares of edge 0.01 with 60 x 60 and 70 x 70 cells, in plane strain. $E = 15 \cdot 10^9$, $\nu = 0.2$ below and $20 \cdot 10^9$, 0.4 above.
The law of contact is $p = k \langle -g \rangle$.

- hueeber2 ($k = 10^{15}$) and hueeber4 ($10^{12}$): the lower end of the lower and the upper end of the upper square are clamped. The
  tractions are $-(10^5, 10^6)$ on the right side of the lower and $(1.17 \cdot 10^5, -1.17 \cdot 10^6)$ on the left side of the upper
  square: the nodal forces of the deck are the same on both.
- hueeber3 ($10^{12}$): the tractions $(\pm 10^5, -10^6)$ act on both sides of the lower square, and the upper end moves by
  $(0, -5 \cdot 10^{-7})$.

A part of the interface opens.
"""
SKETCH = r"""
        /////////// 0.02
        +---------+
    t ->|    2    |
      | |         |
      v +---------+ 0.01    contact, no friction
        |         |<- t
        |    1    | |
        +---------+ v
        ///////////
"""
ELEMENTS = r"""
Hexahedra of one layer there, quadrilaterals with the same displacements here. Contact is at points of quadrature on the common parts of
facets, with the same law in C (`tests/verification/law.c`). Tolerance: 1e-5 of the largest displacement.
"""
SIDES = {"Body 2/Traction": "", "Body 2/Prescribed displacement": "3: 0, -5e-7",
         "Body 1/Traction": "0: 8.3333e-3*120e5, -8.3333e-2*120e5; "
                            "1: -8.3333e-3*120e5, -8.3333e-2*120e5"}


# Node of the deck, body, x, and (u_x, u_y) of the three decks.
NODES = (
    (1, 1, 0.01, ((1.103640e-06, -1.435801e-06), (4.967544e-07, -1.198806e-06),
                  (1.351624e-06, -1.539539e-06))),
    (121, 1, 0.005, ((6.424103e-07, -3.207680e-07), (0., -4.281106e-07),
                     (9.189436e-07, -2.750396e-07))),
    (241, 1, 0., ((2.853008e-07, -6.522366e-07), (-4.967544e-07, -1.198806e-06),
                  (7.437969e-07, -2.509475e-08))),
    (17383, 2, 0.01, ((8.052557e-07, 2.919392e-07), (2.118828e-10, -4.977164e-07),
                      (9.602108e-07, 3.584811e-07))),
    (17523, 2, 0., ((9.720737e-07, -6.569607e-07), (-2.118828e-10, -4.977164e-07),
                    (1.294341e-06, -1.061983e-06))))


def solve(deck):
    deck.compile("linear")
    soft = {"Method/Law parameters": "stiffness: 1e12"}
    for case, (name, settings) in enumerate((
            ("hueeber2", {}), ("hueeber3", {**soft, **SIDES}),
            ("hueeber4", soft))):
        result = deck.run(settings=settings)
        scale = max(abs(v) for row in NODES for v in row[3][case])
        worst = 0.
        for number, body, x, values in NODES:
            # The interface, of nodes of either square.
            for d, found, value in zip("xy", result.moved(body, x, 0.01),
                                       values[case]):
                worst = max(worst, abs(found - value))
                if number == 1:
                    deck.compare(f"{name}, u_{d}, node 1", value, found, 1e-5,
                                 scale=scale)
        deck.compare(f"{name}, largest difference of u_x, u_y at five nodes",
                     0., worst, 1e-5, scale=scale)
