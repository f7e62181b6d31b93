# SPDX-License-Identifier: LGPL-2.1-or-later
"""Scenes of bodies that are close to each other and do not touch, made from a
seed. How far apart they are is measured here, on the facets of the meshes."""
import math
import random

from block_scene import block, section, solid
from ucd import ucd


def to_segment(p, a, b):
    """Distance of a point from a segment."""
    d = (b[0] - a[0], b[1] - a[1])
    t = ((p[0] - a[0]) * d[0] + (p[1] - a[1]) * d[1]) / (d[0]**2 + d[1]**2)
    t = min(1., max(0., t))
    return math.hypot(p[0] - a[0] - t * d[0], p[1] - a[1] - t * d[1])


def edges(polygon):
    return list(zip(polygon, polygon[1:] + polygon[:1]))


def between(first, second):
    """Distance of two polygons of which none is inside the other; negative if
    a corner of one is in the other (both convex, counterclockwise)."""
    def inside(p, polygon):
        return all((b[0] - a[0]) * (p[1] - a[1]) - (b[1] - a[1]) * (p[0] - a[0])
                   > 0. for a, b in edges(polygon))

    least = min(to_segment(p, a, b) for one, other in
                ((first, second), (second, first))
                for p in one for a, b in edges(other))
    if any(inside(p, second) for p in first) or any(
            inside(p, first) for p in second):
        return -least
    return least


def move_apart(distance, wanted, far):
    """Way along which the distance is the wanted one, seen from far away; the
    distance there is never less."""
    near = 0.
    for _ in range(200):
        middle = 0.5 * (near + far)
        if distance(middle) > wanted:
            far = middle
        else:
            near = middle
    return far


def polygon(n, radius, centre, turned):
    return [(centre[0] + radius * math.cos(turned + 2. * math.pi * k / n),
             centre[1] + radius * math.sin(turned + 2. * math.pi * k / n))
            for k in range(n)]


def ring(outside, centre):
    """Mesh of what is between a polygon (side 3) and its half (side 2)."""
    n = len(outside)
    inside = [(0.5 * (x + centre[0]), 0.5 * (y + centre[1]))
              for x, y in outside]
    quads = [(0, "quad", n + k + 1, k + 1, (k + 1) % n + 1,
              n + (k + 1) % n + 1) for k in range(n)]
    lines = [(3, "line", k + 1, (k + 1) % n + 1) for k in range(n)]
    lines += [(2, "line", n + k + 1, n + (k + 1) % n + 1) for k in range(n)]
    return ucd(outside + inside, quads + lines)


def rotation(rng):
    """A random rotation in space, from a unit quaternion."""
    w, x, y, z = (rng.gauss(0., 1.) for _ in range(4))
    s = 2. / (w * w + x * x + y * y + z * z)
    return ((1 - s * (y * y + z * z), s * (x * y - z * w), s * (x * z + y * w)),
            (s * (x * y + z * w), 1 - s * (x * x + z * z), s * (y * z - x * w)),
            (s * (x * z - y * w), s * (y * z + x * w), 1 - s * (x * x + y * y)))


def shell(n, turned):
    """Corners and cells of a ball with a hole (side 2); the surface (side 3) is
    that of a cube of n^3 cells, blown up."""
    number, nodes, items = {}, [], []

    def node(cube, radius):
        key = (cube, radius)
        if key not in number:
            x = [math.tan(0.25 * math.pi * (2. * c / n - 1.)) for c in cube]
            length = math.sqrt(sum(c * c for c in x))
            nodes.append([radius * sum(r * c for r, c in zip(row, x)) / length
                          for row in turned])
            number[key] = len(nodes)
        return number[key]

    for axis in range(3):
        for side in (0, n):
            for i in range(n):
                for j in range(n):
                    cube = []
                    for a, b in ((i, j), (i + 1, j), (i + 1, j + 1), (i, j + 1)):
                        c = [0, 0, 0]
                        c[axis], c[(axis + 1) % 3], c[(axis + 2) % 3] = side, a, b
                        cube.append(tuple(c))
                    if side == 0:
                        cube.reverse()
                    inside = [node(c, 0.5) for c in cube]
                    outside = [node(c, 1.) for c in cube]
                    items += [(0, "hex", *inside, *outside),
                              (2, "quad", *inside), (3, "quad", *outside)]
    return nodes, items


