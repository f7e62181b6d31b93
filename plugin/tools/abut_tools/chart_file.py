# SPDX-License-Identifier: LGPL-2.1-or-later
"""The input of a chart. A chart file has entries of its own, and sections that
hold settings of the scene: `All curves`, `Curve NAME` and `Error/Finer run`.
The program checks the latter when the scene is planned with them."""
import itertools
import math
import os
import re
from dataclasses import dataclass, replace
from typing import NamedTuple

from .errors import InputError
from .nearest_word import did_you_mean
from .parameter_file import ParameterFile

PICTURES = ("error-time", "error-work", "error-axis", "time-axis",
            "memory-axis")


def words_of(text):
    """Parts of "a, b, c"."""
    return [word.strip() for word in text.split(",") if word.strip()]


def is_number(low, high=math.inf, kind=float):
    def legal(text):
        try:
            return low <= kind(text) <= high and math.isfinite(kind(text))
        except ValueError:
            return False
    return legal


def are_numbers(text):
    return all(is_number(-math.inf)(word) for word in re.split(r"[,\s]+", text))


class Entry(NamedTuple):
    """A parameter of a chart file."""
    default: str
    legal: str      # its values in words
    is_legal: object
    meaning: str


def anything(_):
    return True


ENTRIES = {
    "Title": Entry("", "text", anything, "Title of the pictures."),
    "Scene file": Entry("", "text", anything,
        "The scene that is run; relative names are relative to this file."),
    "Axis": Entry("Refinement/Level", "text", anything,
        "The parameter of the scene that varies along a curve, "
        "`Section/Name`; several, separated by commas, take the same value."),
    "Values": Entry("", "text", anything,
        "Its values, separated by ` | `, those of the cheapest runs first. A "
        "curve may have `Axis` and `Values` of its own."),
    "Axis quantity": Entry("", "text", anything,
        "Key of summary.json that takes the place of the value in pictures, "
        "such as facets or dofs."),
    "Axis label": Entry("", "text", anything,
        "Label of that axis in pictures. Empty: its name."),
    "Time": Entry("processor_seconds", "text", anything,
        "The cost of a run: processor_seconds or wall_seconds (without the "
        "sections results and output), or another key of summary.json."),
    "Repeats": Entry("3", "a whole number from 1 to 1000",
        is_number(1, 1000, int),
        "Timed runs of each setting, of which the median counts."),
    "Repeat seconds": Entry("10", "a number of at least 0", is_number(0),
        "Fewer repeats of a setting once they have taken so many processor "
        "seconds."),
    "Time limit": Entry("60", "a number of at least 1", is_number(1),
        "Processor seconds, rounded up, after which a run is ended and counts "
        "as failed; ten times as long on the wall. The finer run has ten times "
        "as much."),
    "Targets": Entry("0.1, 0.01, 0.001", "numbers, separated by commas",
        are_numbers, "Errors for which the cheapest run is looked for."),
    "Pictures": Entry("error-time, error-work",
        "some of " + ", ".join(PICTURES),
        lambda text: set(words_of(text)) <= set(PICTURES),
        "Pictures that are drawn."),
    "Error/Quantity": Entry("", "text", anything,
        "Key of summary.json. l2_error, h1_error, energy_norm_error and others "
        "that are errors by themselves need an exact solution in the scene; "
        "any other, such as contact_force or point_1[2] (the third component), "
        "needs a reference. So does a function of a column of levels.csv, "
        "which has a row per load step: mean, ripple (standard deviation "
        "divided by the size of the mean) or largest (in size), of all rows or "
        "those after a time up to another one, of a column or the ratio of "
        "two, such as ripple(pair_1_force_y, 1, 2) or largest(pair_1_force_x / "
        "pair_1_force_y, 1, 2). Empty: no error is charted."),
    "Error/Reference": Entry("", "a number",
        lambda text: not text or is_number(-1e300, 1e300)(text),
        "Right value of the quantity. In its place a section `Finer run` may "
        "hold settings of the scene for a run that is made once and gives "
        "it."),
    "Error/Scale": Entry("0", "a number of at least 0", is_number(0),
        "The error is divided by it. 0: by the size of the reference, or not "
        "at all."),
    "Error/Label": Entry("", "text", anything,
        "Label of the error in pictures. Empty: made of the quantity.")}

ALL_CURVES, FINER_RUN = "All curves/", "Error/Finer run/"
OF_CURVE = re.compile(r"(Curve(?: [^/]*)?)/")


def reference_text():
    """The parameters of a chart file as Markdown."""
    lines = []
    for path, entry in ENTRIES.items():
        default = f"`{entry.default}`" if entry.default else "(empty)"
        lines.append(f"- **{path}** = {default} ({entry.legal}). "
                     f"{entry.meaning}")
    return "\n".join(lines) + "\n"


@dataclass
class ChartCurve:
    """Settings that a curve adds to the scene, and the parameters that vary
    along it."""
    name: str
    section: str      # several curves may come from one
    settings: list
    axis: list        # all take the same value
    values: list
    axis_origin: str  # where the values stand, for messages

    @property
    def axis_name(self):
        return ", ".join(self.axis)


def alternatives(text):
    """Parts of "a | b | c": bars between blanks, so that formulas may contain
    ||."""
    return [part.strip() for part in text.split(" | ")]


def below(section, assignments):
    """The assignments of a section, without its name."""
    return [one._replace(path=one.path[len(section):]) for one in assignments
            if one.path.startswith(section)]


