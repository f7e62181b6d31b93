# SPDX-License-Identifier: LGPL-2.1-or-later
"""Bodies in contact on 1, 2, 3 and 5 ranks: the same forces, and the same
nodes in contact, wherever the mesh is cut."""
import math
import re

import vtu
from block_scene import block, pair, section, solid
from program import Program

RANKS = (1, 2, 3, 5)
EXACT = section("Method", "Enforcement = lagrange",
                "Final linear tolerance = 1e-12")


def from_level(level, *more):
    return section("Refinement", f"Level = {level}",
                   f"Coarsest level = {level}", *more)


# A block on another, turned one: pressed on one edge, lifted on the other, and
# pushed along, on meshes that are refined where contact ends.
PUSHED = solid(
    3,
    block(1, "4, 2, 1 : 0, 0, 0 : 2, 1, 0.5 : true", "4: 0, 0, 0",
          "Rotate = 0, 0, 21"),
    block(2, "3, 3, 1 : 0.37, 0.2, 0.5 : 1.4, 0.9, 1 : true",
          "5: 0.03*t, 0.01*t, -0.02*t*(1.1-x)"),
    pair("2: 4", "1: 5"), section("Load steps", "Steps = 2"),
    from_level(1, "Adaptive cycles = 1"), EXACT)

# A disc that is rolled along a strip: contact begins on one rank and ends on
# another.
ROLLED = solid(
    2, block(1, "8, 1 : 0, -1 : 8, 0 : true", "2: 0, 0"),
    section("Obstacle 1", "Kind = sphere", "Centre = 0, 3", "Radius = 3",
            "Motion = 1+1.5*t, -0.05"),
    section("Pair 1", "Secondary = 1: 3", "Obstacle = 1"),
    section("Load steps", "Steps = 4", "End time = 4"), from_level(2), EXACT,
    bodies=1, obstacles=1)

# Two blocks of as many cells, so that on two ranks each has one.
APART = solid(
    3, block(1, "4, 2, 1 : 0, 0, 0 : 1, 1, 1 : true", "4: 0, 0, 0"),
    block(2, "1, 2, 4 : 0, 0, 1 : 1, 1, 2 : true", "5: 0, 0, -0.02*(1.1-x)"),
    pair("1: 5", "2: 4"), from_level(1), EXACT)

p = Program()


def size(values):
    return math.sqrt(sum(v * v for v in values))


def near(one, other, scale, tolerance):
    return (len(one) == len(other) and scale > 0
            and size(a - b for a, b in zip(one, other)) <= tolerance * scale)


def solve(name, text, ranks):
    """Summary and what ranks have written of contact, by load step."""
    out = f"{name}-{ranks}"
    result = p.call("run", p.write(name + ".prm", text), "--quiet", "--output",
                    out, ranks=ranks)
    p.expect(result.returncode == 0, f"{out}: {result.stderr}")
    steps = [vtu.pieces(path)
             for path in sorted((p.folder / out).glob("contact_*.vtu"))]
    values = [value for pieces in steps for piece in pieces
              for value in zip(piece.fields["status"], piece.fields["gap"])]
    p.expect(all(math.isnan(gap) for status, gap in values if status == -1)
             and all(math.isfinite(gap) for status, gap in values
                     if status == 1), f"{out}: gaps without rows")
    return p.summary(out), steps


def nodes(pieces):
    """States of contact by node of the undeformed mesh: 1 in contact, 0 open,
    -1 without a row; between, where the node hangs."""
    result = {}
    for piece in pieces:
        for point, state in zip(piece.points, piece.fields["status"]):
            place = tuple(round(x, 4) for x in point)
            result.setdefault(place, set()).add(round(state, 3))
    return result


def compare(name, text, n_steps):
    """Solve on all numbers of ranks; returns what each had."""
    runs = {ranks: solve(name, text, ranks) for ranks in RANKS}
    one, steps = runs[1]
    force = size(one["pair_1_force"])
    p.expect(len(steps) == n_steps, f"{name}: {len(steps)} steps")
    for ranks in RANKS[1:]:
        other, other_steps = runs[ranks]
        here = f"{name} on {ranks} ranks: "
        for key in ("dofs", "cells", "pair_1_rows", "pair_1_active"):
            p.expect(other[key] == one[key],
                     f"{here}{key} {other[key]} is not {one[key]}")
        for key in ("pair_1_force", "pair_1_moment", "reaction_1"):
            p.expect(near(other[key], one[key], force, 1e-8),
                     f"{here}{key} {other[key]} is not {one[key]}")
        p.close(other["energy"] / one["energy"], 1, 1e-8, here + "energy")
        p.expect(other["force_imbalance"] <= 1e-11, here + "balance")
        for step, (mine, first) in enumerate(zip(other_steps, steps)):
            p.expect(nodes(mine) == nodes(first),
                     f"{here}nodes in contact at step {step + 1}")
        p.expect(len(other_steps) == len(steps), here + "steps")
    return runs


