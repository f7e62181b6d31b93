# SPDX-License-Identifier: LGPL-2.1-or-later
"""Tables of a chart."""
import csv
import io
import math

from .chart_rows import cheapest, is_as_fast

NUMBERS = ("x", "quantity", "error", "time", "processor_seconds",
           "wall_seconds", "fastest", "slowest", "repeats", "matvecs",
           "linear_iterations", "nonlinear_iterations", "dofs", "constraints",
           "active", "peak_memory_mb")
HEAD = ("curve", "axis", "value", "ended", "exit_code", "reason", *NUMBERS,
        "time_front", "work_front", "run")


def number_text(number):
    """All digits; nothing where there is no number."""
    if not math.isfinite(number):
        return ""
    return str(int(number)) if number == int(number) else repr(float(number))


def runs_csv(chart, rows):
    """A row for each point, failed ones included."""
    out = io.StringIO()
    table = csv.writer(out, lineterminator="\n")
    table.writerow(HEAD)
    for row in rows:
        curve = chart.curves[row.curve]
        table.writerow([curve.name, curve.axis_name, row.value, row.ended,
                        row.code, row.reason,
                        *(number_text(getattr(row, key)) for key in NUMBERS),
                        int(row.time_front), int(row.work_front), row.key])
    return out.getvalue()


def cheapest_table(chart, rows):
    """The least time in which each curve comes to each target, with the value
    along its axis; the best, and all that cannot be told from it, in bold."""
    head = "".join(f" {100 * target:g} % |" for target in chart.targets)
    lines = [f"| {chart.time} (value along the axis) |{head}",
             "|---|" + "---|" * len(chart.targets)]
    for number, curve in enumerate(chart.curves):
        line = f"| {curve.name} |"
        for target in chart.targets:
            own = cheapest([row for row in rows if row.curve == number], target)
            if own is None:
                line += " - |"
                continue
            bold = "**" if is_as_fast(own, cheapest(rows, target)) else ""
            line += f" {bold}{own.time:.3g}{bold} ({own.value}) |"
        lines.append(line)
    return "\n".join(lines) + "\n"
