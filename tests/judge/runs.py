# SPDX-License-Identifier: LGPL-2.1-or-later
"""Runs of the program within limits, and scenes cut to a small size."""
import os
import pathlib
import re
import resource
import signal
import subprocess
import tempfile

from scene import Scene

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
MOST_UNKNOWNS = 2000
WAITING = 15  # real by processor time, on a machine with other work
MEMORY = 6 * 2**30
# What the judge needs.
QUIET = {"Output/Nodal values": "true", "Output/Pictures": "false",
         "Output/Fields": "true"}


def base_scenes():
    """Scenes of prm/ that the judge knows, by name."""
    result = {}
    for path in sorted((ROOT / "prm").glob("*.prm")):
        if Scene(path).get("Scene", "obstacle") in ("solid", "obstacle"):
            result[path.name] = path
    return result


def limits(seconds, memory):
    """What a child does before it becomes the program."""
    def of_child():
        resource.setrlimit(resource.RLIMIT_CPU, (seconds, seconds + 2))
        if memory:
            resource.setrlimit(resource.RLIMIT_AS, (memory, memory))
        os.setsid()
    return of_child


def run(words, seconds, folder, memory=MEMORY):
    """Exit code ("time" if it took too long), and what it printed as output
    and as errors."""
    environment = dict(os.environ, OMP_NUM_THREADS="1",
                       DEAL_II_NUM_THREADS="1", OMPI_ALLOW_RUN_AS_ROOT="1",
                       OMPI_ALLOW_RUN_AS_ROOT_CONFIRM="1")
    with open(folder / "stdout", "w+", encoding="utf-8",
              errors="replace") as output, open(
                  folder / "stderr", "w+", encoding="utf-8",
                  errors="replace") as errors:
        child = subprocess.Popen(
            list(map(str, words)), stdout=output, stderr=errors, cwd=folder,
            env=environment, preexec_fn=limits(seconds, memory))
        try:
            code = child.wait(WAITING * seconds)
        except subprocess.TimeoutExpired:
            os.killpg(child.pid, signal.SIGKILL)
            child.wait()
            code = "time"
        output.seek(0)
        errors.seek(0)
        texts = output.read(), errors.read()
    if code in (-signal.SIGXCPU, -signal.SIGKILL):
        code = "time"
    return code, *texts


def words_of(abut, scene, ranks, overrides=()):
    """The command of a run into the folder `out`."""
    words = [abut, "run", scene, "--output", "out", "--quiet"]
    for name, value in overrides:
        words += ["--set-if-used", f"{name}={value}"]
    return (["mpirun", "--oversubscribe", "-n", ranks] if ranks > 1
            else []) + words


def small(level):
    """Values that cut a scene down to a level."""
    return {"Refinement/Level": level,
            "Refinement/Coarsest level": max(0, level - 1),
            "Refinement/Adaptive cycles": 0}


def find_level(abut, path, overrides=(), most=MOST_UNKNOWNS):
    """A level of a scene, not finer than its own, on which it has no more than
    so many unknowns: from their number on a coarse one, by `abut check`."""
    overrides = dict(overrides)
    scene = Scene(path)
    kind = scene.get("Scene", "obstacle")
    own = int(overrides.get("Refinement/Level") or scene.get(
        "Refinement/Level", "2" if kind == "solid" else "5"))
    level = min(own, 1)
    words = [abut, "check", path]
    for name, value in {**overrides, **small(level)}.items():
        words += ["--set-if-used", f"{name}={value}"]
    with tempfile.TemporaryDirectory(prefix="abut-level-") as folder:
        code, output, _ = run(words, 60, pathlib.Path(folder))
    found = re.search(r"^ *dofs +(\d+)", output, re.MULTILINE)
    if code != 0 or not found:
        return level
    # each level has a little less than 2^dim times as many
    factor = 2**int(scene.get("Dimension", "2"))
    unknowns = int(found[1]) * factor
    while level < own and unknowns <= most:
        level, unknowns = level + 1, unknowns * factor
    return level
