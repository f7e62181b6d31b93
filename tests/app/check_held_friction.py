# SPDX-License-Identifier: LGPL-2.1-or-later
"""Friction where supports hold nodes of the contact: T = mu N where all slides, in
the sums of the pair and in the reaction, and tau against the slip at each node."""
import math
import random

from program import Program

p = Program()

METHODS = [{"Method/Enforcement": "lagrange"},
           {"Method/Enforcement": "penalty"},
           {"Method/Enforcement": "quadratic penalty"},
           {"Method/Enforcement": "augmented lagrangian"},
           {"Method/Discretisation": "dual mortar"},
           {"Method/Discretisation": "mortar",
            "Method/System": "saddle point"},
           {"Method/Discretisation": "dual mortar",
            "Method/System": "saddle point"},
           {"Method/Enforcement": "nitsche", "Method/Nitsche theta": 0}]


class Block:
    """A block on its lower side, pressed from above and dragged by its left one."""

    def __init__(self, size, cells, mu, pressure, drag):
        self.dim = len(size)
        self.size, self.cells, self.mu = size, cells, mu
        self.pressure, self.drag = pressure, drag
        self.down = 2 * self.dim - 2  # id of the lower side
        self.normal = pressure * math.prod(size[:-1])

    def mesh(self, body, size, cells, low):
        high = [a + b for a, b in zip(low, size)]
        return f"""subsection Body {body}
  subsection Mesh
    set Generator = subdivided_hyper_rectangle
    set Arguments = {", ".join(map(str, cells))} : {words(low)} : {words(high)} : true
  end
  set Young modulus = 1000
  set Poisson ratio = 0
"""

    def text(self, body, more, obstacles=1):
        support = ", ".join([f"({self.drag})"] + ["free"] * (self.dim - 1))
        return f"""set Scene = solid
set Dimension = {self.dim}
subsection Solid
  set Bodies = {body}
  set Pairs = 1
  set Obstacles = {obstacles}
end
{self.mesh(body, self.size, self.cells, [0.] * self.dim)}
  set Support = 0: {support}
  set Pressure = {self.down + 1}: {self.pressure}
end
{more}
subsection Refinement
  set Level = 0
end
subsection Output
  set Fields = false
  set Pictures = false
  set Nodal values = true
end
"""

    def on_plane(self):
        return self.text(1, f"""subsection Obstacle 1
  set Kind = plane
end
subsection Pair 1
  set Secondary = 1: {self.down}
  set Obstacle = 1
  set Friction = {self.mu}
end
""")

    def on_body(self, size, cells, low, exchanged=False):
        fixed = ", ".join(["0"] * self.dim)
        sides = [f"2: {self.down}", f"1: {self.down + 1}"]
        if exchanged:
            sides.reverse()
        return self.text(2, f"""{self.mesh(1, size, cells, low)}
  set Support = {self.down}: {fixed}
end
subsection Pair 1
  set Secondary = {sides[0]}
  set Primary = {sides[1]}
  set Friction = {self.mu}
end
""", obstacles=0)


def words(vector):
    return ", ".join(f"{v:.17g}" for v in vector)


def run(text, settings=(), ranks=0):
    p.write("held.prm", text)
    return p.solve_with(p.folder / "held.prm", dict(settings), ranks)[0]


def expect_sliding(block, summary, name, body=1, tolerance=1e-10):
    """The friction of the pair, and what the dragged body's support feels."""
    mu_n = block.mu * block.normal
    p.close(summary["pair_1_friction_force"], mu_n, tolerance, f"{name}: T")
    p.close(math.hypot(*summary["pair_1_friction"]), mu_n, tolerance,
            f"{name}: resultant")
    p.close(summary["pair_1_normal_force"], block.normal, tolerance,
            f"{name}: N")
    found = summary[f"reaction_{body}"]
    p.close(found[0], -mu_n, max(tolerance, 1e-6 if "nitsche" in name else 0.),
            f"{name}: reaction")
    p.expect(summary["pair_1_slipping"] == summary["pair_1_active"],
             f"{name}: not all of it slips")


def drawn(count):
    """Blocks of all sizes, by a fixed seed."""
    draw = random.Random(34)
    for i in range(count):
        width, height = draw.uniform(0.5, 3.), draw.uniform(0.3, 0.8)
        cells = [draw.choice([1, 2, 3, 5, 8]), draw.choice([1, 2, 4])]
        yield i, Block([width, height], cells, draw.uniform(0.05, 0.5),
                       draw.uniform(0.2, 5.),
                       f"-{draw.uniform(0.02, 0.2):.17g}*t")


def generated():
    for i, block in drawn(10):
        settings = METHODS[i % len(METHODS)]
        expect_sliding(block, run(block.on_plane(), settings),
                       f"block {i}, {settings}",
                       tolerance=1e-9)


