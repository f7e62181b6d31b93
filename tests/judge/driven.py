# SPDX-License-Identifier: LGPL-2.1-or-later
"""Judges rigid obstacles that forces move: the balance of forces on them, and in
time the momentum that each step gives them."""
import math

from formula import Formula, split
from thresholds import THRESHOLDS
from vectors import dot


def driven(scene):
    """Numbers of these obstacles, with their free directions."""
    for number in range(1, int(scene.get("Solid/Obstacles", "0")) + 1):
        free = scene.get(f"Obstacle {number}/Free directions")
        if free:
            yield number, sorted("xyz".index(d.strip())
                                 for d in free.split(","))


def driven_work(solid):
    """Work of the forces on them, which contact balances."""
    return -math.fsum(dot(solid.summary[f"obstacle_{number}_force"],
                          solid.summary[f"obstacle_{number}_displacement"])
                      for number, _ in driven(solid.scene))


def _values(scene, name, dim, time):
    values = [Formula(part)((0., 0., 0.), time)
              for part in split(scene.get(name), ",")]
    return values or [0.] * dim


def _outer(solid, number, time):
    """Force and weight of an obstacle."""
    mass = solid.scene.number(f"Obstacle {number}/Mass", 0.)
    force = _values(solid.scene, f"Obstacle {number}/Force", solid.dim, time)
    gravity = _values(solid.scene, "Solid/Gravity", solid.dim, time)
    return [f + mass * g for f, g in zip(force, gravity)]


def judge_driven_balance(solid):
    """In equilibrium: force, weight and contact."""
    for number, free in driven(solid.scene):
        outer = _outer(solid, number, solid.time)
        contact = solid.summary[f"obstacle_{number}_force"]
        limit = THRESHOLDS["obstacle"]
        for d in free:
            solid.findings.check(
                f"balance of Obstacle {number}, {'xyz'[d]}",
                abs(outer[d] + contact[d]),
                limit.value * max(map(abs, contact)), limit.reason)


def judge_driven_motion(judge, gammas):
    """In time: the momentum that a step gives them. @p gammas: weight of the
    forces at its end, by the name of the scheme."""
    solid, scene, rows = judge.solid, judge.scene, judge.rows
    obstacles = list(driven(scene))
    if not obstacles:
        return
    texts = [scene.get("Solid/Gravity")] + [
        scene.get(f"Obstacle {n}/Force") for n, _ in obstacles]
    scheme = scene.get("Time stepping/Scheme")
    if scheme not in gammas or any("t" in text for text in texts):
        solid.findings.leave("momentum of obstacles", "forces change, or the "
                             "scheme weights accelerations")
        return
    gamma = gammas[scheme](
        lambda name, default: scene.number(f"Time stepping/{name}", default))
    worst = size = 0.
    for number, free in obstacles:
        mass = scene.number(f"Obstacle {number}/Mass", 0.)
        outer = _outer(solid, number, 0.)
        for d in free:
            force = f"obstacle_{number}_force_{'xyz'[d]}"
            velocity = f"obstacle_{number}_velocity_{'xyz'[d]}"
            for before, now in zip(rows, rows[1:]):
                step = now["time"] - before["time"]
                push = step * math.fsum([(1 - gamma) * before[force],
                                         gamma * now[force], outer[d]])
                gained = mass * (now[velocity] - before[velocity])
                if mass > 0.:
                    worst = max(worst, abs(gained - push))
                size = max(size, abs(push), abs(mass * now[velocity]))
    limit = THRESHOLDS["momentum"]
    solid.findings.check("momentum of obstacles", worst, limit.value * size,
                         limit.reason)
