# SPDX-License-Identifier: LGPL-2.1-or-later
"""Files in deal.II's syntax (subsection, set, end, include, comments, lines
continued by a backslash), read so that each value has the file and line that
set it."""
import pathlib
from typing import NamedTuple

from .errors import InputError
from .nearest_word import did_you_mean


class Assignment(NamedTuple):
    """`set Name = value` of a file or of the command line."""
    path: str    # Section/Subsection/Name
    value: str
    origin: str  # file:line, or the option


def squeezed(text):
    """Without blanks at both ends and with single blanks within."""
    return " ".join(text.split())


class ParameterFile:
    """The assignments of a file and of the option --set, in order."""

    def __init__(self, path, overrides=()):
        self.path = str(path)
        self.name = pathlib.Path(path).stem
        self.assignments = []
        self._read(self.path, 0)
        for text in overrides:
            path, sign, value = text.partition("=")
            if not sign:
                raise InputError(f'--set "{text}": write --set '
                                 '"Section/Name=value".')
            path = "/".join(squeezed(word) for word in path.split("/"))
            self.assignments.append(
                Assignment(path, value.strip(), f'--set "{text}"'))

    def _read(self, name, depth):
        try:
            with open(name, encoding="utf-8", errors="replace") as file:
                lines = list(file)
        except OSError:
            raise InputError(f"cannot read the file '{name}'.") from None
        if depth > 10:
            raise InputError(f"{name}: files include each other without end.")
        sections, continued, number = [], "", 0
        for number, line in enumerate(lines, 1):
            line = (continued + line.partition("#")[0]).strip()
            continued = line[:-1] if line.endswith("\\") else ""
            if line and not line.endswith("\\"):
                self._read_line(line, name, number, sections, depth)
        if sections:
            raise InputError(f"{name}:{number}: the file ends within "
                             f"subsection '{sections[-1]}': an 'end' is "
                             "missing.")

    def _read_line(self, line, file, number, sections, depth):
        place = f"{file}:{number}"
        keyword, rest = (line.split(None, 1) + [""])[:2]
        command = keyword.lower()
        if command == "subsection":
            sections.append(squeezed(rest))
        elif command == "end":
            if not sections:
                raise InputError(f"{place}: 'end' without 'subsection'.")
            sections.pop()
        elif command == "include":
            self._read(str(pathlib.Path(file).parent / squeezed(rest)),
                       depth + 1)
        elif command == "set":
            name, sign, value = rest.partition("=")
            if not sign:
                raise InputError(f"{place}: 'set' without '=': {line}")
            self.assignments.append(Assignment(
                "/".join([*sections, squeezed(name)]), value.strip(), place))
        else:
            words = ["set", "subsection", "end", "include"]
            raise InputError(f"{place}: '{keyword}' is not a word of a scene "
                             "file." + did_you_mean(keyword, words))

    def find(self, path):
        """The assignment of a parameter that counts, the last one, or None."""
        found = [one for one in self.assignments if one.path == path]
        return found[-1] if found else None

    def origin(self, path):
        """File and line that set it, the option, or the file alone."""
        found = self.find(path)
        return found.origin if found else self.path

    def placed(self, error):
        """The error with the place of its parameter in front."""
        if not error.parameter:
            return error
        return InputError(f"{self.origin(error.parameter)}: {error.parameter}: "
                          f"{error}")

    def extract(self, wanted):
        """Take out the assignments of the paths that `wanted` accepts."""
        found = [one for one in self.assignments if wanted(one.path)]
        self.assignments = [one for one in self.assignments
                            if not wanted(one.path)]
        return found
