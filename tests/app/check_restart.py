# SPDX-License-Identifier: LGPL-2.1-or-later
"""Runs that are killed or stopped, and resumed: the results of a run that was
left alone; and what is refused. Part 1: on one rank; part 2: on two, or from one
on to two. A short run ends bodies, a membrane and a bar on its way once each by
each signal."""
import ctypes
import os
import pathlib
import shutil
import signal
import subprocess
import sys
import time

from block_scene import section
from program import Program

p = Program()
sys.path.insert(0, str(p.source / "tests" / "bench"))
sys.path.insert(0, str(p.source / "tests" / "scenes"))
import kill_and_resume  # noqa: E402

SECONDS = 600
OUT = p.folder / "out"
EVERY = section("Checkpoint", "Every steps = 1")
BODIES = (p.source / "tests/bench/restart/rolling-press.prm").read_text()
MEMBRANE = (p.source / "tests/bench/restart/creeping-front.prm").read_text()


def words(scene, *more, settings=()):
    result = ["run", scene, "--output", "out", "--quiet", *more]
    for setting in settings:
        result += ["--set", setting]
    return result


def ranked(command, ranks):
    if ranks == 1:
        return command
    # Time for a checkpoint between SIGTERM and SIGKILL. mpirun waits all of it,
    # twice, after a rank has ended with a code of its own.
    return ["mpirun", "--mca", "odls_base_sigkill_timeout", "1",
            "--oversubscribe", "-n", str(ranks)] + command


def run(scene, *more, settings=(), ranks=1, seconds=SECONDS):
    """To its end."""
    command = words(scene, *more, settings=settings)
    if ranks == 1:
        return p.call(*command, timeout=seconds)
    return subprocess.run(ranked([p.abut, *command], ranks), cwd=p.folder,
                          text=True, capture_output=True, timeout=seconds)


def checkpoints():
    """Numbers of the checkpoints in the folder."""
    return sorted(int(path.suffix[1:]) for path in OUT.glob("checkpoint.*")
                  if path.suffix[1:].isdigit())


def interrupt(scene, number, how, settings=(), ranks=1, more=()):
    """Send a signal once there is a checkpoint of that number or a later one;
    returns the process, which has ended."""
    command = ranked([p.abut, *words(scene, *more, settings=settings)], ranks)
    process = subprocess.Popen(command, cwd=p.folder, text=True,
                               stdout=subprocess.PIPE, stderr=subprocess.PIPE)
    end = time.monotonic() + SECONDS
    while process.poll() is None and time.monotonic() < end:
        if checkpoints() and checkpoints()[-1] >= number:
            break
        time.sleep(0.002)
    kill_and_resume.stop(process, how)
    process.output = process.communicate(timeout=SECONDS)
    return process


def alone(scene, settings=(), ranks=1):
    """Results of the run that is left alone."""
    shutil.rmtree(OUT, ignore_errors=True)
    result = run(scene, settings=settings, ranks=ranks)
    p.expect(result.returncode == 0, f"{scene}: {result.stderr}")
    p.expect(not list(OUT.glob("checkpoint*")),
             "checkpoints are left after the end")
    expected = kill_and_resume.results(OUT)
    shutil.rmtree(OUT)
    return expected


def expect_same(expected, what):
    for line in kill_and_resume.compare(expected, kill_and_resume.results(OUT),
                                        1e-12, what):
        p.expect(False, line)
    shutil.rmtree(OUT)


def killed(scene, number, expected, settings=(), ranks=1):
    what = f"{scene} killed after {number}, {ranks} ranks"
    process = interrupt(scene, number, signal.SIGKILL, settings, ranks)
    p.expect(process.returncode != 0, f"{what}: ended before it was killed")
    result = run(scene, "--resume", settings=settings, ranks=ranks)
    p.expect(result.returncode == 0, f"{what}: {result.stderr}")
    expect_same(expected, what)


