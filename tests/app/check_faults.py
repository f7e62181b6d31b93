# SPDX-License-Identifier: LGPL-2.1-or-later
"""What a machine may do to a run: a disk that is full, a folder that goes, a
rank that is killed, memory that ends. Each run ends soon, with one message that
names what it was, and nothing is left running; and a thousand load steps take
no more memory than ten."""
import os
import resource
import shutil
import signal
import subprocess
import time

from program import Program, set_words

p = Program()
OUT = p.folder / "out"
LONG = {"Time stepping/Number of steps": 5000, "Obstacle 1/Motion": "0, -1e-6*t",
        "Output/Pictures": "false"}
# Scene, settings: each writes with all that writes.
SCENES = (("rigid-plate.prm", {"Checkpoint/Every steps": 1}),
          ("step-41.prm", {"Checkpoint/Every steps": 1, "Refinement/Level": 5,
                           "Output/Nodal values": "true"}))


def words(scene, settings):
    return ["run", p.source / "prm" / scene, "--output", "out", "--quiet",
            *set_words(settings)]


def on_small_disk(kilobytes, scene, settings, ranks):
    """A run whose output folder is on a disk of that size."""
    OUT.mkdir(exist_ok=True)
    mount = (f"mount -t tmpfs -o size={kilobytes}k tmpfs {OUT}"
             " && exec \"$@\"")
    return p.call(*words(scene, settings), ranks=ranks,
                  before=["unshare", "-m", "sh", "-c", mount, "sh"])


def can_mount():
    return subprocess.run(
        ["unshare", "-m", "mount", "-t", "tmpfs", "-o", "size=4k", "tmpfs",
         p.folder], capture_output=True).returncode == 0


def full_disks(scene, settings, ranks):
    """Less and less room, until there is none; with enough of it the run is
    good."""
    ended = []
    for kilobytes in (4, 40, 8000) if p.short else (4, 24, 40, 120, 8000):
        result = on_small_disk(kilobytes, scene, settings, ranks)
        ended.append(result.returncode)
        if result.returncode != 0:
            p.expect_error(result, "No space left on device", str(OUT.name))
    p.expect(ended[0] == 2 and ended[-1] == 0,
             f"{scene}, full disks, {ranks} ranks: {ended}")


if can_mount():
    for (name, values), n in zip(SCENES, (2, 1)):
        full_disks(name, values, n)
else:
    print("full disks: not tried, as file systems cannot be mounted here")
shutil.rmtree(OUT, ignore_errors=True)


def start(settings, ranks=1):
    """A run that takes long, once it has written something."""
    command = [p.abut, *map(str, words("rigid-plate.prm", settings))]
    if ranks > 1:
        command = ["mpirun", "--oversubscribe", "-n", str(ranks), *command]
    process = subprocess.Popen(command, cwd=p.folder, text=True,
                               stdout=subprocess.DEVNULL,
                               stderr=subprocess.PIPE)
    end = time.monotonic() + 300
    while (not list(OUT.glob("*.pvd")) and process.poll() is None
           and time.monotonic() < end):
        time.sleep(0.01)
    return process


def finish(process, what):
    """What it says; it ends by itself and soon."""
    try:
        return process.communicate(timeout=300)[1]
    except subprocess.TimeoutExpired:
        process.kill()
        p.expect(False, f"{what}: does not end")
        return ""


# The folder goes, with all that is in it.
for n in (1, 2):
    running = start(LONG, n)
    OUT.rename(p.folder / f"gone-{n}")  # at once, while files are written
    text = finish(running, "folder removed")
    errors = [line for line in text.splitlines() if "abut: error:" in line]
    p.expect(running.returncode == 2 and len(errors) == 1
             and "No such file or directory" in errors[0],
             f"folder removed, {n} ranks: {running.returncode}, {text}")
    shutil.rmtree(OUT, ignore_errors=True)


# One of three ranks is killed: the others go, too.
def ranks_of(process):
    out = subprocess.run(["ps", "--ppid", str(process.pid), "-o", "pid="],
                         capture_output=True, text=True).stdout
    return [int(word) for word in out.split()]


def is_running(pid):
    """Those that ended may wait to be asked how."""
    out = subprocess.run(["ps", "-p", str(pid), "-o", "state="],
                         capture_output=True, text=True).stdout
    return out.strip() not in ("", "Z")


running = start(LONG, 3)
pids = ranks_of(running)
p.expect(len(pids) == 3, f"ranks: {pids}")
os.kill(pids[1], signal.SIGKILL)
finish(running, "a rank killed")
p.expect(running.returncode != 0, "a rank killed: exit code 0")
deadline = time.monotonic() + 120
while any(map(is_running, pids)) and time.monotonic() < deadline:
    time.sleep(0.1)
p.expect(not any(map(is_running, pids)),
         "ranks that go on without the one that was killed")
# What it left is not in the way of the next run.
p.expect(p.call(*words("rigid-plate.prm", {})).returncode == 0,
         "a run after the one that was killed")
shutil.rmtree(OUT)

# Memory ends.
def little_memory():
    resource.setrlimit(resource.RLIMIT_AS, (1200 << 20, 1200 << 20))


result = p.call(*words("step-41.prm", {"Refinement/Level": 11}),
                at_start=little_memory)
p.expect_error(result, "memory")

# A thousand load steps.
shutil.rmtree(OUT, ignore_errors=True)


def peak(steps):
    summary, _ = p.solve("patch-2d.prm", *set_words({
        "Time stepping/Number of steps": steps, "Output/Fields": "false",
        "Output/Pictures": "false", "Refinement/Level": 3}))
    return 1e6 * summary["peak_memory_mb"]


# The first steps take some of the heap for good; from then on a step keeps its line of
# the tables, and not the half of a vector of its 3428 unknowns.
steps = 300 if p.short else 1000
few, many = peak(100), peak(steps)
kept = (many - few) / (steps - 100)
print(f"a load step keeps {kept:.0f} bytes")
p.expect(kept < 4 * 3428, f"memory of load steps: {few}, {many}")
p.finish()
