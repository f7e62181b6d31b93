# SPDX-License-Identifier: LGPL-2.1-or-later
"""Errors, warnings and command lines as those of the program."""
import argparse
import sys


class InputError(Exception):
    """Something that the user gave is wrong: one error, exit code 2."""


def warn(text):
    print(f"abut: warning: {text}", file=sys.stderr)


class Words(argparse.ArgumentParser):
    """The command line of a tool; mistakes are InputErrors."""

    def __init__(self, tool):
        super().__init__(prog=f"abut {tool}", add_help=False,
                         allow_abbrev=False)

    def error(self, message):
        raise InputError(f"'{self.prog}': {message}. '{self.prog} --help' "
                         "explains the command.")