def stopped(scene, number, how, expected, settings=(), ranks=1):
    """Stopped twice: once after it was resumed, too."""
    what = f"{scene} {how.name} after {number}, {ranks} ranks"
    process = interrupt(scene, number, how, settings, ranks)
    p.expect(process.returncode == 4,
             f"{what}: exit code {process.returncode} {process.output}")
    p.expect(len(checkpoints()) == 1, f"{what}: checkpoints {checkpoints()}")
    process = interrupt(scene, number + 2, how, settings, ranks, ["--resume"])
    p.expect(process.returncode == 4,
             f"{what}, again: exit code {process.returncode} {process.output}")
    result = run(scene, "--resume", settings=settings, ranks=ranks)
    p.expect(result.returncode == 0, f"{what}: {result.stderr}")
    expect_same(expected, what)


def refused(scene, *texts, settings=()):
    """--resume ends with one error and changes no file."""
    before = {path: path.read_bytes() for path in OUT.rglob("*")
              if path.is_file()}
    result = run(scene, "--resume", settings=settings)
    p.expect_error(result, *texts)
    after = {path: path.read_bytes() for path in OUT.rglob("*")
             if path.is_file()}
    p.expect(before == after, f"files changed by a refused --resume: {texts}")


def is_locked_by(pid):
    """The file is there before it is locked; it is signed when it is."""
    try:
        return f"process {pid} " in (OUT / ".abut-lock").read_text()
    except FileNotFoundError:
        return False


def check_refusals(scene, settings):
    shutil.rmtree(OUT, ignore_errors=True)
    refused(scene, "no checkpoint", settings=settings)
    interrupt(scene, 2, signal.SIGTERM, settings)
    checkpoint = OUT / f"checkpoint.{checkpoints()[-1]}"

    refused(scene, "Method/Complementarity parameter was '1' and is '2'",
            settings=[*settings, "Method/Complementarity parameter=2"])
    file = checkpoint / "rank.0"
    good = file.read_bytes()
    for bad in (good[:-1], good[:100] + b"x" + good[101:], b""):
        file.write_bytes(bad)
        refused(scene, "damaged", checkpoint.name, settings=settings)
    file.unlink()
    refused(scene, "damaged", settings=settings)
    file.write_bytes(good)

    # A run in this folder: another one is refused, with --resume or without.
    process = subprocess.Popen(
        [p.abut, *words(scene, "--resume", settings=settings)], cwd=p.folder,
        stdout=subprocess.DEVNULL)
    while process.poll() is None and not is_locked_by(process.pid):
        time.sleep(0.002)
    process.send_signal(signal.SIGSTOP)  # however fast it is
    for more in ((), ("--resume",)):
        p.expect_error(run(scene, *more, settings=settings), "another run",
                       f"process {process.pid}", "--output")
    process.send_signal(signal.SIGCONT)
    p.expect(process.wait() == 0, "the run that had the folder")
    p.expect(not (OUT / ".abut-lock").exists(), "the lock is left")
    shutil.rmtree(OUT)


def check_other_ranks(scene, expected, settings=()):
    interrupt(scene, 3, signal.SIGKILL, settings)
    result = run(scene, "--resume", settings=settings, ranks=2)
    p.expect(result.returncode == 0, f"on two ranks: {result.stderr}")
    # Adaptive meshes may differ in a few cells where errors are nearly equal.
    for line in kill_and_resume.compare_coarsely(
            expected, kill_and_resume.results(OUT), 1e-5, "on two ranks"):
        p.expect(False, line)
    shutil.rmtree(OUT)


def check_new_begin(scene, expected, settings):
    """Without --resume a run begins anew, whatever is in the folder."""
    interrupt(scene, 3, signal.SIGKILL, settings)
    p.expect(len(checkpoints()) > 0, "a checkpoint of the first run")
    result = run(scene, settings=settings)
    p.expect(result.returncode == 0, f"begun anew: {result.stderr}")
    p.expect(not list(OUT.glob("checkpoint*")), "old checkpoint is left")
    expect_same(expected, "begun anew")


