#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""The drawings of the theory pages and two curves from runs: pressures of the patch
test, and the flight of a bouncing ball.

    tests/bench/theory_pictures.py build/release/abut [--folder doc/pictures]"""
import numpy
from matplotlib import patches

import pictures
from pictures import arrow, bare, run, style


def hatched(axes, x, y):
    """A clamped straight side."""
    axes.plot(x, y, color=style.BLACK, linewidth=1.2)
    for s in numpy.linspace(0, 1, 12):
        at = numpy.array([x[0] + s * (x[1] - x[0]), y[0] + s * (y[1] - y[0])])
        axes.plot([at[0], at[0] - 0.12], [at[1], at[1] - 0.16],
                  color=style.BLACK, linewidth=0.5)


def draw_contact(folder):
    figure, axes = style.figure(style.PAGE, 0.36, 1, 2)
    bodies, laws = axes.flat
    bare(bodies, (-2.6, 2.8), (-2.2, 2.6))
    angle = numpy.linspace(0, 2 * numpy.pi, 200)
    upper = numpy.array([1.7 * numpy.cos(angle), 1.25 + 1.0 * numpy.sin(angle)])
    bodies.fill(*upper, facecolor=style.SKY, alpha=0.35, edgecolor=style.BLUE)
    x = numpy.linspace(-2.3, 2.3, 100)
    lower = -0.15 - 0.12 * x ** 2
    bodies.fill_between(x, -1.8, lower, facecolor=style.ORANGE, alpha=0.25,
                        linewidth=0)
    bodies.plot([-2.3, *x, 2.3], [-1.8, *lower, -1.8], color=style.ORANGE)
    hatched(bodies, (-2.3, 2.3), (-1.8, -1.8))
    bottom = (angle > 1.25 * numpy.pi) & (angle < 1.75 * numpy.pi)
    bodies.plot(*upper[:, bottom], color=style.BLUE, linewidth=2.5)
    bodies.plot(x[25:75], lower[25:75], color=style.VERMILION, linewidth=2.5)
    for at in (-0.6, -0.2, 0.2, 0.6):
        arrow(bodies, (at, 2.6), (at, 2.24))
    bodies.text(0.9, 2.35, r"$\bar t$ on $\Gamma_t$")
    bodies.text(-0.2, 1.3, r"$\Omega^1$, secondary", ha="center")
    bodies.text(0, -1.3, r"$\Omega^2$, primary", ha="center")
    bodies.text(2.35, -1.75, r"$\Gamma_u$")
    s = upper[:, numpy.argmin(abs(angle - 1.62 * numpy.pi))]
    m = numpy.array([s[0] + 0.06, -0.15 - 0.12 * (s[0] + 0.06) ** 2])
    bodies.plot(*s, "o", color=style.BLACK)
    bodies.plot(*m, "o", color=style.BLACK)
    bodies.text(*(s + [0.1, 0.1]), "$x_s$")
    bodies.text(*(m + [-0.42, -0.4]), "$x_m$")
    arrow(bodies, s, s + [0.2, -0.95])
    bodies.text(*(s + [0.3, -0.75]), "$n$")
    arrow(bodies, (-0.9, 0.42), (-0.9, -0.25), style.GREY, "<->")
    bodies.text(-1.2, 0.0, "$g$", color=style.GREY)
    gap = numpy.linspace(-0.8, 1.2, 600)
    with numpy.errstate(divide="ignore", invalid="ignore"):
        curves = {
            "exact": None,
            r"penalty $\epsilon\langle -g\rangle$": numpy.maximum(-1.6 * gap, 0),
            r"augmented $\langle\bar p - \epsilon g\rangle$":
                numpy.maximum(0.9 - 1.6 * gap, 0),
            r"barrier $\mu/g$": numpy.where(gap > 0, 0.06 / gap, numpy.nan)}
    for i, (name, pressure) in enumerate(curves.items()):
        if pressure is None:
            laws.plot([0, 0, 1.2], [2, 0, 0], color=style.BLACK, linewidth=2,
                      label=name)
        else:
            laws.plot(gap, pressure, label=name, **style.line_style(i - 1))
    laws.axvspan(-0.8, 0, color=style.PALE, linewidth=0, zorder=0)
    laws.set_xlim(-0.8, 1.2)
    laws.set_ylim(-0.1, 2)
    laws.set_xlabel("gap $g$")
    laws.set_ylabel("pressure $p$")
    laws.legend(loc="upper right")
    style.letters(axes.flat)
    style.save(figure, folder, "theory-contact")


def draw_points(folder):
    figure, axes = style.figure(style.PAGE, 0.2, 2, 2)
    secondary, primary = [0.0, 1.0, 2.0, 3.0], [-0.2, 0.55, 1.3, 2.05, 2.8, 3.3]
    for one, title in zip(axes.flat, ("node to segment", "quadrature point",
                                      "mortar: hat function",
                                      "dual mortar: dual function")):
        bare(one, (-0.4, 3.5), (-0.35, 1.35))
        one.set_title(title)
        one.plot(secondary, [0.3] * 4, color=style.BLUE, marker="|",
                 markersize=8, linewidth=2)
        one.plot(primary, [0] * 6, color=style.ORANGE, marker="|", markersize=8,
                 linewidth=2)
        cuts = sorted({*secondary, *(x for x in primary if 0 < x < 3)})
        if title.startswith("node"):
            for x in secondary:
                one.plot([x, x], [0.3, 0], color=style.GREY, linewidth=0.8,
                         linestyle="--")
                one.plot(x, 0.3, "o", color=style.VERMILION, markersize=5)
        else:
            for x in cuts:
                one.plot([x, x], [0.3, 0], color=style.GREY, linewidth=0.5)
        if title.startswith("quadrature"):
            for a, b in zip(cuts, cuts[1:]):
                for s in (-1, 1):
                    x = (a + b) / 2 + s * (b - a) / 2 / numpy.sqrt(3)
                    one.plot(x, 0.3, "o", color=style.VERMILION, markersize=3)
        elif "function" in title:
            x = numpy.linspace(0, 3, 301)
            here = numpy.clip(1 - abs(x - 1), 0, None)
            if title.startswith("dual"):
                s = abs(x - 1)
                here = numpy.where(s <= 1, 2 - 3 * s, 0)
            one.plot(x, 0.3 + 0.5 * here, color=style.VERMILION)
            one.fill_between(x, 0.3, 0.3 + 0.5 * here, color=style.VERMILION,
                             alpha=0.2, linewidth=0)
            one.text(1.35, 0.85, r"$\psi_j$", color=style.VERMILION)
    style.letters(axes.flat)
    style.save(figure, folder, "theory-points")


def draw_patch(abut, folder):
    figure, [[axes]] = style.figure(style.COLUMN, 0.62)
    for i, word in enumerate(("node to segment", "dual mortar")):
        table = run(abut, "patch-2d.prm", folder / "run",
                    f"Method/Discretisation={word}").table("pair_1.csv")
        axes.plot(table["arc"], table["pressure"], label=word,
                  **style.curve_style(i))
    axes.set_xlabel("arc length along the contact line")
    axes.set_ylabel("pressure (exact: 1)")
    style.legend(axes)
    style.save(figure, folder, "theory-patch-test")


def draw_friction(folder):
    figure, axes = style.figure(style.PAGE, 0.34, 1, 2)
    curve, disc = axes.flat
    curve.plot([-1.5, 0, 0, 1.5], [1, 1, -1, -1], color=style.BLACK, linewidth=2,
               label="Coulomb")
    slip = numpy.linspace(-1.5, 1.5, 300)
    curve.plot(slip, numpy.clip(-2.5 * slip, -1, 1), color=style.BLUE,
               linestyle="--", label="penalty in stick")
    curve.set_xlabel("slip $s$")
    curve.set_ylabel(r"traction $\tau/(\mu p)$")
    curve.legend(loc="upper right")
    bare(disc, (-2.4, 2.9), (-1.7, 1.8))
    disc.add_patch(patches.Circle((0, 0), 1, facecolor=style.SKY, alpha=0.35,
                                  edgecolor=style.BLUE))
    disc.plot(0, 0, ".", color=style.BLACK)
    arrow(disc, (0, 0), (-0.7, 0.714), style.BLUE)
    disc.text(-1.35, 0.85, r"$\rho = \mu p$", color=style.BLUE)
    arrow(disc, (0, 0), (0.35, -0.4))
    disc.text(0.4, -0.62, r"stick: $x$ inside")
    arrow(disc, (0, 0), (1.7, 0.95))
    disc.text(1.75, 0.95, "$x$")
    direction = numpy.array([1.7, 0.95]) / numpy.hypot(1.7, 0.95)
    arrow(disc, (0, 0), direction, style.VERMILION)
    disc.text(0.98, 0.22, r"slip: $\tau = \rho\,x/|x|$", color=style.VERMILION)
    disc.text(0, -1.55, r"$x = \tau - c\,s$ decides", ha="center")
    style.letters(axes.flat)
    style.save(figure, folder, "theory-friction")


def draw_mass(abut, folder):
    figure, axes = style.figure(style.PAGE, 0.36, 1, 2)
    sketch, flight = axes.flat
    bare(sketch, (-1.6, 2.6), (-2.5, 1.7))
    sketch.plot([-1, 1], [1.5, 1.5], color=style.BLACK, linewidth=1.2)
    y = numpy.linspace(1.5, 0.2, 200)
    wave = numpy.where((y > 0.4) & (y < 1.3),
                       0.22 * numpy.sin((y - 0.4) * 2 * numpy.pi / 0.15), 0)
    sketch.plot(wave, y, color=style.BLACK, linewidth=0.9)
    sketch.add_patch(patches.Rectangle((-0.45, -0.6), 0.9, 0.8,
                                       facecolor=style.SKY,
                                       edgecolor=style.BLUE))
    sketch.text(0, -0.2, "$m$", ha="center", va="center")
    sketch.text(0.4, 0.8, "$k$")
    hatched(sketch, (-1.2, 1.2), (-1.9, -1.9))
    arrow(sketch, (1.5, -0.6), (1.5, -1.9), style.GREY, "<->")
    sketch.text(1.65, -1.3, "$h$", color=style.GREY)
    arrow(sketch, (-1.3, -0.2), (-1.3, -0.9))
    sketch.text(-1.2, -0.6, "$u$")
    arrow(sketch, (0, -0.6), (0, -1.3), style.VERMILION)
    sketch.text(0.1, -1.2, "$mg$", color=style.VERMILION)
    table = run(abut, "dynamics-bouncing-ball.prm", folder / "run").table("levels.csv")
    name = next(key for key in table if key.startswith("u"))
    flight.plot(table["time"], 1 + table[name], color=style.BLUE)
    flight.set_xlabel("time")
    flight.set_ylabel("gap of the ball")
    flight.set_ylim(0, None)
    style.letters(axes.flat)
    style.save(figure, folder, "lecture-mass")


def draw(abut, folder):
    for each in (draw_contact, draw_points, draw_friction):
        each(folder)
    for each in (draw_patch, draw_mass):
        each(abut, folder)


if __name__ == "__main__":
    pictures.main(__doc__, draw)
