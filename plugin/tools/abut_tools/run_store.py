# SPDX-License-Identifier: LGPL-2.1-or-later
"""Finished runs on disk. Each stands in a folder `runs/<key>-<repeat>` with the
files that `abut run` wrote and `record.json`. A run works in `<that>.part`, which
is renamed when all is written: an interrupted one leaves nothing that could be
taken for a result."""
import fcntl
import hashlib
import json
import os
import pathlib
import shutil
from dataclasses import asdict, dataclass

from .errors import InputError


@dataclass
class RunRecord:
    """What is kept of a run."""
    ended: str = ""     # ok, unusable, refused, failed, out of time
    code: int = 0       # exit code, or minus the signal
    reason: str = ""    # message of the run, unless ok
    limit: float = 0    # processor seconds that it had
    seconds: float = 0  # on the wall, from start to end
    setting: str = ""   # all that it depends on


def key(setting):
    """Name of a run, made from all that it depends on."""
    return hashlib.sha256(setting.encode()).hexdigest()[:16]


def write_at_once(path, text):
    """A reader sees the old file or the new one."""
    part = pathlib.Path(f"{path}.part")
    part.write_text(text, encoding="utf-8")
    part.rename(path)


def make_output_folder(folder):
    """With its parents, and make sure that files can be written there."""
    advice = "Choose another one with --output DIR."
    try:
        os.makedirs(folder, exist_ok=True)
    except OSError as error:
        raise InputError(f"cannot make the output folder '{folder}': "
                         f"{error.strerror}. {advice}") from None
    probe = os.path.join(folder, ".abut-can-write")
    try:
        pathlib.Path(probe).write_text("x")
        os.remove(probe)
    except OSError as error:
        raise InputError(f"cannot write into the output folder '{folder}': "
                         f"{error.strerror}. {advice}") from None


class RunStore:
    """The folder `runs` of a chart, locked for the life of this process."""

    def __init__(self, chart_folder):
        self._folder = pathlib.Path(chart_folder) / "runs"
        make_output_folder(self._folder)
        self._lock = open(self._folder / "lock", "a")
        try:
            fcntl.flock(self._lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except OSError:
            raise InputError(f"another 'abut chart' works in '{chart_folder}'. "
                             "Choose another folder with --output DIR."
                             ) from None
        for part in self._folder.glob("*.part"):
            shutil.rmtree(part)

    def place(self, setting, repeat):
        return self._folder / f"{key(setting)}-{repeat}"

    def find(self, setting, repeat, limit):
        """The finished run of a setting; None if there is none, if a signal
        ended it, or if it ended for want of time and there is more now."""
        try:
            text = (self.place(setting, repeat) / "record.json").read_text()
            record = RunRecord(**json.loads(text))
        except (OSError, ValueError, TypeError):
            return None
        short = record.ended == "out of time" and record.limit < limit
        is_other = record.setting != setting or record.code < 0
        return None if short or is_other else record

    def begin(self, setting, repeat):
        """An empty folder for a run to work in."""
        part = self.place(setting, repeat).with_suffix(".part")
        shutil.rmtree(part, ignore_errors=True)
        part.mkdir()
        return part

    def finish(self, record, repeat):
        """Keep the contents of the folder given by begin(), and the record."""
        here = self.place(record.setting, repeat)
        part = here.with_suffix(".part")
        write_at_once(part / "record.json", json.dumps(asdict(record), indent=2))
        # What stood here was short of time.
        shutil.rmtree(here, ignore_errors=True)
        part.rename(here)
