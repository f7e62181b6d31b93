# SPDX-License-Identifier: LGPL-2.1-or-later
"""What a run has written: summary, parameters, tables and fields."""
import csv
import functools
import json
import math
import pathlib
import re
import xml.etree.ElementTree

import numpy

from .errors import InputError
from .vtu import read_mesh


class RunFolder:
    """The output folder of a run, finished or not."""

    def __init__(self, path):
        self.path = pathlib.Path(path)
        if not self.path.is_dir():
            raise InputError(f"'{path}' is not a folder.")
        if not any((self.path / name).is_file()
                   for name in ("run.json", "parameters.json", "summary.json")):
            raise InputError(f"'{path}' is not the output folder of a run: "
                             "run.json and summary.json are missing.")

    @functools.cached_property
    def record(self):
        """run.json: how the run was started and how it ended; empty where the
        file is missing."""
        return self._json("run.json") if self.has("run.json") else {}

    @functools.cached_property
    def is_finished(self):
        """Whether summary.json is of this run; False: the run was killed or
        refused, or it is still running."""
        return self.has("summary.json") and self.record.get("has_results", True)

    @functools.cached_property
    def summary(self):
        """Figures of the run; empty without summary.json."""
        return self._json("summary.json") if self.is_finished else {}

    @functools.cached_property
    def input(self):
        """parameters.json: scene, file, kind, dimension, parameters; empty
        where the file is missing."""
        name = "parameters.json"
        return self._json(name) if (self.path / name).is_file() else {}

    @property
    def name(self):
        """Of the scene."""
        return self.title[0]

    @property
    def title(self):
        """The title of the scene or the name of its file, and where in the
        folder that is from."""
        for text, of in (
                (self.parameter("Title"), "parameters.json#/parameters/Title/value"),
                (self.summary.get("title"), "summary.json#/title"),
                (self.input.get("scene"), "parameters.json#/scene"),
                (self.record.get("scene_file"), "run.json#/scene_file"),
                (self.summary.get("scene"), "summary.json#/scene")):
            if text:
                return text, of
        return self.path.name, "files"

    @property
    def kind(self):
        return self.input.get("kind", "")

    @property
    def parameters(self):
        """By path: value, default, given (set by the user), origin."""
        return self.input.get("parameters", {})

    def parameter(self, path, otherwise=""):
        """Value of a parameter, a text."""
        found = self.parameters.get(path)
        return found["value"] if found else otherwise

    def number(self, path, otherwise=math.nan):
        try:
            return float(self.parameter(path))
        except ValueError:
            return otherwise

    def numbers(self, path):
        """The numbers of a parameter."""
        return [float(word) for word in
                re.split(r"[\s,;]+", self.parameter(path)) if word]

    def sections(self, beginning):
        """Names of the sections `beginning 1`, `beginning 2`, ..."""
        found = {path.split("/")[0] for path in self.parameters
                 if re.fullmatch(beginning + r" \d+", path.split("/")[0])}
        return sorted(found, key=lambda name: int(name.split()[-1]))

    def has(self, name):
        return (self.path / name).is_file()

    def table(self, name):
        """The columns of read_table(); None where the file is missing."""
        return read_table(self.path / name) if self.has(name) else None

    def pairs(self):
        """The tables pair_1.csv, pair_2.csv, ... by number."""
        found = {int(path.stem[5:]): self.table(path.name)
                 for path in self.path.glob("pair_*.csv")
                 if path.stem[5:].isdigit()}
        return dict(sorted(found.items()))

    def fields(self, name):
        """Times and files of the series NAME.pvd, in order; files that are
        missing are left out."""
        try:
            tree = xml.etree.ElementTree.parse(self.path / f"{name}.pvd")
        except FileNotFoundError:
            return []
        except xml.etree.ElementTree.ParseError as error:
            raise InputError(f"{self.path / name}.pvd is not complete: {error}."
                             ) from error
        found = [(float(entry.get("timestep")), self.path / entry.get("file"))
                 for entry in tree.iter("DataSet")]
        return [(time, file) for time, file in found if file.is_file()]

    def last_field(self, name):
        """The last step of a series as a Mesh; None if there is none."""
        files = self.fields(name)
        return read_mesh(files[-1][1]) if files else None

    def _json(self, name):
        try:
            return json.loads((self.path / name).read_text(encoding="utf-8"))
        except ValueError as error:
            raise InputError(f"{self.path / name} is not complete: {error}."
                             ) from error


def read_table(path):
    """Columns of a CSV file by name, as arrays of numbers (NaN where a place is
    empty) or of texts. Rows that a killed run has left half written are left
    out."""
    with open(path, encoding="utf-8", newline="") as file:
        names, *rows = list(csv.reader(file)) or [[]]
    rows = [row for row in rows if len(row) == len(names)]
    return {column: _column([row[i] for row in rows])
            for i, column in enumerate(names)}


def _column(texts):
    try:
        return numpy.array([float(text) if text else math.nan
                            for text in texts])
    except ValueError:
        return numpy.array(texts)
