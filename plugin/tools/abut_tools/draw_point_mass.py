# SPDX-License-Identifier: LGPL-2.1-or-later
"""Pictures of the scene `point mass`: minimise 1/2 u'Ku - f'u under
g0 + B u >= 0. One mass with one constraint, and two masses: path. One mass with
one inequality and a sweep of penalties: energy, penalty, lagrangian."""
import numpy

from . import style
from .errors import warn


class Model:
    """The data of the scene."""

    def __init__(self, run):
        def rows(text):
            return numpy.array([[float(word) for word in
                                 row.replace(",", " ").split()]
                                for row in text.split(";")])

        self.force = numpy.array(run.numbers("Masses/Force"))
        n = len(self.force)
        self.stiffness = rows(run.parameter("Masses/Stiffness"))
        self.rows = rows(run.parameter("Constraints/B")).reshape(-1, n)
        gaps = run.numbers("Constraints/Initial gap")
        self.gaps = numpy.broadcast_to(gaps, len(self.rows))
        start = run.numbers("Masses/Start")
        self.start = numpy.broadcast_to(start or 0.0, n)
        kinds = run.parameter("Constraints/Kind").replace(",", " ").split()
        self.has_equality = "equality" in kinds

    def energy(self, *u):
        u = numpy.array(u)
        product = numpy.tensordot(self.stiffness, u, 1)
        return (0.5 * (u * product).sum(axis=0)
                - numpy.tensordot(self.force, u, 1))

    def row_stiffness(self, row=0):
        """What penalties are multiples of."""
        b = self.rows[row]
        return (b ** 2 * numpy.diag(self.stiffness)).sum() / (b ** 2).sum() ** 2

    def length_scale(self):
        return max([*(abs(self.force) / numpy.diag(self.stiffness)),
                    *abs(self.gaps)])


class OneMass:
    """The one mass and its one row."""

    def __init__(self, model):
        self.energy = model.energy
        self.k, self.f = model.stiffness[0, 0], model.force[0]
        self.b, self.g0 = model.rows[0, 0], model.gaps[0]
        self.has_equality = model.has_equality
        self.row_stiffness = model.row_stiffness()
        self.free, self.wall = self.f / self.k, -self.g0 / self.b
        span = abs(self.free - self.wall) or model.length_scale()
        self.low = min(self.free, self.wall) - 0.75 * span
        self.high = max(self.free, self.wall) + 0.5 * span
        self.wall_force = self.force(self.wall)

    def gap(self, u):
        return self.g0 + self.b * u

    def force(self, u):
        """Contact force that equilibrium needs: k u = f + b p."""
        return (self.k * u - self.f) / self.b

    def shade(self, axes, low, high):
        """The side of the obstacle, from its wall to the edge."""
        axes.axvspan(self.wall, high if self.b < 0 else low, color=style.PALE,
                     linewidth=0, zorder=0)
        axes.annotate("obstacle", (self.wall, 0.97),
                      xycoords=("data", "axes fraction"), va="top",
                      ha="left" if self.b < 0 else "right", color=style.GREY,
                      textcoords="offset points",
                      xytext=(-4 * numpy.sign(self.b), 0))

    def penalized(self, u, penalty):
        """Energy with that of the springs in place of the obstacle."""
        closed = numpy.minimum(self.gap(u), 0.0)
        return (self.energy(u)
                + 0.5 * penalty * self.row_stiffness * closed ** 2)

    def minimum(self, penalty):
        """Displacement and contact force where that energy is least."""
        spring = penalty * self.row_stiffness
        u = ((self.f - spring * self.b * self.g0)
             / (self.k + spring * self.b ** 2))
        u = numpy.where(self.gap(self.free) >= 0, self.free, u)
        return u, self.force(u)


