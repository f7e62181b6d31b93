# SPDX-License-Identifier: LGPL-2.1-or-later
TITLE = "press fit of two rings"
SOURCE = ("CalculiX (https://github.com/Dhondtguido/CalculiX), "
          "`test/ring2.inp` and `.dat.ref`")
QUICK = True
PROBLEM = r"""
A ring of radii 0.9501 and 1.0501 in a ring of radii 1.05 and 1.15, both of height 0.1, axisymmetric, $E = 210000$, $\nu = 0.3$. They overlap by
$D = 10^{-4}$; the law of contact is $p = 10^7 \langle -g \rangle$.

Closed form of small strain: the stress of Lamé's rings is plane, since the ends are free. With $u_i$ and $u_o$ for the unit pressure on
the inner and the outer ring, $p\, (u_i + u_o + 10^{-7}) = D$.
"""
SKETCH = r"""
     axis                   0.9501   1.05  1.15
      |                        +-------+------+ 0.1
      |                        | inner | outer|
      |  - - - - - - - - - - - | ring  | ring |- - - middle: u_y = 0
      |                        +-------+------+ 0
"""
ELEMENTS = r"""
One serendipity element (CAX8) per ring there, expanded to a wedge of 2 degrees: $\sin(1°)/1° = 1 - 5 \cdot 10^{-5}$. Biquadratic elements here.
Large strain and the same law in C (`tests/verification/law.c`). Tolerance: 1e-4, the wedge and the change of 2.5e-5 when CalculiX
2.20 has 4 x 4 elements per ring. The closed form within 1e-8, with small strain on a finer mesh.
"""
REMARKS = r"""
With 4 x 4 elements CalculiX 2.20 finds -4.735098e-5, -4.61644e-5, 5.37356e-5, 5.20961e-5. All four are 5.1e-5 below the values of Abut, and so are
those of small strain below the closed form: the closed form decides.
"""
E, NU = 210000., 0.3
EDGES = (("inner ring, r = 0.9501", 1, 0.9501, -4.734981e-5),
         ("inner ring, r = 1.0501", 1, 1.0501, -4.616549e-5),
         ("outer ring, r = 1.05", 2, 1.05, 5.373454e-5),
         ("outer ring, r = 1.15", 2, 1.15, 5.209715e-5))


def lame(r, a, b, inner, outer):
    """Radial displacement of a ring of radii a and b under pressures."""
    c = b * b - a * a
    return ((1 - NU) * (inner * a * a - outer * b * b) * r
            + (1 + NU) * (inner - outer) * a * a * b * b / r) / (E * c)


def closed_form():
    a, b, c, d = .9501, 1.0501, 1.05, 1.15
    # Forces are the same: the pressure of the inner ring is smaller.
    unit = c / b
    p = 1e-4 / (lame(c, c, d, 1, 0) - lame(b, a, b, 0, unit) + 1e-7)
    return [lame(r, a, b, 0, p * unit) if body == 1 else lame(r, c, d, p, 0)
            for _, body, r, _ in EDGES]


def solve(deck):
    deck.compile("linear")
    result = deck.run()
    for name, body, r, value in EDGES:
        deck.compare("u_r, " + name, value, result.moved(body, r, .1)[0], 1e-4)
    result = deck.run(settings={"Body 1/Material": "hooke",
                                "Body 2/Material": "hooke",
                                "Refinement/Level": 5})
    for (name, body, r, _), value in zip(EDGES, closed_form()):
        deck.compare(f"u_r, {name}, small strain, closed form", value,
                     result.moved(body, r, .1)[0], 1e-8)
