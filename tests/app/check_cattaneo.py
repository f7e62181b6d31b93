# SPDX-License-Identifier: LGPL-2.1-or-later
"""Cattaneo and Mindlin: a cylinder on a block, and two cylinders, pressed, pulled,
and pulled back, in part, to no force, and as far the other way.
Stick, slip, reverse slip and tractions against the closed forms (Johnson, Contact
Mechanics, 7.2 and 7.4) with the forces that the run has."""
import math

from program import Program

p = Program()

MU = 0.2
MODULUS = 200. / (2. * (1. - 0.3 ** 2))


def root(x):
    return math.sqrt(max(0., x))


class Closed:
    """Hertz, and a load of friction on it."""

    def __init__(self, normal, radius):
        self.a = math.sqrt(4. * normal * radius / (math.pi * MODULUS))
        self.p0 = 2. * normal / (math.pi * self.a)
        self.normal = normal

    def stick(self, force):
        return self.a * math.sqrt(1. - force / (MU * self.normal))

    def traction(self, x, force, mu=MU):
        """Of a first load: largest mu p0 outside of the stick zone."""
        c = self.a * math.sqrt(1. - force / (mu * self.normal))
        return mu * self.p0 * (root(1. - (x / self.a) ** 2)
                               - c / self.a * root(1. - (x / c) ** 2))


class Scene:
    """Bodies of a combined radius, pressed by a way and pulled aside by another,
    on the mesh of some cycles, with facets of a size."""

    def __init__(self, name, radius, press, pull, cycles, facet, within):
        self.name, self.radius, self.facet = name, radius, facet
        self.press, self.pull, self.cycles = press, pull, cycles
        self.within = within  # facets that rims may be off

    def run(self, steps, back=0.):
        aside = f"t > 2 ? {self.pull} - {back}*(t - 2) : {self.pull}*(t - 1)"
        summary, _ = p.solve_with(self.name + ".prm", {
            "Time stepping/Number of steps": steps, "Time stepping/End time": steps,
            "Output/Pictures": "false", "Refinement/Adaptive cycles": self.cycles,
            "Body 2/Prescribed displacement": f"1: (t > 1 ? ({aside}) : 0), "
            f"(t < 1 ? -{self.press}*t : -{self.press})"})
        return summary, [node for node in p.table("pair_1.csv")
                         if node["status"] > 0]

    def expect(self, condition, what):
        p.expect(condition, f"{self.name}: {what}")

    def compare(self, what, nodes, exact, limit):
        """Root mean square of the difference, in parts of mu p0."""
        errors = [node["friction"] - exact(node["x"]) for node in nodes]
        error = math.sqrt(sum(e * e for e in errors) / len(errors))
        error /= MU * self.closed.p0
        self.expect(error < limit, f"{what}: tractions off by {error} mu p0")
        print(self.name, what, "off by", error, "of mu p0")

    def stuck(self, nodes):
        return [node["x"] for node in nodes if node["status"] == 1.]

    def check_pull(self, sharp=True):
        pulled, nodes = self.run(2)
        self.first = abs(pulled["pair_1_friction"][0])
        self.sign = math.copysign(1., pulled["pair_1_friction"][0])
        closed = self.closed = Closed(pulled["pair_1_normal_force"],
                                      self.radius)
        self.expect(abs(max(n["x"] for n in nodes) - closed.a) < self.facet,
                    "half width")
        stick, c = self.stuck(nodes), closed.stick(self.first)
        self.expect(abs(max(stick) - c) < self.within * self.facet
                    and abs(min(stick) + c) < self.within * self.facet,
                    f"stick zone {min(stick)} .. {max(stick)}, not {c}")
        p.close(pulled["pair_1_pressure"], closed.p0, 0.03, "largest pressure")
        if sharp:
            p.close(max(abs(n["friction"]) for n in nodes),
                    closed.traction(c, self.first), 0.05,
                    self.name + ": largest traction")
        self.compare("pulled", nodes, lambda x: self.sign
                     * closed.traction(x, self.first), 0.06)
        return pulled["dissipation"]

    def check_back(self, what, back):
        """Back by F1 - F: as a first load with twice the friction, the other
        way."""
        summary, nodes = self.run(3, back)
        closed, force = self.closed, self.sign * summary["pair_1_friction"][0]
        change = (self.first - force) / (2. * MU * closed.normal)
        b = closed.a * math.sqrt(1. - change)
        slips = [abs(n["x"]) for n in nodes if n["status"] == 2.]
        self.expect(abs(min(slips) - b) < self.within * self.facet,
                    f"{what}: reverse slip from {min(slips)}, not {b}")
        self.compare(what, nodes, lambda x: self.sign
                     * (closed.traction(x, self.first)
                        - closed.traction(x, self.first - force, 2. * MU)),
                     0.06)
        return force, summary["dissipation"]

    def check_turned(self):
        """To -Q1, as far to the other side: minus what the pull has left."""
        turned, nodes = self.run(3, 2. * self.pull)
        p.close(-self.sign * turned["pair_1_friction"][0], self.first, 1e-3,
                self.name + ": -Q1")
        p.close(max(abs(x) for x in self.stuck(nodes)),
                self.closed.stick(self.first), 0.1,
                self.name + ": stick zone at -Q1")
        self.compare("at -Q1", nodes, lambda x: -self.sign
                     * self.closed.traction(x, self.first), 0.06)
        return turned["dissipation"]

    def check_pressed(self, ratio):
        pressed, _ = self.run(1)
        self.expect(pressed["pair_1_friction_force"]
                    <= ratio * MU * pressed["pair_1_normal_force"],
                    "equal materials slide on each other when pressed")

    def check(self, nothing, sharp):
        """@p nothing: way back after which no force is left; @p sharp: whether
        the mesh resolves the largest traction."""
        pulled = self.check_pull(sharp)
        _, back = self.check_back("back", 0.85 * self.pull)
        force, _ = self.check_back("at no force", nothing)
        print(self.name, "left", force, "of", self.first)
        self.expect(abs(force) < 0.03 * self.first, f"{force} of {self.first} is left")
        turned = self.check_turned()
        self.expect(turned > back > pulled > 0., "dissipation")


def main():
    block = Scene("cattaneo", 8., 0.12, 0.035, 6, 0.0625, 1.5)
    block.check_pressed(0.1)
    block.check(0.0336, True)
    # As fine as the largest traction wants it, and then coarser.
    Scene("cattaneo-cylinders", 4., 0.184, 0.03, 9, 0.0246, 1.).check_pull()
    cylinders = Scene("cattaneo-cylinders", 4., 0.184, 0.03, 8, 0.0491, 1.)
    cylinders.check_pressed(0.)
    cylinders.check(0.0295, False)


main()
p.finish()
