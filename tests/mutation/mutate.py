#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Does a test of the core fail if the core is wrong?

Takes the sources of laws, clipping, detection and strategies, makes one small
mistake at a time (another operator, another number, a condition turned round,
a statement left out), and runs the tests of the core until one of them fails.
Mistakes are drawn from all that are possible, a share of each file, with a
fixed seed; those done before are read from the results, so that the run can be
stopped and goes on.

    mutate.py [--build build/mutation] [--number 400] [--seconds 3600]
              [--files 'plugin/core/law/*.c' ...] [--again] [--report]

--again   tries those again that no test has found
--report  prints the table only

One processor is used. The table is that of doc/develop/tests.md.
"""
import argparse
import collections
import fnmatch
import hashlib
import json
import pathlib
import re
import shlex
import subprocess
import sys
import tempfile
import time

ROOT = pathlib.Path(__file__).resolve().parents[2]
GROUPS = {
    "law": ["plugin/core/law/*.c"],
    "clipping": ["plugin/core/geometry/clip*.c",
                 "plugin/core/contact/coupling_segment*.c"],
    "detection": ["plugin/core/contact/detect.c"],
    "strategies": ["plugin/core/strategy/*.c"],
}
# What is written instead of what, where neither is a part of something longer.
OPERATORS = {
    " + ": [" - "], " - ": [" + "], " * ": [" / "], " / ": [" * "],
    " += ": [" -= "], " -= ": [" += "], " *= ": [" /= "], " /= ": [" *= "],
    " < ": [" <= ", " > "], " <= ": [" < "], " > ": [" >= ", " < "],
    " >= ": [" > "], " == ": [" != "], " != ": [" == "],
    " && ": [" || "], " || ": [" && "],
}
WORDS = {"true": "false", "false": "true", "fmin": "fmax", "fmax": "fmin",
         "ABUT_STATE_OPEN": "ABUT_STATE_CLOSED",
         "ABUT_STATE_CLOSED": "ABUT_STATE_OPEN"}
# Tests of the core run with sanitizers (the preset `core`); here only those that
# find nothing without.
SANITIZED = ["-fsanitize=address,undefined", "-fno-sanitize-recover=all"]
# Left alone: what compilers read, and tables of names.
SKIPPED = re.compile(r"^\s*(#|static_assert|typedef|extern|case\b|default:)")


def blank(text):
    """The text with comments and strings blanked out, at equal length."""
    def hide(match):
        return re.sub(r"[^\n]", " ", match.group())
    return re.sub(r'/\*.*?\*/|//[^\n]*|"(?:\\.|[^"\\\n])*"', hide, text,
                  flags=re.S)


def other_number(word):
    if "." in word or "e" in word:
        value = float(word)
        return repr(value * 2 if value else 1.)
    return str(int(word) + 1)


def balanced(code, start):
    """End of the bracket that opens at start."""
    depth = 0
    for i in range(start, len(code)):
        depth += {"(": 1, ")": -1}.get(code[i], 0)
        if depth == 0:
            return i + 1
    return len(code)


def mistakes(text):
    """(begin, end, replacement) of all mistakes in a source."""
    code = blank(text)
    skipped = set()
    position = 0
    for line in code.splitlines(keepends=True):
        if SKIPPED.match(line) or "abut_fail" in line:
            skipped.update(range(position, position + len(line)))
        position += len(line)
    found = []

    def add(begin, end, new):
        if begin not in skipped and text[begin:end] != new:
            found.append((begin, end, new))

    # A line may begin with an operator.
    for match in re.finditer(r"(?<=[\s\w)\]])\s([-+*/<>=!&|]{1,2})\s(?=\S)", code):
        for old, news in OPERATORS.items():
            if match.group(1) == old.strip():
                for new in news:
                    add(match.start(1), match.end(1), new.strip())
    # Room for more numbers, and zeros to begin with, are no mistakes.
    harmless = [match.span() for match in re.finditer(
        r"\b(?:double|float|bool|u?int\w*) \w[^;=()]*|= \{[{}0., ]*\}", code)]
    for match in re.finditer(r"(?<![\w.])(\d+\.?\d*(?:e-?\d+)?)(?![\w.])", code):
        if not any(a <= match.start() < b for a, b in harmless):
            add(match.start(), match.end(), other_number(match.group()))
    for match in re.finditer(r"(?<=[=(,?:] )-(?=[\w(])|(?<=return )-(?=[\w(])"
                             r"|(?<=\()-(?=[\w(])", code):
        add(match.start(), match.end(), "")
    for match in re.finditer(r"\b\w+\b", code):
        if match.group() in WORDS:
            add(match.start(), match.end(), WORDS[match.group()])
    for match in re.finditer(r"\b(if|while) \(", code):
        begin = match.end() - 1
        add(begin, balanced(code, begin),
            f"(!{text[begin:balanced(code, begin)]})")
    for match in re.finditer(r"!(?=[\w(])", code):
        add(match.start(), match.end(), "")
    # Statements that change something.
    for match in re.finditer(r"(?<=\n) +(\w[\w>.\[\]-]* (?:[-+*/]?=) [^;{}\n]+;|"
                             r"(?:continue|break);)(?=\n)", code):
        if re.match(r"\s*(const|return|int32_t|double|bool)\b", match.group()):
            continue
        add(match.start(1), match.end(1), ";")
    return sorted(set(found))


class Core:
    """The core and its tests, built without sanitizers."""

    def __init__(self, build):
        self.build = build
        subprocess.run(
            ["cmake", "-S", ROOT, "-B", build, "-G", "Ninja", "-D",
             "ABUT_CORE_ONLY=ON", "-D", "CMAKE_BUILD_TYPE=Release", "-D",
             "CMAKE_EXPORT_COMPILE_COMMANDS=ON"], check=True,
            stdout=subprocess.DEVNULL)
        subprocess.run(["cmake", "--build", build], check=True,
                       stdout=subprocess.DEVNULL)
        commands = json.loads((build / "compile_commands.json").read_text())
        self.compile = {}  # by source
        for entry in commands:
            words = shlex.split(entry["command"])
            if "/plugin/core/" in entry["file"]:
                name = str(pathlib.Path(entry["file"]).relative_to(ROOT))
                self.compile[name] = words
        self.link, self.seconds = {}, {}
        for test in sorted(build.glob("test_*")):
            self.link[test.name] = self.link_command(test.name)
            begin = time.monotonic()
            if not self.passes(test, 600):
                raise SystemExit(f"{test.name} fails without any mistake")
            self.seconds[test.name] = time.monotonic() - begin
        self.kills = collections.Counter()

    def link_command(self, program):
        lines = subprocess.run(
            ["ninja", "-C", self.build, "-t", "commands", program], check=True,
            capture_output=True, text=True).stdout.splitlines()
        line = next(l for l in lines if f"-o {program} " in l + " ")
        return shlex.split(re.sub(r"^: && | && :$", "", line))

    def count(self, name, test):
        self.kills[test] += 1
        self.kills[name, test] += 1

    def passes(self, program, limit, in_time=True):
        """in_time: a test that takes longer fails."""
        try:
            return subprocess.run(
                [program], timeout=limit, stdout=subprocess.DEVNULL,
                stderr=subprocess.DEVNULL, cwd=program.parent).returncode == 0
        except subprocess.TimeoutExpired:
            return not in_time

    def compiles(self, name, text, folder, flags=()):
        """Makes an object of another text of one source; False if it is none."""
        source = folder / pathlib.Path(name).name
        source.write_text(text)
        words = list(self.compile[name])
        words[words.index("-o") + 1] = str(folder / "changed.o")
        words[words.index("-c") + 1] = str(source)
        words += ["-I", str((ROOT / name).parent), "-w", *flags]
        return subprocess.run(words, cwd=self.build,
                              capture_output=True).returncode == 0

    def killer(self, name, folder, flags=()):
        """The first test that fails, those first that are likely to and short;
        None if none does."""
        words = self.compile[name]
        old = words[words.index("-o") + 1]
        for test in sorted(self.seconds, key=lambda t: (
                self.seconds[t] + 0.1)
                / (1 + self.kills[t] + 20 * self.kills[name, t])):
            link = [str(folder / "changed.o") if w == old else w
                    for w in self.link[test]]
            link[link.index("-o") + 1] = str(folder / test)
            link += flags
            subprocess.run(link, cwd=self.build, check=True,
                           capture_output=True)
            # Sanitizers take their time; what hangs was found without.
            good = self.passes(folder / test, 10 + 10 * self.seconds[test],
                               not flags)
            (folder / test).unlink()
            if not good:
                self.count(name, test)
                return test
        return None


def drawn(files, number):
    """Some of all mistakes: (file, text, mistake), in an order that looks
    random and stays the same for sources that stay the same."""
    everything = []
    for name in files:
        text = (ROOT / name).read_text()
        everything += [(name, text, mistake) for mistake in mistakes(text)]
    everything.sort(key=lambda each: hashlib.sha256(
        f"{each[0]}:{each[2]}".encode()).digest())
    return everything[:number]


def key_of(name, text, mistake):
    """Says which mistake it is as long as the source is the same."""
    digest = hashlib.sha256(text.encode()).hexdigest()[:12]
    return f"{name}:{digest}:{mistake[0]}:{mistake[1]}:{mistake[2]}"


def describe(name, text, mistake):
    begin, end, new = mistake
    line = text.count("\n", 0, begin) + 1
    return f"{name}:{line}: {text[begin:end]!r} -> {new!r}"


def group_of(name):
    for group, patterns in GROUPS.items():
        if any(fnmatch.fnmatch(name, pattern) for pattern in patterns):
            return group
    return "others"


def report(results):
    """The table, and what no test has found."""
    print("| | mistakes | found | |\n|---|---|---|---|")
    rows = collections.defaultdict(list)
    for result in results:
        rows[group_of(result["file"])].append(result["killer"] is not None)
        rows["all"].append(result["killer"] is not None)
    for group in [*GROUPS, "others", "all"]:
        if rows[group]:
            n, found = len(rows[group]), sum(rows[group])
            print(f"| {group} | {n} | {found} | {100 * found / n:.1f} % |")
    for result in results:
        if result["killer"] is None:
            print("not found:", result["what"])


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--build", type=pathlib.Path,
                        default=ROOT / "build/mutation")
    parser.add_argument("--number", type=int, default=400)
    parser.add_argument("--seconds", type=float, default=3600)
    parser.add_argument("--files", nargs="*",
                        default=sum(GROUPS.values(), []))
    parser.add_argument("--again", action="store_true")
    parser.add_argument("--report", action="store_true")
    options = parser.parse_args()
    build = options.build.resolve()
    build.mkdir(parents=True, exist_ok=True)
    files = sorted({str(p.relative_to(ROOT)) for pattern in options.files
                    for p in ROOT.glob(pattern)})
    log = build / "results.jsonl"
    done = {}
    if log.exists():
        for line in log.read_text().splitlines():
            entry = json.loads(line)
            done[entry["key"]] = entry
    core = None if options.report else Core(build)
    for entry in done.values() if core else []:
        core.count(entry["file"], entry["killer"])
    results = []
    end = time.monotonic() + options.seconds
    for name, text, mistake in drawn(files, options.number):
        key = key_of(name, text, mistake)
        known = done.get(key)
        if known is None or (options.again and known["killer"] is None):
            if core is None or time.monotonic() > end:
                if known is not None:
                    results.append(known)
                continue
            with tempfile.TemporaryDirectory(prefix="abut-mutation-") as folder:
                folder = pathlib.Path(folder)
                changed = text[:mistake[0]] + mistake[2] + text[mistake[1]:]
                killer = (core.killer(name, folder)
                          if core.compiles(name, changed, folder)
                          else "compiler")
                if killer is None and core.compiles(name, changed, folder,
                                                    SANITIZED):
                    killer = core.killer(name, folder, SANITIZED)
            known = {"key": key, "file": name, "killer": killer,
                     "what": describe(name, text, mistake)}
            with open(log, "a", encoding="utf-8") as out:
                out.write(json.dumps(known) + "\n")
            print("found    " if killer else "NOT FOUND", known["what"],
                  killer or "", flush=True)
        # What is no C is no mistake.
        if known["killer"] != "compiler":
            results.append(known)
    report(results)
    found = sum(result["killer"] is not None for result in results)
    return 0 if results and found >= 0.9 * len(results) else 1


if __name__ == "__main__":
    sys.exit(main())
