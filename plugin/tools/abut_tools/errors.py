# SPDX-License-Identifier: LGPL-2.1-or-later
"""Errors, warnings and command lines as those of the program."""
import argparse
import sys

from .nearest_word import did_you_mean


class InputError(Exception):
    """Something that the user gave is wrong: one error, exit code 2. Who knows
    where the parameter was set places it in front of the message."""

    def __init__(self, message, parameter=""):
        super().__init__(message)
        self.parameter = parameter


def warn(text):
    print(f"abut: warning: {text}", file=sys.stderr)


class Words(argparse.ArgumentParser):
    """The command line of a tool; mistakes are InputErrors."""

    def __init__(self, tool):
        super().__init__(prog=f"abut {tool}", add_help=False,
                         allow_abbrev=False)

    def parse_args(self, words):
        arguments, unknown = self.parse_known_args(words)
        for word in unknown:
            if word.startswith("-"):
                raise InputError(
                    f"'{self.prog}' has no option '{word}'."
                    + did_you_mean(word, self._option_string_actions))
            raise InputError(f"'{self.prog}' takes no '{word}'.")
        return arguments

    def error(self, message):
        raise InputError(f"'{self.prog}': {message}. '{self.prog} --help' "
                         "explains the command.")
