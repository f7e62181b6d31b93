# SPDX-License-Identifier: LGPL-2.1-or-later
"""Who may touch whom while bodies slide: contact elements that are gained, lost
and exchanged as geometry says, the same answer by all algorithms, few searches,
and ranks that keep little more than their share."""
from block_scene import block, pair, section, solid
from program import Program, set_words
from sliding_scenes import RUBBER

p = Program()


def solved(scene, *settings, ranks=0):
    result = p.call("run", scene, "--output", "out", "--quiet",
                    *set_words(settings), ranks=ranks)
    p.expect(result.returncode == 0, f"{scene} {settings}: exit code "
             f"{result.returncode}\n{result.stderr}")
    return p.results()


# A flat die with six facets comes down on a block from a height of two facets, is
# pressed by 1 % of a facet, slides by half a facet at a step, and goes up again.
# Facets have a size of 0.2 on both sides, nodes of the die are 0.3 of it behind
# those of the block. A node is paired within max(half a facet, 1.5 times what the
# die moves in the step): first at a gap of 0.08, and last at that, too.
N_NODES = 7
FLAT = p.write("flat.prm", solid(
    2, block(1, "20, 2 : 0, 0.6 : 4, 1 : true", "2: 0, 0", more=RUBBER),
    block(2, "6, 2 : 0.26, 1.4 : 1.46, 1.8 : true",
          "3: if(t > 6, 0.1*(min(t, 26) - 6), 0), if(t > 5, "
          "-0.402 + 0.08*max(0, t - 26), -0.08*t)", more=RUBBER),
    pair("2: 2", "1: 3"), section("Load steps", "Steps = 29", "End time = 29"),
    section("Refinement", "Level = 0"), section("Output", "Fields = false")))


def expected(t):
    """Gained, lost and exchanged in the step that ends at t."""
    if t == 4:
        return N_NODES, 0, 0
    if t == 28:
        return 0, N_NODES, 0
    place = lambda time: 0.3 + 0.5 * (min(max(time, 6), 26) - 6)
    return 0, 0, N_NODES * (int(place(t)) - int(place(t - 1)))


def check_elements():
    for words in (["Method/Discretisation=node to segment"],
                  ["Method/Discretisation=dual mortar"]):
        summary, rows = solved(FLAT, *words)
        p.expect(len(rows) == 29, f"{words}: {len(rows)} load steps")
        for row in rows:
            found = tuple(row[key] for key in ("gained", "lost", "exchanged"))
            p.expect(found == expected(row["time"]),
                     f"{words}: {found} at {row['time']}, not "
                     f"{expected(row['time'])}")
        totals = [summary[f"elements_{key}"]
                  for key in ("gained", "lost", "exchanged")]
        p.expect(totals == [N_NODES, N_NODES, 10 * N_NODES],
                 f"{words}: {totals} in all")


def check_algorithms():
    """Bit by bit."""
    first = None
    for words in (["Search/Algorithm=all pairs"],
                  ["Search/Algorithm=uniform buckets"],
                  ["Search/Algorithm=adaptive buckets"],
                  ["Search/Algorithm=adaptive buckets", "Search/Skin=1e-9"]):
        summary, rows = solved(FLAT, *words)
        answer = [[row[key] for key in row
                   if "seconds" not in key
                   and key not in ("searches", "reuses")] for row in rows]
        first = first or answer
        p.expect(answer == first, f"{words}: another answer")
        asked = summary["searches"] + summary["search_reuses"]
        print(words, summary["searches"], "of", asked, "searches",
              summary["linearisations"], "linearisations")
        # Every linearisation, every trial and every commit look.
        p.expect(asked > summary["linearisations"], f"{words}: {asked} searches")
        if len(words) == 1:
            p.expect(summary["searches"] <= 29 + 6, f"{words}: "
                     f"{summary['searches']} searches in 29 load steps")
        else: # but at one and the same place
            p.expect(summary["searches"] > summary["linearisations"],
                     f"{words}: {summary['searches']} searches")


