# SPDX-License-Identifier: LGPL-2.1-or-later
"""Runs of a scene with settings."""
import hashlib
import json
import os
import signal
import time
from typing import NamedTuple

from .errors import InputError
from .run_store import RunRecord

ENDED = {0: "ok", 2: "refused", 3: "unusable"}
BEGINNINGS = ("abut: error: ", "abut: internal error: ", "abut: warning: ")


def checksum(path):
    with open(path, "rb") as file:
        return hashlib.sha256(file.read()).hexdigest()


def last_words(log):
    """What a run printed at its end: the error, else the last warning."""
    said = {}
    with open(log, encoding="utf-8", errors="replace") as lines:
        for line in lines:
            for beginning in BEGINNINGS:
                if line.startswith(beginning):
                    said[beginning] = line[len(beginning):].rstrip("\n")
    return next((said[name] for name in BEGINNINGS if name in said), "")


class RunSetting(NamedTuple):
    """A scene with settings. Two runs with the same text give the same
    results: it has all values, checksums of the files that they name, and of
    the program."""
    overrides: list
    text: str
    values: dict  # of all parameters, by path
    refusal: str  # why it cannot be run, or ""


class RunMaker:
    def __init__(self, program, scene_file):
        self._program, self._scene = program, scene_file
        version = program.ask("--version").stdout
        self._identity = f"{version}program {checksum(program.path)}\n"
        self._checksums = {}

    def words(self, overrides):
        # A curve need not use what the axis changes.
        return [word for one in overrides
                for word in ("--set-if-used", f"{one.path}={one.value}")]

    def setting(self, overrides):
        """The scene with settings. Raises InputError, its place in the
        message, where a parameter does not exist or a value is not legal by
        itself."""
        result = self._program.ask("check", self._scene, "--values",
                                   *self.words(overrides))
        error = self._error_of(result.stderr, overrides)
        if not result.stdout:
            raise InputError(error)
        values = {path: entry["value"] for path, entry
                  in json.loads(result.stdout)["parameters"].items()}
        text = self._identity + "".join(
            f"{path} = {value}\n{self._content(value)}"
            for path, value in sorted(values.items()))
        return RunSetting(list(overrides), text, values,
                          error if result.returncode else "")

    def _error_of(self, errors, overrides):
        """The error printed, with the place in the chart file in place of the
        option."""
        text = errors.partition(": ")[2].partition(": ")[2].strip()
        for one in overrides:
            option = f'--set-if-used "{one.path}={one.value}"'
            if text.startswith(option):
                return one.origin + text[len(option):]
        return text

    def _content(self, value):
        """A line with the checksum of the file that a value names, beside the
        scene or from here; "" if it names none."""
        for path in (os.path.join(os.path.dirname(self._scene), value), value):
            if value and os.path.isfile(path):
                if path not in self._checksums:
                    self._checksums[path] = checksum(path)
                return f"  file {self._checksums[path]}\n"
        return ""

    def run(self, store, setting, repeat, limit):
        """The run of a setting, made now unless the store has it already, and
        whether it was made now.
        repeat: number of the run among equal ones
        limit: processor seconds that it may take"""
        found = store.find(setting.text, repeat, limit)
        if found:
            return found, False
        return self._make(store, setting, repeat, limit), True

    def _make(self, store, setting, repeat, limit):
        folder = store.begin(setting.text, repeat)
        log = folder / "log.txt"
        words = ["run", self._scene, "--quiet", "--output", folder,
                 *self.words(setting.overrides)]
        start = time.monotonic()
        ending = self._program.run(words, log, limit)
        record = RunRecord(code=ending.code, limit=limit, setting=setting.text,
                           seconds=time.monotonic() - start)
        if ending.out_of_time:
            record.ended, record.code = "out of time", 0
            record.reason = (f"ended at the limit of {limit:g} processor "
                             "seconds")
        else:
            record.ended = ENDED.get(ending.code, "failed")
            if ending.code < 0:
                name = signal.strsignal(-ending.code)
                record.reason = f"ended by signal: {name}"
            elif ending.code > 0:
                record.reason = last_words(log)
        store.finish(record, repeat)
        return record
