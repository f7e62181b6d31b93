# SPDX-License-Identifier: LGPL-2.1-or-later
"""Many runs of the program, by `abut serve`, which is loaded once and forks a
process for each run: to load the program with all that it is linked to takes
longer than to solve a small scene."""
import os
import pathlib
import select
import signal
import subprocess
import tempfile


class Served:
    """Runs the program's commands, one at a time."""

    def __init__(self, program, environment=None):
        self._program, self._environment = str(program), environment
        self._process = self._owner = None

    def _start(self):
        self._owner = os.getpid()
        self._process = subprocess.Popen(
            [self._program, "serve"], stdin=subprocess.PIPE,
            stdout=subprocess.PIPE, env=self._environment,
            start_new_session=True)

    def run(self, words, folder=".", timeout=None):
        """Stands for subprocess.run() with the program's own words."""
        words = list(map(str, words))
        with tempfile.TemporaryDirectory(prefix="abut-served-") as own:
            texts = [pathlib.Path(own) / name for name in ("output", "errors")]
            code = self.code(words, folder, timeout, texts)
            output, errors = (path.read_text(encoding="utf-8", errors="replace")
                              for path in texts)
        return subprocess.CompletedProcess([self._program, *words], code,
                                           output, errors)

    def code(self, words, folder, timeout, texts, seconds=0, memory=0):
        """Exit code of a run, or minus the signal that ended it. The run
        appends its output and errors to two files, and may take so many
        seconds of processor time and bytes (0: any)."""
        if self._process is None or self._owner != os.getpid():
            self._start()  # one that was there before a fork is the parent's
        request = [len(words), os.path.abspath(folder),
                   *map(os.path.abspath, texts), seconds, memory, *words]
        self._process.stdin.write(
            b"".join(os.fsencode(str(field)) + b"\0" for field in request))
        self._process.stdin.flush()
        if not select.select([self._process.stdout], [], [], timeout)[0]:
            self.end()
            raise subprocess.TimeoutExpired(words, timeout)
        answer = self._process.stdout.readline()
        if not answer:
            self.end()
            raise ChildProcessError(f"'{self._program} serve' has ended")
        return int(answer)

    def end(self):
        """With the run that goes on; else `abut serve` ends when nobody can
        ask it any more."""
        if self._process is not None and self._owner == os.getpid():
            os.killpg(self._process.pid, signal.SIGKILL)
            self._process.communicate()
        self._process = None
