#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""The energy of a bar that knocks for ever, by every scheme.

Runs prm/dynamics-periodic-bar.prm over 100 periods with each scheme and half of
its step, draws kinetic + strain + contact energy at the end of each period by
the exact 1/8, and prints the table of doc/develop/dynamics.md. Needs Matplotlib.

    tests/bench/knocking_bar_picture.py build/release/abut picture.svg
"""
import pathlib
import sys
import tempfile

import pictures

PERIOD, PERIODS, EXACT = 3., 100, 1. / 8.
# Explicit schemes are below their limit with half of the others' step.
SCHEMES = {"hht": 0.02, "trapezoid": 0.02, "midpoint": 0.02,
           "generalised alpha": 0.02, "contact stabilised": 0.02,
           "velocity level": 0.02, "energy momentum": 0.02,
           "central difference": 0.01,
           "central difference with projection": 0.01}


def run(abut, folder, scheme, step):
    """Energies by the exact one at the ends of all steps, and force at 1.5."""
    table = pictures.run(
        abut, "dynamics-periodic-bar.prm", folder, f"Time stepping/Scheme={scheme}",
        f"Time stepping/Step size={step}",
        f"Time stepping/End time={PERIOD * PERIODS}").table("levels.csv")
    energies = sum(table[f"{kind}_energy"]
                   for kind in ("kinetic", "strain", "contact")) / EXACT
    return energies, table["force_height"][abs(table["time"] - 1.5).argmin()]


def summary(energies):
    """After the first step; largest above that; change in a period."""
    first = energies[1]
    return first, max(energies[1:]) - first, (energies[-1] - first) / PERIODS


def main():
    if len(sys.argv) != 3:
        raise SystemExit(__doc__)
    curves = {}
    print("| scheme | dt | after a step | largest above that | 10 periods | 100 "
          "periods | in a period | with dt/2 | force at 1.5 |\n"
          + "|---" * 9 + "|")
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name) / "out"
        for scheme, step in SCHEMES.items():
            energies, force = run(sys.argv[1], folder, scheme, step)
            half, _ = run(sys.argv[1], folder, scheme, step / 2.)
            first, above, change = summary(energies)
            stride = (len(energies) - 1) // PERIODS
            print(f"| {scheme} | {step} | {first:.4f} | {above:.1e} | "
                  f"{energies[10 * stride]:.4f} | {energies[-1]:.4f} | "
                  f"{100 * change:+.3f} % | {100 * summary(half)[2]:+.3f} % | "
                  f"{force:.4f} |")
            curves[f"{scheme}, $\\Delta t$ = {step}"] = energies[::stride]
    draw(sys.argv[2], curves)


def draw(picture, curves):
    style = pictures.style
    figure, [[axes]] = style.figure(style.PAGE, 0.5)
    for i, (label, energies) in enumerate(curves.items()):
        axes.plot(energies, label=label, **style.line_style(i))
    axes.axhline(1.0, color=style.GREY, linewidth=0.8, linestyle="--")
    axes.annotate("exact: 1/8", (PERIODS, 1.0), ha="right", va="bottom",
                  color=style.GREY, fontsize=7)
    axes.set_ylim(0.65, 1.03)
    axes.set_xlabel("periods $t/T$")
    axes.set_ylabel("energy / exact energy")
    style.legend(axes)
    pictures.save(figure, picture)


if __name__ == "__main__":
    main()
