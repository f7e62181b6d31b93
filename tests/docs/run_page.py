#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Runs the blocks of a page of the manual in the order of the page, in an empty
folder with links to prm, doc and include, and the program in PATH:

    run_page.py PAGE.md --abut build/release/abut

The first line of each block of code gives its intent:

    ```sh {run}         commands; the exit code must be 0, or N with {run N}
    ```text {output}    what the commands before have printed: lines of it in their
                        order, words as they are, numbers to 1e-5 of their size,
                        seconds ("0.02 s") of any size, and all numbers
                        below 1e-9 equal
    ```prm {check}      a scene, read by `abut check`
    ```c {compile}      a file in C11, compiled with the public headers
    ```text {show}      for reading only

{check NAME}, {compile NAME} and {show NAME} also write the block into a file of that
name. Below a block a line `<!-- expect FILE KEY VALUE TOLERANCE -->` compares a
number of a summary.json, or several (VALUE with commas), with an absolute
tolerance. A block without intent is an error."""
import argparse
import json
import os
import pathlib
import re
import subprocess
import sys
import tempfile
import time

SOURCE = pathlib.Path(__file__).resolve().parents[2]
ROUND_OFF = 1e-9
SECONDS = 240  # a block takes 5 s at most, a program 20 s; this is for a machine with other work
LINE = re.compile(r"^(?P<fence>```+)(?P<info>.*)$|^<!-- expect (?P<expect>.*) -->$")
INFO = re.compile(r"^(?P<language>\w+) \{(?P<intent>run|output|check|compile|show)"
                  r"(?: (?P<more>[\w.-]+))?\}$")


def steps(text):
    """Blocks of a page: line, intent, language, word behind the intent or None,
    text. An expectation is a block, too."""
    lines = text.split("\n")
    n = 0
    while n < len(lines):
        found, begin = LINE.match(lines[n]), n + 1
        n += 1
        if not found:
            continue
        if found["expect"]:
            yield begin, "expect", None, None, found["expect"]
            continue
        body = []
        while lines[n] != found["fence"]:
            body.append(lines[n])
            n += 1
        n += 1
        # Directives of the site, and formulas.
        if found["info"].startswith("{") or found["info"] == "math":
            continue
        info = INFO.match(found["info"])
        if not info:
            raise ValueError(f"line {begin}: a block without intent: {found['info']}")
        yield (begin, info["intent"], info["language"], info["more"],
               "\n".join(body) + "\n")


def words(line):
    line = re.sub(r"\b\d+\.\d+ s(?=\s|$)", "TIME s", line)
    return [word for word in re.split(r"[\s,\[\]]+", line) if word]


def same(printed, wanted):
    """Whether two lines have the same words, numbers to 1e-5 or round-off."""
    pairs = list(zip(printed, wanted))
    for a, b in pairs:
        try:
            x, y = float(a), float(b)
            if a != b and not (abs(x - y) <= 1e-5 * abs(y)
                               or max(abs(x), abs(y)) <= ROUND_OFF):
                return False  # also a number that is not finite
        except ValueError:
            if a != b:
                return False
    return len(printed) == len(wanted)


class Page:
    def __init__(self, folder, abut):
        self.folder = folder
        self.environment = dict(os.environ, PATH=f"{abut.parent}:{os.environ['PATH']}")
        for name in ("prm", "doc", "include"):
            (folder / name).symlink_to(SOURCE / name)

    def call(self, command, code=0):
        done = subprocess.run(command, cwd=self.folder, env=self.environment,
                              timeout=SECONDS, text=True, stdout=subprocess.PIPE,
                              stderr=subprocess.STDOUT, stdin=subprocess.DEVNULL)
        self.printed = done.stdout
        if done.returncode != code:
            return (f"exit code {done.returncode}, expected {code}:\n"
                    + done.stdout[-3000:])
        return None

    def run(self, language, code, text):
        if language not in ("sh", "python"):
            return f"{language} cannot be run"
        program = (["bash", "-eu", "-o", "pipefail", "-c", text]
                   if language == "sh" else [sys.executable, "-c", text])
        return self.call(program, int(code or 0))

    def output(self, _, __, text):
        lines = [words(line) for line in self.printed.split("\n")]
        for line in text.strip().split("\n"):
            while lines and not same(lines[0], words(line)):
                del lines[0]
            if not lines:
                return f"'{line}' was not printed, but:\n{self.printed[-3000:]}"
            del lines[0]
        return None

    def show(self, _, name, text):
        if name:
            (self.folder / name).write_text(text, encoding="utf-8")

    def check(self, language, name, text):
        name = name or f"block.{language}"
        self.show(language, name, text)
        return self.call(["abut", "check", name])

    def compile(self, language, name, text):
        if language != "c":
            return f"{language} cannot be compiled here"
        name = name or "block.c"
        self.show(language, name, text)
        return self.call(["cc", "-std=c11", "-Wall", "-Werror", "-fsyntax-only",
                          "-Iinclude", name])

    def expect(self, _, __, text):
        file, key, value, tolerance = text.split()
        file = self.folder / file
        if not file.exists():
            return f"no file {file.name}"
        found = json.loads(file.read_text(encoding="utf-8"))[key]
        numbers = found if isinstance(found, list) else [found]
        wanted = [float(one) for one in value.split(",")]
        if len(numbers) != len(wanted) or not all(
                abs(a - b) <= float(tolerance) for a, b in zip(numbers, wanted)):
            return f"{key} is {found}, expected {value} within {tolerance}"
        return None


def main():
    arguments = argparse.ArgumentParser(description=__doc__)
    arguments.add_argument("page", type=pathlib.Path)
    arguments.add_argument("--abut", type=pathlib.Path, required=True)
    arguments = arguments.parse_args()
    faults = 0
    with tempfile.TemporaryDirectory() as folder:
        page = Page(pathlib.Path(folder), arguments.abut.resolve())
        for line, intent, language, more, text in steps(
                arguments.page.read_text(encoding="utf-8")):
            begin = time.monotonic()
            fault = getattr(page, intent)(language, more, text)
            print(f"{arguments.page.name}:{line}: {intent}"
                  f" {time.monotonic() - begin:.1f} s{': ' + fault if fault else ''}")
            faults += fault is not None
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
