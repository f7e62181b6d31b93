# SPDX-License-Identifier: LGPL-2.1-or-later
"""Entries of the failure atlas. An entry NAME is two scene files, NAME.prm that
fails and NAME.cure.prm, which usually includes the first and changes what cures
it. Comments of fixed form state what is expected of them:

    # failure: ABUT-F06       code that the run must name; `none` where it
                              must not fail and must name none
    # avoids: ABUT-F04        with `failure: none`: the failure that the
                              program never meets; may be left out
    # title: penalty too small
    # done: what was done     may be repeated to go on, like `cure`
    # exit: 0                 exit code of the run; 0 if left out
    # symptom: max_penetration > 0.1
    # symptom: contact_force < 0.5 * cure
    # vary: Method/Penalty = 1; 1e5; 1e10
    # table: condition, linear_iterations

and in the second file

    # cure: what cures it
    # exit: 0
    # symptom: max_penetration < 1e-9

A symptom is a name that RunFigures has a number for, one of < <= = >= >, and a
number, `true`, `false`, `cure` (the same name in the other run) or a number
times `cure`. With `vary` both files are also run with each value of a
parameter, and the report tables the numbers named."""
import math
import operator
import pathlib
import re
from collections import defaultdict
from dataclasses import dataclass, field

from .errors import InputError
from .nearest_word import did_you_mean

CURE = ".cure.prm"
FORM = re.compile(r"(\S+)\s+(<=|>=|<|>|=)\s+(.+)")
OF_CURE = re.compile(r"(?:(\S+)\s*\*\s*)?cure")
RELATIONS = {"<": operator.lt, "<=": operator.le, ">": operator.gt,
             ">=": operator.ge, "=": operator.eq}


def parse_number(text):
    """None if it is not a finite one."""
    try:
        return float(text) if math.isfinite(float(text)) else None
    except ValueError:
        return None


class Symptom:
    """An expected relation between numbers."""

    def __init__(self, text):
        self.text = text  # as written
        form = FORM.fullmatch(text)
        self._factor = None
        if form:
            self.quantity, self._relation, right = form.groups()
            right = right.strip()
            of_cure = OF_CURE.fullmatch(right)
            self._of_cure = bool(of_cure)
            if of_cure:
                right = of_cure.group(1) or "1"
            self._factor = parse_number(
                {"true": "1", "false": "0"}.get(right, right))
        if self._factor is None:
            raise InputError(f"'# symptom: {text}': write NAME < NUMBER, or "
                             "NAME < NUMBER * cure, with one of < <= = >= >.")

    @property
    def expected(self):
        """The relation without the name."""
        return self.text[len(self.quantity) + 1:]

    def holds(self, run, cure):
        """Whether it holds for the figures of the two runs; not for numbers
        that are missing."""
        left, right = run.value(self.quantity), self._factor
        if self._of_cure:
            of = cure.value(self.quantity)
            right = None if of is None else right * of
        if left is None or right is None:
            return False
        if "=" in self._relation and abs(left - right) <= 1e-9 * abs(right):
            return True
        return self._relation != "=" and RELATIONS[self._relation](left, right)


class Remarks:
    """Comments `# word: text` of a scene file, in order."""

    FORM = re.compile(r"#\s*([a-z]+):\s*(.*)")

    def __init__(self, path, words):
        self._path, self._lines = path, defaultdict(list)
        try:
            lines = path.read_text(encoding="utf-8").splitlines()
        except OSError:
            raise InputError(f"cannot read '{path}'.") from None
        for line in lines:
            found = self.FORM.fullmatch(line.strip())
            if not found:
                continue
            word, text = found.groups()
            if word in words:
                self._lines[word].append(text)
            elif did_you_mean(word, words):
                self.complain(f"'# {word}:' is not known."
                              + did_you_mean(word, words))

    def list(self, word):
        return self._lines[word]

    def text(self, word):
        """All lines of a word as one text."""
        return " ".join(self._lines[word])

    def needed(self, word):
        """The same, which must be there."""
        if not self.text(word):
            self.complain(f"a line '# {word}: ...' is missing.")
        return self.text(word)

    def complain(self, message):
        raise InputError(f"{self._path}: {message}")


@dataclass
class AtlasScene:
    """One of the two files of an entry."""
    path: pathlib.Path
    text: str  # what is done there
    exit_code: int
    symptoms: list


@dataclass
class AtlasEntry:
    """Failures are codes; "" is none."""
    name: str
    title: str
    failure: str
    avoided: str  # what it does not meet
    failing: AtlasScene
    cure: AtlasScene
    varied: str = ""  # path of the parameter that is varied
    values: list = field(default_factory=list)  # of it
    table: list = field(default_factory=list)   # numbers for each value

    @property
    def run_names(self):
        return ("failing", "cured") if self.failure else ("first", "second")


def read_scene(path, remarks, text):
    code = parse_number(remarks.text("exit") or "0")
    if code is None:
        remarks.complain(f"'# exit: {remarks.text('exit')}' is not a number.")
    try:
        symptoms = [Symptom(line) for line in remarks.list("symptom")]
    except InputError as error:
        remarks.complain(str(error))
    return AtlasScene(path, remarks.needed(text), int(code), symptoms)


def read_code(remarks, code, codes):
    if code and code != "none" and code not in codes:
        remarks.complain(f"there is no failure '{code}'.")
    return "" if code == "none" else code


def read_entry(path, codes):
    name = path.stem
    failing = Remarks(path, ["failure", "avoids", "title", "done", "exit",
                             "symptom", "vary", "table"])
    failure = read_code(failing, failing.needed("failure"), codes)
    avoided = read_code(failing, failing.text("avoids"), codes)
    if failure and avoided:
        failing.complain("'# avoids:' needs '# failure: none'.")
    title = failing.needed("title")
    scene = read_scene(path, failing, "done")
    varied, values, table = "", [], []
    if failing.text("vary"):
        varied, sign, text = failing.text("vary").partition("=")
        if not sign:
            failing.complain("write '# vary: Section/Name = value; value'.")
        values = [value.strip() for value in text.split(";")]
        table = [key.strip() for key in failing.needed("table").split(",")]
    other = path.with_name(name + CURE)
    cure = Remarks(other, ["cure", "exit", "symptom"])
    return AtlasEntry(name, title, failure, avoided, scene,
                      read_scene(other, cure, "cure"), varied.strip(), values,
                      table)


def read_atlas(path, codes):
    """The entry of a file NAME.prm, or all of a folder in order of code and
    name. Raises InputError for what is missing or cannot be read."""
    if not path.exists():
        raise InputError(f"there is no '{path}'.")
    if not path.is_dir():
        return [read_entry(path, codes)]
    entries = [read_entry(file.with_name(file.name[:-len(CURE)] + ".prm"),
                          codes) for file in path.glob("*" + CURE)]
    if not entries:
        raise InputError(f"no file NAME{CURE} in '{path}'.")
    order = {code: i for i, code in enumerate(codes)}
    return sorted(entries, key=lambda entry: (
        order.get(entry.failure, len(order)), entry.name))
