# SPDX-License-Identifier: LGPL-2.1-or-later
"""GetFEM through its Python interface, in a process of its own."""
import functools
import json
import os
import subprocess
import sys

import process

PROGRAM = os.path.join(os.path.dirname(os.path.abspath(__file__)),
                       "getfem_program.py")
METHODS = ["lagrange", "penalty"]


@functools.lru_cache
def interpreter():
    """An interpreter that has GetFEM (packages come with /usr/bin/python3)."""
    for python in (sys.executable, "/usr/bin/python3"):
        try:
            if subprocess.run([python, "-c", "import getfem, numpy"],
                              capture_output=True).returncode == 0:
                return python
        except OSError:
            pass
    return None


def version():
    """Name and version, or None if it is not installed."""
    if not interpreter():
        return None
    text = subprocess.run(["dpkg-query", "-W", "-f", "${Version}",
                           "python3-getfem"], capture_output=True, text=True)
    return "GetFEM " + text.stdout.split("+")[0]


def run(problem, method, folder, kappa=1.0, **limits):
    """The answer with wall time, memory and iterations."""
    given = os.path.join(folder, "problem.json")
    with open(given, "w") as file:
        json.dump(problem, file)
    found = os.path.join(folder, "answer.json")
    measured = process.run(
        [interpreter(), PROGRAM, given, found, method, str(kappa)], folder,
        "log", **limits)
    with open(found) as file:
        answer = json.load(file)
    answer["pressure"] = {int(node): value
                          for node, value in answer["pressure"].items()}
    answer.update(measured)
    return answer
