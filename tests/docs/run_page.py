#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Runs the blocks of a page of the manual in the order of the page, in an empty
folder with a link to prm and the program in PATH:

    run_page.py PAGE.md --abut build/release/abut

The first line of each block of code gives its intent:

    ```sh {run}         commands; the exit code must be 0, or N with {run N}
    ```prm {check}      a scene, read by `abut check`
    ```c {compile}      a file in C11, compiled with the public headers
    ```text {show}      for reading only

Below a block a line `<!-- expect FILE KEY VALUE TOLERANCE -->` compares a number of
a summary.json, or several (VALUE with commas), with an absolute tolerance. A block without intent is an error."""
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
SECONDS = 120  # a block takes 5 s at most; this is for a machine with other work
LINE = re.compile(r"^(?P<fence>```+)(?P<info>.*)$|^<!-- expect (?P<expect>.*) -->$")
INFO = re.compile(r"^(?P<language>\w+) \{(?P<intent>run|check|compile|show)"
                  r"(?: (?P<code>\d+))?\}$")


def steps(text):
    """Blocks (line, language, intent, exit code, text) and expectations (line, None,
    words) of a page."""
    lines = text.split("\n")
    n = 0
    while n < len(lines):
        found, begin = LINE.match(lines[n]), n + 1
        n += 1
        if not found:
            continue
        if found["expect"]:
            yield begin, None, "expect", 0, found["expect"].split()
            continue
        body = []
        while lines[n] != found["fence"]:
            body.append(lines[n])
            n += 1
        n += 1
        if found["info"].startswith("{"):  # a directive of the site
            continue
        info = INFO.match(found["info"])
        if not info:
            raise ValueError(f"line {begin}: a block without intent: {found['info']}")
        yield (begin, info["language"], info["intent"], int(info["code"] or 0),
               "\n".join(body) + "\n")


class Page:
    def __init__(self, folder, abut):
        self.folder = folder
        self.environment = dict(os.environ, PATH=f"{abut.parent}:{os.environ['PATH']}")
        (folder / "prm").symlink_to(SOURCE / "prm")
        (folder / "doc").symlink_to(SOURCE / "doc")

    def call(self, command, code=0):
        done = subprocess.run(command, cwd=self.folder, env=self.environment,
                              timeout=SECONDS, text=True, stdout=subprocess.PIPE,
                              stderr=subprocess.STDOUT, stdin=subprocess.DEVNULL)
        if done.returncode != code:
            return (f"exit code {done.returncode}, expected {code}:\n"
                    + done.stdout[-3000:])
        return None

    def run(self, language, text, code):
        if language not in ("sh", "python"):
            return f"{language} cannot be run"
        program = (["bash", "-eu", "-o", "pipefail", "-c", text]
                   if language == "sh" else [sys.executable, "-c", text])
        return self.call(program, code)

    def check(self, language, text, code):
        (self.folder / "block.prm").write_text(text, encoding="utf-8")
        return self.call(["abut", "check", "block.prm"], code)

    def compile(self, language, text, code):
        if language != "c":
            return f"{language} cannot be compiled here"
        (self.folder / "block.c").write_text(text, encoding="utf-8")
        return self.call(["cc", "-std=c11", "-Wall", "-Werror", "-fsyntax-only",
                          f"-I{SOURCE}/include", "block.c"], code)

    def expect(self, words):
        file, key, value, tolerance = words
        found = json.loads((self.folder / file).read_text(encoding="utf-8"))[key]
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
        for line, language, intent, code, text in steps(
                arguments.page.read_text(encoding="utf-8")):
            if intent == "show":
                continue
            begin = time.monotonic()
            fault = (page.expect(text) if intent == "expect"
                     else getattr(page, intent)(language, text, code))
            print(f"{arguments.page.name}:{line}: {intent}"
                  f" {time.monotonic() - begin:.1f} s{': ' + fault if fault else ''}")
            faults += fault is not None
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
