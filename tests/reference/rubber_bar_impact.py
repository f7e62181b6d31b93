#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""A rubber bar flies against a wall: discrete values of time schemes at large
strain.

    rubber_bar_impact.py [tests/scenes/rubber-bar-impact.json]

prints them, or looks whether that file has them.

A chain of 50 linear elements of length 0.2, density 1 and energy per length
mu/2 (s^2 - 1 - 2 ln s) at stretch s, mu = 450: neo-Hooke's bar with Poisson
ratio 0, which stays as thick as it is. It starts 5 away from the wall with
velocity -10. With x(al) = (1 - al) x_new + al x_old,

    M a(alpha_m) + F(u(alpha_f)) = lam e_0,    0 <= lam _|_ u_0 + 5 >= 0,

Newmark's formulas with beta and gamma; where mass is modified node 0 has none,
its neighbour has it, and v_0 is the difference of displacements. Each step is
solved by Newton's method to round-off. Nothing is shared with Abut: these are
the figures of tests/scenes/rubber-bar-impact.json.
"""
import json
import math
import sys

N, H, MU, DT, WALL = 50, 0.2, 450.0, 1 / 150, -5.0


def force(u):
    """Internal forces and their tridiagonal derivative (diagonal, above)."""
    f, diagonal, above = [0.0] * (N + 1), [0.0] * (N + 1), [0.0] * N
    for e in range(N):
        s = 1 + (u[e + 1] - u[e]) / H
        stress, slope = MU * (s - 1 / s), MU * (1 + 1 / s**2) / H
        f[e] -= stress
        f[e + 1] += stress
        diagonal[e] += slope
        diagonal[e + 1] += slope
        above[e] -= slope
    return f, diagonal, above


def stored(u):
    stretches = [1 + (u[e + 1] - u[e]) / H for e in range(N)]
    return sum(H * MU / 2 * (s * s - 1 - 2 * math.log(s)) for s in stretches)


def mass(kind):
    """Diagonal and upper diagonal."""
    diagonal, above = [0.0] * (N + 1), [0.0] * N
    for e in range(N):
        if kind == "lumped":
            block = (H / 2, H / 2, 0.0)
        elif kind == "modified" and e == 0:
            block = (0.0, H, 0.0)
        else:
            block = (H / 3, H / 3, H / 6)
        diagonal[e] += block[0]
        diagonal[e + 1] += block[1]
        above[e] += block[2]
    return diagonal, above


def times(matrix, x):
    diagonal, above = matrix
    y = [d * v for d, v in zip(diagonal, x)]
    for i, b in enumerate(above):
        y[i] += b * x[i + 1]
        y[i + 1] += b * x[i]
    return y


def solve(diagonal, above, right):
    """Symmetric tridiagonal system."""
    d, r = list(diagonal), list(right)
    for i in range(1, len(d)):
        factor = above[i - 1] / d[i - 1]
        d[i] -= factor * above[i - 1]
        r[i] -= factor * r[i - 1]
    x = [0.0] * len(d)
    x[-1] = r[-1] / d[-1]
    for i in range(len(d) - 2, -1, -1):
        x[i] = (r[i] - above[i] * x[i + 1]) / d[i]
    return x


def newton(residual, u):
    """The answer with the wall, and its force: node 0 held or free."""
    def run(held, start):
        x = list(start)
        for _ in range(60):
            r, d, b = residual(x)
            if held:
                x[0], r0, r[0], d[0], b[0] = WALL, r[0], 0.0, 1.0, 0.0
            step = solve(d, b, [-v for v in r])
            x = [p + q for p, q in zip(x, step)]
            if max(map(abs, step)) < 1e-14:
                break
        return x, (residual(x)[0][0] if held else 0.0)
    first = list(u)
    x, lam = run(False, first)
    if x[0] >= WALL:
        return x, 0.0
    first[0] = WALL
    x, lam = run(True, first)
    assert lam >= 0
    return x, lam


def motion(alpha_f, beta, gamma, kind, steps, dt=DT, projects=False):
    """Balance of energy by that of the start, impulse, displacement of node 0
    in the end, largest force, and the steps of first and last contact."""
    m = mass(kind)
    massless = kind == "modified"
    u, v, a = [0.0] * (N + 1), [-10.0] * (N + 1), [0.0] * (N + 1)
    if massless:
        a[0] = 0.0
    impulse, highest, touched = 0.0, 0.0, []
    for number in range(1, steps + 1):
        lam = 0.0
        guess = [p + dt * q + dt * dt * (0.5 - beta) * r
                 for p, q, r in zip(u, v, a)]
        start = list(v)
        if projects and guess[0] < WALL:
            # nearest in M with node 0 on the wall
            way = WALL - guess[0]
            d, b = list(m[0]), list(m[1])
            right = [0.0] * (N + 1)
            right[0], right[1] = way, -b[0] * way
            d[0], b[0] = 1.0, 0.0
            shift = solve(d, b, right)
            lam += times(m, shift)[0] / dt**2
            start = [q + s / dt for q, s in zip(v, shift)]
            guess = [p + s for p, s in zip(guess, shift)]
        if beta == 0:
            new = guess
            f = force(new)[0]
            acceleration = [-q / w for q, w in zip(f, m[0])]
        else:
            def residual(x):
                at = [(1 - alpha_f) * p + alpha_f * q for p, q in zip(x, u)]
                f, d, b = force(at)
                scale = 1 / (beta * dt * dt)
                inertia = times(m, [(p - q) * scale
                                    for p, q in zip(x, guess)])
                return ([p + q for p, q in zip(f, inertia)],
                        [(1 - alpha_f) * p + scale * q
                         for p, q in zip(d, m[0])],
                        [(1 - alpha_f) * p + scale * q
                         for p, q in zip(b, m[1])])
            new, pressed = newton(residual, guess)
            lam += pressed
            acceleration = [(p - q) / (beta * dt * dt)
                            for p, q in zip(new, guess)]
        speed = [q + dt * ((1 - gamma) * old + gamma * now)
                 for q, old, now in zip(start, a, acceleration)]
        if massless:
            speed[0], acceleration[0] = (new[0] - u[0]) / dt, 0.0
        u, v, a = new, speed, acceleration
        impulse += dt * lam
        highest = max(highest, lam)
        if lam > 0:
            touched.append(number)
    energy = sum(p * q for p, q in zip(v, times(m, v))) / 2 + stored(u)
    return {"balance": energy, "impulse": impulse, "u_0": u[0],
            "largest force": highest, "contact": (touched[0], touched[-1])}


def main():
    al = -0.1
    hht = (-al, (1 - al)**2 / 4, 0.5 - al)
    for name, given in (
            ("hht", (*hht, "modified", 300)),
            ("trapezoid", (0.0, 0.25, 0.5, "modified", 300)),
            ("midpoint", (0.5, 0.5, 1.0, "modified", 300)),
            ("hht, consistent", (*hht, "consistent", 300)),
            ("contact stabilised", (0.5, 0.5, 1.0, "consistent", 300, DT,
                                    True)),
            ("central difference with projection",
             (0.0, 0.0, 0.5, "lumped", 1200, DT / 4, True))):
        values = motion(*given)
        if len(sys.argv) < 2:
            print(name, values)
            continue
        with open(sys.argv[1], encoding="utf-8") as file:
            case, = (c for c in json.load(file)["cases"] if c["name"] == name)
        wanted = case["summary"]
        for mine, given in ((values["balance"], wanted["balance"]["value"]),
                            (values["impulse"],
                             wanted["pair_1_impulse"]["value"][0]),
                            (values["u_0"], wanted["point_1"]["value"][0])):
            if abs(mine - given) > 1e-9 * abs(mine):
                sys.exit(f"{name}: {mine} here, {given} in the file")


if __name__ == "__main__":
    main()
