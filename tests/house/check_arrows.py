#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Includes run one way: each room of plugin/ may include from itself and from
the rooms that it names, all of which stand above it in the table."""
import argparse
import pathlib
import re
import sys
import tempfile

BELOW_SCENES = "input restart report mesh physics adapt pictures"

# A room (or a single file) and what it may include. The longest name that fits
# a file is its room.
ROOMS = [
    ("core/base", ""),
    ("core/geometry", "core/base"),
    ("core/search", "core/base core/geometry"),
    ("core/law", "core/base"),
    ("core/time", "core/base"),
    ("core/multigrid", "core/base"),
    ("core/constraint", "core/base core/geometry core/search core/law"),
    ("core/history", "core/base"),
    ("core/contact", "core/base core/geometry core/search core/law "
                     "core/constraint"),
    ("core/interface", "core/base core/geometry core/search core/law "
                       "core/constraint core/contact"),
    ("core/strategy", "core/base core/law core/constraint core/contact"),
    ("core/model", "core/base core/constraint core/strategy"),
    ("solve", ""),
    ("shim", "solve"),
    ("module", "shim"),
    ("app/input", ""),
    ("app/process", ""),
    ("app/restart", "app/input"),
    ("app/report", "app/input app/restart"),
    ("app/physics", "app/input shim"),
    ("app/mesh", "app/input app/physics shim"),
    ("app/adapt", "app/input app/restart app/report app/physics shim"),
    ("app/pictures", "app/input app/process app/restart app/report app/mesh "
                     "app/physics shim"),
    ("app/scenes", " ".join("app/" + room for room in BELOW_SCENES.split())
     + " solve shim"),
    *((f"app/scenes/{kind}", "app/scenes solve shim " + " ".join(
        "app/" + room for room in BELOW_SCENES.split()))
      for kind in ("obstacle", "solid", "point_mass", "search")),
    # The list of the kinds of scenes.
    ("app/scenes/scene_kinds.cc",
     "app/scenes app/scenes/obstacle app/scenes/solid app/scenes/point_mass "
     "app/scenes/search"),
    ("app/command", "app/input app/process app/restart app/report "
                    "app/scenes"),
]


def room_of(name, rooms):
    """The room of a file, given relative to plugin/."""
    fits = [room for room, _ in rooms
            if name == room or name.startswith(room + "/")]
    return max(fits, key=len, default=None)


def target_of(file, include, root):
    """The file that an include in quotes means."""
    for folder in (file.parent, root, root / "core"):
        if (folder / include).is_file():
            return (folder / include).resolve().relative_to(root.resolve())
    return None


def mistakes(root, rooms):
    """Sentences about files without a room and arrows that run the other way."""
    allowed = {room: set(names.split()) for room, names in rooms}
    before = set()
    for room, names in rooms:
        for name in set(names.split()) - before:
            yield f"the table lets {room} include {name}, which is not above it"
        before.add(room)
    for file in sorted(root.rglob("*")):
        name = file.relative_to(root).as_posix()
        if file.suffix not in (".c", ".cc", ".h") or "/" not in name:
            continue
        room = room_of(name, rooms)
        if room is None:
            yield f"{name} is in no room"
            continue
        text = file.read_text()
        if room.startswith("core/") and "#include <abut/dealii/" in text:
            yield f"{name} includes a header for deal.II"
        for include in re.findall(r'^\s*#\s*include\s+"([^"]+)"', text, re.M):
            target = target_of(file, include, root)
            if target is None:
                yield f'{name} includes "{include}", which is not in the house'
                continue
            other = room_of(target.as_posix(), rooms)
            if other != room and other not in allowed[room]:
                yield f"{name} includes {target}: {room} must not know {other}"


def check_itself():
    """What the script must find, it finds."""
    rooms = [("low", ""), ("high", "low")]
    with tempfile.TemporaryDirectory() as folder:
        root = pathlib.Path(folder)
        for room in ("low", "high", "other"):
            (root / room).mkdir()
        (root / "low/a.h").write_text('#include "high/b.h"\n')
        (root / "high/b.h").write_text('#include "low/a.h"\n#include "b.h"\n')
        (root / "high/c.cc").write_text('#include "nowhere.h"\n')
        (root / "other/d.h").write_text("")
        found = list(mistakes(root, rooms))
        assert len(found) == 3, found
        assert len(list(mistakes(root, rooms[::-1]))) == 4


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--source", required=True, type=pathlib.Path)
    plugin = parser.parse_args().source / "plugin"
    check_itself()
    found = list(mistakes(plugin, ROOMS))
    for mistake in found:
        print(mistake)
    sys.exit(1 if found else 0)


main()
