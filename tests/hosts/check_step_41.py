# SPDX-License-Identifier: LGPL-2.1-or-later
"""deal.II's step-41 with its active sets replaced by Abut: the active sets and
contact forces of an independent program on the same meshes, in no more steps
than step-41 takes."""
import argparse
import re
import subprocess
import sys
import tempfile

# Level: size of the active set, contact force, active-set solves of step-41.
STEP_41 = {3: (38, 18.67805454, 3), 4: (103, 19.22538172, 5),
           5: (395, 19.76854801, 6), 6: (1452, 19.99859538, 11),
           7: (5399, 20.11164530, 19)}


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--program", required=True)
    arguments = parser.parse_args()
    good = True
    for level, (active, force, steps) in STEP_41.items():
        with tempfile.TemporaryDirectory(prefix="abut-test-") as folder:
            text = subprocess.run([arguments.program, str(level)], cwd=folder,
                                  text=True, check=True, capture_output=True,
                                  timeout=600).stdout
        found = re.search(r"(\d+) steps, size of active set: (\d+), contact "
                          r"force: ([-0-9.e+]+), .*converged", text)
        print(f"level {level}:", found and found.groups())
        # One step more than step-41's: the last solve is an accurate one.
        good = (good and found is not None and int(found[2]) == active
                and abs(float(found[3]) / force - 1) < 1e-8
                and int(found[1]) <= steps + 1)
    if not good:
        print("FAILED: not the figures of step-41")
    sys.exit(0 if good else 1)


if __name__ == "__main__":
    main()