def body(number, file, come=()):
    """A body whose inside is fixed, or comes from where it is in the mesh."""
    dimension = 3 if file.endswith("3.inp") else 2
    return section(f"Body {number}", section("Mesh", f"File = {file}"),
                   "Poisson ratio = 0.3", "Support = 2: " + ", ".join(
                       f"{c:.17g}*t" for c in come or dimension * [0]))


def scene(p, name, dimension, parts, pair_lines, obstacles=0, steps=1):
    return p.write(name, solid(
        dimension, *parts, section("Pair 1", *pair_lines),
        section("Method", "Discretisation = dual mortar"),
        section("Load steps", f"Steps = {steps}"),
        section("Refinement", "Level = 0"),
        section("Output", "Fields = false", "Pictures = false"),
        bodies=2 - obstacles, obstacles=obstacles))


def coming(rng, along, across, facet):
    """How a body comes to its place without touching on the way: from farther
    off, by more than what facets are inclined by, and from the side; and in how
    many load steps."""
    off, aside = facet * rng.uniform(0.5, 2.), facet * rng.uniform(-3., 3.)
    return ([aside * b - off * a for a, b in zip(along, across)],
            rng.choice((1, 2, 5)))


def two_polygons(p, rng, name, mesh, comes=False):
    """Two polygons, each of facets of its own length."""
    counts = [int(rng.uniform(.7, 1.4) * (20, 30, 45)[mesh]) for _ in range(2)]
    radii = [rng.uniform(0.5, 2.) for _ in range(2)]
    angle = rng.uniform(0., 2. * math.pi)
    along = (math.cos(angle), math.sin(angle))
    first = polygon(counts[0], radii[0], (0., 0.), rng.uniform(0., 7.))
    turned = rng.uniform(0., 7.)

    def second(way):
        return polygon(counts[1], radii[1], [way * a for a in along], turned)

    facet = max(2. * r * math.sin(math.pi / n) for r, n in zip(radii, counts))
    clearance = facet * 10.**rng.uniform(-6., -1.)
    way = move_apart(lambda way: between(first, second(way)), clearance,
                     1.5 * sum(radii))
    come, steps = (coming(rng, along, (-along[1], along[0]), facet) if comes
                   else ((0., 0.), 1))
    at = [way * a - c for a, c in zip(along, come)]
    p.write(f"{name}-a2.inp", ring(first, (0., 0.)))
    p.write(f"{name}-b2.inp", ring(
        [(x - come[0], y - come[1]) for x, y in second(way)], at))
    return scene(p, f"{name}.prm", 2,
                 [body(1, f"{name}-a2.inp"), body(2, f"{name}-b2.inp", come)],
                 ["Secondary = 1: 3", "Primary = 2: 3"],
                 steps=steps), clearance / facet


def polygon_and_disc(p, rng, name, mesh):
    """A polygon and a rigid disc."""
    n = int(rng.uniform(.7, 1.4) * (20, 30, 45)[mesh])
    radius, size = rng.uniform(0.3, 3.), rng.uniform(0.5, 2.)
    angle = rng.uniform(0., 2. * math.pi)
    corners = polygon(n, size, (0., 0.), rng.uniform(0., 7.))
    facet = 2. * size * math.sin(math.pi / n)
    clearance = facet * 10.**rng.uniform(-6., -1.)
    centre = lambda way: (way * math.cos(angle), way * math.sin(angle))
    way = move_apart(lambda way: min(to_segment(centre(way), a, b) for a, b
                                     in edges(corners)) - radius,
                     clearance, 1.5 * (size + radius))
    p.write(f"{name}-a2.inp", ring(corners, (0., 0.)))
    x, y = centre(way)
    disc = section("Obstacle 1", "Kind = sphere",
                   f"Centre = {x:.17g}, {y:.17g}", f"Radius = {radius:.17g}")
    return scene(p, f"{name}.prm", 2, [body(1, f"{name}-a2.inp"), disc],
                 ["Secondary = 1: 3", "Obstacle = 1"], 1), clearance / facet


