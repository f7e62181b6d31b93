# SPDX-License-Identifier: LGPL-2.1-or-later
"""Runs of the program within limits, and scenes cut to a small size."""
import math
import multiprocessing
import os
import pathlib
import re
import resource
import signal
import subprocess
import sys
import tempfile

from scene import Scene

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
sys.path.insert(0, str(ROOT / "plugin/tools"))
from abut_tools.served import Served  # noqa: E402

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
        scene = Scene(path)
        if has_mesh(scene) or scene.get("Scene") == "motion":
            result[path.name] = path
    return result


def environment():
    return dict(os.environ, OMP_NUM_THREADS="1", DEAL_II_NUM_THREADS="1",
                OMPI_ALLOW_RUN_AS_ROOT="1", OMPI_ALLOW_RUN_AS_ROOT_CONFIRM="1")


# Programs that are loaded once, by what they stand for.
STAND_INS = {}


def stand_in(abut, served):
    """Runs of `abut` on one rank are those of a program that is loaded once;
    said before processes are forked, each of which has its own."""
    if served:
        STAND_INS[str(abut)] = Served(served.resolve(), environment())


def in_pools(trial, cases, jobs, ranks_of):
    """Results of the cases as they come, so many at once. Ranks wait for each
    other in loops, and far longer beside other ranks: what runs on several comes
    last, and has the processors for itself."""
    cases = list(cases)
    for several in False, True:
        part = [case for case in cases if (ranks_of(case) > 1) == several]
        with multiprocessing.Pool(max(1, jobs // 2) if several
                                  else jobs) as pool:
            yield from pool.imap_unordered(trial, part)


def has_mesh(scene):
    """Whether a scene has what cuts it to a size, and fields."""
    return scene.get("Scene", "obstacle") in ("solid", "obstacle")


def limits(seconds, memory):
    """What a child does before it becomes the program."""
    def of_child():
        resource.setrlimit(resource.RLIMIT_CPU, (seconds, seconds + 2))
        if memory:
            resource.setrlimit(resource.RLIMIT_AS, (memory, memory))
        os.setsid()
    return of_child


def code_of(words, seconds, folder, memory, texts):
    """Exit code of a run that writes output and errors into these files."""
    if words[0] in STAND_INS:
        return STAND_INS[words[0]].code(words[1:], folder, WAITING * seconds,
                                        texts, seconds, memory or 0)
    with open(texts[0], "wb") as output, open(texts[1], "wb") as errors:
        child = subprocess.Popen(
            words, stdout=output, stderr=errors, cwd=folder,
            env=environment(), preexec_fn=limits(seconds, memory))
        try:
            return child.wait(WAITING * seconds)
        except subprocess.TimeoutExpired:
            os.killpg(child.pid, signal.SIGKILL)
            child.wait()
            raise


def run(words, seconds, folder, memory=MEMORY):
    """Exit code ("time" if it took too long), and what it printed as output
    and as errors."""
    texts = [folder / name for name in ("stdout", "stderr")]
    try:
        code = code_of(list(map(str, words)), seconds, folder, memory, texts)
    except subprocess.TimeoutExpired:
        code = "time"
    # mpirun tells of its children's signals as shells do.
    if code in (-signal.SIGXCPU, -signal.SIGKILL, 128 + signal.SIGXCPU):
        code = "time"
    return code, *(text.read_text(encoding="utf-8", errors="replace")
                   for text in texts)


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


def n_steps(scene):
    """Load or time steps of a scene."""
    if scene.get("Time stepping/Scheme", "quasi-static") == "quasi-static":
        return scene.number("Time stepping/Number of steps", 1.)
    step = scene.number("Time stepping/Step size", 0.)
    return scene.number("Time stepping/End time", 1.) / step if step > 0 else 1.


def shorten(scene, part):
    """Cut a scene to the first part of its motion."""
    steps = max(1, round(part * n_steps(scene)))
    if scene.get("Time stepping/Scheme", "quasi-static") == "quasi-static":
        end = scene.number("Time stepping/End time", 1.)
        end *= steps / n_steps(scene)
        scene.values["Time stepping/End time"] = f"{end:.12g}"
        scene.values["Time stepping/Number of steps"] = str(steps)
    else:
        step = scene.number("Time stepping/Step size", 0.)
        scene.values["Time stepping/End time"] = f"{steps * step:.12g}"


def unknowns_of(abut, path, overrides, level):
    """On a level, by `abut check`, or None."""
    words = [abut, "check", path]
    for name, value in {**overrides, **small(level)}.items():
        words += ["--set-if-used", f"{name}={value}"]
    with tempfile.TemporaryDirectory(prefix="abut-level-") as folder:
        code, output, _ = run(words, 60, pathlib.Path(folder))
    found = re.search(r"^ *dofs +(\d+)", output, re.MULTILINE)
    return int(found[1]) if code == 0 and found else None


def find_size(abut, path, overrides=(), most=MOST_UNKNOWNS):
    """A level of a scene, not finer than its own, on which it has no more than
    so many unknowns, from their number on a coarse one; and this number, 0 of
    what has no mesh."""
    overrides = dict(overrides)
    scene = Scene(path)
    if not has_mesh(scene):
        return 0, 0
    kind = scene.get("Scene", "obstacle")
    own = int(overrides.get("Refinement/Level") or scene.get(
        "Refinement/Level", "2" if kind == "solid" else "5"))
    level = min(own, 1)
    unknowns = unknowns_of(abut, path, overrides, level)
    if unknowns is None:
        return level, 0
    # each level has a little less than 2^dim times as many
    dim = int(scene.get("Dimension", "2"))
    while level < own and unknowns * 2**dim <= most:
        level, unknowns = level + 1, unknowns * 2**dim
    while level > 0 and unknowns > most:
        level, unknowns = level - 1, unknowns / 2**dim
    return level, unknowns


def cost_of_motion(scene):
    """Steps of a scene, in space four times as many."""
    return n_steps(scene) * (4 if scene.get("Dimension", "2") == "3" else 1)


def find_cut(abut, path, most=MOST_UNKNOWNS, cost=math.inf):
    """A level of a scene as find_size() gives it, and the part of its motion
    that it comes through at this cost, unknowns times cost_of_motion(). Coarser
    meshes come before shorter motions."""
    steps = cost_of_motion(Scene(path))
    level, unknowns = find_size(abut, path, most=min(most, cost / steps))
    return level, min(1., cost / (unknowns * steps)) if unknowns else 1.
