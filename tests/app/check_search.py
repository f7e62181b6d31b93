# SPDX-License-Identifier: LGPL-2.1-or-later
"""`abut search` against brute force and closed forms on small surfaces, and
its errors."""
import itertools
import math
import struct

from program import Program

p = Program()
QUIET = ("--output", "out", "--quiet", "--set", "Sweep/Bucket sizes=",
         "--set", "Output/Fields=false")


def scene(secondary, primary="", search="", dimension=3):
    return p.write("scene.prm", f"""set Scene = search
set Dimension = {dimension}
subsection Secondary
{secondary}
end
subsection Primary
{primary}
end
subsection Search
{search}
end
""")


def box(n, low, high, surface, *more):
    """A box of n cells per side and one in the last direction."""
    cells = ", ".join(map(str, n)) + ", 1"
    return "\n".join([
        "set Generator = subdivided_hyper_rectangle",
        f"set Arguments = {cells} : {', '.join(map(str, low))} : "
        f"{', '.join(map(str, high))} : true",
        f"set Surface ids = {surface}", *more])


def search(file, *words):
    result = p.call("search", file, *QUIET, *words)
    p.expect(result.returncode == 0, f"exit {result.returncode}: "
             f"{result.stderr}")
    return p.summary() if result.returncode == 0 else {}


def expect(found, what, **values):
    for key, value in values.items():
        if isinstance(value, float):
            p.close(found.get(key), value, 1e-9, f"{what}: {key}")
        else:
            p.expect(found.get(key) == value,
                     f"{what}: {key} is {found.get(key)}, not {value}")


def upper(n, gap=0.05, *more):
    return box((n, n), (0, 0, gap), (1, 1, gap + 1), 4, *more)


def lower(n, *more):
    return box((n, n), (0, 0, -1), (1, 1, 0), 5, *more)


# Candidates and pairs of boxes by the definition, node by node and facet by
# facet. The reach is chosen so that no distance is one of its limits.
def brute_force(n1, n2, gap, relative_reach):
    size, nodes = 1 / n2, 0
    reach, radius = relative_reach * size, math.sqrt(0.5) * size
    for i, j in itertools.product(range(n1 + 1), repeat=2):
        for k, l in itertools.product(range(n2), repeat=2):
            dx = abs(i / n1 - (k + 0.5) / n2)
            dy = abs(j / n1 - (l + 0.5) / n2)
            if (max(dx, dy) <= size / 2 + reach and gap <= reach
                    and math.sqrt(dx * dx + dy * dy + gap * gap)
                    <= reach + radius):
                nodes += 1
    line = sum(abs((i + 0.5) / n1 - (k + 0.5) / n2)
               <= 0.5 / n1 + size / 2 + reach
               for i in range(n1) for k in range(n2))
    return nodes, line * line


for n1, n2, reach in ((7, 5, 0.317), (4, 9, 1.137)):
    candidates, pairs = brute_force(n1, n2, 0.05, reach)
    for algorithm in ("all pairs", "uniform buckets", "adaptive buckets"):
        expect(search(scene(upper(n1), lower(n2), f"set Relative reach = "
                            f"{reach}\nset Algorithm = {algorithm}")),
               f"{n1} {n2} {algorithm}", candidates=candidates, pairs=pairs,
               pairs_with_area=(n1 + n2 - 1)**2, common_area=1.0,
               contact_elements=(n1 + 1)**2, smallest_gap=0.05)

# A bucket size that is absurd changes nothing.
for size in (1e-9, 1e9):
    expect(search(scene(upper(7), lower(5), "set Relative reach = 0.317\n"
                        f"set Bucket size = {size}\n"
                        "set Algorithm = uniform buckets")),
           f"bucket size {size}", pairs_with_area=121,
           candidates=brute_force(7, 5, 0.05, 0.317)[0])

# Other words of the section: lists that are too long find the same contact,
# a bucket holds as many facets as it may, and a surface at 60 degrees is
# faced within 70 degrees but not within 50.
expect(search(scene(upper(7), lower(5), "set Skin = 0.3\n"
                    "set Bucket capacity = 3")),
       "skin", contact_elements=64, pairs_with_area=121, bucket_capacity=3)