def section_of(assignment):
    return OF_CURVE.match(assignment.path).group(1)


def multiplied(curve):
    """One curve for each combination of the alternatives in its settings;
    those that have some are added to its name."""
    choices = [alternatives(one.value) for one in curve.settings]
    for values in itertools.product(*choices):
        chosen = [value for value, choice in zip(values, choices)
                  if len(choice) > 1]
        yield replace(curve, name=", ".join(filter(None, [curve.name, *chosen])),
                      settings=[one._replace(value=value) for one, value
                                in zip(curve.settings, values)])


def check_repeated(assignments):
    """A section that comes back, or says something twice, is another curve
    with the same name, which would lose the first one. The command line may
    well say something once more."""
    paths, sections, last = set(), set(), None
    for one in assignments:
        if one.origin.startswith("--"):
            continue
        section = section_of(one)
        if one.path in paths or (section != last and section in sections):
            raise InputError(
                f"{one.origin}: '{one.path}' is in a second section "
                f"'{section}', or set twice: give each curve a name of its "
                "own.")
        paths.add(one.path)
        sections.add(section)
        last = section


class ChartFile:
    """A chart file that was read; raises InputError."""

    def __init__(self, path, overrides=()):
        self.file = ParameterFile(path, overrides)
        self.name = self.file.name
        settings = self.file.extract(
            lambda path: path.startswith((ALL_CURVES, FINER_RUN))
            or OF_CURVE.match(path))
        self.finer_run = below(FINER_RUN, settings)
        try:
            self._check_entries()
            self._read_entries()
            self._check_error()
            self.curves = list(self._read_curves(settings))
        except InputError as error:
            raise self.file.placed(error) from None

    def get(self, path):
        found = self.file.find(path)
        return found.value if found else ENTRIES[path].default

    def _check_entries(self):
        for one in self.file.assignments:
            entry = ENTRIES.get(one.path)
            if entry is None:
                raise InputError("there is no such parameter."
                                 + did_you_mean(one.path, ENTRIES), one.path)
            value = self.get(one.path)
            if not entry.is_legal(value):
                raise InputError(f"'{value}' is not {entry.legal}.", one.path)

    def _read_entries(self):
        get = self.get
        self.title = get("Title") or self.name
        if not get("Scene file"):
            raise InputError("the chart does not say which scene it is about: "
                             "'set Scene file'.", "Scene file")
        self.scene_file = os.path.normpath(os.path.join(
            os.path.dirname(self.file.path), get("Scene file")))
        if not os.path.isfile(self.scene_file):
            raise InputError(f"there is no scene file '{self.scene_file}'.",
                             "Scene file")
        self.axis_label = get("Axis label")
        self.axis_quantity = get("Axis quantity")
        self.time = get("Time")
        self.repeats = int(get("Repeats"))
        self.repeat_seconds = float(get("Repeat seconds"))
        self.time_limit = float(get("Time limit"))
        self.targets = [float(word) for word
                        in re.split(r"[,\s]+", get("Targets"))]
        self.pictures = words_of(get("Pictures"))
        self.quantity = get("Error/Quantity")
        self.scale = float(get("Error/Scale"))
        self.error_label = get("Error/Label")
        reference = get("Error/Reference")
        self.reference = float(reference) if reference else None

    @property
    def is_error(self):
        """Whether the quantity is an error by itself, against a solution that
        the scene has."""
        return self.reference is None and not self.finer_run

    def _check_error(self):
        if self.reference is not None and self.finer_run:
            raise InputError("there are two references: this value and the "
                             "section 'Finer run'.", "Error/Reference")
        if not self.quantity:
            if not self.is_error:
                raise InputError("of which quantity? 'set Quantity' to a key "
                                 "of summary.json.", "Error/Reference")
            of_errors = [word for word in self.pictures if "error" in word]
            if self.file.find("Pictures") and of_errors:
                raise InputError(f"{of_errors[0]} needs an error: 'set "
                                 "Quantity' in section Error.", "Pictures")
            self.pictures = [word for word in self.pictures
                             if word not in of_errors]
        elif self.is_error and not self.quantity.endswith("_error"):
            raise InputError(
                f"'{self.quantity}' is not an error by itself: give its right "
                "value as Reference, or settings for a run that finds it in "
                "section 'Finer run'.", "Error/Quantity")

    def _read_curves(self, settings):
        of_curves = [one for one in settings if OF_CURVE.match(one.path)]
        check_repeated(of_curves)
        sections = dict.fromkeys(map(section_of, of_curves)) or ["Curve scene"]
        seen = set()
        for section in sections:
            for curve in multiplied(self._read_curve(section, settings)):
                if curve.name in seen:
                    raise InputError(f"two curves are called '{curve.name}'.")
                seen.add(curve.name)
                yield curve

    def _read_curve(self, section, settings):
        own = below(section + "/", settings)
        name = section[len("Curve"):].strip()
        given = {one.path: one for one in own}
        axis, values = given.get("Axis"), given.get("Values")
        curve = ChartCurve(
            name, section,
            below(ALL_CURVES, settings)
            + [one for one in own if one.path not in ("Axis", "Values")],
            words_of(axis.value if axis else self.get("Axis")),
            alternatives(values.value if values else self.get("Values")),
            values.origin if values else self.file.origin("Values"))
        if curve.values == [""]:
            raise InputError(f"the curve '{name}' has no values along its "
                             "axis.", "Values")
        return curve