def ball_and_block(p, rng, name, mesh, comes=False):
    """A turned ball of flat-sided facets above a block: no point of it is lower
    than its lowest corner."""
    n, cells = (3, 4, 6)[mesh], (5, 9, 13)[mesh]
    facet = 3. / cells
    clearance = facet * 10.**rng.uniform(-6., -1.)
    nodes, items = shell(n, rotation(rng))
    shift = (rng.uniform(-.5, .5), rng.uniform(-.5, .5),
             clearance - min(x[2] for x in nodes))
    come, steps = (coming(rng, (0., 0., 1.), (0.6, 0.8, 0.), facet) if comes
                   else ((0., 0., 0.), 1))
    p.write(f"{name}-b3.inp", ucd(
        [[x + s - c for x, s, c in zip(node, shift, come)]
         for node in nodes], items))
    return scene(p, f"{name}.prm", 3, [
        block(1, f"{cells}, {cells}, 2 : -1.5, -1.5, -0.5 : 1.5, 1.5, 0 : true",
              "4: 0, 0, 0"), body(2, f"{name}-b3.inp", come)],
        ["Secondary = 1: 5", "Primary = 2: 3"],
        steps=steps), clearance / facet


def sphere_and_block(p, rng, name, mesh):
    """A rigid ball above a turned block."""
    cells = (5, 9, 13)[mesh]
    facet, radius = 3. / cells, rng.uniform(0.3, 5.)
    clearance = facet * 10.**rng.uniform(-6., -1.)
    turn = rng.uniform(-180., 180.)
    c, s = math.cos(math.radians(turn)), math.sin(math.radians(turn))
    x, y, z = (rng.uniform(-.5, .5), rng.uniform(-.5, .5), radius + clearance)
    ball = section("Obstacle 1", "Kind = sphere", f"Radius = {radius:.17g}",
                   f"Centre = {x:.17g}, {c * y - s * z:.17g}, "
                   f"{s * y + c * z:.17g}")
    return scene(p, f"{name}.prm", 3, [
        block(1, f"{cells}, {cells}, 2 : -1.5, -1.5, -0.5 : 1.5, 1.5, 0 : true",
              "4: 0, 0, 0", f"Rotate = {turn:.17g}, 0, 0"), ball],
        ["Secondary = 1: 5", "Obstacle = 1"], 1), clearance / facet


KINDS = (two_polygons, ball_and_block, polygon_and_disc, sphere_and_block)


def make(p, seed):
    """Scene number seed: its file, its kind, and how far apart the two are,
    divided by the length of a facet. p.write(name, text) writes files."""
    kind = KINDS[seed % len(KINDS)]
    mesh = seed // len(KINDS) % 3
    file, clearance = kind(p, random.Random(seed), f"apart-{seed}", mesh)
    return file, kind.__name__, clearance


def make_coming(p, seed):
    """The same of two bodies one of which comes there, by a translation that
    moves all of it."""
    kind = KINDS[seed % 2]
    mesh = seed // 2 % 3
    file, clearance = kind(p, random.Random(seed), f"coming-{seed}", mesh, True)
    return file, kind.__name__, clearance


LARGE = {"small strain": ["Method/Contact geometry=current"],
         "large strain": ["Body 1/Material=neo-hooke",
                          "Body 2/Material=neo-hooke"]}
