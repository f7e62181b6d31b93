# SPDX-License-Identifier: LGPL-2.1-or-later
"""Runs of the program by one that is loaded once for all: see served.cc."""
import os
import pathlib
import select
import signal
import subprocess
import tempfile


class Served:
    """Stands for subprocess.run() with the program's own words."""

    def __init__(self, program, environment=None):
        self._program, self._environment = str(program), environment
        self._process = self._owner = None

    def _start(self):
        self._owner = os.getpid()
        self._process = subprocess.Popen(
            [self._program], stdin=subprocess.PIPE, stdout=subprocess.PIPE,
            env=self._environment, start_new_session=True)

    def run(self, words, folder, timeout):
        """Run the program with these words in the folder."""
        words = list(map(str, words))
        with tempfile.TemporaryDirectory(prefix="abut-served-") as own:
            texts = [pathlib.Path(own) / name for name in ("output", "errors")]
            code = self.code(words, folder, timeout, texts)
            output, errors = (path.read_text(encoding="utf-8", errors="replace")
                              for path in texts)
        return subprocess.CompletedProcess([self._program, *words], code,
                                           output, errors)

    def code(self, words, folder, timeout, texts, seconds=0, memory=0):
        """Exit code of a run that writes output and errors into two files and
        may take so many seconds of processor time and bytes, or any."""
        if self._process is None or self._owner != os.getpid():
            self._start()  # one that was there before a fork is the parent's
        request = [len(words), folder, *texts, seconds, memory, *words]
        self._process.stdin.write(
            b"".join(os.fsencode(str(field)) + b"\0" for field in request))
        self._process.stdin.flush()
        if not select.select([self._process.stdout], [], [], timeout)[0]:
            self._end()
            raise subprocess.TimeoutExpired(words, timeout)
        return int(self._process.stdout.readline())

    def _end(self):
        """With the run that it has; else it ends when nobody can ask it."""
        os.killpg(self._process.pid, signal.SIGKILL)
        self._process.communicate()
        self._process = None
