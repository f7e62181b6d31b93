# SPDX-License-Identifier: LGPL-2.1-or-later
"""Judges a membrane above or below an obstacle."""
import math

from elements import corners, gauss, interpolate, shapes
from formula import Formula, numbers
from motion import MembraneMotionJudge, in_motion
from run_files import Fields, last_row, read_nodes
from thresholds import ADHESIVE, LEAST_OF_FIELDS, THRESHOLDS
from tolerances import of_balance, of_energy, of_gaps
from vectors import cross, invert, norm, sub
from verdict import Wrong


class HeightMap:
    """A grey image as a bilinear function."""

    def __init__(self, scene):
        def get(name, default):
            return scene.get(f"Contact/Height map{name}", default)
        self.lower = numbers(get(" lower corner", "0, 0"))
        self.upper = numbers(get(" upper corner", "1, 1"))
        self.lowest = float(get(" lowest", "0"))
        self.highest = float(get(" highest", "1"))
        data = (scene.folder / get("", "")).read_bytes()
        words, at = [], 0
        while len(words) < 4:
            while data[at:at + 1].isspace() or data[at:at + 1] == b"#":
                at = (data.index(b"\n", at) if data[at:at + 1] == b"#"
                      else at) + 1
            end = at
            while not data[end:end + 1].isspace():
                end += 1
            words.append(data[at:end])
            at = end
        self.width, self.height, white = map(int, words[1:])
        if words[0] == b"P2":
            grey = [int(word) for word in data[at:].split()]
        elif white > 255:
            grey = [256 * a + b for a, b in zip(data[at + 1::2],
                                                data[at + 2::2])]
        else:
            grey = list(data[at + 1:])
        self.grey = [g / white for g in grey]

    def __call__(self, x, time=0.):
        place = []
        for s, n in (((x[0] - self.lower[0]) / (self.upper[0] - self.lower[0]),
                      self.width),
                     ((self.upper[1] - x[1]) / (self.upper[1] - self.lower[1]),
                      self.height)):
            s = max(0., min(n - 1., s * (n - 1)))
            i = min(int(s), max(n - 2, 0))
            place.append((i, min(i + 1, n - 1), s - i))
        (i, right, a), (j, below, b) = place

        def at(column, row):
            return self.grey[row * self.width + column]
        grey = ((1 - b) * ((1 - a) * at(i, j) + a * at(right, j))
                + b * ((1 - a) * at(i, below) + a * at(right, below)))
        return self.lowest + (self.highest - self.lowest) * grey


class Line:
    """A side of a cell as a cell of its own."""

    def __init__(self, dim, degree, nodes):
        self.dim, self.degree, self.nodes = dim, degree, nodes


