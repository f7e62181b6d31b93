# SPDX-License-Identifier: LGPL-2.1-or-later
"""Texts of scenes of blocks in contact, from their numbers."""


def section(title, *lines):
    """A subsection; lines NAME = VALUE, or sections inside."""
    inside = "".join(line if line.startswith("subsection")
                     else f"set {line}\n" for line in lines)
    return f"subsection {title}\n{inside}end\n"


def block(number, arguments, support, *mesh, more=()):
    """A rectangle or box: cells, corners and whether sides have ids of their
    own; mesh: further lines of its mesh, more: of the body."""
    return section(
        f"Body {number}",
        section("Mesh", "Generator = subdivided_hyper_rectangle",
                f"Arguments = {arguments}", *mesh),
        f"Support = {support}", *more)


def pair(secondary, primary):
    return section("Pair 1", f"Secondary = {secondary}", f"Primary = {primary}")


def solid(dimension, *parts, bodies=2, obstacles=0, pairs=1):
    """The whole scene: its parts, each a section."""
    return (f"set Scene = solid\nset Dimension = {dimension}\n"
            + section("Solid", f"Bodies = {bodies}", f"Obstacles = {obstacles}",
                      f"Pairs = {pairs}") + "".join(parts))
