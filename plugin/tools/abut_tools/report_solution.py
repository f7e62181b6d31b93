# SPDX-License-Identifier: LGPL-2.1-or-later
"""How a run was solved, what it cost, and the files that it wrote."""
import math

import numpy

from . import style
from .report_page import (details, escape, figure, labelled, number, pointer,
                          quoted, table)
from .report_results import figures
from .style import svg_element

# What a run tells of its effort, in the order of the page.
EFFORT = ("method", "discretisation", "linear_solver", "load_steps",
          "load_steps_cut_back", "time_steps", "nonlinear_iterations",
          "linearisations", "linear_iterations", "matvecs", "searches",
          "search_reuses", "fallback_steps", "stable_time_step")

# Rows of a table on the page; of more there are the first and the last.
MOST_ROWS, FIRST, LAST = 24, 4, 12


def process(run):
    parts = [figures(run, EFFORT, ""), convergence(run), levels(run),
             modelled(run), could_be_left_out(run)]
    return "\n".join(part for part in parts if part)


def convergence(run):
    """Iterations: residuals of Newton's method, or changes of the active
    set."""
    newton, steps = run.table("newton.csv"), run.table("steps.csv")
    if newton and len(newton["residual"]) > 1:
        drawn = newton_picture(newton)
        caption = ("Forces out of balance after each linearisation; vertical "
                   "lines: next load step or mesh.")
    elif steps and len(steps["n_changes"]) > 1:
        drawn = steps_picture(steps)
        caption = ("Contact points that changed their state in each linear "
                   "system, and points in contact; vertical lines: next load "
                   "step or mesh.")
    else:
        return ""
    return "<h3>Convergence</h3>\n" + figure(
        svg_element(drawn, "convergence"), caption, "Convergence of the iteration")


def ends(*columns):
    """Where a new load step or mesh begins."""
    rows = numpy.column_stack(columns)
    return [i + 0.5 for i in range(1, len(rows))
            if (rows[i] != rows[i - 1]).any()]


def with_ends(axes, places):
    if len(places) <= 60:
        for place in places:
            axes.axvline(place, color=style.GREY, linewidth=0.5)


def newton_picture(newton):
    drawn, ((axes,),) = style.figure(style.PAGE, 0.36)
    count = numpy.arange(1, len(newton["residual"]) + 1)
    with_ends(axes, ends(newton["load_step"], newton["level"]))
    axes.plot(count, numpy.where(newton["residual"] > 0, newton["residual"],
                                 math.nan), label="forces out of balance",
              **style.curve_style(0))
    axes.plot(count, numpy.where(newton["error"] > 0, newton["error"],
                                 math.nan), label="relative error",
              **style.curve_style(1))
    axes.set_yscale("log")
    axes.set_xlabel("linearisation")
    style.whole_numbers(axes.xaxis)
    style.legend(axes)
    return drawn


def steps_picture(steps):
    drawn, ((axes,),) = style.figure(style.PAGE, 0.36)
    count = numpy.arange(1, len(steps["n_changes"]) + 1)
    with_ends(axes, ends(steps["level"]))
    axes.plot(count, steps["n_active"], label="points in contact",
              **style.curve_style(0))
    axes.plot(count, steps["n_changes"], label="changes of their state",
              **style.curve_style(1))
    axes.set_yscale("symlog", linthresh=1)
    axes.set_ylim(bottom=0)
    axes.set_xlabel("linear system")
    style.whole_numbers(axes.xaxis)
    style.legend(axes)
    return drawn


def levels(run):
    """levels.csv; columns without numbers are left out."""
    columns = run.table("levels.csv")
    if not columns:
        return ""
    shown = [name for name, values in columns.items()
             if values.dtype.kind != "f" or numpy.isfinite(values).any()]
    shown = [name for name in shown if not (
        columns[name].dtype.kind == "f" and not columns[name].any()
        and name not in ("load_step", "time", "step"))]
    n = len(next(iter(columns.values())))
    rows = list(range(n))
    if n > MOST_ROWS:
        rows = rows[:FIRST] + rows[-LAST:]

    def cell(name, row):
        value = columns[name][row]
        if columns[name].dtype.kind != "f":
            return quoted(value, f"levels.csv:{name}:{row}")
        if not math.isfinite(value):
            return ""
        value = float(value)
        return number(int(value) if value.is_integer() and abs(value) < 1e15
                      else value, f"levels.csv:{name}:{row}", digits=5)
    caption = ("The first and the last rows of levels.csv, "
               f"which has {number(n, 'levels.csv', 'rows')}."
               if n > MOST_ROWS else "levels.csv.") + (
                   " Columns that are empty or zero are left out."
                   if len(shown) < len(columns) else "")
    return "<h3>Meshes and steps</h3>\n" + table(
        [labelled(name) for name in shown],
        [[cell(name, row) for name in shown] for row in rows], caption,
        numeric=range(len(shown)))


def modelled(run):
    rows = []
    for name, entry in run.summary.get("modelled", {}).items():
        where = f'summary.json#{pointer("modelled", name)}'
        rows.append([escape(name), "on" if entry["on"] else
                     '<span class="soft">off</span>',
                     quoted(entry["why"], f"{where}/why")])
    return rows and "<h3>What was modelled</h3>\n" + table(
        ["", "", "reason"], rows)


