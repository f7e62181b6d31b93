# SPDX-License-Identifier: LGPL-2.1-or-later
"""One program at a time, on one thread, within limits of time and memory."""
import contextlib
import fcntl
import os
import resource
import subprocess
import time

ONE_THREAD = {name: "1" for name in (
    "OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS",
    "NUMBER_OF_CPUS", "CCX_NPROC_STIFFNESS", "CCX_NPROC_RESULTS",
    "CCX_NPROC_EQUATION_SOLVER", "DEAL_II_NUM_THREADS")}


class Failure(Exception):
    """The program gave no answer; the text says why."""


@contextlib.contextmanager
def alone(lock):
    """Hold the lock file meanwhile, if one is named."""
    if not lock:
        yield
        return
    with open(lock, "a") as file:
        fcntl.flock(file, fcntl.LOCK_EX)
        yield


def run(command, folder, log, seconds=300, gigabytes=8):
    """Seconds of wall and processor, peak megabytes; raises Failure with the
    log's end."""
    limit = int(gigabytes * 2 ** 30)

    def limits():
        resource.setrlimit(resource.RLIMIT_AS, (limit, limit))

    path = os.path.join(folder, log)
    with open(path, "w") as output:
        begin = time.perf_counter()
        process = subprocess.Popen(command, cwd=folder, stdout=output,
                                   stderr=subprocess.STDOUT,
                                   preexec_fn=limits,
                                   env=dict(os.environ, **ONE_THREAD))
        late = False
        while True:
            done, status, usage = os.wait4(process.pid, os.WNOHANG)
            if done:
                break
            if not late and time.perf_counter() - begin > seconds:
                process.kill()
                late = True
            time.sleep(0.005)
        wall = time.perf_counter() - begin
        process.returncode = os.waitstatus_to_exitcode(status)
    if late:
        raise Failure(f"stopped after {seconds:g} s")
    if process.returncode != 0:
        with open(path, errors="replace") as file:
            lines = [line.strip() for line in file if line.strip()]
        raise Failure(f"exit code {process.returncode}: "
                      + " / ".join(lines[-3:])[-200:])
    return {"wall": wall, "processor": usage.ru_utime + usage.ru_stime,
            "megabytes": usage.ru_maxrss / 1024}
