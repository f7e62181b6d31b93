# SPDX-License-Identifier: LGPL-2.1-or-later
"""Cattaneo and Mindlin: a cylinder pressed on a block, pulled, and pulled back, in
part and as far the other way.
Stick, slip, reverse slip and tractions against the closed forms (Johnson, Contact
Mechanics, 7.2 and 7.4) with the forces that the run has."""
import math

from program import Program, set_words

p = Program()

MU, RADIUS = 0.2, 8.
MODULUS = 200. / (2. * (1. - 0.3 ** 2))
PULL = "(t > 1 ? (t > 2 ? 0.035 - %g*(t - 2) : 0.035*(t - 1)) : 0)"


def root(x):
    return math.sqrt(max(0., x))


class Closed:
    """Hertz, and a load of friction on it."""

    def __init__(self, normal):
        self.a = math.sqrt(4. * normal * RADIUS / (math.pi * MODULUS))
        self.p0 = 2. * normal / (math.pi * self.a)
        Closed.largest = self.p0
        self.normal = normal

    def stick(self, force):
        return self.a * math.sqrt(1. - force / (MU * self.normal))

    def traction(self, x, force, mu=MU):
        """Of a first load: largest mu p0 outside of the stick zone."""
        c = self.a * math.sqrt(1. - force / (mu * self.normal))
        return mu * self.p0 * (root(1. - (x / self.a) ** 2)
                               - c / self.a * root(1. - (x / c) ** 2))


def run(steps, back=0.03):
    summary, _ = p.solve_with("cattaneo.prm", {
        "Load steps/Steps": steps, "Load steps/End time": steps,
        "Output/Pictures": "false",
        "Body 2/Support": f"1: {PULL % back}, (t < 1 ? -0.12*t : -0.12)"})
    return summary, [node for node in p.table("pair_1.csv")
                     if node["status"] > 0]


def compare(name, nodes, exact, limit):
    """Root mean square of the difference, in parts of mu p0."""
    errors = [node["friction"] - exact(node["x"]) for node in nodes]
    error = math.sqrt(sum(e * e for e in errors) / len(errors))
    p.expect(error < limit, f"{name}: tractions are off by {error}")
    print(name, "off by", error / (MU * Closed.largest), "of mu p0")


def main():
    pressed, nodes = run(1)
    closed = Closed(pressed["pair_1_normal_force"])
    facet = 0.0625
    p.expect(abs(max(n["x"] for n in nodes) - closed.a) < facet, "half width")
    p.close(pressed["pair_1_pressure"], closed.p0, 0.03, "largest pressure")
    p.expect(pressed["pair_1_friction_force"]
             < 0.1 * MU * pressed["pair_1_normal_force"],
             "equal materials slide on each other when pressed")

    pulled, nodes = run(2)
    first = abs(pulled["pair_1_friction"][0])
    sign = math.copysign(1., pulled["pair_1_friction"][0])
    stick = [n["x"] for n in nodes if n["status"] == 1.]
    c = closed.stick(first)
    p.expect(abs(max(stick) - c) < 1.5 * facet
             and abs(min(stick) + c) < 1.5 * facet,
             f"stick zone {min(stick)} .. {max(stick)}, not {c}")
    p.close(max(abs(n["friction"]) for n in nodes), closed.traction(c, first),
            0.05, "largest traction")
    compare("pulled", nodes, lambda x: sign * closed.traction(x, first),
            0.06 * MU * closed.p0)

    # Back by F1 - F: as a first load with twice the friction, the other way.
    back, nodes = run(3)
    force = sign * back["pair_1_friction"][0]
    b = closed.a * math.sqrt(1. - (first - force) / (2. * MU * closed.normal))
    slips = [abs(n["x"]) for n in nodes if n["status"] == 2.]
    p.expect(abs(min(slips) - b) < 1.5 * facet,
             f"reverse slip from {min(slips)}, not {b}")
    compare("back", nodes,
            lambda x: sign * (closed.traction(x, first)
                              - closed.traction(x, first - force, 2. * MU)),
            0.06 * MU * closed.p0)
    p.expect(back["dissipation"] > pulled["dissipation"] > 0., "dissipation")

    # To -Q1, as far to the other side: minus what the pull has left.
    turned, nodes = run(3, 0.07)
    p.close(-sign * turned["pair_1_friction"][0], first, 1e-3, "-Q1")
    p.close(max(abs(n["x"]) for n in nodes if n["status"] == 1.), c, 0.1,
            "stick zone at -Q1")
    compare("at -Q1", nodes, lambda x: -sign * closed.traction(x, first),
            0.06 * MU * closed.p0)
    p.expect(turned["dissipation"] > back["dissipation"], "dissipation")


main()
p.finish()