def could_be_left_out(run):
    lines = [f'<li>{quoted(text, f"summary.json#/could_be_left_out/{i}")}</li>'
             for i, text in enumerate(run.summary.get("could_be_left_out",
                                                      []))]
    unused = [f'<li>{quoted(text, f"summary.json#/not_used/{i}")}</li>'
              for i, text in enumerate(run.summary.get("not_used", []))]
    return "\n".join(
        details(heading, f'<ul>{"".join(items)}</ul>')
        for heading, items in (("What could be left out", lines),
                               ("Parameters that this run did not use",
                                unused)) if items)


def cost(run):
    """Time and memory by section."""
    sections = run.summary.get("sections", {})
    wall = run.summary.get("wall_seconds")
    if not sections or not wall:
        return ""
    rows = []
    for name, entry in sections.items():
        where = f'summary.json#{pointer("sections", name)}'
        share = entry["seconds"] / wall
        depth = name.count("/")
        rows.append([
            f'<span style="padding-left:{depth}em">'
            f'{escape(name.rsplit("/", 1)[-1])}</span>',
            f'<div class="bars"><span class="bar" style="width:'
            f'{min(100, 100 * share):.1f}%"></span></div>',
            number(share, [f"{where}/seconds", "summary.json#/wall_seconds"],
                   "share", 2),
            number(entry["seconds"], f"{where}/seconds", digits=3),
            number(entry["memory_mb"], f"{where}/memory_mb", digits=3),
            number(entry["calls"], f"{where}/calls")])
    summary = run.summary
    text = ("<p>" + number(wall, "summary.json#/wall_seconds", digits=4,
                           unit="s")
            + " on the clock, "
            + number(summary["processor_seconds"],
                     "summary.json#/processor_seconds", digits=4, unit="s")
            + " of processors on "
            + number(summary["ranks"], "summary.json#/ranks")
            + " rank(s); at most "
            + number(summary["peak_memory_mb"],
                     "summary.json#/peak_memory_mb", digits=4, unit="MiB")
            + " of memory on a rank.</p>")
    return text + table(
        ["section", "", "share of the time", "seconds", "memory kept [MiB]",
         "calls"], rows, numeric=(2, 3, 4, 5))


# Endings and beginnings of names, and what the files are.
KINDS = (
    ("summary.json", "all figures of the run"),
    ("parameters.json", "all parameters with their values"),
    ("run.json", "how the run was started and how it ended"),
    ("outline.json", "outline of the bodies for sketches"),
    ("obstacles.vtu", "surfaces of rigid obstacles"),
    ("primary.vtu", "primary surface"),
    ("secondary.vtu", "secondary surface with the results of the search"),
    ("candidates.csv", "a row for each node and candidate"),
    ("motion.csv", "a row for each time step"),
    ("_closed_form.csv", "closed form of tractions on a contact line"),
    ("levels.csv", "a row for each mesh, load step or time step"),
    ("steps.csv", "a row for each linear system"),
    ("newton.csv", "a row for each linearisation"),
    ("nodal.csv", "displacement and forces of all nodes"),
    ("masses.csv", "a row for each mass"),
    ("sweep.csv", "a row for each value of the sweep"),
    ("report.html", "this page"),
    (".pvd", "list of the fields over time or meshes, for ParaView"),
    (".pvtu", "fields of one time or mesh, for ParaView"),
    (".vtu", "part of the fields, for ParaView"),
    (".csv", "contact line of a pair: pressure, gap, state"),
    (".svg", "picture"), (".png", "picture"),
)


def files(run):
    """Files of the folder with sizes."""
    rows, series = [], {}
    names = [path for path in sorted(run.path.iterdir())
             if path.is_file() and not path.name.startswith(".")
             and path.name not in ("report.html", "report.html.part")]
    for path in names:
        what = next((words for ending, words in KINDS
                     if path.name.endswith(ending)), "")
        group = path.name.split("_0")[0] if path.suffix in (".vtu", ".pvtu") \
            else None
        if group:
            series.setdefault((group, path.suffix), []).append(path)
        else:
            rows.append([quoted(path.name, "files"), what, size_of(path)])
    for (group, suffix), members in series.items():
        what = next(words for ending, words in KINDS if suffix == ending)
        if len(members) <= 3:
            rows += [[quoted(path.name, "files"), what, size_of(path)]
                     for path in members]
        else:
            total = sum(path.stat().st_size for path in members)
            rows.append([f"{quoted(members[0].name, 'files')} to "
                         f"{quoted(members[-1].name, 'files')}", what,
                         number(total, [f"{path.name}:" for path in members],
                                "sum")])
    content = table(["file", "content", "bytes"], rows, numeric=(2,))
    if run.has("fields.pvd"):
        warp, colour = (("Warp By Scalar", "pressure")
                        if run.kind == "obstacle" else
                        ("Warp By Vector", "von_mises_stress"))
        content += (
            "<p>In ParaView: <em>File, Open</em>, <code>fields.pvd</code>, "
            f"<em>Apply</em>; <em>Filters, {warp}</em> with "
            "<code>displacement</code> shows the deformed state; colour by "
            f"<code>{colour}</code>.")
        if run.has("contact.pvd"):
            content += (" <code>contact.pvd</code> has the contact surfaces "
                        "with pressure, gap and state.")
        content += "</p>"
    return content


def size_of(path):
    return number(path.stat().st_size, f"{path.name}:", "size")
