# SPDX-License-Identifier: LGPL-2.1-or-later
"""The problems, as data that each program's writer turns into its input.

A problem: `bodies` (see hexmesh), `young`, `poisson`, `supports` [{body, face,
components, values}] with values as expressions of x, y, z (functions of
Python's math), `loads` [{body, face, pressure}], `contact` {secondary: [body,
face], primary: [body, face] or None for the rigid plane z = 0}, perhaps
`coarse`: bodies whose cells, bisected `levels` times, are the same but for a
hundredth of a cell, with `sphere`: the faces that lie on one, `size`: facet
size in contact, `pressure`: the largest pressure expected, and what figures.py
needs to judge the answers.
"""
import math

import hexmesh

# Hertz's half-space neglects what is of the order of a / R; with a / R = 0.003
# that is 0.1 % of the force, with 0.03 it would be 1 %.
RADIUS, YOUNG, POISSON, APPROACH = 100.0, 1e5, 0.3, 1e-3


def hertz_numbers():
    """Contact radius, force and largest pressure by Hertz."""
    stiffness = YOUNG / (1 - POISSON ** 2)
    radius = math.sqrt(APPROACH * RADIUS)
    force = 4 / 3 * stiffness * math.sqrt(RADIUS) * APPROACH ** 1.5
    return radius, force, 1.5 * force / (math.pi * radius ** 2)


def far_field():
    """Displacements far from the contact: Boussinesq's for Hertz's force,
    pushed down by the approach."""
    force = hertz_numbers()[1]
    factor = force / (4 * math.pi * YOUNG / (2 * (1 + POISSON)))
    rho = "sqrt(x*x+y*y+z*z)"
    radial = (f"{factor!r}*(z/({rho}*{rho}*{rho})"
              f"-{1 - 2 * POISSON!r}/({rho}*({rho}+z)))")
    down = (f"{factor!r}*(z*z/({rho}*{rho}*{rho})+{2 - 2 * POISSON!r}/{rho})"
            f"-{APPROACH!r}")
    return [f"x*{radial}", f"y*{radial}", down]


def _lower(x, y):
    """Height of the sphere."""
    return RADIUS - math.sqrt(RADIUS ** 2 - x * x - y * y)


def _cap(nodes, reach):
    """A body with its contact face within `reach`."""
    body = hexmesh.block(nodes)
    hexmesh.split_face(body, "zmin", "contact",
                       lambda x, y, z: max(x, y) < reach)
    return body


def hertz(across, up, levels, width=12.0):
    """A quarter of a sphere's lowest part on the rigid plane z = 0.

    So many cells across and up, nearly half of them within 1.25 contact radii;
    the body is `width` contact radii wide. They are those of a coarse mesh
    bisected `levels` times: whoever refines meshes, as Abut does, may start
    from that one (`coarse`). On its outer faces the displacements are
    prescribed that the half-space has there.
    """
    a, force, p0 = hertz_numbers()
    length = width * a
    axes, fine = [], []
    for cells in (across, up):
        cells //= 2 ** levels
        fine.append(max(2, round(0.45 * cells)))
        axes.append(hexmesh.graded(1.25 * a, fine[-1], length, cells))
    reach = next(x for x in axes[0] if x >= 2.5 * a)
    nodes = hexmesh.grid(
        axes[0], axes[0], axes[1], lambda x, y, z:
        (x, y, _lower(x, y) + (length - _lower(x, y)) * z / length))
    coarse = _cap(nodes, reach)
    for _ in range(levels):
        nodes = hexmesh.bisected(nodes)
        nodes[0] = [[[x, y, _lower(x, y)] for x, y, _ in row]
                    for row in nodes[0]]
    outside = far_field()
    supports = [{"body": 0, "face": "xmin", "components": [0],
                 "values": ["0"]},
                {"body": 0, "face": "ymin", "components": [1],
                 "values": ["0"]}]
    supports += [{"body": 0, "face": face, "components": [0, 1, 2],
                  "values": outside} for face in ("xmax", "ymax", "zmax")]
    return {"name": "hertz", "bodies": [_cap(nodes, reach)],
            "young": YOUNG, "poisson": POISSON, "supports": supports,
            "loads": [],
            "contact": {"secondary": [0, "contact"], "primary": None},
            "size": 1.25 * a / (fine[0] * 2 ** levels), "pressure": p0,
            "force": force / 4, "levels": levels, "coarse": [coarse],
            "sphere": {"faces": ["zmin", "contact"],
                       "centre": [0.0, 0.0, RADIUS]}}


def _two_blocks(upper, lower):
    """Blocks 1 x 1 x 1/2 one on the other, their grids not matching; the
    planes x = 0 and y = 0 are planes of symmetry."""
    def cube(cells, bottom):
        axis = hexmesh.uniform(0, 1, cells)
        return hexmesh.block(hexmesh.grid(axis, axis, hexmesh.uniform(
            bottom, bottom + 0.5, cells // 2)))
    supports = []
    for body in (0, 1):
        for component, face in enumerate(("xmin", "ymin")):
            supports.append({"body": body, "face": face,
                             "components": [component], "values": ["0"]})
    return {"bodies": [cube(upper, 0.0), cube(lower, -0.5)], "young": 1e5,
            "poisson": 0.3, "supports": supports,
            "contact": {"secondary": [0, "zmin"], "primary": [1, "zmax"]},
            "size": 1 / upper}


def uniform_blocks(upper, lower):
    """Pressure 1 on the whole top: uniform stress is the exact solution."""
    problem = _two_blocks(upper, lower)
    problem["supports"].append({"body": 1, "face": "zmin", "components": [2],
                                "values": ["0"]})
    problem.update(name="uniform blocks", pressure=1.0, loads=[
        {"body": 0, "face": "zmax", "pressure": 1.0}])
    return problem


def pressed_blocks(upper, lower):
    """Pressure 1 on the middle quarter of the top, the lower block clamped:
    the upper block bends and lifts off outside."""
    problem = _two_blocks(upper, lower)
    hexmesh.split_face(problem["bodies"][0], "zmax", "loaded",
                       lambda x, y, z: x < 0.5 and y < 0.5)
    problem["supports"].append({"body": 1, "face": "zmin",
                                "components": [0, 1, 2],
                                "values": ["0", "0", "0"]})
    problem.update(name="pressed blocks", pressure=1.0, loads=[
        {"body": 0, "face": "loaded", "pressure": 1.0}])
    return problem


SIZES = {"hertz": [(8, 8, 0), (16, 16, 1), (28, 24, 2)],
         "uniform blocks": [(8, 10), (16, 20), (22, 28)],
         "pressed blocks": [(8, 10), (16, 20), (22, 28)]}


def make(name, size):
    """The problem `name` with SIZES[name][size]."""
    maker = {"hertz": hertz, "uniform blocks": uniform_blocks,
             "pressed blocks": pressed_blocks}[name]
    return maker(*SIZES[name][size])


def unknowns(problem):
    """Displacement unknowns of the deformable bodies, supports included."""
    return 3 * sum(len(body["nodes"]) for body in problem["bodies"])


def value(expression, point):
    """An expression of x, y, z at a point."""
    names = dict(vars(math), x=point[0], y=point[1], z=point[2])
    return eval(expression, {"__builtins__": {}}, names)