def pictures(run, width):
    model = Model(run)
    n, sweep = len(model.force), run.table("sweep.csv")
    if n == 1 and len(model.rows) == 1:
        mass = OneMass(model)
        yield "path", _path_of_one(mass, run, width)
        if sweep is not None and not model.has_equality:
            yield "energy", _energy(mass, sweep, width)
            yield "penalty", _penalty(mass, sweep, width)
            yield "lagrangian", _lagrangian(mass, width)
    elif n == 2:
        yield "path", _path(model, run, width)
    else:
        warn("no pictures: they are drawn for one mass with one constraint and "
             "for two masses.")


def _energy(mass, sweep, width):
    figure, [[axes]] = style.figure(width)
    u = numpy.linspace(mass.low, mass.high, 900)
    at_wall, lowest = mass.energy(mass.wall), mass.energy(mass.free)
    height = max(abs(at_wall), at_wall - lowest)
    axes.set_xlim(mass.low, mass.high)
    axes.set_ylim(lowest - 0.4 * height, at_wall + 1.6 * height)
    mass.shade(axes, mass.low, mass.high)
    style.named(*axes.plot(u, mass.energy(u), color=style.GREY, linestyle="--",
                           label="no obstacle"), "free")
    for i, penalty in enumerate(sweep["penalty"]):
        style.named(*axes.plot(
            u, mass.penalized(u, penalty), **style.line_style(i),
            label=rf"$\epsilon/k$ = {style.number(penalty)}"), f"penalty_{i + 1}")
    minima = sweep["u"]
    style.named(*axes.plot(minima, mass.penalized(minima, sweep["penalty"]),
                           "o", color=style.BLACK, label="minima"), "minima")
    axes.set_xlabel("displacement $u$ [length]")
    axes.set_ylabel("energy [force·length]")
    style.legend(axes)
    return figure


def _penalty(mass, sweep, width):
    figure, [[axes]] = style.figure(width)
    powers = numpy.log10(sweep["penalty"])
    penalties = numpy.logspace(powers.min() - 1, powers.max(), 81)
    displacement, force = mass.minimum(penalties)
    exact = {"color": style.GREY, "linestyle": "--", "linewidth": 0.8}
    axes.axhline(mass.wall, **exact)
    axes.axhline(mass.wall_force, **exact)
    for i, (name, curve, marks, text) in enumerate((
            ("displacement", displacement, sweep["u"], "displacement $u$"),
            ("force", force, sweep["p"], "contact force $p$"))):
        style.named(*axes.plot(penalties, curve, label=text,
                               **style.line_style(i)), name)
        style.named(*axes.plot(sweep["penalty"], marks, style.MARKERS[i],
                               color=style.COLOURS[i]), f"{name}_of_runs")
    axes.plot([], [], **exact, label="exact: obstacle, force on it")
    values = [mass.free, mass.wall, mass.wall_force]
    axes.set_ylim(1.12 * min(0.0, *values),
                  1.12 * max(*values, 0.1 * abs(mass.free)))
    axes.set_xlim(penalties[0], penalties[-1] * 1.3)
    style.logarithmic(axes.xaxis)
    axes.set_xlabel(r"penalty / stiffness, $\epsilon/k$")
    axes.set_ylabel("displacement $u$ [length],\ncontact force $p$ [force]")
    style.legend(axes)
    return figure


