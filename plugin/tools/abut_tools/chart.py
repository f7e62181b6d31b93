# SPDX-License-Identifier: LGPL-2.1-or-later
"""`abut chart`: one scene run in many ways, errors against time and work.

All points are planned and their scenes read first, so that a mistake shows
before the first run. Then the runs are made, all curves' first points first:
what comes early is cheap and shows soon what is wrong.

An error against the exact solution is found by a run of its own. The timed runs
have no exact solution, so that they do not integrate errors and solve coarse
meshes no more tightly than a user's run does."""
import pathlib
import statistics
import time
from typing import NamedTuple

from .chart_clock import ChartClock
from .chart_file import ChartFile, reference_text
from .chart_rows import NAN, ChartRow, mark_fronts
from .chart_tables import cheapest_table, runs_csv
from .errors import InputError, Words, warn
from .nearest_word import did_you_mean
from .parameter_file import Assignment
from .run_figures import RunFigures
from .run_maker import RunMaker, RunSetting
from .run_store import RunStore, key, make_output_folder, write_at_once
from .serial_program import SerialProgram, this_program

DISPLACEMENT, GRADIENT = (f"Exact solution/{name}"
                          for name in ("Displacement", "Gradient"))
# What an error of the summary needs in the scene.
ERROR_SOURCES = {"l2_error": DISPLACEMENT, "h1_error": DISPLACEMENT,
                 "energy_norm_error": DISPLACEMENT,
                 "nodal_error": DISPLACEMENT,
                 "energy_error": "Exact solution/Energy",
                 "contact_force_error": "Exact solution/Contact force"}
# Files that no chart needs.
SILENT = ("Output/Fields", "Output/Pictures", "Output/Report")


class Point(NamedTuple):
    curve: int
    number: int  # along the curve
    measured: RunSetting
    timed: RunSetting


def setting_of(path, value):
    return Assignment(path, value, "abut chart")


def has_value(setting, path):
    return setting.values.get(path) not in (None, "", "nan")


