# SPDX-License-Identifier: LGPL-2.1-or-later
"""Runs of the program on one rank and one thread, each in a process of its
own."""
import math
import os
import pathlib
import signal
import subprocess
from typing import NamedTuple

from .served import Served


def serial_environment():
    """This environment without what MPI's start has put into it, and with one
    thread."""
    kept = {name: value for name, value in os.environ.items()
            if not name.startswith(("PMI", "OMPI_"))
            or name.startswith("OMPI_ALLOW_RUN_AS_ROOT")}
    return {**kept, "DEAL_II_NUM_THREADS": "1", "OMP_NUM_THREADS": "1"}


def this_program():
    """The program that has started this tool."""
    return os.environ["ABUT_PROGRAM"]


class Ending(NamedTuple):
    """How a run has ended."""
    code: int                  # exit code, or minus the signal
    out_of_time: bool = False  # ended at its limit


class SerialProgram:
    def __init__(self, path):
        self.path = str(path)
        self._served = Served(path, serial_environment())

    def run(self, words, log, limit):
        """Run the program with these words. It prints into a file and may take
        so many processor seconds (rounded up), or ten times as many on the
        wall."""
        pathlib.Path(log).unlink(missing_ok=True)
        try:
            code = self._served.code(words, ".", 10 * limit, [log, log],
                                     seconds=math.ceil(limit))
        except subprocess.TimeoutExpired:
            return Ending(-signal.SIGKILL, True)
        return Ending(code, code == -signal.SIGXCPU)

    def ask(self, *words):
        """Run it to see what it prints: code, output and errors."""
        return self._served.run(words)