# The same die is pressed on a long block and slides over it with friction, a
# facet at a step, twenty of its ninety, across the places where the block is cut
# for two ranks and for three.
LONG = p.write("long.prm", solid(
    2, block(1, "90, 2 : 0, 0.6 : 18, 1 : true", "2: 0, 0", more=RUBBER),
    block(2, "6, 2 : 5.26, 1 : 6.46, 1.4 : true",
          "3: 0.2*max(0, t - 1), -0.002", more=RUBBER),
    section("Pair 1", "Secondary = 2: 2", "Primary = 1: 3", "Friction = 0.2"),
    section("Load steps", "Steps = 21", "End time = 21"),
    section("Refinement", "Level = 0"), section("Output", "Fields = false")))


def check_ranks():
    """Forces are the same, and a rank has its own facets, and those that are
    near: the die's six and what they may touch, with two rings and the way of
    a step."""
    whole = 90 + 6
    runs = {ranks: solved(LONG, ranks=ranks) for ranks in (1, 2, 3)}
    _, steps = runs[1]
    p.expect([row["exchanged"] for row in steps] == [0.] + 20 * [N_NODES],
             f"exchanged {[row['exchanged'] for row in steps]}")
    scale = max(row["contact_force"] for row in steps)
    for ranks in (2, 3):
        summary, rows = runs[ranks]
        what = f"{ranks} ranks: "
        p.expect(len(rows) == len(steps), what + "load steps")
        for mine, theirs in zip(rows, steps):
            for key in ("pair_1_force_x", "pair_1_force_y"):
                p.expect(abs(mine[key] - theirs[key]) < 1e-7 * scale,
                         f"{what}{key} at {mine['time']}: {mine[key]}, on one "
                         f"rank {theirs[key]}")
            for key in ("gained", "lost", "exchanged"):
                p.expect(mine[key] == theirs[key], f"{what}{key} at "
                         f"{mine['time']}: {mine[key]}, not {theirs[key]}")
        most = summary["facets_on_rank"][1] + summary["ghost_facets_on_rank"][1]
        print(what, "facets", summary["facets_on_rank"], "of others",
              summary["ghost_facets_on_rank"], "gathered",
              summary["facet_gatherings"], "times")
        p.expect(most <= whole / ranks + 30, f"{what}{most} facets of {whole}")
        p.expect(1 < summary["facet_gatherings"] < len(rows) + 2,
                 f"{what}gathered {summary['facet_gatherings']} times")


def check_groups():
    """A node near two bodies belongs to the nearer one, in whatever order the
    pairs stand. One block is pressed on two, the second of which is lower."""
    bodies = (block(1, "10, 2 : 0, 1 : 2, 1.4 : true", "3: 0, -0.05")
              + block(2, "5, 3 : 0, 0 : 0.99, 1 : true", "2: 0, 0")
              + block(3, "5, 3 : 1.01, 0 : 2, 0.998 : true", "2: 0, 0"))
    answers = []
    for order in ((2, 3), (3, 2)):
        pairs = "".join(section(f"Pair {k + 1}", "Secondary = 1: 2",
                                f"Primary = {body}: 3")
                        for k, body in enumerate(order))
        scene = p.write("groups.prm", (
            "set Scene = solid\nset Dimension = 2\n"
            + section("Solid", "Bodies = 3", "Pairs = 2") + bodies + pairs
            + section("Refinement", "Level = 0")))
        summary, _ = solved(scene)
        forces = {body: summary[f"pair_{k + 1}_force"]
                  for k, body in enumerate(order)}
        rows = {body: summary[f"pair_{k + 1}_rows"]
                for k, body in enumerate(order)}
        answers.append((summary["energy"], forces, rows))
    (energy, forces, rows), (other, swapped, others) = answers
    p.close(other, energy, 1e-10, "pairs in another order: energy")
    p.expect(rows == others, f"pairs in another order: rows {rows}, {others}")
    for body in (2, 3):
        p.close(swapped[body][1], forces[body][1], 1e-9,
                f"pairs in another order: force on body {body}")
        p.expect(forces[body][1] > 0., f"body {body} is touched")


check_elements()
check_algorithms()
check_groups()
check_ranks()
p.finish()
