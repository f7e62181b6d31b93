# SPDX-License-Identifier: LGPL-2.1-or-later
"""The numbers that a run has left in its folder, by name:

    order(h1_error)         log2 of the last two rows of levels.csv
    growth(energy)          last row divided by the one before
    starts(contact_force)   how often the column leaves 0
    mean(contact_force)     of the rows that have a number there
    ripple(contact_force)   their standard deviation divided by the size of
                            their mean
    largest(contact_force)  their largest size
    contact_force           of summary.json; true and false are 1 and 0
    pair_1_force[1]         a component, counted from 0
    sections/solve/seconds  of an object inside

In place of a column there may be the ratio of two, `a/b`. mean, ripple and
largest may have a range of times, `mean(contact_force, 1, 2)`: rows after the
first time, up to the second."""
import json
import math
import pathlib
import re

import numpy

from .nearest_word import did_you_mean, nearest_word
from .run_folder import read_table


def read_json(path):
    """An object of JSON; empty where there is none."""
    try:
        return json.loads(path.read_text())
    except (OSError, ValueError):
        return {}


def finite(value):
    return float(value) if math.isfinite(value) else None


def number_of(value):
    """A number of JSON, else None."""
    is_number = isinstance(value, (bool, int, float))
    return finite(value) if is_number else None


def starts(column):
    before = numpy.concatenate([[0.], column[:-1]])
    return numpy.count_nonzero((before == 0) & (column != 0))


def growth(column):
    return column[-1] / column[-2] if len(column) > 1 else math.nan


def ripple(column):
    return numpy.std(column) / abs(numpy.mean(column))


OF_ALL_ROWS = {"order": lambda column: -numpy.log2(growth(column)),
               "growth": growth, "starts": starts}
OF_NUMBERS = {"mean": numpy.mean, "ripple": ripple,
              "largest": lambda column: numpy.max(numpy.abs(column))}
CALL = re.compile(r"(\w+)\((.*)\)")


class RunFigures:
    """Reads summary.json and levels.csv, as far as they exist."""

    def __init__(self, folder):
        folder = pathlib.Path(folder)
        self.summary = read_json(folder / "summary.json")
        table = folder / "levels.csv"
        self.columns = read_table(table) if table.is_file() else {}

    def value(self, name):
        """A number by name, None if it is missing or not finite."""
        call = CALL.fullmatch(name)
        if not call:
            return self._of_summary(name)
        function, argument = call.groups()
        with numpy.errstate(all="ignore"):
            if function in OF_ALL_ROWS:
                column = self._column(argument)
                value = OF_ALL_ROWS[function]
            else:
                column = self._numbers(argument)
                value = OF_NUMBERS.get(function)
            if column is None or value is None:
                return None
            return finite(value(column))

    def cost(self, key):
        """processor_seconds or wall_seconds without the sections `results` and
        `output`, which measure and write; any other number as it is."""
        result = self.value(key)
        if result is None or key not in ("processor_seconds", "wall_seconds"):
            return result
        part = "seconds" if key == "wall_seconds" else key
        return result - sum(self.value(f"sections/{name}/{part}") or 0.
                            for name in ("results", "output"))

    def _entry(self, path):
        entry = self.summary
        for name in path.split("/"):
            entry = entry.get(name) if isinstance(entry, dict) else None
        return entry

    def _of_summary(self, key):
        name, bracket, index = key.partition("[")
        entry = self._entry(name)
        if bracket:
            number = re.match(r"\d*", index).group() or "0"
            entry = (entry[int(number)] if isinstance(entry, list)
                     and int(number) < len(entry) else None)
        return number_of(entry)

    def _column(self, text):
        """A column or a ratio of two; None where one is missing."""
        parts = [self.columns.get(name.strip()) for name in text.split("/", 1)]
        if any(part is None for part in parts):
            return None
        return parts[0] if len(parts) == 1 else parts[0] / parts[1]

    def _numbers(self, text):
        """The finite numbers of a column, within a range of times if there is
        one; None where there are none, or the range is not one."""
        name, *bounds = (part.strip() for part in text.split(","))
        column = self._column(name)
        if column is None:
            return None
        wanted = numpy.isfinite(column)
        if bounds:
            try:
                begin, end = map(float, bounds)
            except ValueError:
                return None
            if "time" not in self.columns:
                return None
            # Times are printed with round-off.
            noise = 1e-9 * (abs(begin) + abs(end))
            time = self.columns["time"]
            wanted &= (time > begin + noise) & (time <= end + noise)
        return column[wanted] if wanted.any() else None

    def explain(self, name):
        """Why there is no number of this name, and what to write instead, with
        a blank in front; "" if nothing is like it."""
        if "(" in name:
            return self._explain_call(name)
        key = name.partition("[")[0]
        entry = self._entry(key)
        if key not in self.summary and entry is None:
            nearest = nearest_word(key, self.summary)
            for end in ("", "[0]"):
                if nearest and self.value(nearest + end) is not None:
                    return f" Did you mean '{nearest}{end}'?"
            return ""
        if number_of(entry) is not None:
            return f" '{key}' is one number, not a list: write '{key}'."
        if not isinstance(entry, list) or not entry:
            return f" '{key}' is there, but is no number."
        n = len(entry)
        return (f" '{key}' is a list of {n}: write '{key}[0]'"
                + (f" or up to '[{n - 1}]'." if n > 1 else "."))

    def _explain_call(self, name):
        call = CALL.fullmatch(name)
        if not call or call.group(1) not in {**OF_ALL_ROWS, **OF_NUMBERS}:
            return (" Functions of a column of levels.csv are order, growth, "
                    "starts, mean, ripple and largest: 'mean(contact_force)'.")
        for part in call.group(2).partition(",")[0].split("/"):
            if part.strip() not in self.columns:
                return (f" levels.csv has no column '{part.strip()}'."
                        + did_you_mean(part.strip(), self.columns))
        return (" No row of levels.csv has numbers there. A range of times is "
                "written so: 'mean(contact_force, 1, 2)', the rows after time "
                "1 up to 2.")
