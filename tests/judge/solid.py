# SPDX-License-Identifier: LGPL-2.1-or-later
"""Judges elastic bodies in contact."""
import functools
import itertools
import math

from coulomb import judge_friction
from driven import driven_work, judge_driven_balance
from elements import (corners, derivative, gauss, interpolate, shapes,
                      slopes)
from formula import Formula, split
from hanging import hanging_forces, missing_moment
from material import (body_law, deformation, has_mean_dilatation,
                      large_strain_energy, moduli)
from motion import MotionJudge, in_motion
from obstacles import Obstacle
from run_files import Fields, last_row, read_nodes
from surfaces import Facet, Tree, Volume, set_chords
from thresholds import ADHESIVE, LEAST_OF_FIELDS, THRESHOLDS
from tolerances import of_balance, of_energy, of_gaps
from vectors import add, cross, dot, invert, norm, scale, sub
from verdict import CannotJudge, Wrong, says

# More cells than this are not integrated again: minutes.
MOST_CELLS = 20000


class Pair:
    """What the scene says about a pair."""

    def __init__(self, scene, number, time):
        section = f"Pair {number}"
        self.number = number
        self.secondary = self._surface(scene.get(f"{section}/Secondary"))
        self.primary = self._surface(scene.get(f"{section}/Primary"))
        self.obstacle = int(scene.number(f"{section}/Obstacle", 0))
        self.tied = scene.flag(f"{section}/Tied")
        self.mesh_gap = scene.flag(f"{section}/Use mesh gap", True)
        gap = scene.get(f"{section}/Initial gap", "0") or "0"
        self.gap = Formula(gap)((0., 0., 0.), time)

    @staticmethod
    def _surface(text):
        """Boundary ids by body; `*` is None."""
        result = {}
        for part in split(text, ";"):
            body, _, ids = part.partition(":")
            result[int(body)] = (None if ids.strip() == "*" else
                                 {int(i) for i in split(ids, ",")})
        return result

    @staticmethod
    def facets(surface, facets):
        return [f for f in facets if f.body in surface and (
            surface[f.body] is None or f.boundary in surface[f.body])]


