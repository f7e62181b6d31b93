# SPDX-License-Identifier: LGPL-2.1-or-later
"""Errors of an answer: the same figures for every program.

An answer has `displacements` [body][node][3], `pressure` {node of the
secondary body: value} and `force` (on the modelled quarter).
"""
import math

import hexmesh
import problems

# Pressed blocks, from reference.py: good to 2e-4, 2e-4 and 1e-4.
PRESSED = {"compliance": 0.60825, "opening": 0.18868, "pressure": 0.88552}


def hertz(problem, answer):
    """Relative errors of force, largest pressure and contact radius.

    The radius is that of a circle with the area of the nodes under more than
    a twentieth of the largest pressure (where Hertz has 0.9987 of the radius).
    """
    radius, force, largest = problems.hertz_numbers()
    body, face = problem["contact"]["secondary"]
    areas = hexmesh.nodal_areas(problem["bodies"][body], face)
    area = 4 * sum(areas[node] for node, value in answer["pressure"].items()
                   if value > 0.05 * largest and node in areas)
    return {"force error": 4 * answer["force"] / force - 1,
            "largest pressure error":
                max(answer["pressure"].values()) / largest - 1,
            "radius error": math.sqrt(area / math.pi) / radius - 1}


def uniform_blocks(problem, answer):
    """Largest errors of displacement and pressure, relative."""
    young, poisson = problem["young"], problem["poisson"]
    worst = 0.0
    for body, moved in zip(problem["bodies"], answer["displacements"]):
        for (x, y, z), u in zip(body["nodes"], moved):
            exact = (poisson * x / young, poisson * y / young,
                     -(z + 0.5) / young)
            worst = max(worst, *(abs(a - b) for a, b in zip(u, exact)))
    return {"displacement error": worst * young,
            "pressure error": max(abs(value - 1) for value in
                                  answer["pressure"].values())}


def pressed_numbers(problem, answer):
    """Mean sinking of the loaded part, opening of the corner (1, 1), both
    times E, and pressure in the middle."""
    upper, lower = problem["bodies"]
    areas = hexmesh.nodal_areas(upper, "loaded")
    sinking = -sum(area * answer["displacements"][0][node][2]
                   for node, area in areas.items()) / sum(areas.values())

    def corner(body):
        return max(hexmesh.face_nodes(
            problem["bodies"][body], ["zmin", "zmax"][body]),
            key=lambda n: sum(problem["bodies"][body]["nodes"][n][:2]))

    opening = (answer["displacements"][0][corner(0)][2]
               - answer["displacements"][1][corner(1)][2])
    return {"compliance": sinking * problem["young"],
            "opening": opening * problem["young"],
            "pressure": answer["pressure"].get(0, 0.0)}


def pressed_blocks(problem, answer):
    """Relative errors of those numbers."""
    return {f"{name} error": value / PRESSED[name] - 1
            for name, value in pressed_numbers(problem, answer).items()}


def errors(problem, answer):
    return {"hertz": hertz, "uniform blocks": uniform_blocks,
            "pressed blocks": pressed_blocks}[problem["name"]](problem,
                                                               answer)