for angle, n in ((70, 9), (50, 0)):
    found = search(scene(box((2, 2), (0.4, 0, 0), (0.6, 0.1, 1), 4,
                             "set Rotate = 60, 0, 0", "set Move = 0, 0.5, 0.1"),
                         lower(5), "set Reach = 0.5\n"
                         f"set Facing angle = {angle}"))
    expect(found, f"angle {angle}", contact_elements=n,
           rejected_facing_away=0 if n else found["candidates"])
    p.expect(found["candidates"] > 0, "no candidates")

# Uncovered: of 9 columns of nodes at x = 1/2 .. 3/2, those beyond 1 are not
# paired; they have 3 1/2 eighths of the area.
expect(search(scene(upper(8, 0.0625, "set Move = 0.5, 0, 0"), lower(8),
                    "set Extension = 0\nset Relative reach = 1")),
       "shifted", contact_elements=45, uncovered_area=3.5 / 8)

# Too far apart; inside out; overlapping; on the wrong side of a thin body.
result = p.call("search", scene(upper(4, 3), lower(4)), *QUIET)
p.expect("no facet is within reach" in result.stderr, "no word on reach")
expect(p.summary(), "far", contact_elements=0, candidates=0, pairs=0,
       uncovered_area=1.0)
result = p.call("search", scene(box((4, 4), (0, 0, -1), (1, 1, 0.05), 5),
                                lower(4)), *QUIET)
p.expect("inside out" in result.stderr, "no word on reversed normals")
expect(p.summary(), "reversed", contact_elements=0, reversed_normals=25,
       pairs_with_area=0)
result = p.call("search", scene(upper(4, -0.04), lower(4)), *QUIET)
p.expect("25 nodes overlap" in result.stderr, "no word on overlaps")
expect(p.summary(), "overlap", contact_elements=25, initial_overlaps=25,
       largest_overlap=0.04)
for thickness, n in (("0.07", 0), ("0.09", 25), ("5: 0.07", 0),
                     ("5: 0.09; *: 0.01", 25)):
    expect(search(scene(upper(4, -0.04), lower(4),
                        f"set Thickness = {thickness}")),
           f"thickness {thickness}", contact_elements=n)

# A strip bent to a ring with a slit of 0.02 radian: its two ends face each
# other, (4 + 1) (3 + 1) nodes each. Everything else of it is out of reach.
ring = box((60, 4), (0, 1, 0), (1, 1.4, 0.3), "*",
           "set Arguments = 60, 4, 3 : 0, 1, 0 : 1, 1.4, 0.3 : true",
           "set Map = y*sin((2*pi-0.02)*x); y*cos((2*pi-0.02)*x); z")
found = search(scene(ring, "", "set Self contact = true"))
expect(found, "ring", contact_elements=40)
p.expect(0.0199 < found["smallest_gap"] <= 0.02
         and 0.0279 < found["largest_gap"] <= 0.028,
         f"slit {found['smallest_gap']} {found['largest_gap']}")


# STL, text and binary: an n x n grid at height z, two triangles a square.
def triangles(n, z, flip=()):
    result = []
    for i, j in itertools.product(range(n), repeat=2):
        a, b, c, d = ((x / n, y / n, z) for x, y in
                      ((i, j), (i + 1, j), (i, j + 1), (i + 1, j + 1)))
        result += [(a, b, d), (a, d, c)]
    return [t[::-1] if i in flip else t for i, t in enumerate(result)]


def text_stl(name, list_of_triangles):
    lines = ["solid s"]
    for t in list_of_triangles:
        lines += ["facet normal 0 0 1", "outer loop",
                  *(f"vertex {x} {y} {z}" for x, y, z in t), "endloop",
                  "endfacet"]
    p.write(name, "\n".join(lines + ["endsolid s", ""]))


def binary_stl(name, list_of_triangles):
    data = b"solid, though it is binary".ljust(80) + struct.pack(
        "<I", len(list_of_triangles))
    for t in list_of_triangles:
        data += struct.pack("<12fH", 0, 0, 1, *(c for x in t for c in x), 0)
    (p.folder / name).write_bytes(data)


text_stl("text.stl", triangles(4, 0))
binary_stl("binary.stl", triangles(4, 0))
for name in ("text.stl", "binary.stl"):
    expect(search(scene(upper(8), f"set File = {name}")), name, facets=32,
           contact_elements=81, common_area=1.0, primary_area=1.0,
           uncovered_area=0.0, pairs_with_area=4 * 16 + 2 * 16)