def _lagrangian(mass, width):
    figure, [[axes]] = style.figure(width, 0.95 if style.is_narrow(width) else 0.68)
    multiplier = -mass.wall_force
    span = max(abs(multiplier), abs(mass.f)) or 1.0
    bottom, top = multiplier - span, multiplier + span
    u, multipliers = numpy.meshgrid(numpy.linspace(mass.low, mass.high, 161),
                                    numpy.linspace(bottom, top, 161))
    values = mass.energy(u) + multipliers * mass.gap(u)
    saddle = mass.energy(mass.wall)
    reach = max(abs(values[[0, 0, -1, -1], [0, -1, 0, -1]] - saddle))
    levels = numpy.linspace(saddle - reach, saddle + reach, 27)
    lines = axes.contour(u, multipliers, values, levels, cmap=style.FIELD_MAP,
                         linewidths=0.8)
    bar = style.colour_bar(figure, lines, axes,
                           r"Lagrangian $L(u, \lambda)$ [force·length]",
                           ticks=style.ticker.MaxNLocator(6))
    bar.outline.set_linewidth(0)
    line = numpy.array([mass.low, mass.high])
    style.named(*axes.plot(
        line, (mass.k * line - mass.f) / -mass.b, color=style.BLACK,
        linestyle=":", label=r"$\partial L/\partial u = 0$"), "equilibrium")
    axes.axvline(mass.wall, color=style.BLACK, linestyle="--", linewidth=0.8,
                 label=r"$\partial L/\partial\lambda = 0$: gap closed")
    style.named(*axes.plot([mass.wall], [multiplier], "o", color=style.BLACK,
                           markersize=5, label=f"saddle point $u$ = "
                           f"{mass.wall:.4g}, $\\lambda$ = {multiplier:.4g}"),
                "saddle")
    axes.set_xlim(mass.low, mass.high)
    axes.set_ylim(bottom, top)
    axes.grid(False)
    axes.set_xlabel("displacement $u$ [length]")
    axes.set_ylabel(r"multiplier $\lambda = -p$ [force]")
    style.legend(axes)
    return figure


def _path_of_one(mass, run, width):
    figure, [[axes]] = style.figure(min(width, 130), 0.7)
    levels = run.table("levels.csv")
    u, p = levels["u"], levels["p"]
    ends = [*u, mass.free, mass.wall]
    margin = 0.15 * (max(ends) - min(ends)) or 0.5 * (mass.high - mass.low)
    low, high = min(ends) - margin, max(ends) + margin
    if not mass.has_equality:
        mass.shade(axes, low, high)
    style.named(*axes.plot([low, high], [mass.force(low), mass.force(high)],
                           color=style.GREY, linestyle="--",
                           label="equilibrium $ku = f + Bp$"), "equilibrium")
    axes.axvline(mass.wall, color=style.VERMILION, label="gap closed")
    style.named(*axes.plot(u, p, marker="o", color=style.BLUE,
                           label="iterates"), "path")
    axes.set_xlim(low, high)
    axes.set_xlabel("displacement $u$ [length]")
    axes.set_ylabel("contact force $p$ [force]")
    style.legend(axes)
    return figure


def _path(model, run, width):
    figure, [[axes]] = style.figure(min(width, 130), 0.9)
    levels = run.table("levels.csv")
    path = numpy.vstack([model.start,
                         numpy.column_stack([levels["u_1"], levels["u_2"]])])
    low, high = path.min(axis=0), path.max(axis=0)
    centre, span = (low + high) / 2, (high - low).max() or model.length_scale()
    (x0, y0), (x1, y1) = centre - span, centre + span
    grid = numpy.meshgrid(numpy.linspace(x0, x1, 121),
                          numpy.linspace(y0, y1, 121))
    axes.contour(*grid, model.energy(*grid), 16, colors="#a0b8cc",
                 linewidths=0.6)
    axes.plot([], [], color="#a0b8cc", linewidth=0.6, label="energy")
    for i, ((a, b), gap) in enumerate(zip(model.rows, model.gaps)):
        ends = (([x0, x1], [(-gap - a * x) / b for x in (x0, x1)]) if b
                else ([-gap / a] * 2, [y0, y1]))
        style.named(*axes.plot(*ends, color=style.VERMILION, linestyle="--",
                               label="" if i else "gap closed"), f"row_{i + 1}")
    style.named(*axes.plot(path[:, 0], path[:, 1], marker="o",
                           color=style.BLUE, label="outer iterations"), "path")
    axes.set_xlim(x0, x1)
    axes.set_ylim(y0, y1)
    axes.set_aspect("equal")
    axes.grid(False)
    axes.set_xlabel("displacement $u_1$ [length]")
    axes.set_ylabel("displacement $u_2$ [length]")
    style.legend(axes)
    return figure
