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
            steps = {**settings, "Time stepping/Number of steps": 4,
                     "Time stepping/End time": 1}
            name = f"stopped, {cells}, {settings}"
            expect_kept(run(block.on_plane(), steps), 0.3, name)
            steps = {**steps, "Time stepping/Number of steps": 6, "Time stepping/End time": 1.5,
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


class Corner:
    """A block pressed against a floor and a wall, both turned by an angle, the
    floor drawn towards the wall by a displacement that all of it slides by."""

    def __init__(self, draw):
        self.size = [draw.uniform(0.5, 2.), draw.uniform(0.5, 2.)]
        self.cells = [draw.choice([1, 2, 3, 5]), draw.choice([1, 2, 4])]
        self.top, self.side = draw.uniform(0.2, 2.), draw.uniform(0.2, 2.)
        self.mu, self.mu_of_wall = draw.uniform(0.1, 0.5), draw.uniform(0.1, 0.5)
        self.degrees = draw.choice([0., 30., draw.uniform(0., 90.)])

    def turned(self, x, y):
        angle = math.radians(self.degrees)
        return [x * math.cos(angle) - y * math.sin(angle),
                x * math.sin(angle) + y * math.cos(angle)]

    def block(self, body, low, size, cells, more):
        high = [a + b for a, b in zip(low, size)]
        return (f"subsection Body {body}\n  subsection Mesh\n"
                "    set Generator = subdivided_hyper_rectangle\n"
                f"    set Arguments = {', '.join(map(str, cells))} : "
                f"{words(low)} : {words(high)} : true\n"
                f"    set Rotate = {self.degrees:.17g}\n  end\n"
                "  set Young modulus = 1000\n  set Poisson ratio = 0\n"
                f"{more}end\n")

    def text(self, floor, mu_of_wall, wall_first=False):
        """With the floor as an obstacle, or as a body that its lower side
        draws."""
        loads = f"  set Pressure = 1: {self.side}; 3: {self.top}\n"
        drawn = [f"{v:.17g}*t" for v in self.turned(-0.1, 0.)]
        wall = plane("Obstacle 1", self.turned(1., 0.))
        if floor == "obstacle":
            parts = [self.block(1, [0., 0.], self.size, self.cells, loads), wall,
                     plane("Obstacle 2", self.turned(0., 1.),
                           f"  set Motion = {'; '.join(drawn)}\n")]
            sides, numbers = "1", (1, 2)
        else:
            parts = [self.block(1, [-1., -0.5], [self.size[0] + 2., 0.5],
                                [8, 2],
                                f"  set Support = 2: ({drawn[0]}), ({drawn[1]})\n"),
                     self.block(2, [0., 0.], self.size, self.cells, loads), wall]
            sides, numbers = "2", (2, 1)
        pairs = [f"  set Secondary = {sides}: 2\n  set Friction = {self.mu}\n"
                 + ("  set Obstacle = 2\n" if floor == "obstacle"
                    else "  set Primary = 1: 3\n"),
                 f"  set Secondary = {sides}: 0\n  set Obstacle = 1\n"
                 f"  set Friction = {mu_of_wall}\n"]
        if wall_first:
            pairs.reverse()
        parts += [f"subsection Pair {i + 1}\n{pair}end\n"
                  for i, pair in enumerate(pairs)]
        return ("set Scene = solid\nset Dimension = 2\nsubsection Solid\n"
                f"  set Bodies = {numbers[0]}\n  set Obstacles = {numbers[1]}\n"
                "  set Pairs = 2\nend\n" + "".join(parts)
                + "subsection Refinement\n  set Level = 0\nend\n"
                  "subsection Output\n  set Fields = false\n"
                  "  set Pictures = false\nend\n")

    def expect(self, summary, mu_of_wall, name, wall_first=False):
        """N of the floor is the load less the friction of the wall, and N of
        the wall is the load with the friction of the floor."""
        top, side = self.top * self.size[0], self.side * self.size[1]
        normal = (top - mu_of_wall * side) / (1. + self.mu * mu_of_wall)
        wall = side + self.mu * normal
        floor_key, wall_key = ("pair_2", "pair_1") if wall_first else (
            "pair_1", "pair_2")
        for key, wanted in ((floor_key + "_normal_force", normal),
                            (floor_key + "_friction_force", self.mu * normal)):
            p.close(summary.get(key), wanted, 1e-9, f"{name}: {key}")
        p.close(math.hypot(*summary[wall_key + "_force"]),
                wall * math.hypot(1., mu_of_wall), 1e-9, f"{name}: wall")


def plane(section, normal, more=""):
    return (f"subsection {section}\n  set Kind = plane\n"
            f"  set Normal = {words(normal)}\n{more}end\n")


def corners():
    """The node in the corner slides along the floor, which the wall keeps it
    from following. On a floor that gives way it slides along the wall, too."""
    draw = random.Random(341)
    for i in range(10):
        corner = Corner(draw)
        settings = METHODS[i % 7]
        name = f"corner {i}, {settings}"
        corner.expect(run(corner.text("obstacle", 0.), settings), 0., name)
        if i % 2 == 0 and corner.top * corner.size[0] > corner.side * corner.size[1]:
            # the wall is loaded by what presses the block down, too
            wall_first = i % 4 == 0
            corner.expect(
                run(corner.text("body", corner.mu_of_wall, wall_first),
                    settings), corner.mu_of_wall, name + ", body", wall_first)


def groove(degrees, more="", support="(-0.1*t), free, free"):
    """A block in a groove of two planes that its end draws along."""
    angle = math.radians(degrees)
    return f"""set Scene = solid
set Dimension = 3
subsection Solid
  set Bodies = 1
  set Obstacles = 2
  set Pairs = 2
end
subsection Body 1
  subsection Mesh
    set Generator = subdivided_hyper_rectangle
    set Arguments = 2, 2, 2 : 0, 0, 0 : 1, 1, 1 : true
    set Rotate = {degrees}, 0, 0
  end
  set Young modulus = 1000
  set Poisson ratio = 0
  set Support = 0: {support}
  set Pressure = 3: 1; 5: 2{more}
end
{plane("Obstacle 1", [0., -math.sin(angle), math.cos(angle)])}
{plane("Obstacle 2", [0., math.cos(angle), math.sin(angle)])}
subsection Pair 1
  set Secondary = 1: 4
  set Obstacle = 1
  set Friction = 0.3
end
subsection Pair 2
  set Secondary = 1: 2
  set Obstacle = 2
  set Friction = 0.2
end
subsection Refinement
  set Level = 0
end
subsection Output
  set Fields = false
  set Pictures = false
end
"""


def in_a_groove():
    """Drawn along it, all slides, nodes of the edge along both planes. Pushed
    by less, all sticks: the tractions along it are the push."""
    for degrees in (0., 35.):
        for settings in (METHODS[0], METHODS[6]):
            summary = run(groove(degrees), settings)
            name = f"groove of {degrees} degrees, {settings}"
            for pair, mu in ((1, 0.3), (2, 0.2)):
                p.close(summary[f"pair_{pair}_friction_force"],
                        mu * summary[f"pair_{pair}_normal_force"], 1e-9, name)
            p.close(-summary["reaction_1"][0], summary["pair_1_friction"][0]
                    + summary["pair_2_friction"][0], 1e-9, name + ": reaction")
            p.expect(0.98 * 0.8 < -summary["reaction_1"][0] < 0.8,
                     name + f": reaction {summary['reaction_1']}")
        pushed = groove(degrees, "; 0: 0.2").replace(
            "  set Support = 0: (-0.1*t), free, free\n", "")
        summary = run(pushed)
        p.close(summary["pair_1_friction"][0] + summary["pair_2_friction"][0],
                -0.2, 1e-9, f"pushed along a groove of {degrees} degrees")


def slanted(corners, refinements, support, planes, gap=0., round_x=False):
    """A quadrilateral on planes: boundary id, point, normal and coefficient."""
    corners = " ; ".join(words(corner) for corner in corners)
    text = f"""set Scene = solid
set Dimension = 2
subsection Solid
  set Obstacles = {len(planes)}
  set Pairs = {len(planes)}
  set Plane = {"axisymmetric" if round_x else "strain"}
end
subsection Body 1
  subsection Mesh
    set Generator = general_cell
    set Arguments = {corners} : true
  end
  set Refinements = {refinements}
  set Young modulus = 1000
  set Support = {support}
end
subsection Refinement
  set Level = 0
end
"""
    for k, (side, point, normal, mu) in enumerate(planes, 1):
        text += plane(f"Obstacle {k}", normal, f"  set Point = {words(point)}\n")
        text += (f"subsection Pair {k}\n  set Secondary = 1: {side}\n"
                 f"  set Obstacle = {k}\n  set Friction = {mu!r}\n"
                 f"  set Initial gap = {gap!r}\nend\n")
    return text


def shapes():
    """A wedge between two planes, a round taper in its seat and a ring on a
    shaft, pushed at an end face: the reaction is N sin + T cos of the flanks."""
    draw = random.Random(342)
    for i in range(10):
        angle = draw.uniform(0.1, 0.5)
        foot, height = draw.uniform(0.3, 1.), draw.uniform(0.5, 1.5)
        mu, refinements = draw.uniform(0.1, 0.5), draw.choice([0, 1, 2])
        s, c, w = math.sin(angle), math.cos(angle), height * math.tan(angle)
        push = "free, (-0.01*t)"
        if i % 3 == 0:
            text = slanted([(-foot, 0), (foot, 0), (-foot - w, height),
                            (foot + w, height)], refinements, f"3: {push}",
                           [(0, (-foot, 0), (c, s), mu),
                            (1, (foot, 0), (-c, s), mu)])
        elif i % 3 == 1:
            text = slanted([(0, 0), (foot, 0), (0, height),
                            (foot + w, height)], refinements + 1,
                           f"0: 0, free; 3: {push}",
                           [(1, (foot, 0), (-c, s), mu)], round_x=True)
        else:
            s, c = 0., 1.
            text = slanted([(foot, 0), (foot + 1., 0), (foot, height),
                            (foot + 1., height)], refinements, f"3: {push}",
                           [(0, (foot, 0), (1, 0), mu)],
                           gap=-draw.uniform(1e-4, 1e-3), round_x=True)
        settings = METHODS[i % len(METHODS)]
        summary = run(text, settings)
        name = f"shape {i}, {settings}"
        flanks = [k for k in (1, 2) if f"pair_{k}_force" in summary]
        normal = sum(summary[f"pair_{k}_normal_force"] for k in flanks)
        friction = sum(summary[f"pair_{k}_friction_force"] for k in flanks)
        p.close(friction, mu * normal, 1e-9, name)
        p.close(-summary["reaction_1"][1], normal * s + friction * c, 1e-9,
                name + ": reaction")
        p.expect(normal > 0., name + ": nothing presses")


def prescribed_normals():
    """The lower left node has its displacement along the normal prescribed."""
    block = Block([1., 1.], [4, 4], 0.3, 1., "-0.1*t")
    text = block.on_plane()
    support = "(-0.1*t), free"
    p.expect(support in text, "no such support")
    for settings in METHODS:
        name = f"prescribed normal, {settings}"
        summary = run(text.replace(support, "(-0.1*t), 0"), settings)
        p.close(summary["pair_1_friction_force"],
                0.3 * summary["pair_1_normal_force"], 1e-9, name)
        p.close(summary["pair_1_normal_force"] + summary["reaction_1"][1], 1.,
                1e-9, name + ": balance")
        # Nitsche's method has points of quadrature, at such nodes, too.
        count = 0 if "nitsche" in settings.values() else 1
        without = count * max(0., sum(
            node["reaction_y"] for node in p.table("nodal.csv")
            if node["x"] == node["y"] == 0.))
        p.close(summary["pair_1_prescribed_share"],
                without / (without + summary["pair_1_normal_force"]), 1e-9,
                name + ": share")
        p.expect(summary["pair_1_prescribed_nodes"] == count,
                 f"{name}: {summary['pair_1_prescribed_nodes']} nodes")
    lifted = run(text.replace(support, "(-0.1*t), 0.01"))
    p.expect(lifted["pair_1_friction_force"] == 0. == lifted["pair_1_active"],
             "a lifted node has friction")
    inside = p.call("run", p.write("held.prm", text.replace(
        support, "(-0.1*t), -0.01")), "--output", "out")
    p.expect(inside.returncode == 3 and "ABUT-F26" in inside.stderr,
             f"a node held inside: exit code {inside.returncode}")


def in_shear():
    """A block drawn by both of its sides over a layer that shears and sticks:
    T = G d w / h, at nodes that supports fix and whose primary can move."""
    text = Block([1., 0.5], [1, 1], 0.3, 1., "1e-4*t").on_body(
        [1., 0.5], [1, 1], [0., -0.5])
    text = text.replace("  set Support = 2: 0, 0\n",
                        "  set Support = 0, 1: free, 0; 2: 0, 0\n").replace(
                            "Support = 0: (1e-4*t)", "Support = 0, 1: (1e-4*t)")
    for settings in METHODS[:1] + METHODS[2:7]:
        summary = run(text, settings)
        p.close(summary["reaction_2"][0], 0.1,
                1e-5 if "Method/Enforcement" in settings
                and "lagrange" not in settings.values() else 1e-9,
                f"shear, {settings}")
    # with the sides exchanged all normals are prescribed
    exchanged = text.replace("Secondary = 2: 2", "Secondary = 1: 3").replace(
        "Primary = 1: 3", "Primary = 2: 2")
    p.expect_error(p.call("run", p.write("held.prm", exchanged)), "ABUT-F26",
                   "Exchange the two sides")


def on_ranks():
    block = Block([1., 1.], [8, 8], 0.3, 1., "-0.1*t")
    expect_sliding(block, run(block.on_plane(), METHODS[4], 3), "3 ranks")
    corner = Corner(random.Random(5))
    corner.expect(run(corner.text("obstacle", 0.), METHODS[0], 3), 0.,
                  "corner, 3 ranks")


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
corners()
in_a_groove()
shapes()
prescribed_normals()
in_shear()
on_ranks()
p.finish()