def ranks_in_contact(pieces):
    return [k for k, piece in enumerate(pieces)
            if max(piece.fields["status"]) == 1.]


def facet_sizes(pieces):
    """Diagonals of the facets of either side: those without rows are of the
    primary."""
    sizes = {False: set(), True: set()}
    for piece in pieces:
        for cell in piece.cells:
            corners = [piece.points[v] for v in cell]
            rows = max(piece.fields["status"][v] for v in cell) > -1
            sizes[rows].add(max(round(math.dist(a, b), 3) for a in corners
                                for b in corners))
    return sizes


def check_pushed():
    runs = compare("pushed", PUSHED, 2)
    for ranks in RANKS[1:]:
        summary, steps = runs[ranks]
        p.expect(len(steps[-1]) >= 2 and len(ranks_in_contact(steps[-1])) >= 2,
                 f"contact is cut by {ranks} ranks")
        p.expect(0 < summary["pair_1_active"] < summary["pair_1_rows"],
                 "a part is in contact")
    sizes = facet_sizes(runs[1][1][-1])
    p.expect(all(len(side) >= 2 for side in sizes.values()),
             f"hanging nodes on both sides: {sizes}")


def check_rolled():
    runs = compare("rolled", ROLLED, 4)
    for ranks in RANKS[2:]:
        places = [ranks_in_contact(pieces) for pieces in runs[ranks][1]]
        p.expect(len(places) == 4 and places[0] and places[-1]
                 and max(places[0]) < min(places[-1]),
                 f"contact moves over {ranks} ranks: {places}")


def check_apart():
    runs = compare("apart", APART, 1)
    pieces = runs[2][1][-1]
    states = [set(piece.fields["status"]) for piece in pieces]
    p.expect(len(states) == 2 and -1. not in states[0] and states[1] == {-1.},
             f"a body each: {states}")
    p.expect(runs[2][0]["ghost_facets_on_rank"][0] > 0, "facets of the other")


# Two long strips, of which each of five ranks has a part.
STRIPS = solid(
    2, block(1, "20, 1 : 0, -1 : 20, 0 : true", "2: 0, 0"),
    block(2, "30, 1 : 0, 0 : 20, 1 : true", "3: 0, -0.01"),
    pair("2: 2", "1: 3"), EXACT)


def check_volume():
    """No rank has the whole interface, and twice the facets are twice the
    bytes."""
    levels = []
    for level in (2, 3):
        done = p.call("check", p.write("strips.prm", STRIPS), "--set",
                      f"Refinement/Level={level}", "--set",
                      f"Refinement/Coarsest level={level}", "--verbose",
                      ranks=5)
        p.expect(done.returncode == 0, "strips: " + done.stderr)
        found = {line.split()[0]: [float(word) for word in line.split()[1:]]
                 for line in done.stdout.splitlines()
                 if re.match(r" *(facets|ghost|communicated|gathered)_", line)}
        n_facets = 50 * 2**level
        most = found["facets_on_rank"][1] + found["ghost_facets_on_rank"][1]
        p.expect(found["ghost_facets_on_rank"][0] > 0 and most < 0.6 * n_facets,
                 f"strips, level {level}: {found} of {n_facets} facets")
        levels.append(found)
    coarse, fine = (found["communicated_bytes"][0] for found in levels)
    p.expect(coarse < fine <= 2.1 * coarse, f"bytes: {coarse}, then {fine}")
    p.expect(levels[0]["gathered_bytes"] == levels[1]["gathered_bytes"],
             "bytes of boxes do not depend on the mesh")


def check_idle_ranks():
    """Two cells on the coarsest mesh: some ranks have nothing to do there."""
    one, many = (p.solve("rigid-plate.prm", ranks=ranks)[0]
                 for ranks in (1, 5))
    for key in ("energy", "contact_force"):
        p.close(many[key], one[key], 1e-8, f"more ranks than cells: {key}")


def check_jumps():
    """Points that jump are counted wherever they are: what is said is the
    same."""
    said = []
    for ranks in (0, 3):
        result = p.call("run", p.source / "prm/failures/jumping-node.prm",
                        "--output", "out", "--quiet", ranks=ranks)
        p.expect(result.returncode == 3, f"jumping node on {ranks} ranks: "
                 f"exit code {result.returncode}")
        said += re.findall(r"Of the points that press, \d+ jumped",
                           result.stderr)
    p.expect(len(said) == 2 and said[0] == said[1], f"jumps: {said}")


check_pushed()
check_rolled()
check_jumps()
check_apart()
check_volume()
check_idle_ranks()
p.finish()
