# SPDX-License-Identifier: LGPL-2.1-or-later
"""Materials of elastic bodies: stored energy, its derivatives, nodal forces."""
import math

from elements import derivative, gauss, slopes
from vectors import add, cross, dot, invert
from verdict import Wrong


def body_law(scene, body):
    return scene.get(f"Body {body}/Material", "hooke")


def has_mean_dilatation(scene, body):
    return scene.get(f"Body {body}/Element") == "mean dilatation"


def deformation(gradient, hoop, x):
    """With the third direction, and by how much it changes volumes."""
    dim = len(gradient)
    f = [[(gradient[i][j] if i < dim and j < dim else 0.) + (i == j)
          for j in range(3)] for i in range(3)]
    if dim == 2:
        f[2][2] += hoop
    det = dot(f[0], cross(f[1], f[2]))
    if det <= 0:
        raise Wrong(f"a body is turned inside out at {x}")
    return f, det


def large_strain_energy(law, gradient, hoop, lame, mu, x):
    """Per undeformed volume, of neo-Hooke's or St. Venant and Kirchhoff's
    material."""
    f, det = deformation(gradient, hoop, x)
    right = [[sum(f[k][i] * f[k][j] for k in range(3)) for j in range(3)]
             for i in range(3)]
    trace = sum(right[i][i] for i in range(3))
    if law == "neo-hooke":
        return (mu / 2 * (trace - 3 - 2 * math.log(det))
                + lame / 2 * math.log(det)**2)
    green = [[(right[i][j] - (i == j)) / 2 for j in range(3)]
             for i in range(3)]
    return (lame / 8 * (trace - 3)**2
            + mu * sum(e * e for row in green for e in row))


def large_strain_stress(law, gradient, lame, mu):
    """The derivative of that energy by the gradient, in the plane (of strain)
    or in space."""
    dim = len(gradient)
    f = [[(gradient[i][j] if i < dim and j < dim else 0.) + (i == j)
          for j in range(3)] for i in range(3)]
    if law == "neo-hooke":
        inverse, det = invert(f)
        factor = lame * math.log(det) - mu
        return [[mu * f[i][j] + factor * inverse[j][i] for j in range(dim)]
                for i in range(dim)]
    green = [[(sum(f[k][i] * f[k][j] for k in range(3)) - (i == j)) / 2
              for j in range(3)] for i in range(3)]
    trace = sum(green[i][i] for i in range(3))
    second = [[2 * mu * green[i][j] + lame * trace * (i == j)
               for j in range(3)] for i in range(3)]
    return [[sum(f[i][k] * second[k][j] for k in range(3))
             for j in range(dim)] for i in range(dim)]


def small_strain_stress(gradient, lame, mu):
    dim = len(gradient)
    trace = sum(gradient[i][i] for i in range(dim))
    return [[mu * (gradient[i][j] + gradient[j][i]) + lame * trace * (i == j)
             for j in range(dim)] for i in range(dim)]


def moduli(judge):
    """Lame's numbers by body."""
    material = {}
    for body in range(1, judge.n_bodies + 1):
        young = judge.scene.number(f"Body {body}/Young modulus", 1.)
        ratio = judge.scene.number(f"Body {body}/Poisson ratio", 0.3)
        mu = young / (2 * (1 + ratio))
        lame = young * ratio / ((1 + ratio) * (1 - 2 * ratio))
        if judge.plane == "stress" and judge.dim == 2:
            lame = 2 * lame * mu / (lame + 2 * mu)
        material[body] = lame, mu
    return material


def stress_at(judge, body, gradient, numbers):
    """By undeformed area."""
    if judge.large:
        return large_strain_stress(body_law(judge.scene, body), gradient,
                                   *numbers)
    return small_strain_stress(gradient, *numbers)


def points_of(judge, cell):
    """Of a cell at the points of a rule: undeformed volume, gradient of the
    displacement, slopes of the shape functions."""
    points = [judge.nodes.place[i] for i in cell.nodes]
    values = [judge.u[i] for i in cell.nodes]
    for place, weight in gauss(judge.dim, judge.degree + 1):
        _, inverse, dx = judge.at(cell, points, place)
        columns = tuple(zip(*inverse))
        directions = slopes(judge.dim, cell.degree, place)
        gradient = [[dot(row, column) for column in columns]
                    for row in derivative(directions, values)]
        yield dx * weight, gradient, [[dot(slope, column) for column in columns]
                                      for slope in zip(*directions)]


def volume_stress(judge, gradient, pressure):
    """Of one pressure in a cell: the derivative of the present volume."""
    dim = judge.dim
    if not judge.large:
        return [[pressure * (i == j) for j in range(dim)] for i in range(dim)]
    f, det = deformation(gradient, 0., "")
    inverse, _ = invert(f)
    return [[pressure * det * inverse[j][i] for j in range(dim)]
            for i in range(dim)]


def mean_pressure(judge, points, lame):
    """Of the energy of a cell's mean change of volume, by present volume."""
    volume = growth = 0.
    for dx, gradient, _ in points:
        volume += dx
        growth += dx * (deformation(gradient, 0., "")[1] - 1. if judge.large
                        else sum(gradient[i][i] for i in range(judge.dim)))
    growth /= volume
    return (lame * math.log1p(growth) / (1. + growth) if judge.large
            else lame * growth)


def material_forces(judge, wanted):
    """The derivative of the stored energy by the displacements of some nodes,
    not of bodies of revolution."""
    forces = {i: (0.,) * judge.dim for i in wanted}
    material = moduli(judge) if wanted else {}
    for cell in judge.fields.cells:
        if not any(i in forces for i in cell.nodes):
            continue
        lame, mu = material[cell.body]
        points = list(points_of(judge, cell))
        pressure = 0.
        if has_mean_dilatation(judge.scene, cell.body):
            pressure, lame = mean_pressure(judge, points, lame), 0.
        for dx, gradient, shape_slopes in points:
            stress = stress_at(judge, cell.body, gradient, (lame, mu))
            if pressure:
                stress = [add(a, b) for a, b in zip(
                    stress, volume_stress(judge, gradient, pressure))]
            for i, slope in zip(cell.nodes, shape_slopes):
                if i in forces:
                    forces[i] = add(forces[i],
                                    [dot(row, slope) for row in stress], dx)
    return forces