def check_left_semaphores():
    """A run that was killed while MPI wrote its mesh leaves semaphores of Open MPI
    with the names of the files, which nobody ever frees."""
    library = ctypes.CDLL(None)
    library.sem_open.restype = ctypes.c_void_p
    names = [f"OMPIO_{name}".encode()
             for name in ("mesh", "mesh_fixed.data", "mesh_variable.data")]
    for name in names:
        library.sem_unlink(name)
        p.expect(library.sem_open(name, os.O_CREAT, 0o600, 0), f"{name} is ours")
    try:
        result = run(bodies, settings=steps, seconds=60)
        p.expect(result.returncode == 0, f"semaphores are left: {result.stderr}")
        interrupt(bodies, 2, signal.SIGTERM, steps)
        result = run(bodies, "--resume", settings=steps, seconds=60)
        p.expect(result.returncode == 0, f"resumed: {result.stderr}")
    except subprocess.TimeoutExpired:
        p.expect(False, "the run waits for a semaphore of one that was killed")
    finally:
        for name in names:
            library.sem_unlink(name)
    shutil.rmtree(OUT)


bodies = p.write("bodies.prm", BODIES)
membrane = p.write("membrane.prm", MEMBRANE)
steps = ["Time stepping/Number of steps=8", "Refinement/Level=3"]
cycles = ["Refinement/Adaptive cycles=6", "Refinement/Refine fraction=0.4"]


def check_one_rank():
    expected = alone(bodies, steps)
    for number in (1, 5):
        killed(bodies, number, expected, steps)
    stopped(bodies, 2, signal.SIGTERM, expected, steps)
    stopped(bodies, 3, signal.SIGINT, expected, steps)
    check_refusals(bodies, steps)
    check_new_begin(bodies, expected, steps)
    # One checkpoint less often: the step in work is lost, no figure.
    killed(bodies, 1, expected, [*steps, "Checkpoint/Every steps=3"])


def check_two_ranks(name, settings):
    check_other_ranks(name, alone(name, settings), settings)
    expected = alone(name, settings, ranks=2)
    killed(name, 4, expected, settings, ranks=2)
    stopped(name, 2, signal.SIGTERM, expected, settings, ranks=2)


def check_target():
    """To a target error, and in three dimensions."""
    target = ["Refinement/Target error=0.05", "Refinement/Refine fraction=0.4",
              "Refinement/Coarsest level=2"]
    expected = alone(membrane, target)
    killed(membrane, 3, expected, target)


def check_disc():
    """A disc from a file: resumed, refinement goes on along the circle, on two
    ranks too, whose mesh p4est has made anew."""
    corners = [(x * r, y * r) for r in (0.4, 0.5**0.5)
               for x, y in ((-1, -1), (1, -1), (1, 1), (-1, 1))]
    cells = [(1, 2, 3, 4), *((k + 1, k + 5, (k + 1) % 4 + 5, (k + 1) % 4 + 1)
                             for k in range(4))]
    p.write("disc.inp", f"8 {len(cells)} 0 0 0\n"
            + "".join(f"{i} {x!r} {y!r} 0\n"
                      for i, (x, y) in enumerate(corners, start=1))
            + "".join(f"{i} 0 quad {' '.join(map(str, cell))}\n"
                      for i, cell in enumerate(cells, start=1)))
    file = ["Mesh/Generator=", "Mesh/Arguments=", "Mesh/File=disc.inp", *cycles]
    disc = [*file, "Mesh/Curved sides=0: circle: 0, 0"]
    expected = alone(membrane, disc)
    killed(membrane, 3, expected, disc)
    check_other_ranks(membrane, expected, disc)
    chords = alone(membrane, file)
    p.expect(kill_and_resume.compare_coarsely(expected, chords, 1e-3, ""),
             "a disc as a square")