def between_bodies():
    """The block over a longer one, and with the sides exchanged."""
    block = Block([1., 1.], [4, 4], 0.3, 1., "-0.1*t")
    for settings in p.some(METHODS, 3):
        if settings.get("Method/Enforcement") == "nitsche":
            settings = {**settings, "Method/Segments": "false"}
        for exchanged in (False, True):
            expect_sliding(
                block, run(block.on_body([3., 0.5], [8, 4], [-1., -0.5],
                                         exchanged), settings),
                f"over a block, {settings}, exchanged: {exchanged}", 2,
                tolerance=1e-9)


def stopped():
    """The drag ends at t = 0.5: the friction stays; then half of the pressure,
    which half of the friction goes with."""
    for cells in ([1, 1], [4, 4]):
        block = Block([1., 1.], cells, 0.3, 1., "-0.1*min(t, 0.5)")
        for settings in METHODS[:2] + METHODS[3:5]:
            steps = {**settings, "Load steps/Steps": 4,
                     "Load steps/End time": 1}
            name = f"stopped, {cells}, {settings}"
            expect_kept(run(block.on_plane(), steps), 0.3, name)
            steps = {**steps, "Load steps/Steps": 6, "Load steps/End time": 1.5,
                     "Body 1/Pressure": f"{block.down + 1}: (t > 1.1 ? 0.5 : 1)"}
            expect_kept(run(block.on_plane(), steps), 0.15,
                        name + ", half of the pressure")


def expect_kept(summary, traction, name):
    """Augmented Lagrangian remembers pressures to its own tolerance."""
    limit = 1e-5 if "augmented" in name else 1e-10
    p.close(summary["pair_1_friction"][0], traction, limit, name)
    p.close(-summary["reaction_1"][0], traction, limit, name + ": reaction")


def in_space():
    """Dragged along x by a side that is free along y, and pushed along y."""
    block = Block([1., 1., 1.], [2, 2, 2], 0.3, 1., "-0.1*t")
    text = block.on_plane()
    for settings in (METHODS[0], METHODS[4]):
        summary = run(text, {**settings, "Body 1/Pressure": "5: 1; 2: 0.1"})
        mu_n = block.mu * block.normal
        p.close(summary["pair_1_friction_force"], mu_n, 1e-9, "in space: T")
        p.close(-summary["pair_1_friction"][1], 0.1, 1e-9,
                "in space: friction along y")
        for node in p.table("nodal.csv"):
            if node["status"] == 2.:
                tau = node["contact_x"], node["contact_y"]
                slip = node["slip_x"], node["slip_y"]
                size = math.hypot(*tau)
                p.close(size, block.mu * node["contact_z"], 1e-9,
                        "in space: |tau| = mu p")
                turned = tau[0] * slip[1] - tau[1] * slip[0]
                p.expect(abs(turned) < 1e-9 * size * math.hypot(*slip),
                         "in space: tau is not along the slip")


def oblique():
    """On an inclined plane the nodes of the side have one direction left, which
    is along neither normal nor tangent."""
    block = Block([1., 0.5], [4, 2], 0.2, 1., "-0.05*t")
    for degrees in (10., 20.):
        angle = math.radians(degrees)
        text = block.on_plane().replace(
            "  set Kind = plane\n", "  set Kind = plane\n"
            f"  set Normal = {-math.sin(angle)}, {math.cos(angle)}\n").replace(
            ": true\n  end", f": true\n    set Rotate = {degrees}\n  end")
        for settings in (METHODS[0], METHODS[3], METHODS[4]):
            summary = run(text, settings)
            name = f"plane of {degrees} degrees, {settings}"
            p.close(summary["pair_1_friction_force"],
                    block.mu * summary["pair_1_normal_force"], 1e-9, name)
            # pressure and reaction against normal force and friction
            load = block.normal * math.sin(angle)
            n, tangent = (summary["pair_1_normal_force"],
                          summary["pair_1_friction_force"])
            p.close(summary["reaction_1"][0], n * math.sin(angle)
                    - tangent * math.cos(angle) - load, 1e-9,
                    name + ": reaction")


def on_ranks():
    block = Block([1., 1.], [8, 8], 0.3, 1., "-0.1*t")
    expect_sliding(block, run(block.on_plane(), METHODS[4], 3), "3 ranks")


for cells in p.some((1, 4, 8), 2):
    square = Block([1., 1.], [cells, cells], 0.3, 1., "-0.1*t")
    for method in METHODS:
        expect_sliding(square, run(square.on_plane(), method),
                       f"{cells} x {cells} cells, {method}")
generated()
between_bodies()
stopped()
in_space()
oblique()
on_ranks()
p.finish()
