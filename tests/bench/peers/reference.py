# SPDX-License-Identifier: LGPL-2.1-or-later
"""Reference numbers of the pressed blocks, as figures.PRESSED holds them.

GetFEM on matching grids (both blocks n x n x n/2), n doubled twice; prints the
numbers of each grid and Aitken's extrapolation, which is as good as its
difference from the finest grid is small.

    tests/bench/peers/reference.py [--cells 8 16 32]
"""
import argparse
import tempfile

import figures
import getfem_peer
import problems


def main():
    parser = argparse.ArgumentParser(
        description=__doc__,
        formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--cells", type=int, nargs=3, default=[8, 16, 32])
    arguments = parser.parse_args()
    rows = []
    for cells in arguments.cells:
        problem = problems.pressed_blocks(cells, cells)
        with tempfile.TemporaryDirectory() as folder:
            answer = getfem_peer.run(problem, "lagrange", folder,
                                     seconds=3000, gigabytes=16)
        rows.append(figures.pressed_numbers(problem, answer))
        print(cells, rows[-1], f"{answer['wall']:.1f} s", flush=True)
    for name in rows[0]:
        first, second, third = (row[name] for row in rows)
        step, last = second - first, third - second
        print(f"{name}: {third + last * last / (step - last):.7g} "
              f"(orders fall by {step / last:.2f})")


if __name__ == "__main__":
    main()