class Chart:
    def __init__(self, chart, program, progress):
        self._chart, self._progress = chart, progress
        self._maker = RunMaker(program, chart.scene_file)
        self._store = None
        self._reference = chart.reference or 0.
        self._seconds = 0.  # of the runs of the present point

    def plan(self):
        declared = self._maker.setting([]).values
        self._silent = [setting_of(path, "false") for path in SILENT
                        if path in declared]
        points = [self._plan_point(curve.settings + [
                      Assignment(path, value, curve.axis_origin)
                      for path in curve.axis], number, i)
                  for number, curve in enumerate(self._chart.curves)
                  for i, value in enumerate(curve.values)]
        self._refuse_empty_sections(points)
        self._points = sorted(points, key=lambda point: point.number)
        if self._chart.finer_run:
            finer = self._plan_point(self._chart.finer_run, 0, 0)
            if finer.measured.refusal:
                raise InputError(finer.measured.refusal)
            self._finer = finer.timed

    def _plan_point(self, settings, curve, number):
        settings = self._silent + settings
        measured = timed = self._maker.setting(settings)
        self._require_error(measured)
        if has_value(measured, DISPLACEMENT) and not measured.refusal:
            without = [setting_of(path, "") for path in (DISPLACEMENT, GRADIENT)]
            timed = self._maker.setting(settings + without)
            if ERROR_SOURCES.get(self._chart.quantity) != DISPLACEMENT:
                measured = timed
        return Point(curve, number, measured, timed)

    def _require_error(self, setting):
        quantity = self._chart.quantity
        if not quantity or not self._chart.is_error:
            return
        source = ERROR_SOURCES.get(quantity)
        if source is None:
            raise InputError(f"no scene has '{quantity}'."
                             + did_you_mean(quantity, ERROR_SOURCES),
                             "Error/Quantity")
        if not has_value(setting, source):
            raise InputError(
                f"there is no {quantity}: the scene "
                f"'{self._chart.scene_file}' has no '{source}'. Take another "
                "quantity with its right value as Reference, or with a "
                "section 'Finer run'.", "Error/Quantity")

    def _refuse_empty_sections(self, points):
        """One impossible combination among others is a result; a section that
        has nothing else is a mistake."""
        sections = [self._chart.curves[point.curve].section for point in points]
        possible = {section for section, point in zip(sections, points)
                    if not point.measured.refusal}
        for section, point in zip(sections, points):
            if section not in possible:
                raise InputError(f"{point.measured.refusal} (all of section "
                                 f"'{section}')")

    def print_plan(self):
        for point in self._points:
            refusal = point.measured.refusal
            self._progress(self._name(point.curve, point.number)
                                  + (f": refused: {refusal}" if refusal else ""))
        self._progress(f"{len(self._points)} points, up to "
                              f"{self._chart.repeats} timed runs each")

    def _name(self, curve, number):
        curve = self._chart.curves[curve]
        return f"{curve.name}, {curve.values[number]}"

    def run(self, store):
        """All rows, in order of curves."""
        self._store = store
        self._find_reference()
        clock = ChartClock([len(curve.values) for curve in self._chart.curves])
        rows = []
        for point in self._points:
            self._seconds = 0.
            rows.append(self._run_point(point))
            clock.set(point.curve, point.number, self._seconds)
            left = clock.text()
            self._progress(
                f"{len(rows)}/{len(self._points)}  "
                f"{self._name(point.curve, point.number)}: "
                + self._text(rows[-1]) + (f"; {left}" if left else ""))
        rows.sort(key=lambda row: row.curve)
        mark_fronts(rows)
        return rows

    def _text(self, row):
        if not row.ok:
            return f"{row.ended}: {row.reason}"
        error = f"error {row.error:.3g}, " if self._chart.quantity else ""
        return f"{error}{self._chart.time} {row.time:.3g}"

    def _find_reference(self):
        if not self._chart.finer_run:
            return
        quantity = self._chart.quantity
        self._progress("finer run for the reference")
        record, is_new = self._maker.run(self._store, self._finer, 0,
                                         10 * self._chart.time_limit)
        if record.ended != "ok":
            raise InputError("the finer run, which gives the reference, ended "
                             f"as '{record.ended}': {record.reason}")
        self._reference = self._value(self._figures(self._finer, 0),
                                      "Error/Quantity", quantity)
        self._progress(f"reference: {quantity} = {self._reference:.10g}"
                              + ("" if is_new else " (made earlier)"))

    def _figures(self, setting, repeat):
        return RunFigures(self._store.place(setting.text, repeat))

    def _value(self, figures, parameter, name):
        """A number of a run that went well."""
        number = figures.cost(name)
        if number is None:
            where = "." if "(" in name else " in summary.json."
            raise InputError(f"the runs have no number '{name}'{where}"
                             + figures.explain(name), parameter)
        return number

    def _make(self, setting, repeat):
        """How a run of the present point has ended, and its figures."""
        record, _ = self._maker.run(self._store, setting, repeat,
                                    self._chart.time_limit)
        self._seconds += record.seconds
        return record, self._figures(setting, repeat)

    def _run_point(self, point):
        row = ChartRow(point.curve,
                       self._chart.curves[point.curve].values[point.number])
        if point.measured.refusal:
            row.ended, row.code = "refused", 2
            row.reason = point.measured.refusal
            return row
        record, figures = self._make(point.measured, 0)
        self._fill(row, record, figures)
        if row.ok:
            if not self._chart.axis_quantity:
                row.x = self._axis_number(row.value, point.number)
            if self._chart.quantity:
                self._value(figures, "Error/Quantity", self._chart.quantity)
            self._time(point, row)
        return row

    @staticmethod
    def _axis_number(value, number):
        """The value along the axis, or its number where it is a word."""
        try:
            return float(value)
        except ValueError:
            return number + 1.

    def _fill(self, row, record, figures):
        chart = self._chart

        def number(name):
            value = figures.value(name) if name else None
            return NAN if value is None else value

        row.ended, row.reason, row.code = (record.ended, record.reason,
                                           record.code)
        row.key = key(record.setting)
        row.quantity = number(chart.quantity)
        if chart.quantity:
            size = 0. if chart.is_error else abs(self._reference)
            scale = chart.scale or size or 1.
            row.error = abs(row.quantity - self._reference) / scale
        for name in ("dofs", "constraints", "active"):
            setattr(row, name, number(name))
        if chart.axis_quantity:
            row.x = number(chart.axis_quantity)

    def _time(self, point, row):
        """Medians of the repeats, or why one has no answer."""
        chart, spent = self._chart, 0.
        columns = {"time": [], "processor_seconds": [], "wall_seconds": [],
                   "peak_memory_mb": []}
        for repeat in range(chart.repeats):
            if repeat > 0 and spent >= chart.repeat_seconds:
                break
            record, figures = self._make(point.timed, repeat)
            if record.ended != "ok":
                row.ended, row.reason, row.code = (record.ended, record.reason,
                                                   record.code)
                return
            for name, column in columns.items():
                column.append(self._value(
                    figures, "Time", chart.time if name == "time" else name))
            spent += columns["processor_seconds"][-1]
            if repeat == 0:
                self._count_work(figures, row)
        row.repeats = len(columns["time"])
        row.fastest, row.slowest = min(columns["time"]), max(columns["time"])
        for name, column in columns.items():
            setattr(row, name, statistics.median(column))

    def _count_work(self, figures, row):
        for name in ("matvecs", "linear_iterations", "nonlinear_iterations"):
            value = figures.value(name)
            setattr(row, name, NAN if value is None else value)
        if self._chart.axis_quantity:
            self._value(figures, "Axis quantity", self._chart.axis_quantity)