def check_files():
    """Files that parameters name count with their content."""
    mesh = p.source / "prm/slotted-block.inp"
    shutil.copy(mesh, p.folder)
    slot = p.write("slot.prm", (p.source / "prm/self-contact.prm").read_text()
                   + EVERY)
    few = ["Refinement/Level=2", "Time stepping/Number of steps=6"]
    interrupt(slot, 2, signal.SIGTERM, few)
    p.write(mesh.name, mesh.read_text() + "\n")
    refused(slot, "content of Body 1/Mesh/File was", settings=few)
    shutil.copy(mesh, p.folder)
    p.expect(run(slot, "--resume", settings=few).returncode == 0, "the old mesh")


def check_motion():
    """A bar on its way, in contact and on its way back: velocities and
    accelerations go on, too."""
    bar = p.write("bar.prm", (p.source / "prm/bar-impact.prm").read_text()
                  + EVERY)
    short = ["Obstacle 1/Expression=-0.05", "Time stepping/End time=0.12", "Output/Every=4",
             "Body 1/Mesh/Arguments=10, 1 : 0, 0 : 1, 1 : true"]
    expected = alone(bar, short)
    for number in p.some((9, 1)):
        killed(bar, number, expected, short)
    stopped(bar, 3, signal.SIGINT, expected, short)


def check_driven():
    """A mass on its way into a bar, and a ball that is pressed deeper in load
    steps: place, velocity and stiffness of obstacles go on, too."""
    for name, more in (
            ("struck-bar", ["Body 1/Mesh/Arguments=10, 1 : 0, 0 : 1, 1 : true",
                            "Time stepping/Step size=0.02", "Time stepping/End time=1.2",
                            "Output/Every=20"]),
            ("pressed-ball", ["Time stepping/Number of steps=24", "Refinement/Level=3",
                              "Refinement/Adaptive cycles=0"])):
        scene = p.write(name + ".prm",
                        (p.source / f"prm/{name}.prm").read_text() + EVERY)
        expected = alone(scene, more)
        killed(scene, 5, expected, more)
        stopped(scene, 3, signal.SIGTERM, expected, more)


def check_string():
    """A string that is lifted off a floor that falls: what the floor has worked
    goes on, too."""
    string = p.write("string.prm",
                     (p.source / "prm/lifted-string.prm").read_text() + EVERY)
    short = ["Membrane/Prescribed displacement=0: 0", "Membrane/Body force=-4",
             "Contact/Obstacle=-t^2/2", "Time stepping/Step size=0.05", "Output/Every=4",
             "Output/Pictures=false", "Exact solution/Displacement=",
             "Exact solution/Gradient="]
    expected = alone(string, short)
    killed(string, 9, expected, short)
    stopped(string, 3, signal.SIGTERM, expected, short)


def check_large_strain():
    """A disc on its way into rubber, whose points move: the steps that were cut
    back, what was extrapolated and the rows' places go on, too."""
    disc = p.write("disc.prm", (p.source / "prm/finite-disc.prm").read_text()
                   + EVERY)
    coarse = ["Refinement/Level=3", "Time stepping/Maximum Newton iterations=5",
              "Time stepping/Number of steps=6"]
    expected = alone(disc, coarse)
    killed(disc, 4, expected, coarse)
    stopped(disc, 2, signal.SIGTERM, expected, coarse)


def check_large_motion():
    """A soft ring on its way, in contact and off again, in time: velocities,
    pressures at points that move, and steps that were halved go on."""
    ring = p.write("ring.prm", (p.source / "prm/ring-impact.prm").read_text()
                   + EVERY)
    short = ["Time stepping/End time=0.8", "Time stepping/Step size=0.04", "Output/Every=4",
             "Output/Pictures=false", "Body 1/Mesh/Arguments="
             "0, 1.02 : 0.8 : 1 : 16 : true"]
    expected = alone(ring, short)
    killed(ring, 9, expected, short)
    stopped(ring, 3, signal.SIGTERM, expected, short)


