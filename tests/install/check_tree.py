#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Install the build into a folder of its own and use it from there: the
program, the C library through pkg-config, the library and the plugin through
find_package. The tree is moved once, to show that no path is built in. Programs
of the other build mode are refused until its libraries are installed, too (this is
part 2, which takes the tree that part 1 has installed)."""
import argparse
import json
import pathlib
import shutil
import sys

from installed import Tree, passed, require, run


def install(arguments):
    first = pathlib.Path(arguments.scratch) / "first"
    prefix = pathlib.Path(arguments.scratch) / "prefix"
    for folder in (first, prefix):
        shutil.rmtree(folder, ignore_errors=True)
    run(arguments.cmake, "--install", arguments.build, "--prefix", first)
    first.rename(prefix)
    return Tree(prefix, arguments.libdir)


def check_files(tree, suffix):
    expected = [
        "bin/abut", "include/abut/abut.h", "include/abut/user_law.h",
        "include/abut/dealii/load_plugin.h", "share/abut/prm/step-41.prm",
        "share/abut/tools/abut_tools/draw.py",
        "share/doc/abut/README.md", "share/doc/abut/parameters.md",
        "share/doc/abut/examples/user-law/soft_law.c",
        "share/doc/abut/copyright"]
    for name in expected:
        require((tree.prefix / name).is_file(), f"{name} is not installed")
    for name in ("abut" + suffix, "abut_core"):
        links = [tree.libraries / f"lib{name}.so{end}"
                 for end in ("", ".0.1", ".0.1.0")]
        for link in links[:2]:
            require(link.is_symlink(), f"{link} is not a link")
        require(links[0].resolve() == links[2], f"{links[0]} points elsewhere")
        soname = tree.run("readelf", "-d", links[2]).stdout
        require(f"soname: [lib{name}.so.0.1]" in soname, soname)
    require((tree.libraries / f"libabut_plugin{suffix}.so").is_file(),
            "the plugin is not installed")
    scenes = list((tree.prefix / "share/abut/prm").glob("*.prm"))
    require(len(scenes) >= 25, f"{len(scenes)} scenes")


def check_program(tree, scratch):
    tree.run(tree.abut, "run", tree.prefix / "share/abut/prm/string.prm",
             "--output", scratch / "string", cwd=scratch)
    summary = json.loads((scratch / "string/summary.json").read_text())
    require(summary["converged"] is True, "string.prm did not converge")
    tree.run(tree.abut, "draw", scratch / "string", cwd=scratch)
    require((scratch / "string/displacement.svg").is_file(), "no picture")
    left = list((tree.prefix / "share/abut/tools").rglob("__pycache__"))
    require(not left, f"compiled files are installed or left: {left}")


def check_c(tree, scratch):
    """Force 0.3 and contact from x = 0.2: see the head of the example. The line
    is that of doc/c-interface.md."""
    examples = tree.prefix / "share/doc/abut/examples/c-interface"
    text = (tree.prefix / "share/doc/abut/c-interface.md").read_text()
    line = text.split("```sh {show}\n")[1].split("```")[0]
    program = scratch / "program"
    shutil.copy(examples / "bar_on_a_bed.c", scratch / "program.c")
    tree.run("sh", "-euc", line, cwd=scratch)
    # It ends with 1 where it misses theory.
    tree.run(program)
    shutil.copy(examples / "two_strings.c", scratch / "program.c")
    tree.run("sh", "-euc", line, cwd=scratch)
    needed = tree.run("ldd", program).stdout
    require("deal" not in needed and "mpi" not in needed, needed)
    check_strings(tree.run(program).stdout)


def check_strings(output):
    words = output.replace(",", " ").split()
    force = float(words[words.index("force") + 1])
    edge = float(words[words.index("=") + 1])
    require(abs(force - 0.3) < 1e-6, output)
    require(abs(edge - 0.2) <= 1 / 60, output)


def configure(tree, arguments, build, mode, *more, code=0):
    """The project `consumer`, with the build type that is given."""
    shutil.rmtree(build, ignore_errors=True)
    example = tree.prefix / "share/doc/abut/examples/c-interface/two_strings.c"
    source = pathlib.Path(__file__).parent / "consumer"
    return tree.run(
        arguments.cmake, "-S", source, "-B", build, "-G", "Ninja",
        f"-DCMAKE_BUILD_TYPE={mode}", f"-DCMAKE_PREFIX_PATH={tree.prefix}",
        f"-DEXAMPLE={example}", *more, code=code)


def check_find_package(tree, arguments, scratch):
    build = scratch / "consumer"
    configure(tree, arguments, build, arguments.mode)
    tree.run(arguments.cmake, "--build", build, "-j1")
    output = tree.run(build / "consumer").stdout
    require("is registered already" in output and "same methods: 8" in output,
            output)
    check_strings(tree.run(build / "two-strings").stdout)


OTHER = {"Debug": "Release", "Release": "Debug"}
POSTFIX = {"Debug": ".g", "Release": ""}
PRESET = {"Debug": "dev", "Release": "release"}


def check_other_mode_refused(tree, arguments, scratch):
    """A program in the mode that is not installed; and one in none."""
    other = OTHER[arguments.mode]
    for mode, words in ((other, [f"CMAKE_BUILD_TYPE={other}",
                                 f"libabut_plugin{POSTFIX[other]}.so",
                                 f"preset '{PRESET[other]}'"]),
                        ("", ["-DCMAKE_BUILD_TYPE=Release or Debug"])):
        result = configure(tree, arguments, scratch / "refused", mode, code=1)
        message = " ".join(result.stderr.split())
        for word in words:
            require(word in message, f"no {word} in {message}")


def add_other_mode(tree, libdir, mode):
    """A tree with the libraries of both modes, as another build would install
    them: those of the other mode are copies of these."""
    other = OTHER[mode]
    both = Tree(tree.prefix.parent / "both", libdir)
    shutil.rmtree(both.prefix, ignore_errors=True)
    shutil.copytree(tree.prefix, both.prefix, symlinks=True)
    ours, theirs = POSTFIX[mode] + ".so", POSTFIX[other] + ".so"
    for name in ("abut", "abut_plugin"):
        shutil.copy(both.libraries / f"lib{name}{ours}",
                    both.libraries / f"lib{name}{theirs}")
    targets = both.libraries / "cmake/Abut"
    text = (targets / f"AbutDealii-{mode.lower()}.cmake").read_text()
    text = text.replace(mode.upper(), other.upper()).replace(mode, other)
    text = text.replace(f"libabut{ours}.0.1.0", f"libabut{theirs}")
    (targets / f"AbutDealii-{other.lower()}.cmake").write_text(text)
    return both


def check_both_modes(tree, arguments, scratch):
    """Each program gets the libraries of its own mode, Abut's and deal.II's,
    and nothing of the other."""
    both = add_other_mode(tree, arguments.libdir, arguments.mode)
    build = scratch / "both-modes"
    for mode in OTHER:
        configure(both, arguments, build, mode)
        rules = (build / "build.ninja").read_text()
        link = rules[rules.index("build consumer:"):].split("\n\n")[0]
        for library in ("libabut", "libdeal.ii"):
            found = {word.rsplit("/", 1)[-1].split(".so")[0]
                     for word in link.split()
                     if f"/{library}" in word and ".so" in word}
            require(found == {library + POSTFIX[mode]},
                    f"{mode}: links to {found}")
        define = f"libabut_plugin{POSTFIX[mode]}.so"
        require(define in rules, f"{mode}: Abut_PLUGIN is not {define}")
        require(("-DNDEBUG" in rules) == (mode == "Release"),
                f"{mode}: NDEBUG")


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    for name in ("cmake", "build", "scratch", "libdir", "mode"):
        parser.add_argument("--" + name, required=True)
    parser.add_argument("--part", type=int, choices=(1, 2), required=True)
    arguments = parser.parse_args()
    scratch = pathlib.Path(arguments.scratch)
    scratch.mkdir(parents=True, exist_ok=True)

    def modes():
        tree = Tree(scratch / "prefix", arguments.libdir)
        check_other_mode_refused(tree, arguments, scratch)
        check_both_modes(tree, arguments, scratch)

    def checks():
        tree = install(arguments)
        check_files(tree, ".g" if arguments.mode == "Debug" else "")
        if arguments.mode == "Release":
            check_program(tree, scratch)
        check_c(tree, scratch)
        check_find_package(tree, arguments, scratch)

    return passed(checks if arguments.part == 1 else modes)


if __name__ == "__main__":
    sys.exit(main())
