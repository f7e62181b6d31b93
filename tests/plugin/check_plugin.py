#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Load the plugin into programs of both build modes, and files that are no
plugins, or plugins for others: copies of the real one in which a few bytes are
changed. Every pairing works, or is refused with one line before the plugin is
loaded; no program crashes at its end."""
import argparse
import os
import pathlib
import subprocess
import sys

MAGIC = b"abut-plugin\n\r\032"
# Offsets in abut_plugin_stamp.
ABI, INDEX, MODE, DEALII, TRILINOS, MPI, COMPILER, LAYOUT = (
    16, 20, 24, 40, 64, 88, 120, 168)


# Bytes per cycle. Allocators keep up to 40 000 bytes more at the end than after
# ten cycles, however many cycles there are; the smallest object that can be
# forgotten has 576.
LARGEST_GROWTH = 500


def number(value):
    return value.to_bytes(4, "little")


class Checker:
    def __init__(self, arguments):
        self.plugin = pathlib.Path(arguments.plugin)
        self.scratch = pathlib.Path(arguments.scratch)
        self.scratch.mkdir(parents=True, exist_ok=True)
        self.content = self.plugin.read_bytes()
        self.n_failures = 0

    def fail(self, message):
        self.n_failures += 1
        print("FAILED: " + message)

    def run(self, host, *words, ranks=1):
        command = [host, *map(str, words)]
        if ranks > 1:
            command = ["mpirun", "--oversubscribe", "-n", str(ranks)] + command
        return subprocess.run(command, capture_output=True, text=True,
                              check=False)

    def works(self, name, host, *words, largest_error, ranks=1):
        result = self.run(host, *words, ranks=ranks)
        output = result.stdout.split()
        if result.returncode != 0 or len(output) != 4:
            self.fail(f"{name}: exit code {result.returncode}, "
                      f"{result.stdout}{result.stderr}")
        elif not float(output[3]) <= largest_error:
            self.fail(f"{name}: error {output[3]} > {largest_error}")
        else:
            print(f"{name}: error {output[3]}")

    def refused(self, host, cases, ranks=1):
        """All plugins of the cases (path, words, whether it is loaded) are
        refused, each with a line that holds its path and the words."""
        result = self.run(host, *(path for path, _, _ in cases), ranks=ranks)
        lines = result.stderr.splitlines()
        if ranks > 1:  # what mpirun adds does not count
            lines = [line for line in lines if "Cannot use" in line]
        if result.returncode != 2 or len(lines) != len(cases) or result.stdout:
            self.fail(f"exit code {result.returncode}, "
                      f"{result.stdout}{result.stderr}")
            return
        for line, (path, words, is_loaded) in zip(lines, cases):
            print(line)
            for word in (f"'{path}'", *words):
                if word not in line:
                    self.fail(f"no {word} in the line above")
            if ("[loaded]" in line) != is_loaded:
                self.fail("it should " + "not " * (not is_loaded)
                          + "have been loaded")

    def fake(self, name, place, new):
        """A copy of the plugin with other bytes, at an offset of the stamp or
        instead of given ones."""
        content = bytearray(self.content)
        start = (content.index(MAGIC) + place if isinstance(place, int)
                 else content.index(place))
        content[start:start + len(new)] = new
        path = self.scratch / (name + ".so")
        path.write_bytes(content)
        return path


def check_memory(check, host, n_cycles):
    """What is left behind by loading, solving and refining is no more than
    what a program without contact leaves behind, a few bytes."""
    result = check.run(host, check.plugin, f"cycles={n_cycles}")
    words = result.stdout.split()
    if result.returncode != 0 or len(words) != 9:
        check.fail(f"cycles: exit code {result.returncode}, {result.stdout}"
                   f"{result.stderr}")
        return
    print(f"{n_cycles} cycles: {words[5]} bytes per cycle, error {words[3]}")
    if not float(words[3]) <= 1e-10 or not float(words[5]) <= LARGEST_GROWTH:
        check.fail("memory or force of cycles")


def wrong_files(check):
    text = check.scratch / "text.so"
    text.write_text("This is not a library.\n" * 10, encoding="ascii")
    half = check.scratch / "half.so"
    half.write_bytes(check.content[:len(check.content) // 2])
    return [
        (check.scratch / "none.so", ["no such file"], False),
        (check.scratch, ["no such file"], False),
        (text, ["not a shared library"], False),
        (half, ["the end of the file is missing"], False),
    ]


def wrong_stamps(check):
    fakes = [
        ("abi", ABI, number(77), ["plugin ABI 77", "version of Abut"]),
        ("dealii", DEALII, b"9.3.2\0", ["deal.II 9.3.2", "same deal.II"]),
        ("index", INDEX, number(48), ["global numbers of bits 48"]),
        ("mpi", MPI, b"MPICH 4.0.2\0", ["MPICH 4.0.2", "same MPI"]),
        ("trilinos", TRILINOS, b"1.2.3\0", ["Trilinos 1.2.3"]),
        ("compiler", COMPILER, b"C++ ABI 1002, libc++\0",
         ["C++ ABI 1002, libc++", "same compiler"]),
        ("layout", LAYOUT, bytes(8), ["class layout 0"]),
    ]
    return [(check.fake(name, place, new), words, False)
            for name, place, new, words in fakes]


def wrong_symbols(check):
    return [
        (check.fake("entry", b"abut_plugin_query\0", b"abut_plugin_quarz\0"),
         ["does not export the symbol abut_plugin_query"], True),
        (check.fake("symbol", b"\0MPI_Allreduce\0", b"\0MPI_Nonesuch0\0"),
         ["cannot be loaded", "MPI_Nonesuch0"], False),
    ]


def check_names(check, host):
    """A name without a slash is one of a library, as for dlopen(); others are
    paths."""
    name, folder = check.plugin.name, str(check.plugin.parent)
    search = os.environ.get("LD_LIBRARY_PATH")
    check.refused(host, [("libabut_nowhere.so",
                          ["no such file in the library folders (", "/lib",
                           "LD_LIBRARY_PATH"], False),
                         ("./libabut_nowhere.so",
                          ["no such file in the working folder",
                           str(pathlib.Path.cwd())], False)])
    os.environ["LD_LIBRARY_PATH"] = folder
    check.works("by LD_LIBRARY_PATH", host, name, largest_error=1e-10)
    del os.environ["LD_LIBRARY_PATH"]
    if search is not None:
        os.environ["LD_LIBRARY_PATH"] = search
    check.works("by a relative path", host,
                "./" + os.path.relpath(check.plugin), largest_error=1e-10)


def check_all(arguments):
    check = Checker(arguments)
    hosts = {"Debug": arguments.debug_host, "Release": arguments.release_host}
    mode = arguments.mode
    host = hosts.pop(mode)
    (other_mode, other_host), = hosts.items()

    check.works("same mode", host, check.plugin, largest_error=1e-10)
    check.works("same mode, 2 ranks", host, check.plugin, largest_error=1e-10,
                ranks=2)
    # MethodParameters are made by a program without any function of Abut.
    check.works("parameters from C++", host, check.plugin, "method=by hand",
                largest_error=1e-10)
    # Springs of 50 times the stiffness of a facet yield by about 1 / 200.
    check.works("penalty", host, check.plugin, "Method/Enforcement=penalty",
                largest_error=2e-2)
    check_memory(check, host, arguments.cycles)
    modes = [f"plugin: it was built with deal.II in mode {mode}",
             f"program with deal.II in mode {other_mode}"]
    check.refused(other_host, [(check.plugin, modes, False)])
    no_plugin = [(check.scratch / "none.so", ["no such file"], False)]
    check.refused(host, no_plugin, ranks=2)

    check_names(check, host)

    # The stamp is all that is looked at in a plugin of the other mode.
    fakes = [(check.fake("mode", MODE, other_mode.encode() + b"\0"),
              ["in mode Debug", "in mode Release"], False),
             (arguments.library, ["not a plugin of Abut"], False)]
    fakes += wrong_files(check) + wrong_stamps(check) + wrong_symbols(check)
    check.refused(host, fakes)
    check.works("the one that fits", host, *(fake[0] for fake in fakes),
                check.plugin, largest_error=1e-10)
    return 1 if check.n_failures else 0


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    for name in ("plugin", "library", "debug-host", "release-host", "mode",
                 "scratch"):
        parser.add_argument("--" + name, required=True)
    parser.add_argument("--cycles", type=int, default=100)
    return check_all(parser.parse_args())


if __name__ == "__main__":
    sys.exit(main())
