# SPDX-License-Identifier: LGPL-2.1-or-later
"""Curves of tables: errors and effort over unknowns, energies and forces over
time."""
import numpy

from . import style
from .labels import label, words

MOST_POINTS = 2000  # more points than pixels only make the file large


def convergence(run, width):
    """Errors and linear systems over degrees of freedom, for the meshes of the
    first load step; None where there is nothing to show."""
    table = run.table("levels.csv")
    if table is None or "dofs" not in table or not len(table["dofs"]):
        return None
    if "load_step" in table:
        first = table["load_step"] == table["load_step"][0]
        table = {name: values[first] for name, values in table.items()}
    errors, target = _errors(run, table)
    errors = [(name, text, values) for name, text, values in errors
              if (values > 0).sum() > 0]
    dofs = table["dofs"]
    if len(dofs) < 2 and not errors:
        return None
    n = 2 if errors else 1
    figure, axes = style.figure(width, 0.45, rows=n, sharex=True)
    axes = axes[:, 0]
    if errors:
        _draw_errors(axes[0], dofs, errors)
        if target:
            axes[0].axhline(target, color=style.GREY, linestyle="--",
                            linewidth=0.8, label="target")
        style.legend(axes[0])
        axes[0].set_ylabel("error")
    style.named(*axes[-1].plot(dofs, table["steps"], **style.curve_style(0)),
                "linear_systems")
    axes[-1].set_ylim(0, 1.1 * max(table["steps"]))
    style.whole_numbers(axes[-1].yaxis)
    style.logarithmic(axes[-1].xaxis)
    axes[-1].set_ylabel("linear systems\nper mesh")
    axes[-1].set_xlabel(label("dofs"))
    style.letters(axes)
    return figure


def _errors(run, table):
    """Name, label and values of each curve, and the target if there is one."""
    nothing = numpy.full(len(table["dofs"]), numpy.nan)
    curves = []
    for key in ("l2_error", "h1_error", "energy_norm_error"):
        if key == "h1_error" and run.kind == "solid":
            continue
        curves.append((key, label(key), table.get(key, nothing)))
    exact = run.number("Exact solution/Energy")
    if run.kind != "solid" and numpy.isfinite(exact):
        curves.append(("energy_error", "error of the energy",
                       abs(table["energy"] - exact)))
    for key, value in run.summary.get("expected", {}).items():
        if key in table and value != 0:
            curves.append((f"expected_{key}", f"error of {words(key)}",
                           abs(table[key] / value - 1)))
    judged = table.get("estimated_error", nothing)
    estimate = numpy.where(numpy.isnan(judged),
                           table.get("estimate", nothing), numpy.nan)
    curves.append(("estimate", label("estimate"), estimate))
    of = (" of the contact force" if run.parameter("Refinement/Target quantity")
          == "contact force" else "")
    curves.append(("estimated_error", "estimated relative error" + of, judged))
    target = run.number("Refinement/Target error", 0.0)
    return curves, target if numpy.isfinite(judged).any() else 0.0


def _draw_errors(axes, dofs, errors):
    for i, (name, text, values) in enumerate(errors):
        good = values > 0
        style.named(*axes.plot(dofs[good], values[good], label=text,
                               **style.curve_style(i)), name)
    axes.set_xscale("log")
    style.logarithmic(axes.yaxis)
    # The slope of the last half of the first curve that has one.
    for i, (_, _, values) in enumerate(errors):
        good = numpy.flatnonzero(values > 0)
        part = good[-(len(good) // 2 + 1):]
        if len(good) < 3 or numpy.ptp(values[good]) == 0 \
                or dofs[part[0]] == dofs[part[-1]]:
            continue
        slope = fitted_slope(dofs[part], values[part])
        low, high = sorted((dofs[part[0]], dofs[part[-1]]))
        start, width = (low * high) ** 0.5, (high / low) ** 0.4
        style.slope_triangle(axes, start / width ** 0.5,
                             0.55 * values[part].min()
                             * width ** max(0.0, -slope), slope, width,
                             f"{slope:.2f}")
        break


def fitted_slope(x, y):
    """Least squares in logarithms."""
    return numpy.polyfit(numpy.log(x), numpy.log(y), 1)[0]


ENERGIES = ("kinetic_energy", "strain_energy", "contact_energy",
            "dissipated_energy", "energy_lost_in_impacts", "external_work",
            "energy_balance")


def over_time(run, width):
    """Energies, and forces of contact, over time; None for runs without
    motion."""
    table = run.table("motion.csv") or run.table("levels.csv")
    if table is None or "energy_balance" not in table:
        return None
    panels = [("energy [force·length]",
               [(name, words(name), table[name]) for name in ENERGIES
                if name in table])]
    if "force_height" in table:
        panels.append(("contact force [force]", [
            ("force", "vertical", table["force_height"])]))
    else:
        panels.append(("contact force [force]", [
            (name, name[:-6].replace("_", " "), table[name])
            for name in table if name.endswith("_force")]))
    panels = [(text, [curve for curve in curves if curve[2].any()])
              for text, curves in panels]
    panels = [panel for panel in panels if panel[1]]
    if not panels:
        return None
    figure, axes = style.figure(width, 0.42, rows=len(panels), sharex=True)
    stride = 1 + len(table["time"]) // MOST_POINTS
    for axis, (text, curves) in zip(axes[:, 0], panels):
        for i, (name, curve, values) in enumerate(curves):
            style.named(*axis.plot(table["time"][::stride], values[::stride],
                                   label=curve, **style.line_style(i)), name)
        axis.set_ylabel(text)
        if len(curves) > 1 or len(panels) > 1:
            style.legend(axis)
    axes[-1, 0].set_xlabel(label("time"))
    style.letters(axes[:, 0])
    return figure
