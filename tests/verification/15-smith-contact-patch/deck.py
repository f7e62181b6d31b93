# SPDX-License-Identifier: LGPL-2.1-or-later
import math

TITLE = "two cubes of rubber pressed together"
SOURCE = ("smith (https://github.com/llnl/smith), "
          "`src/smith/physics/tests/contact_patch.cpp`")
QUICK = True
PROBLEM = r"""
Two unit cubes with the bulk modulus $K = 10$ and the shear modulus $G = 0.25$. The planes $x = 0$, $y = 0$ and $z = 0$ are planes of
symmetry; the top, $z = 2$, moves by -0.01. The deck compares with small strain: $u = (0.0025\, c x, 0.0025\, c y, -0.005\, z)$,
$c = (3 K - 2 G)/(3 K + G)$. The root of the sum of squares of all errors is below 1e-3.
"""
SKETCH = r"""
        -0.01
     +----v----+ z = 2
   o |    2    |
     +---------+ z = 1    contact, no friction
   o |    1    |
     +---------+ z = 0
       o     o
"""
ELEMENTS = r"""
The same hexahedra; smith has mortar with penalty or multipliers, Abut mortar with multipliers. Hooke's law reaches the closed form within
1e-10. With neo-Hooke's law the lateral stretch is the root of one equation, reached within 1e-8. The tolerance of the deck applies, too.
"""
REMARKS = r"""
The neo-Hooke law of smith has another function of the volume than that of Abut. Both are Hooke's law for small strain.
"""
K, G = 10., 0.25
C = (3 * K - 2 * G) / (3 * K + G)
LAME = K - 2 * G / 3


def lateral(stretch):
    """Lateral stretch without lateral stress: G (b^2 - 1) + LAME ln J = 0."""
    b = 1.
    for _ in range(50):
        value = G * (b * b - 1) + LAME * math.log(b * b * stretch)
        b -= value / (2 * G * b + 2 * LAME / b)
    return b


def solve(deck):
    places = [(body, x, y, z) for body in (1, 2) for x in (0, 1)
              for y in (0, 1) for z in (body - 1, body)]

    def norm(result, exact):
        return math.sqrt(sum(
            (found - wanted) ** 2 for body, *place in places
            for found, wanted in zip(result.moved(body, *place),
                                     exact(*place))))

    def linear(x, y, z):
        return .0025 * C * x, .0025 * C * y, -.005 * z
    b = lateral(.995)

    def rubber(x, y, z):
        return (b - 1) * x, (b - 1) * y, -.005 * z
    for method in ("mortar", "dual mortar"):
        settings = {"Method/Discretisation": method}
        result = deck.run(settings=settings)
        deck.compare(f"u_x at (1, 1, 1), small strain, {method}", .0025 * C,
                     result.moved(1, 1, 1, 1)[0], 1e-10)
        deck.compare(f"root of the squared errors, small strain, {method}", 0,
                     norm(result, linear), 1e-10, scale=1)
        for body in (1, 2):
            settings[f"Body {body}/Material"] = "neo-hooke"
        result = deck.run(settings=settings)
        deck.compare(f"u_x at (1, 1, 1), neo-Hooke, {method}", b - 1,
                     result.moved(1, 1, 1, 1)[0], 1e-8)
        deck.compare(f"root of the squared errors, neo-Hooke, {method}", 0,
                     norm(result, rubber), 1e-8, scale=1)
        deck.compare("the same against small strain, as in the deck, "
                     + method, 0, norm(result, linear), 1e-3, scale=1)
