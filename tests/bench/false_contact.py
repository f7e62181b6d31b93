#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Forces between bodies that do not touch: none should have one.

Prints, for each kind of scene, in how many of them there is a force, or no
answer, of these without a report of the force, and the largest clearance of
these, divided by the length of a facet; and the same of bodies of which one
comes there, with points that follow.

    tests/bench/false_contact.py build/release/abut [600 [NAME=VALUE ...]]
"""
import json
import pathlib
import sys
import tempfile

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "app"))
import apart_scenes  # noqa: E402
from program import Folder, Served, set_words  # noqa: E402


def look(abut, folder, file, words):
    """Whether a scene is solved without any contact force, and whether a force
    is reported, or the scene has no answer."""
    result = abut.run(["run", file, "--output", "out", "--quiet", *words],
                      folder, 600)
    if result.returncode != 0:
        return False, True
    force = json.loads((pathlib.Path(folder) / "out/summary.json").read_text())[
        "contact_force"]
    return force == 0., "constraints are active where" in result.stderr


def count(abut, make, n, words, title=""):
    number, wrong, silent, largest = {}, {}, {}, {}
    for seed in range(n):
        with tempfile.TemporaryDirectory(prefix="abut-bench-") as folder:
            file, kind, clearance = make(Folder(folder), seed)
            number[kind] = number.get(kind, 0) + 1
            is_right, is_reported = look(abut, folder, file, words)
            if not is_right:
                wrong[kind] = wrong.get(kind, 0) + 1
                silent[kind] = silent.get(kind, 0) + (not is_reported)
                largest[kind] = max(largest.get(kind, 0.), clearance)
    for kind in number:
        print(f"{kind}{title}: {number[kind]} scenes, {wrong.get(kind, 0)} "
              f"wrong, {silent.get(kind, 0)} not reported, clearances up to "
              f"{largest.get(kind, 0.):.2g}", flush=True)


def main():
    abut = Served(sys.argv[1])
    n = int(sys.argv[2]) if len(sys.argv) > 2 else 600
    words = set_words(sys.argv[3:])
    count(abut, apart_scenes.make, n, words)
    for strain, settings in apart_scenes.LARGE.items():
        count(abut, apart_scenes.make_coming, n // 4,
              set_words(settings) + words, f" that comes, {strain}")


if __name__ == "__main__":
    main()