def check_rolling():
    """A disc that rolls in a ring: in the middle of a motion slips are measured
    from where the last step has ended, not from where the next one leads."""
    disc = p.write("disc.prm", (p.source / "prm/rolling-disc.prm").read_text()
                   + EVERY)
    short = ["Time stepping/End time=0.15", "Time stepping/Step size=0.01", "Output/Every=4",
             "Output/Pictures=false", "Refinement/Level=2",
             "Body 1/Young modulus=1000"]
    expected = alone(disc, short)
    killed(disc, 9, expected, short)
    stopped(disc, 5, signal.SIGTERM, expected, short)


def check_friction(ranks):
    """A block that a plate drags to and fro: the places that slips are measured
    from, and the tractions that springs go on from."""
    block = p.write("block.prm",
                    (p.source / "prm/dragged-block.prm").read_text() + EVERY)
    for law in p.some(("penalty", "lagrange")):
        drag = ["Obstacle 1/Motion=(t > 1 ? 0.004*sin(3*(t - 1)) : 0), "
                "(t < 1 ? -0.01*t : -0.01)", "Time stepping/Number of steps=20",
                "Time stepping/End time=5", "Refinement/Level=4",
                f"Method/Enforcement={law}"]
        expected = alone(block, drag)
        if ranks > 1:
            check_other_ranks(block, expected, drag)
        else:
            killed(block, 9, expected, drag)


def check_ironing(name, stops, *settings):
    """A die that is drawn over a block with friction by mortar: what was
    opposite at the last step is found again, as far away as then."""
    shutil.copy(p.source / f"prm/{name}-die.inp", p.folder)
    ironing = p.write(f"{name}.prm",
                      (p.source / f"prm/{name}.prm").read_text() + EVERY)
    short = ["Refinement/Level=0", "Output/Fields=false",
             "Output/Pictures=false", *settings]
    expected = alone(ironing, short)
    for number, how in stops:
        interrupt(ironing, number, how, short)
        result = run(ironing, "--resume", settings=short)
        p.expect(result.returncode == 0, f"{ironing}: {result.stderr}")
        expect_same(expected, "die, resumed")


def check_short():
    expected = alone(bodies, steps)
    killed(bodies, 3, expected, steps)
    expected = alone(membrane, cycles)
    stopped(membrane, 2, signal.SIGTERM, expected, cycles)
    check_refusals(membrane, cycles)
    check_other_ranks(membrane, expected, cycles)
    check_left_semaphores()
    check_motion()
    check_friction(1)


if p.short:
    check_short()
elif p.part == 1:
    check_one_rank()
    check_left_semaphores()
    check_motion()
    check_driven()
    check_string()
    check_large_strain()
    check_large_motion()
    check_rolling()
    check_friction(1)
    check_ironing("ironing", ((10, signal.SIGTERM), (18, signal.SIGTERM),
                              (21, signal.SIGKILL)),
                  "Time stepping/Number of steps=22", "Time stepping/End time=1.1")
    check_ironing("ironing-3d", ((6, signal.SIGKILL),), "Time stepping/Number of steps=8",
                  "Time stepping/End time=1.5")
    expected = alone(membrane, cycles)
    killed(membrane, 5, expected, cycles)
    stopped(membrane, 2, signal.SIGTERM, expected, cycles)
    check_target()
    check_files()
    scene = p.write("search.prm", (p.source / "prm/search-flat.prm").read_text())
    p.expect_error(run(scene, "--resume"), "write no checkpoints")
else:
    check_two_ranks(bodies, steps)
    check_two_ranks(membrane, cycles)
    check_disc()
    check_friction(2)
p.finish()