class MembraneJudge:
    """All checks of a run of the scene `obstacle`."""

    def __init__(self, folder, scene, summary, findings):
        self.folder, self.scene = folder, scene
        self.summary, self.findings = summary, findings
        self.dim = int(scene.get("Dimension", "2"))
        self.degree = int(scene.get("Membrane/Degree", "1"))
        self.nodes = read_nodes(folder, self.dim, self.degree)
        columns = self.nodes.columns
        self.u, self.p = columns["displacement"], columns["pressure"]
        self.gap, self.status = columns["gap"], columns["status"]
        self.load, self.contact = columns["load"], columns["contact"]
        self.reaction, self.held = columns["reaction"], columns["held"]
        self.method = summary.get("method") or ""
        self.lower = self.upper = None
        if scene.get("Contact/Height map"):
            self.lower = HeightMap(scene)
        elif scene.get("Contact/Obstacle"):
            self.lower = self.at_end(scene.get("Contact/Obstacle"))
        if scene.get("Contact/Upper obstacle"):
            self.upper = self.at_end(scene.get("Contact/Upper obstacle"))
        self.pairs = [side for side in (self.lower, self.upper) if side]

    def at_end(self, text):
        """A formula at the time that the run has come to."""
        formula, time = Formula(text), self.summary.get("time") or 0.
        return lambda x: formula(x, time)

    def judge(self):
        self.fields = Fields(self.folder, "fields", self.nodes)
        self.places = ([self.side(*key) for key in self.contact_sides()]
                       if self.scene.get("Contact/Boundary ids") else
                       self.fields.cells)
        self.files_agree()
        self.force()
        self.gaps()
        self.penetration()
        self.tension()
        self.pressure()
        if in_motion(self.scene):
            self.strain_energy(self.summary["strain_energy"], 0.)
            MembraneMotionJudge(self).judge()
        else:
            self.balance()
            self.energies()

    def files_agree(self):
        s = self.summary
        self.findings.require("nodes of nodal.csv",
                              len(self.nodes) == s["dofs"],
                              f"summary.json has {s['dofs']} unknowns")
        self.findings.require("cells of the fields",
                              len(self.fields.cells) == s["cells"],
                              f"summary.json has {s['cells']}")
        limit = THRESHOLDS["agreement"]
        largest = max(map(abs, self.u))
        self.findings.check("displacement of fields and nodal.csv",
                            self.fields.worst,
                            limit.value * largest + LEAST_OF_FIELDS,
                            limit.reason)
        row = last_row(self.folder, "levels.csv")
        for key in ("energy", "contact_force"):
            table = THRESHOLDS["tables"]
            self.findings.check(f"{key} of levels.csv",
                                abs(float(row[key]) - s[key]),
                                table.value * abs(s[key]), table.reason)
        for name, mine in (("pressure", self.p), ("gap", self.gap)):
            worst = max(abs(v - mine[i])
                        for cell, values in zip(self.fields.cells,
                                                self.fields.values[name])
                        for i, v in zip(cell.nodes, values))
            self.findings.check(f"{name} of fields and nodal.csv", worst,
                                limit.value * max(map(abs, mine)),
                                limit.reason)

    # Contact on the boundary

    def contact_sides(self):
        """Sides of cells whose nodes have rows or, at the ends of the contact
        boundary, a prescribed value."""
        single = self.single_sides()
        middles, larger, _ = self.between_sizes(single)
        return [owner for key, owner in single.items()
                if not key & middles and key not in larger
                and any(self.status[i] >= 0 for i in key)
                and all(self.status[i] >= 0 or self.held[i] != 0
                        for i in key)]

    def single_sides(self):
        """Sides, by their corners, that one cell has: cell, direction, end."""
        count = {}
        for cell in self.fields.cells:
            corner = corners(cell.dim, cell.degree)
            for d in range(cell.dim):
                for side in (0, 1):
                    key = frozenset(cell.nodes[i] for k, i in enumerate(corner)
                                    if (k >> d & 1) == side)
                    count.setdefault(key, []).append((cell, d, side))
        return {key: owners[0] for key, owners in count.items()
                if len(owners) == 1}

    def between_sizes(self, sides):
        """Where cells of two sizes meet: the nodes in the middle of the larger
        sides, which are corners of smaller ones, those larger sides, and the
        nodes that hang between."""
        corner = {i for key in sides for i in key}
        middles, larger = set(), set()
        for key in sides:
            places = [self.nodes.place[i] for i in key]
            middle = tuple(sum(x) / len(places) for x in zip(*places))
            try:
                i = self.nodes.find(middle, None)
            except Wrong:
                continue
            if i in corner:
                middles.add(i)
                larger.add(key)
        ends = {i for key in larger for i in key}
        hanging = {i for key, owner in sides.items() if key & middles
                   for i in self.side(*owner).nodes}
        return middles, larger, hanging - ends

    @staticmethod
    def side(cell, d, side):
        n = cell.degree + 1
        nodes = [node for k, node in enumerate(cell.nodes)
                 if k // n**d % n == side * cell.degree]
        return Line(cell.dim - 1, cell.degree, nodes)

    # Checks

    def round_off(self):
        """Of forces, where a membrane that nothing loads is lifted."""
        k = Formula(self.scene.get("Membrane/Conductivity", "1"))
        return (1e-12 * max(abs(k(x)) for x in self.nodes.place)
                * max(map(abs, self.u))
                * self.nodes.extent**(self.dim - 2))

    def balance(self):
        limit = of_balance(self.scene, self.summary)
        forces = self.load + self.contact + self.reaction
        if limit is None:
            self.findings.leave("balance of forces",
                                "the target error sets the tolerances")
        else:
            self.findings.check("balance of forces", abs(math.fsum(forces)),
                                limit.value * math.fsum(map(abs, forces))
                                + self.round_off(), limit.reason)

    def force(self):
        given = self.summary["contact_force"]
        limit = THRESHOLDS["sides"]
        self.findings.check("contact force",
                            abs(math.fsum(self.contact) - given),
                            limit.value * math.fsum(map(abs, self.contact)),
                            "the sum of the nodes")

    def obstacle_gap(self, x, u):
        """Gap to the nearer obstacle."""
        gaps = []
        if self.lower:
            gaps.append(u - self.lower(x))
        if self.upper:
            gaps.append(self.upper(x) - u)
        return min(gaps)

    def is_node(self, i):
        """Whether it has forces: hanging nodes have none of their own."""
        return self.load[i] != 0 or self.contact[i] != 0

    def gaps(self):
        worst = max([abs(self.gap[i] - self.obstacle_gap(x, self.u[i]))
                     for i, x in enumerate(self.nodes.place)
                     if self.status[i] >= 0 and self.is_node(i)] + [0.])
        limit = THRESHOLDS["gap"]
        scale = max(abs(v) for v in self.u + self.gap)
        self.findings.check("gaps at nodes", worst, limit.value * scale,
                            limit.reason)
        force = math.fsum(map(abs, self.contact))
        work = math.fsum(abs(p * g) for p, g in zip(self.contact, self.gap))
        limit = THRESHOLDS["complementarity"]
        law = of_gaps(self.scene, self.summary, max(map(abs, self.u)))
        if (self.method in ("barrier", "interior point")
                and force <= 1e-6 * math.fsum(map(abs, self.load))):
            self.findings.leave("mean gap under pressure",
                                "what a barrier leaves where nothing touches")
            return
        self.findings.check("mean gap under pressure",
                            work / force if force > 0 else 0.,
                            limit.value * self.size() + law, limit.reason)

    def size(self):
        """Median edge of the cells."""
        sizes = sorted(self.size_of(cell) for cell in self.fields.cells)
        return sizes[len(sizes) // 2]

    def size_of(self, cell):
        points = [self.nodes.place[cell.nodes[i]]
                  for i in corners(cell.dim, cell.degree)]
        return max(norm(sub(points[0], points[1 << d]))
                   for d in range(cell.dim))

    def penetration(self):
        worst = (0., 0.)
        limit = THRESHOLDS["penetration, nodes"]
        law = of_gaps(self.scene, self.summary, max(map(abs, self.u)))
        # displacements have a unit of their own
        part = THRESHOLDS["penetration, membrane"].value * max(map(abs, self.u))
        n = 4 if self.dim == 2 else 3
        hanging = self.between_sizes(self.single_sides())[2]
        for side, factor in ((self.lower, 1.), (self.upper, -1.)):
            if side is None:
                continue
            at_node = [factor * side(x) for x in self.nodes.place]
            scale = 1e-9 * max(map(abs, self.u + at_node))
            for cell in self.places:
                nodal = [at_node[i] for i in cell.nodes]
                u = [factor * self.u[i] for i in cell.nodes]
                points = [self.nodes.place[i] for i in cell.nodes]
                allowed = (law + scale
                           + max(part, limit.value * self.size_of(cell)))
                # nodes that hang follow others, which have the rows
                allowed += max([at_node[i] - factor * self.u[i]
                                for i in cell.nodes if i in hanging] + [0.])
                for index in range(n**cell.dim):
                    place = tuple((index // n**d % n + 0.5) / n
                                  for d in range(cell.dim))
                    values = shapes(cell.dim, cell.degree, place)[0]
                    level = factor * side(interpolate(values, points))
                    depth = level - sum(v * w for v, w in zip(values, u))
                    if depth <= 0:
                        continue
                    # steps of the obstacle between nodes that know of them
                    chord = min(level, max(nodal)) - sum(
                        v * w for v, w in zip(values, nodal))
                    worst = max(worst, (depth, allowed + max(0., chord)),
                                key=lambda e: e[0] - e[1])
        self.findings.check("penetration", *worst, limit.reason)

    def tension(self):
        if self.method in ADHESIVE:
            self.findings.leave("tension", "the law is adhesive")
            return
        limit = THRESHOLDS["tension"]
        # quadratic interpolation between parents overshoots
        hanging = (self.between_sizes(self.single_sides())[2]
                   if self.degree > 1 else set())
        for name, values in (("pressure", self.p),
                             ("contact force", self.contact)):
            pull = 0.
            for i, (value, state) in enumerate(zip(values, self.status)):
                if i in hanging:
                    continue
                if not self.upper:
                    pull = max(pull, -value)
                elif not self.lower:
                    pull = max(pull, value)
                elif state > 0:
                    pull = max(pull, -value if state < 1.5 else value)
            self.findings.check(f"tension, {name}", pull,
                                limit.value * max(map(abs, values)),
                                limit.reason)

    def pressure(self):
        """The force is the integral of the pressure."""
        total = 0.
        for cell in self.places:
            points = [self.nodes.place[i] for i in cell.nodes]
            p = [self.p[i] for i in cell.nodes]
            for place, weight in gauss(cell.dim, self.degree + 1):
                values, gradients = shapes(cell.dim, cell.degree, place)
                total += weight * self.area(cell, points, gradients) * sum(
                    v * w for v, w in zip(values, p))
        limit = THRESHOLDS["weights"]
        size = math.fsum(map(abs, self.contact))
        self.findings.check("integral of the pressure",
                            abs(total - self.summary["contact_force"]),
                            limit.value * size, limit.reason)

    @staticmethod
    def jacobian(points, gradients):
        return [[sum(g[j] * p[i] for g, p in zip(gradients, points))
                 for j in range(len(gradients[0]))]
                for i in range(len(points[0]))]

    def area(self, cell, points, gradients):
        matrix = self.jacobian(points, gradients)
        columns = list(zip(*matrix))
        if cell.dim == self.dim:
            return abs(invert(matrix)[1])
        return norm(columns[0] if cell.dim == 1 else cross(*columns))

    def energies(self):
        products = [[f * u for f, u in zip(forces, self.u)]
                    for forces in (self.load, self.contact, self.reaction)]
        size = math.fsum(abs(v) for part in products for v in part)
        stored = self.summary["energy"] + math.fsum(products[0])
        limit = of_energy(self.scene, self.summary)
        if limit is None:
            self.findings.leave("works", "the target error sets the tolerances")
            return
        self.findings.check(
            "twice the energy is the work of all forces",
            abs(2 * stored - math.fsum(map(math.fsum, products))),
            limit.value * max(size, abs(stored))
            + self.round_off() * max(map(abs, self.u)), limit.reason)
        # gap = u - obstacle: what contact works is that on the obstacle
        if not self.upper or not self.lower:
            side = self.lower or self.upper
            given = math.fsum(p * side(x) for p, x in
                              zip(self.contact, self.nodes.place) if p != 0)
            law = math.fsum(abs(p * g)
                            for p, g in zip(self.contact, self.gap))
            self.findings.check(
                "work of contact is that of the initial gaps",
                abs(math.fsum(products[1]) - given),
                limit.value * max(size, abs(given)) + law * (1 + 1e-6),
                limit.reason)
        self.strain_energy(stored, size)

    def strain_energy(self, stored, size):
        mine = self.stored_energy()
        limit = THRESHOLDS["stored energy"]
        self.findings.check("stored energy, integrated again",
                            abs(stored - mine), limit.value * mine
                            + 1e-12 * size
                            + self.round_off() * max(map(abs, self.u)),
                            limit.reason)

    def stored_energy(self):
        k = Formula(self.scene.get("Membrane/Conductivity", "1"))
        total = 0.
        for cell in self.fields.cells:
            points = [self.nodes.place[i] for i in cell.nodes]
            u = [self.u[i] for i in cell.nodes]
            for place, weight in gauss(self.dim, self.degree + 1):
                values, gradients = shapes(self.dim, cell.degree, place)
                inverse, determinant = invert(self.jacobian(points, gradients))
                if inverse is None:
                    raise Wrong("a cell has no volume")
                local = [sum(g[j] * v for g, v in zip(gradients, u))
                         for j in range(self.dim)]
                slope = [sum(inverse[j][d] * local[j]
                             for j in range(self.dim))
                         for d in range(self.dim)]
                x = interpolate(values, points)
                total += (k(x) * sum(s * s for s in slope) / 2
                          * abs(determinant) * weight)
        return total