class SolidJudge:
    """All checks of a run of the scene `solid`."""

    def __init__(self, folder, scene, summary, findings):
        self.folder, self.scene = folder, scene
        self.summary, self.findings = summary, findings
        self.dim = int(scene.get("Dimension", "2"))
        self.degree = int(scene.get("Solid/Degree", "1"))
        self.plane = (scene.get("Solid/Plane", "strain") if self.dim == 2
                      else "")
        self.time = summary["time"]
        self.nodes = read_nodes(folder, self.dim, self.degree)
        self.n_bodies = int(scene.get("Solid/Bodies", "1"))
        self.u = self.nodes.vector("displacement")
        self.largest = max(norm(u) for u in self.u)
        self.load = self.nodes.vector("load")
        self.contact = self.nodes.vector("contact")
        self.reaction = self.nodes.vector("reaction")
        self.held = self.nodes.vector("held")
        n_pairs = int(scene.get("Solid/Pairs", "0"))
        self.pairs = [Pair(scene, i + 1, self.time) for i in range(n_pairs)]
        self.method = summary.get("method") or ""
        self.discretisation = summary.get("discretisation") or "auto"
        self.by_stress = self.method == "nitsche"
        # small strain has forces where they are in the undeformed bodies
        self.law = scene.get("Body 1/Material", "hooke")
        self.large = self.law != "hooke"
        self.lever = ([add(x, u) for x, u in zip(self.nodes.place, self.u)]
                      if self.large else self.nodes.place)

    def judge(self):
        blank = ("gap",)
        if says(self.summary, "inverted at a corner"):
            # there is no stress there, and the run says so
            blank += ("stress", "von_mises_stress", "stress_out_of_plane")
        self.fields = Fields(self.folder, "fields", self.nodes, blank)
        self.files_agree()
        self.loads()
        if in_motion(self.scene):
            # inertia is not among the forces of nodal.csv
            self.work_size = self.works(self.contact)[1]
            MotionJudge(self).judge()
            self.strain_energy()
        else:
            self.balance()
            judge_driven_balance(self)
            self.energies()
        if not self.pairs:
            return
        self.read_surfaces()
        self.volume = None
        for pair in self.pairs:
            self.penetration(pair)
            self.touch(pair)
            self.tension(pair)
            self.sides(pair)
        self.pair_forces()
        self.complementarity()
        self.initial_gaps()
        judge_friction(self)

    def round_off(self, part=1e-13):
        """Of forces, where bodies move and are hardly deformed, or touch by the
        round-off of their places."""
        stiffness = max(self.stiffness(body)
                        for body in range(1, self.n_bodies + 1))
        return (part * stiffness * self.flatness
                * (self.largest + 1e-3 * self.nodes.extent)
                * self.nodes.extent**(self.dim - 2))

    @functools.cached_property
    def flatness(self):
        """Largest ratio of two distances of corners of a cell: flat cells are
        as much stiffer across."""
        worst = 1.
        for cell in self.fields.cells:
            corner = [self.nodes.place[cell.nodes[i]]
                      for i in corners(cell.dim, cell.degree)]
            sizes = [norm(sub(a, b))
                     for a, b in itertools.combinations(corner, 2)]
            if min(sizes) <= 1e-7 * max(sizes):
                raise CannotJudge("cells are too flat for the digits of files")
            worst = max(worst, max(sizes) / min(sizes))
        return worst

    def stiffness(self, body):
        """Of a body that cannot grow wider, which of one that hardly changes
        its volume is far more than its Young modulus."""
        young = self.scene.number(f"Body {body}/Young modulus", 1.)
        ratio = self.scene.number(f"Body {body}/Poisson ratio", 0.3)
        return young * (1. - ratio) / ((1. + ratio) * (1. - 2. * ratio))

    def imbalance(self):
        """Of forces that are in balance: of large strain also Newton's
        tolerance, which is of the forces that it would take to stop bodies
        within a facet on the way of a step."""
        newton = self.scene.number("Time stepping/Newton tolerance", 1e-8)
        return self.round_off(max(1e-13, newton if self.large else 0.))

    # Files

    def files_agree(self):
        check = self.findings.require
        s, nodes = self.summary, self.nodes
        check("nodes of nodal.csv", len(nodes) * self.dim == s["dofs"],
              f"summary.json has {s['dofs']} unknowns")
        check("cells of the fields", len(self.fields.cells) == s["cells"],
              f"summary.json has {s['cells']}")
        bodies = set(range(1, self.n_bodies + 1))
        check("bodies in all files", set(nodes.body) == bodies
              and {c.body for c in self.fields.cells} == bodies,
              f"the scene has {self.n_bodies}")
        self.agree("displacement", self.fields.worst)
        row = last_row(self.folder, "levels.csv")
        for key in ("energy", "contact_force"):
            if s.get(key) is None:
                continue
            limit = THRESHOLDS["tables"]
            self.findings.check(f"{key} of levels.csv",
                                abs(float(row[key]) - s[key]),
                                limit.value * abs(s[key]), limit.reason)

    def agree(self, name, difference):
        limit = THRESHOLDS["agreement"]
        self.findings.check(f"{name} of fields and nodal.csv", difference,
                            limit.value * self.largest + LEAST_OF_FIELDS,
                            limit.reason)

    # Forces and energies

    def balance(self):
        limit = of_balance(self.scene, self.summary, self.large)
        if limit is None:
            self.findings.leave("balance of forces",
                                "the target error sets the tolerances")
            return
        # what is turned about its axis has no resultant of radial forces
        radial = self.plane == "axisymmetric"
        noise = self.imbalance()
        outer = [add(add(a, b), c) for a, b, c in zip(
            self.load, self.contact, self.reaction)]
        aside, inner = ({}, {}) if radial else hanging_forces(self)
        for body in range(1, self.n_bodies + 1):
            force = (0.,) * self.dim
            moment = (0.,) * (1 if self.dim == 2 else 3)
            size = arm = 0.
            for i, of in enumerate(self.nodes.body):
                if of != body:
                    continue
                for part in (self.load[i], self.contact[i], self.reaction[i]):
                    force = add(force, part)
                    moment = add(moment, cross(self.lever[i], part))
                    size += norm(part)
                    arm += norm(part) * norm(self.lever[i])
            left = norm(force[1:]) if radial else norm(force)
            self.findings.check(f"balance of forces on body {body}", left,
                                limit.value * size + noise, limit.reason)
            if not radial:
                missing, more = missing_moment(
                    aside, inner, outer, self.nodes.body, body, len(moment))
                moment, arm = sub(moment, missing), arm + more
                self.findings.check(f"balance of moments on body {body}",
                                    norm(moment), limit.value * arm
                                    + noise * (self.nodes.extent
                                               + self.largest),
                                    limit.reason)
            given = self.summary.get(f"reaction_{body}")
            if given:
                mine = self.total(self.reaction, body)
                self.findings.check(
                    f"reaction_{body} of summary.json",
                    norm(sub(given, mine)), limit.value * size + noise,
                    "the sum of its nodes")

    def total(self, forces, body):
        result = (0.,) * self.dim
        for force, of in zip(forces, self.nodes.body):
            if of == body:
                result = add(result, force)
        return result

    def measure(self, x):
        return 2 * math.pi * x[0] if self.plane == "axisymmetric" else 1.

    def body_force(self, body):
        """Force per volume as formulas, or None."""
        parts = []
        text = self.scene.get(f"Body {body}/Body force")
        if text:
            parts.append((1., [Formula(p) for p in split(
                text, ";" if ";" in text else ",")]))
        density = self.scene.number(f"Body {body}/Density", 0.)
        gravity = self.scene.get("Solid/Gravity")
        if density and gravity:
            parts.append((density, [Formula(p) for p in split(
                gravity, ";" if ";" in gravity else ",")]))
        return parts

    def loads(self):
        """That the loads of the scene are there."""
        for body in range(1, self.n_bodies + 1):
            total = sum(norm(f) for f, of in zip(self.load, self.nodes.body)
                        if of == body)
            surface = False
            for name in ("Traction", "Pressure"):
                for part in split(self.scene.get(f"Body {body}/{name}"), ";"):
                    formulas = split(part.partition(":")[2], ",")
                    surface = surface or not all(
                        Formula(f).is_zero() for f in formulas)
            volume = self.body_force(body)
            # a formula may be 0 all over the surface at this time
            if surface and not any("t" in self.scene.get(
                    f"Body {body}/{name}") or "(" in self.scene.get(
                        f"Body {body}/{name}")
                    for name in ("Traction", "Pressure")):
                self.findings.require(f"loads on body {body}", total > 0,
                                      "the scene has some")
            if volume and not surface:
                self.volume_load(body, volume, total)

    def volume_load(self, body, parts, size):
        mine = (0.,) * self.dim
        for cell in self.fields.cells:
            if cell.body != body:
                continue
            points = [self.nodes.place[i] for i in cell.nodes]
            for place, weight in gauss(self.dim, self.degree + 1):
                x, _, dx = self.at(cell, points, place)
                dx *= weight * self.measure(x)
                for factor, formulas in parts:
                    mine = add(mine, tuple(f(x, self.time) for f in formulas),
                               factor * dx)
        limit = THRESHOLDS["stored energy"]
        self.findings.check(f"volume load on body {body}",
                            norm(sub(mine, self.total(self.load, body))),
                            limit.value * max(size, norm(mine)), limit.reason)

    def at(self, cell, points, place):
        """Position, inverse of the map's derivative and volume element."""
        x = interpolate(shapes(self.dim, cell.degree, place)[0], points)
        inverse, determinant = invert(derivative(
            slopes(self.dim, cell.degree, place), points))
        if inverse is None:
            raise Wrong(f"a cell at {x} has no volume")
        return x, inverse, abs(determinant)

    def stored_energy(self, u=None):
        """By the judge's own integration of the displacements."""
        u = u or self.u
        total = 0.
        material = moduli(self)
        for cell in self.fields.cells:
            points = [self.nodes.place[i] for i in cell.nodes]
            values = [u[i] for i in cell.nodes]
            lame, mu = material[cell.body]
            # one change of volume for the whole cell, where Lame's first
            # constant multiplies it
            averaged, volume, growth = 0., 0., 0.
            if has_mean_dilatation(self.scene, cell.body):
                averaged, lame = lame, 0.
            for place, weight in gauss(self.dim, self.degree + 1):
                x, inverse, dx = self.at(cell, points, place)
                columns = tuple(zip(*inverse))
                strain = [[dot(row, column) for column in columns]
                          for row in derivative(slopes(
                              self.dim, cell.degree, place), values)]
                if self.large:
                    hoop = (interpolate(shapes(self.dim, cell.degree, place)[0],
                                        values)[0] / x[0]
                            if self.plane == "axisymmetric" else 0.)
                    dx *= weight * self.measure(x)
                    total += dx * large_strain_energy(
                        body_law(self.scene, cell.body), strain, hoop, lame, mu,
                        x)
                    volume += dx
                    growth += dx * (deformation(strain, hoop, x)[1] - 1.)
                    continue
                trace = sum(strain[i][i] for i in range(self.dim))
                square = sum((strain[i][j] + strain[j][i])**2 / 4
                             for i in range(self.dim) for j in range(self.dim))
                if self.plane == "axisymmetric" and self.dim == 2:
                    hoop = interpolate(shapes(self.dim, cell.degree, place)[0],
                                       values)[0] / x[0]
                    trace += hoop
                    square += hoop**2
                dx *= weight * self.measure(x)
                total += (lame * trace**2 / 2 + mu * square) * dx
                volume += dx
                growth += dx * trace
            growth /= volume
            if self.large:
                growth = math.log1p(growth)
            total += volume * averaged / 2 * growth**2
        return total

    def virtual_work(self, limit):
        """Of large strain: what the stored energy changes by along a motion is
        the work of all forces on it. Motions: each component of the
        displacement alone, in which hanging nodes stay between others."""
        h = 1e-4
        stiff_volume = self.stiff_volume()
        for d in range(self.dim):
            way = [tuple(u[k] if k == d else 0. for k in range(self.dim))
                   for u in self.u]
            slope, energy = self.slope(way, h)
            work = math.fsum(dot(w, add(add(a, b), c)) for w, a, b, c in
                             zip(way, self.load, self.contact, self.reaction))
            allowed = (limit.value * self.work_size + 1e-12 * energy / h
                       + 2.2e-16 * stiff_volume / h
                       + self.imbalance() * self.largest)
            if abs(slope - work) > allowed:
                # where bodies hardly change their volume, energies are not
                # parabolas of this width
                slope = (4 * self.slope(way, h / 2)[0] - slope) / 3
            self.findings.check(
                f"virtual work of the displacement, {'xyz'[d]}",
                abs(slope - work), allowed, limit.reason)

    def stiff_volume(self):
        """Stiffness times volume: what energies of large strain are differences
        of, however small the strain."""
        stiffness = {body: self.stiffness(body)
                     for body in range(1, self.n_bodies + 1)}
        total = 0.
        for cell in self.fields.cells:
            points = [self.nodes.place[i] for i in cell.nodes]
            for place, weight in gauss(self.dim, self.degree):
                x, _, dx = self.at(cell, points, place)
                total += stiffness[cell.body] * dx * weight * self.measure(x)
        return total

    def slope(self, way, h):
        """Of the stored energy along a motion, by differences; and the
        energy."""
        ends = [self.stored_energy([add(u, w, factor)
                                    for u, w in zip(self.u, way)])
                for factor in (h, -h)]
        return (ends[0] - ends[1]) / (2 * h), ends[0]

    def strain_energy(self):
        """Of a motion at its end, integrated again."""
        if len(self.fields.cells) > MOST_CELLS:
            self.findings.leave("strain energy", "too many cells")
            return
        mine = self.stored_energy()
        limit = THRESHOLDS["stored energy"]
        self.findings.check(
            "strain energy, integrated again",
            abs(self.summary["strain_energy"] - mine),
            limit.value * mine + self.round_off() * self.largest, limit.reason)

    def works(self, forces):
        """Work of forces on the displacements, and of the magnitudes."""
        each = [dot(f, u) for f, u in zip(forces, self.u)]
        sizes = [sum(abs(a * b) for a, b in zip(f, u))
                 for f, u in zip(forces, self.u)]
        return math.fsum(each), math.fsum(sizes)

    def energies(self):
        load, load_size = self.works(self.load)
        reaction, reaction_size = self.works(self.reaction)
        contact, contact_size = self.works(self.contact)
        self.work_size = load_size + reaction_size + contact_size
        stored = self.summary["energy"] + load + driven_work(self)
        limit = of_energy(self.scene, self.summary, self.large)
        if limit is None:
            self.findings.leave("works", "the target error sets the tolerances")
            return
        if self.large:
            self.findings.leave("twice the energy is the work of all forces",
                                "forces are not linear in the displacement, "
                                "the virtual work is looked at instead")
        else:
            self.findings.check(
                "twice the energy is the work of all forces",
                abs(2 * stored - load - reaction - contact),
                limit.value * max(self.work_size, abs(stored))
                + self.round_off() * self.largest, limit.reason)
        if len(self.fields.cells) > MOST_CELLS:
            self.findings.leave("stored energy", "too many cells")
            return
        mine = self.stored_energy()
        if self.large:
            self.virtual_work(limit)
        limit = THRESHOLDS["stored energy"]
        self.findings.check("stored energy, integrated again",
                            abs(stored - mine), limit.value * mine
                            + 1e-12 * self.work_size
                            + self.round_off() * self.largest, limit.reason)

    # Surfaces

    def read_surfaces(self):
        surfaces = Fields(self.folder, "contact", self.nodes)
        self.agree("displacement on contact surfaces", surfaces.worst)
        behind = {}
        for cell in self.fields.cells:
            points = [self.nodes.place[i] for i in cell.nodes]
            middle = scale(tuple(map(sum, zip(*points))), 1 / len(points))
            for face in self.faces(cell):
                behind[face] = middle
        self.facets, self.surface_values = [], surfaces.values
        for number, cell in zip(surfaces.numbers, surfaces.cells):
            ends = frozenset(cell.nodes[i] for i in corners(cell.dim,
                                                            cell.degree))
            if ends not in behind:
                raise Wrong("a contact facet belongs to no cell")
            if number is None:
                raise CannotJudge("contact.pvd has no field boundary_id")
            self.facets.append(Facet(cell, number, self.nodes, self.u,
                                     behind[ends]))
        set_chords(self.facets)
        known = set()
        for pair in self.pairs:
            for surface in (pair.secondary, pair.primary):
                mine = Pair.facets(surface, self.facets)
                known.update(map(id, mine))
                if surface and not mine:
                    raise Wrong(f"contact.pvd lacks a side of pair "
                                f"{pair.number}")
        self.findings.require("facets of all pairs",
                              len(known) == len(self.facets),
                              "all facets of contact.pvd belong to a pair")

    def faces(self, cell):
        corner = [cell.nodes[i] for i in corners(cell.dim, cell.degree)]
        for d in range(cell.dim):
            for side in (0, 1):
                yield frozenset(node for i, node in enumerate(corner)
                                if (i >> d & 1) == side)

    def part_of_facet(self, pair):
        nodes = self.discretisation in ("nodes", "node to segment") or (
            self.discretisation == "auto" and pair.obstacle
            and not self.by_stress)
        return THRESHOLDS["penetration, nodes" if nodes else
                          "penetration, weighted"]

    def inside(self, x, bodies):
        if self.volume is None:
            self.volume = Volume(self.fields.cells, self.nodes, self.u)
        return self.volume.body_at(x, bodies) is not None

    def penetration(self, pair):
        if pair.tied:
            self.findings.leave(f"penetration of pair {pair.number}",
                                "it is tied")
            return
        of_no_use = (self.summary.get("largest_strain", 0.)
                     > THRESHOLDS["strain"].value)
        if of_no_use or says(self.summary, "ABUT-F36",
                             "penetrates between nodes"):
            self.findings.leave(f"penetration of pair {pair.number}",
                                "the run says that shapes or gaps are off")
            return
        if not pair.mesh_gap and self.largest > max(
                f.size for f in Pair.facets(pair.secondary, self.facets)):
            self.findings.leave(f"penetration of pair {pair.number}",
                                "gaps are no distances, and bodies have moved")
            return
        try:
            found = list(self.into_obstacle(pair) if pair.obstacle else
                         self.into_surface(pair))
        except ValueError as error:
            self.findings.leave(f"penetration of pair {pair.number}",
                                str(error))
            return
        depth, limit = max(found, key=lambda e: e[0] - e[1],
                           default=(0., 0.))
        self.findings.check(f"penetration of pair {pair.number}", depth, limit,
                            self.part_of_facet(pair).reason)

    def limit(self, pair, secondary, *others):
        law = of_gaps(self.scene, self.summary,
                      min(secondary.size, self.largest))
        told = self.summary.get(f"pair_{pair.number}_gap_error") or 0.
        return (law + told + sum(f.chord for f in (secondary, *others))
                + self.part_of_facet(pair).value * secondary.size
                + 1e-9 * self.nodes.extent)

    def obstacle(self, pair):
        """The obstacle of a pair where it is now."""
        return Obstacle(self.scene, pair.obstacle, self.dim, self.time,
                        self.summary.get(
                            f"obstacle_{pair.obstacle}_displacement"))

    def into_obstacle(self, pair):
        """Depths of samples of the surface, and of the obstacle."""
        obstacle = self.obstacle(pair)
        facets = Pair.facets(pair.secondary, self.facets)
        for facet in facets:
            # what supports hold inside no contact can move
            held = max([-obstacle.clearance(x, pair.gap) for i, x in
                        zip(facet.nodes, facet.deformed)
                        if any(self.held[i])] + [0.])
            for place in facet.samples():
                depth = -obstacle.clearance(facet.at(place), pair.gap)
                if not pair.mesh_gap:
                    before = obstacle.distance(facet.at(place, False))
                    if before > THRESHOLDS["fitting"].value * facet.size:
                        continue
                    depth += before
                if depth > 0:
                    yield depth, self.limit(pair, facet) + held
        if not pair.mesh_gap:
            return
        tree = Tree([p for f in facets for p in f.pieces(True)])
        bodies = set(pair.secondary)
        for x in obstacle.surface_points():
            distance, _, _, facet = tree.nearest(x)
            limit = self.limit(pair, facet)
            # deep inside, not where they touch on another side
            small = 1e-7 * self.nodes.extent
            within = sub(x, scale(obstacle.normal(x, small), small))
            if (distance - pair.gap > limit and self.inside(x, bodies)
                    and self.inside(within, bodies)):
                yield distance - pair.gap, limit

    def into_surface(self, pair):
        """Depths of samples of either surface inside the other."""
        secondary = Pair.facets(pair.secondary, self.facets)
        primary = Pair.facets(pair.primary, self.facets)
        for mine, other, is_secondary in ((secondary, primary, True),
                                          (primary, secondary, False)):
            tree = Tree([p for f in other for p in f.pieces(True)])
            before = None if pair.mesh_gap else Tree(
                [p for f in other for p in f.pieces(False)])
            bodies = {f.body for f in other}
            for facet in mine:
                for place in facet.samples():
                    depth, partner = self.depth(tree, facet, place, True)
                    if before is not None and partner is not None:
                        old = self.depth(before, facet, place, False)[0]
                        if old < -THRESHOLDS["fitting"].value * facet.size:
                            continue
                        depth -= old
                    if partner is None or depth <= pair.gap:
                        continue
                    sides = ((facet, partner) if is_secondary else
                             (partner, facet))
                    limit = self.limit(pair, *sides)
                    depth -= pair.gap
                    if depth > limit and before is None:
                        # the nearest surface may be the far side of a body
                        x = add(facet.at(place), facet.normal_at(place),
                                0.1 * depth)
                        if not self.inside(x, bodies):
                            continue
                    yield depth, limit

    @staticmethod
    def depth(tree, facet, place, deformed):
        """How far a sample is behind the nearest piece that faces it."""
        x = facet.at(place, deformed)
        distance, y, normal, partner = tree.nearest(
            x, facet.normal_at(place, deformed))
        if partner is None:
            return 0., None
        along = dot(sub(x, y), normal)
        if abs(along) < 0.7 * distance:
            return 0., None
        return -along, partner

    def touch(self, pair):
        """Where there is a force, the surfaces touch somewhere."""
        name = f"clearance of pair {pair.number}"
        why = ("it is tied or adhesive"
               if pair.tied or self.method in ADHESIVE else
               "its gaps are no distances" if not pair.mesh_gap else
               "steps in time have impulses" if in_motion(self.scene) else
               "the run says that gaps are off"
               if says(self.summary, "ABUT-F36") else
               "the bodies do not touch" if self.has_left() else None)
        if why:
            self.findings.leave(name, why)
            return
        force = norm(self.summary[f"pair_{pair.number}_force"])
        if force <= 1e-8 * max(map(norm, self.reaction)) + self.round_off():
            return
        limit = THRESHOLDS["clearance"]
        try:
            clearance, size, chord = min(self.clearances(pair),
                                         default=(0., 1., 0.))
        except ValueError as error:
            self.findings.leave(name, str(error))
            return
        # what rows leave that are linear where surfaces slide on each other
        slip = self.summary.get(f"pair_{pair.number}_slip") or 0.
        told = self.summary.get(f"pair_{pair.number}_gap_error") or 0.
        follows = self.scene.get("Method/Contact geometry", "auto") == "current" or (
            self.large and self.scene.get("Method/Contact geometry", "auto") == "auto")
        self.findings.check(
            name, clearance, limit.value * size
            + of_gaps(self.scene, self.summary, min(self.largest, size)) + told
            + (0. if follows else slip * (slip + 8 * chord) / size)
            + 1e-9 * self.nodes.extent, limit.reason)

    def clearances(self, pair):
        """How far nodes of both sides, and samples of the secondary, are from
        the other one, with the sizes of facets and chord heights."""
        secondary = Pair.facets(pair.secondary, self.facets)
        if pair.obstacle:
            obstacle = self.obstacle(pair)
            for facet in secondary:
                for x in facet.deformed + [facet.at(place)
                                           for place in facet.samples()]:
                    yield (obstacle.clearance(x, pair.gap), facet.size,
                           facet.chord)
            return
        primary = Pair.facets(pair.primary, self.facets)
        for mine, other in ((secondary, primary), (primary, secondary)):
            tree = Tree([p for f in other for p in f.pieces(True)])
            for facet in mine:
                for place in facet.node_places() + (
                        facet.samples() if mine is secondary else []):
                    x = facet.at(place)
                    distance, y, normal, partner = tree.nearest(
                        x, facet.normal_at(place))
                    if partner is None:
                        continue
                    # a far side of a body faces it, too
                    behind = (dot(sub(x, y), normal) < 0.
                              and distance < partner.size)
                    yield ((-distance if behind else distance) + pair.gap,
                           facet.size, max(facet.chord, partner.chord))

    def tension(self, pair):
        if pair.tied or self.method in ADHESIVE:
            self.findings.leave(f"tension of pair {pair.number}",
                                "it is tied" if pair.tied else
                                "its law is adhesive")
            return
        limit = THRESHOLDS["tension"]
        key = f"pair_{pair.number}"
        largest = self.summary[f"{key}_pressure"]
        self.findings.check(f"tension of pair {pair.number}",
                            self.summary[f"{key}_largest_tension"],
                            limit.value * abs(largest), limit.reason)
        if self.has_left():
            self.findings.leave(f"tension of pair {pair.number} in the fields",
                                "the bodies do not touch")
            return
        both = self.degree > 1 or pair.secondary == pair.primary
        if both or self.by_stress:
            self.findings.leave(
                f"tension of pair {pair.number} in the fields",
                "nodal forces of quadratic facets, and of surfaces that touch "
                "themselves, have both signs" if both else
                "nodal forces are residuals")
            return
        wanted = set(map(id, Pair.facets(pair.secondary, self.facets)))
        values = [v for facet, own in zip(self.facets,
                                          self.surface_values["pressure"])
                  if id(facet) in wanted for v in own]
        self.findings.check(f"tension of pair {pair.number} in the fields",
                            -min(values), limit.value * max(map(abs, values))
                            + self.noise(), limit.reason)

    def has_left(self):
        """Whether bodies do not touch, or in motion have left each other: what
        laws with a barrier leave is small beside the stiffness of what is
        strained, or the forces of the steps before."""
        if self.method in ("barrier", "interior point"):
            pressure = max(abs(self.summary[f"pair_{pair.number}_pressure"])
                           for pair in self.pairs)
            if pressure <= 1e-6 * self.summary["largest_strain"] * max(
                    self.stiffness(body)
                    for body in range(1, self.n_bodies + 1)):
                return True
        if not in_motion(self.scene):
            return False
        forces = [sum(abs(value) for name, value in row.items()
                      if "_force_" in name) for row in MotionJudge(self).rows]
        return forces[-1] <= 1e-6 * max(forces)

    def noise(self):
        """Round-off of tractions that are differences of large forces."""
        largest = max(max(norm(f), norm(g))
                      for f, g in zip(self.load, self.reaction))
        least = min(f.size for f in self.facets)**(self.dim - 1)
        return (1e-8 * largest + self.round_off()) / least

    def sides(self, pair):
        key = f"pair_{pair.number}"
        limit = THRESHOLDS["sides"]
        a = self.summary[f"{key}_force"]
        b = self.summary[f"{key}_primary_force"]
        size = norm(a) + norm(b)
        self.findings.check(f"forces on both sides of pair {pair.number}",
                            norm(add(a, b)), limit.value * size, limit.reason)

    def pair_forces(self):
        """Resultants of the pairs and sums of the nodes."""
        if self.by_stress:
            self.findings.leave("resultants of pairs",
                                "nitsche has no nodal forces of its own")
            return
        mine, size = {}, 0.
        for pair in self.pairs:
            sides = [(pair.secondary, "force")]
            if not pair.obstacle:
                sides.append((pair.primary, "primary_force"))
            for surface, word in sides:
                if len(surface) > 1:
                    self.findings.leave("resultants of pairs",
                                        "a side has several bodies")
                    return
                body, = surface
                force = self.summary[f"pair_{pair.number}_{word}"]
                size += norm(force)
                mine[body] = add(mine.get(body, (0.,) * self.dim), force)
        limit = THRESHOLDS["sides"]
        for body, force in mine.items():
            total = self.total(self.contact, body)
            for d in range(self.dim):
                self.findings.check(
                    f"resultant {'xyz'[d]} of pairs on body {body}",
                    abs(force[d] - total[d]), limit.value * size,
                    "the sum of its nodes, those that supports hold as well")
        if self.has_moments():
            self.pair_moments(mine, limit)

    def has_moments(self):
        """Of large strain, at obstacles."""
        return (self.large and self.plane != "axisymmetric"
                and all(pair.obstacle for pair in self.pairs)
                and not self.has_friction()
                and self.method in ("lagrange", "penalty", "quadratic penalty",
                                    "augmented lagrangian"))

    def pair_moments(self, bodies, limit):
        """Of all pairs together, at the places where bodies are."""
        given = (0.,) * 3
        for pair in self.pairs:
            given = add(given, self.summary[f"pair_{pair.number}_moment"])
        mine, arm = (0.,) * (1 if self.dim == 2 else 3), 0.
        for place, force, body in zip(self.lever, self.contact,
                                      self.nodes.body):
            if body in bodies:
                mine = add(mine, cross(place, force))
                arm += norm(place) * norm(force)
        given = given[2:] if self.dim == 2 else given
        self.findings.check("moment of the pairs", norm(sub(given, mine)),
                            limit.value * arm, "the sum of the nodes, where "
                            "they are at present")

    def complementarity(self):
        # forces of mortar multipliers reach the nodes beside them, which are open
        points = self.by_stress or self.discretisation in (
            "quadrature point", "mortar")
        gaps, states = self.nodes.columns["gap"], self.nodes.columns["status"]
        force = work = 0.
        for contact, gap, state in zip(self.contact, gaps, states):
            if state >= 0:
                force += norm(contact)
                work += norm(contact) * abs(gap)
        sizes = sorted(f.size for pair in self.pairs
                       for f in Pair.facets(pair.secondary, self.facets))
        limit = THRESHOLDS["complementarity"]
        size = sizes[len(sizes) // 2]
        law = of_gaps(self.scene, self.summary, min(size, self.largest))
        mean = work / force if force > 0 else 0.
        if points:
            # the rows' own gaps, which are none of nodes
            mean = self.summary["max_complementarity"]
        if self.has_left():
            self.findings.leave("mean gap under pressure",
                                "the bodies do not touch")
            return
        if "penalty" in self.method and any(p.tied for p in self.pairs):
            self.findings.leave("mean gap under pressure",
                                "what a penalty leaves of a tie is not told")
            return
        self.findings.check("mean gap under pressure", mean,
                            limit.value * size + law,
                            limit.reason)

    def has_friction(self):
        return any(f"pair_{pair.number}_friction_force" in self.summary
                   for pair in self.pairs)

    def slips_at_once(self):
        """Whether all that slips does so in one step, against what stays: then
        what is dissipated is the work of the last tractions on all slips."""
        moves = any(self.scene.get(f"Obstacle {pair.obstacle}/{name}", "")
                    for name in ("Motion", "Rotation angle", "Free directions")
                    for pair in self.pairs if pair.obstacle)
        return (not moves and not in_motion(self.scene)
                and self.summary["method"] == "lagrange"
                and int(self.scene.get("Time stepping/Number of steps", "1")) == 1
                and not self.summary.get("load_steps_cut_back"))

    def initial_gaps(self):
        """The work of contact is that on the initial gaps, and what friction
        dissipates, but for what the law leaves open."""
        name = "work of contact is that of the initial gaps"
        limit = of_energy(self.scene, self.summary)
        if limit is None:
            return
        if (self.large
                or self.scene.get("Method/Contact geometry", "auto") == "current"):
            self.findings.leave(name, "gaps need not be linear")
            return
        if self.by_stress:
            self.findings.leave(name, "nitsche has no nodal forces of its own")
            return
        given = math.fsum(self.summary[f"pair_{pair.number}_initial_gap_work"]
                          for pair in self.pairs)
        if self.has_friction():
            if not self.slips_at_once():
                self.findings.leave(name, "friction dissipates along the way")
                return
            given += self.summary["dissipation"]
        contact, _ = self.works(self.contact)
        law = self.summary["max_complementarity"] * self.magnitude()
        self.findings.check(name, abs(contact + given),
                            limit.value * max(self.work_size, abs(given))
                            + law * (1 + 1e-6), limit.reason)

    def magnitude(self):
        """Sum of the magnitudes of all rows' forces, ties by their nodes."""
        return max(self.summary["contact_force"],
                   math.fsum(norm(f) for f in self.contact))
