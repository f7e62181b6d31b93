#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Compile the documentation's example of a user's own law outside of the source
tree against the installed headers, and compare what the program and a deal.II
program that loads the plugin make of it with the solution of one equation.
Then laws with faults: each is refused, or stops the run, with a line that names
it."""
import argparse
import json
import math
import pathlib
import sys

from installed import C_FLAGS, Tree, passed, require, run

TOUCH, CLEARANCE = 5., 0.002
PARAMETERS = f"touch pressure: {TOUCH}, clearance: {CLEARANCE}"


def soft_law(gap):
    s = max(0., 1. - gap / CLEARANCE)
    return TOUCH / (math.e - 1.) * s * math.expm1(s)


def force(young, poisson, shortening, width):
    """Of a block of height 1 whose end is moved by the shortening, in plane
    strain; by bisection for the gap."""
    modulus = young / (1. - poisson**2)
    low, high = -shortening, CLEARANCE
    for _ in range(200):
        gap = 0.5 * (low + high)
        if modulus * (shortening + gap) > soft_law(gap):
            high = gap
        else:
            low = gap
    return width * soft_law(gap)


def compile_law(tree, source, library, *flags):
    tree.run("cc", *C_FLAGS, "-shared", "-fPIC",
             *tree.pkg_config("--cflags", "abut_core"), *flags, source, "-o",
             library)


def check_example(tree, arguments, scratch):
    examples = tree.prefix / "share/doc/abut/examples/user-law"
    scene = scratch / "soft-plate.prm"
    scene.write_text((examples / "soft-plate.prm").read_text())
    # Named in the scene without a folder, it is found beside it.
    law = scratch / "soft_law.so"
    compile_law(tree, examples / "soft_law.c", law)
    expected = force(1000., 0.3, 0.01, 2.)
    for ranks in (1, 2):
        for way in ("node to segment", "dual mortar", "quadrature point"):
            run("mpirun", "--oversubscribe", "-n", ranks, arguments.program,
                "run", scene, "--output", scratch / "soft-plate", "--set",
                f"Method/Discretisation={way}")
            summary = json.loads(
                (scratch / "soft-plate/summary.json").read_text())
            found = summary["pair_1_force"][1]
            print(f"{way} on {ranks} ranks: force {found}, in "
                  f"{summary['nonlinear_iterations']} steps")
            require(summary["method"] == "soft", f"{summary['method']}")
            require(abs(abs(found) - expected) < 1e-7 * expected,
                    f"force {found} is not {expected}")
    for program in (arguments.host, ):
        expected = force(7., 0.3, 0.01, 2.)
        output = run(program, arguments.plugin, "Method/Enforcement=user",
                     f"Method/Law file={law}",
                     f"Method/Law parameters={PARAMETERS}").stdout
        found = float(output.split()[1])
        print(f"loaded: force {found}")
        require(abs(found - expected) < 1e-7 * expected,
                f"force {found} is not {expected}")


def refused(arguments, scratch, code, words, *settings):
    command = [arguments.program, "run", scratch / "soft-plate.prm",
               "--output", scratch / "refused"]
    for setting in settings:
        command += ["--set", setting]
    text = run(*command, code=code).stderr
    line = text.strip().splitlines()[-1]
    print(line)
    for word in words:
        require(word in text, f"no '{word}' in: {text}")


def check_parameters(arguments, scratch):
    bad = [
        ("clearance: 1", ["Method/Law parameters", "'touch pressure' is missing"]),
        (f"{PARAMETERS}, colour: 3", ["'colour'", "touch pressure, clearance"]),
        ("touch pressure: -1, clearance: 1", ["must be above 0"]),
    ]
    for value, words in bad:
        refused(arguments, scratch, 2, words,
                f"Method/Law parameters={value}")
    refused(arguments, scratch, 2, ["none.so: there is no such file"],
            "Method/Law file=none.so")
    refused(arguments, scratch, 2, ["soft-plate.prm: it cannot be loaded"],
            "Method/Law file=soft-plate.prm")
    refused(arguments, scratch, 2, ["the name is empty"], "Method/Law file=")


def check_faults(tree, arguments, scratch):
    source = pathlib.Path(__file__).parent / "bad_law.c"
    faults = [
        (2, ["for ABI 42"]),
        (2, ["abut_law_points has"]),
        (2, ["no symbol abut_user_law_query"]),
        (2, ["abut_user_law_query() returned NULL"]),
        (2, ["abut_law is not complete"]),
        (2, ["outer = ABUT_OUTER_NONE"]),
        (2, ["built-in one, 'penalty'"]),
        (3, ["the law 'bad' gives a value that is not finite at gap"]),
        (3, ["the law 'bad' failed: this combination is not defined"]),
        (3, ["the law 'bad' gives a derivative by the pressure that is zero"]),
        (2, ["cannot be loaded", "function_of_nobody"]),
    ]
    for number, (code, words) in enumerate(faults, start=1):
        law = scratch / f"bad_law_{number}.so"
        compile_law(tree, source, law, f"-DFAULT={number}")
        refused(arguments, scratch, code, words, f"Method/Law file={law}",
                "Method/Law parameters=")


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    for name in ("scratch", "libdir", "program", "host", "plugin"):
        parser.add_argument("--" + name, required=True)
    arguments = parser.parse_args()
    scratch = pathlib.Path(arguments.scratch) / "user-law"
    scratch.mkdir(parents=True, exist_ok=True)
    tree = Tree(pathlib.Path(arguments.scratch) / "prefix", arguments.libdir)

    def checks():
        check_example(tree, arguments, scratch)
        check_parameters(arguments, scratch)
        check_faults(tree, arguments, scratch)

    return passed(checks)


if __name__ == "__main__":
    sys.exit(main())