expect(search(scene(upper(8, 0.05, "set Move = 2, 0, 1"),
                    "set File = text.stl\nset Scale = 2, 1, 1\n"
                    "set Move = 2, 0, 0\nset Map = x; y; z + 1")),
       "moved triangles", contact_elements=81, common_area=1.0,
       primary_area=2.0)


# Errors.
def wrong(file, *words, command="search", ranks=0):
    p.expect_error(p.call(command, file, *QUIET[:3], ranks=ranks), *words)


def wrong_file(name, *words):
    wrong(scene(upper(2), f"set File = {name}"), "scene.prm:9: Primary/File",
          name, *words)


wrong(p.source / "prm/point-mass.prm", "'abut search' takes scenes of kind",
      "point mass")
wrong(scene(upper(2), lower(2)), "one rank", "2", ranks=2)
wrong(scene(upper(2), lower(2)), "one rank", "2", ranks=2, command="run")
wrong_file("nowhere.stl", "cannot be opened")
p.write("garbage.stl", "hello")
wrong_file("garbage.stl", "'solid'")
text_stl("empty.stl", [])
wrong_file("empty.stl", "no triangles")
p.write("word.stl", "solid\nfacet normal 0 0 1\nouter lop\nvertex 0 0\n")
wrong_file("word.stl", "'vertex' in line 4")
flat = triangles(2, 0)
text_stl("degenerate.stl", flat[:5] + [(flat[5][0],) * 2 + flat[5][1:2]]
         + flat[6:])
wrong_file("degenerate.stl", "surface 'Primary'", "facet 5")
text_stl("inverted.stl", triangles(2, 0, flip=(3,)))
wrong_file("inverted.stl", "surface 'Primary'", "inverted", "facet 3")
expect(search(scene(upper(2), "set File = inverted.stl",
                    "set Check orientation = false")), "inverted", facets=8)
text_stl("good.stl", flat)
wrong(scene(upper(2), "set File = good.stl\nset Refinements = 1"),
      "scene.prm:10: Primary/Refinements", "STL")
wrong(scene(box((2,), (0, 0), (1, 1), 3), "set File = good.stl",
            dimension=2), "Primary/File", "3 dimensions")
wrong(scene(upper(2, 0.05, "set Map = x; y; -z"), lower(2)),
      "scene.prm:7: Secondary/Map", "mirrors")
wrong(scene(upper(2, 0.05, "set Map = x; y"), lower(2)), "Secondary/Map",
      "3 formulas")
wrong(scene(upper(2, 0.05, "set Map = x; y; 1/(x - 0.5)"), lower(2)),
      "Secondary/Map")
wrong(scene(box((2, 2), (0, 0, 0), (1, 1, 1), 7), lower(2)),
      "Secondary/Surface ids", "7")
wrong(scene(upper(2, 0.05, "set Refinements = 25"), lower(2)),
      "Secondary/Refinements", "cells")
wrong(scene(upper(2), lower(2), "set Algorithm = octree"), "Search/Algorithm",
      "uniform buckets")
wrong(scene(upper(2), lower(2), "set Thickness = 5: thin"),
      "Search/Thickness", "5: thin")
wrong(scene(upper(2), lower(2), "set Thickness = -1"), "Search/Thickness")
result = p.call("search", scene(upper(2), lower(2)), "--set",
                "Sweep/Bucket sizes=0", *QUIET[:3])
p.expect_error(result, "Sweep/Bucket sizes", "positive")

# check stops after the report: nothing is timed or written.
result = p.call("check", scene(upper(7), lower(5)), "--verbose")
p.expect(result.returncode == 0 and "pairs_with_area" in result.stdout
         and "ns_per_node" not in result.stdout
         and "by algorithm" not in result.stdout
         and not (p.folder / "output").exists(), "check " + result.stdout)

# The sweep's table and picture.
result = p.call("run", scene(upper(7), lower(5)), "--output", "out", "--set",
                "Output/Pictures=true", "--set", "Sweep/Bucket sizes=1 2")
rows = (p.folder / "out/sweep.csv").read_text().splitlines()
p.expect(len(rows) == 1 + 1 + 3 + 3, f"sweep.csv: {rows}")
p.expect(len({row.split(",")[-1] for row in rows[1:]}) == 1,
         "candidates differ")
p.expect((p.folder / "out/search.svg").exists(), "no search.svg")
for name in ("secondary.vtu", "primary.vtu"):
    p.expect((p.folder / "out" / name).stat().st_size > 0, name)

p.finish()