class Progress:
    """Lines on what is done, with the seconds since the start."""

    def __init__(self, quiet):
        self._quiet, self._start = quiet, time.monotonic()

    def __call__(self, line):
        if not self._quiet:
            print(f"{time.monotonic() - self._start:8.2f} s  {line}",
                  flush=True)


def warn_of_failures(chart, rows):
    failed = [row for row in rows if not row.ok]
    if failed:
        first = failed[0]
        warn(f"{len(failed)} of {len(rows)} points have no answer, see "
             f"runs.csv; the first: {chart.curves[first.curve].name}, "
             f"{first.value} was {first.ended}: {first.reason}")


def make_chart(chart, folder, plan_only, progress):
    """Make a chart in a folder, reusing the finished runs that are there, and
    return the exit code.
    plan_only: print the points and stop before the first run"""
    work = Chart(chart, SerialProgram(this_program()), progress)
    work.plan()
    if plan_only:
        work.print_plan()
        return 0
    make_output_folder(folder)
    rows = work.run(RunStore(folder))
    write_at_once(folder / "runs.csv", runs_csv(chart, rows))
    if chart.quantity:
        table = cheapest_table(chart, rows)
        write_at_once(folder / "cheapest.md", table)
        for line in table.splitlines():
            progress(line)
    from .chart_pictures import draw_chart  # Matplotlib takes a while
    draw_chart(folder, chart, rows)
    warn_of_failures(chart, rows)
    progress(f"runs.csv and pictures in {folder}")
    return 0 if any(row.ok for row in rows) else 3


def main(words):
    parser = Words("chart")
    parser.add_argument("file", nargs="?")
    parser.add_argument("--set", action="append", default=[],
                        metavar="NAME=VALUE")
    parser.add_argument("--output", type=pathlib.Path)
    parser.add_argument("--plan", action="store_true")
    parser.add_argument("--parameters", action="store_true")
    parser.add_argument("--quiet", action="store_true")
    arguments = parser.parse_args(words)
    if arguments.parameters:
        print(reference_text(), end="")
        return 0
    if not arguments.file:
        parser.error("a chart file is missing: abut chart FILE.prm")
    chart = ChartFile(arguments.file, arguments.set)
    folder = arguments.output or pathlib.Path("output") / chart.name
    try:
        return make_chart(chart, folder, arguments.plan,
                          Progress(arguments.quiet))
    except InputError as error:
        raise chart.file.placed(error) from None
