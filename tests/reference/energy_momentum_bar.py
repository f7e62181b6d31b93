#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""A bar flies against a wall of springs: discrete values of the scheme that
keeps the energy with that of the springs.

    energy_momentum_bar.py [tests/scenes/dynamics-bar-on-a-wall.json]

prints them, or looks whether that file has them.

50 linear elements of length 0.2, stiffness 900, density 1, consistent mass; 5
away from the wall with velocity -10. With psi(g) = 1/2 eps min(0, g)^2, eps =
900 / 0.2, and the gap g = u_0 + 5,

    M (v+ - v) / dt + K (u + u+) / 2 = P e_0,     (v + v+) / 2 = (u+ - u) / dt,
    P (g+ - g) = psi(g) - psi(g+).

The force is found by bisection on the gap, with the answers of the bar to its
load and to a unit force. Nothing is shared with Abut.
"""
import json
import sys

N, H, STIFFNESS, DT, WALL, STEPS = 50, 0.2, 900.0, 1 / 150, 5.0, 300
EPS = STIFFNESS / H


def times(diagonal, above, x):
    """A symmetric tridiagonal matrix, equal inside, by a vector."""
    n = len(x)
    return [diagonal[i] * x[i] + (above * x[i - 1] if i else 0.0)
            + (above * x[i + 1] if i + 1 < n else 0.0) for i in range(n)]


def solve(diagonal, above, b):
    """Thomas' algorithm."""
    d, x = list(diagonal), list(b)
    for i in range(1, len(d)):
        part = above / d[i - 1]
        d[i] -= part * above
        x[i] -= part * x[i - 1]
    x[-1] /= d[-1]
    for i in range(len(d) - 2, -1, -1):
        x[i] = (x[i] - above * x[i + 1]) / d[i]
    return x


def psi(gap):
    return 0.5 * EPS * min(0.0, gap)**2


def spring(before, after):
    if abs(after - before) < 1e-9:
        return EPS * max(0.0, -(before + after) / 2)
    return (psi(before) - psi(after)) / (after - before)


def gap_at_end(before, free, softness):
    """Where gap = free + softness * spring(before, gap)."""
    low, high = free, max(free, 0.0, -before) + 1.0
    while spring(before, high) * softness + free > high:
        high += 1.0
    for _ in range(200):
        middle = 0.5 * (low + high)
        if free + softness * spring(before, middle) > middle:
            low = middle
        else:
            high = middle
    return 0.5 * (low + high)


def main():
    ends = [1 if i in (0, N) else 2 for i in range(N + 1)]
    mass, mass_above = [H / 3 * e for e in ends], H / 6
    stiff, stiff_above = [STIFFNESS / H * e for e in ends], -STIFFNESS / H
    tangent = [2 / DT**2 * m + k / 2 for m, k in zip(mass, stiff)]
    above = 2 / DT**2 * mass_above + stiff_above / 2
    answer = solve(tangent, above, [1.0] + [0.0] * N)
    u, v = [0.0] * (N + 1), [-10.0] * (N + 1)
    impulse, deepest, at_8 = 0.0, 0.0, 0.0
    for step in range(1, STEPS + 1):
        inertia = times(mass, mass_above,
                        [2 / DT**2 * a + 2 / DT * b for a, b in zip(u, v)])
        load = [a - 0.5 * b
                for a, b in zip(inertia, times(stiff, stiff_above, u))]
        free = solve(tangent, above, load)
        gap = gap_at_end(u[0] + WALL, free[0] + WALL, answer[0])
        force = (gap - free[0] - WALL) / answer[0]
        end = [a + force * b for a, b in zip(free, answer)]
        v = [2 * (a - b) / DT - c for a, b, c in zip(end, u, v)]
        u = end
        impulse += DT * force
        deepest = max(deepest, -gap)
        at_8 = force if step == 120 else at_8
    kinetic = 0.5 * sum(a * b for a, b in
                        zip(v, times(mass, mass_above, v)))
    strain = 0.5 * sum(a * b for a, b in
                       zip(u, times(stiff, stiff_above, u)))
    found = {"energy": kinetic + strain + psi(u[0] + WALL),
             "contact_impulse": impulse, "displacement": u[0],
             "force at 0.8": at_8}
    print(f"{found}, deepest {deepest}")
    if len(sys.argv) < 2:
        return
    with open(sys.argv[1]) as file:
        case = next(case for case in json.load(file)["cases"]
                    if case["set"].get("Time stepping/Scheme") == "energy momentum")
    given = {key: case["summary"][key]["value"] for key in found
             if key in case["summary"]}
    given["force at 0.8"] = case["tables"]["levels.csv"]["columns"][
        "force_height"]["value"][0]
    for key, value in found.items():
        if abs(given[key] - value) > 2e-9 * abs(value):
            raise SystemExit(f"{key}: {value}, the file has {given[key]}")


main()
