#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Test of the judge: true outputs of small scenes pass, and each of many
falsified copies of them is found.

    falsified.py --abut build/release/abut
"""
import argparse
import csv
import json
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import xml.etree.ElementTree

import judge
from hanging import HangingNodes
from run_files import Fields, read_nodes, vtu
from runs import has_mesh
from scene import Scene

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent

BLOCKS = """
set Scene = solid
set Dimension = {dim}
subsection Solid
  set Bodies = 2
  set Pairs = 1
  set Degree = {degree}
end
subsection Body 1
  subsection Mesh
    set Generator = subdivided_hyper_rectangle
    set Arguments = {below} : true
  end
  set Young modulus = 70
  set Support = {floor}
end
subsection Body 2
  subsection Mesh
    set Generator = subdivided_hyper_rectangle
    set Arguments = {above} : true
  end
  set Young modulus = 210
  set Support = {walls}
  set Pressure = {top}: 1
end
subsection Pair 1
  set Secondary = 2: {bottom}
  set Primary = 1: {top}
end
subsection Refinement
  set Level = 0
end
"""

SCENES = {
    "blocks": BLOCKS.format(
        dim=2, degree=1, below="6, 3 : 0, 0 : 3, 1", floor="2: 0, 0",
        above="5, 3 : 0.5, 1 : 2.5, 2", walls="0: 0, free", top=3, bottom=2),
    "quadratic": BLOCKS.format(
        dim=2, degree=2, below="4, 2 : 0, 0 : 3, 1", floor="2: 0, 0",
        above="3, 2 : 0.5, 1 : 2.5, 2", walls="0: 0, free", top=3, bottom=2),
    "cubes": BLOCKS.format(
        dim=3, degree=1, below="3, 3, 2 : 0, 0, 0 : 1.5, 1.5, 1",
        floor="4: 0, 0, 0", above="2, 2, 2 : 0.2, 0.3, 1 : 1.2, 1.3, 2",
        walls="0: 0, free, free; 2: free, 0, free", top=5, bottom=4),
    "disc": """
set Scene = solid
set Dimension = 2
subsection Solid
  set Obstacles = 1
  set Pairs = 1
  set Plane = axisymmetric
end
subsection Body 1
  subsection Mesh
    set Generator = subdivided_hyper_rectangle
    set Arguments = 8, 6 : 0, -1 : 1, 0 : true
  end
  set Support = 0: 0, free; 2: 0, 0
  set Body force = 0, -0.01
end
subsection Obstacle 1
  set Kind = sphere
  set Centre = 0, 1
  set Radius = 1
  set Motion = 0, -0.05*t
end
subsection Pair 1
  set Secondary = 1: 3
  set Obstacle = 1
end
subsection Refinement
  set Level = 0
end
""",
    # hanging nodes on a curved hull
    "hull": """
set Scene = solid
set Dimension = 3
subsection Solid
  set Obstacles = 1
  set Pairs = 1
end
subsection Body 1
  subsection Mesh
    set Generator = subdivided_cylinder
    set Arguments = 1 : 1 : 0.25
  end
  set Young modulus = 100
  set Poisson ratio = 0
  set Support = 2: -0.005, 0, 0
end
subsection Obstacle 1
  set Kind = plane
  set Point = -0.25, 0, 0
  set Normal = 1, 0, 0
  set Rotation angle = t > 1 ? t - 1 : 0
  set Rotation axis = 1, 0, 0
end
subsection Pair 1
  set Secondary = 1: 1
  set Obstacle = 1
  set Friction = 0.3
end
subsection Load steps
  set Steps = 2
  set End time = 2
end
subsection Refinement
  set Level = 1
  set Adaptive cycles = 1
end
""",
    "corner": """
set Scene = solid
set Dimension = 2
subsection Solid
  set Obstacles = 1
  set Pairs = 1
end
subsection Body 1
  subsection Mesh
    set Generator = subdivided_hyper_rectangle
    set Arguments = 8, 8 : 0, 0 : 1, 1 : true
  end
  set Support = 0: 0, free; 2: 0, 0
end
subsection Obstacle 1
  set Kind = sphere
  set Centre = 0.1, 2
  set Radius = 1
  set Motion = 0, -0.05*t
end
subsection Pair 1
  set Secondary = 1: 3
  set Obstacle = 1
end
subsection Refinement
  set Level = 0
end
""",
    "dragged": """
set Scene = solid
set Dimension = 2
subsection Solid
  set Obstacles = 1
  set Pairs = 1
end
subsection Body 1
  subsection Mesh
    set Generator = subdivided_hyper_rectangle
    set Arguments = 16, 8 : 0, 0 : 2, 1 : true
  end
  set Young modulus = 100
  set Support = 1: 0, free
  set Traction = 3: 0, -5; 0: 15, 0
end
subsection Obstacle 1
  set Kind = plane
  set Point = 0, 0
  set Normal = 0, 1
end
subsection Pair 1
  set Secondary = 1: 2
  set Obstacle = 1
  set Friction = 0.7
end
subsection Refinement
  set Level = 0
end
""",
    "membrane": """
set Scene = obstacle
set Dimension = 2
subsection Mesh
  set Generator = hyper_cube
  set Arguments = -1 : 1 : false
end
subsection Membrane
  set Body force = -4
end
subsection Contact
  set Obstacle = -0.3 - 0.2*x^2
end
subsection Refinement
  set Level = 3
end
""",
    "rubbed": BLOCKS.format(
        dim=3, degree=1, below="3, 3, 2 : 0, 0, 0 : 1.5, 1.5, 1",
        floor="4: 0, 0, 0", above="2, 2, 2 : 0.2, 0.3, 1 : 1.2, 1.3, 2",
        walls="5: 0.05, 0.02, -0.02", top=5, bottom=4).replace(
            "  set Pressure = 5: 1\n", "").replace(
                "  set Primary", "  set Friction = 0.3\n  set Primary"),
    "rubber": (ROOT / "prm/finite-disc.prm").read_text(encoding="utf-8")
    .replace("set Level = 4", "set Level = 3")
    .replace("set Number of steps = 15", "set Number of steps = 4"),
    "pad": (ROOT / "prm/rubber-pad.prm").read_text(encoding="utf-8")
    .replace("set Number of steps = 5", "set Number of steps = 2"),
    "motion": (ROOT / "prm/bar-impact.prm").read_text(encoding="utf-8")
    .replace("set End time = 2", "set End time = 0.6"),
    "rubber in motion": (ROOT / "prm/ring-impact.prm").read_text(
        encoding="utf-8").replace("set End time = 4", "set End time = 0.6"),
    "thrown": """
set Scene = motion
set Dimension = 2
subsection Masses
  set Number = 3
  set Mass = 2
  set Spring = 3
end
subsection Motion
  set Gap = 0.2
  set Initial velocity = 1 + 0.1*x; -0.3*x
  set Acceleration = 0; -5
end
subsection Contact
  set Friction = 0.1
end
subsection Time
  set Restitution = 0.4
  set Step = 0.03
  set End = 1
end
""",
    "masses": """
set Scene = chain of masses
set Dimension = 3
subsection Masses
  set Number = 4
  set Spring = 5
  set End spring = 2
  set Gap = if(x > 2.5, 2, 0)
end
subsection Load
  set Pressing force = 0.5 + 0.3*x
  set Driven end = 3*t; 2*t^2
end
subsection Load steps
  set Steps = 8
end
""",
}


class Copy:
    """The files of a run, to be falsified."""

    def __init__(self, folder, scene):
        self.folder, self.scene = folder, scene

    def summary(self, change):
        path = self.folder / "summary.json"
        data = json.loads(path.read_text(encoding="utf-8"))
        change(data)
        path.write_text(json.dumps(data), encoding="utf-8")

    def table(self, name, change):
        """Change the rows of a table, dicts of numbers."""
        path = self.folder / name
        with open(path, newline="", encoding="utf-8") as file:
            reader = csv.DictReader(file)
            names = reader.fieldnames
            rows = [{k: float(v) if v else "" for k, v in row.items()}
                    for row in reader]
        rows = change(rows) or rows
        with open(path, "w", newline="", encoding="utf-8") as file:
            writer = csv.DictWriter(file, names)
            writer.writeheader()
            writer.writerows(rows)

    def nodes(self, change):
        self.table("nodal.csv", change)

    def fields(self, series, name, change):
        """Change a field of the last file: list of values, points, width."""
        path = self.last(series)
        tree = xml.etree.ElementTree.parse(path)
        for piece in tree.iter("Piece"):
            points = vtu.decode(piece.find("Points/DataArray"))
            places = list(zip(points[::3], points[1::3], points[2::3]))
            for array in piece.findall("PointData/DataArray"):
                if array.get("Name") != name:
                    continue
                values = list(vtu.decode(array))
                change(values, places, len(values) // len(places))
                array.set("format", "ascii")
                array.text = " ".join(map(repr, values))
        tree.write(path)

    def cells(self, series, keep):
        """Drop the cells that a function of the piece and the number of the
        cell does not keep."""
        path = self.last(series)
        tree = xml.etree.ElementTree.parse(path)
        for element in tree.iter("Piece"):
            piece = vtu.Piece(element)
            left = [c for c in range(len(piece.cells)) if keep(piece, c)]
            offsets, n = [], 0
            for c in left:
                n += len(piece.cells[c])
                offsets.append(n)
            new = {"connectivity": [i for c in left for i in piece.cells[c]],
                   "offsets": offsets, "types": [piece.types[c] for c in left]}
            for array in element.findall("Cells/DataArray"):
                array.set("format", "ascii")
                array.text = " ".join(map(str, new[array.get("Name")]))
            element.set("NumberOfCells", str(len(left)))
        tree.write(path)

    def last(self, series):
        return sorted(self.folder.glob(f"{series}_*.vtu"))[-1]

    def edit(self, old, new):
        text = self.scene.read_text(encoding="utf-8")
        assert old in text
        self.scene.write_text(text.replace(old, new), encoding="utf-8")


def scale(column, factor, where=lambda row: True):
    """Multiply columns whose name begins so."""
    def change(rows):
        for row in rows:
            if where(row):
                for name in row:
                    if name.startswith(column) and row[name] != "":
                        row[name] *= factor
    return change


def first(condition, **values):
    """Set columns of the first row that fulfils a condition."""
    def change(rows):
        row = next(row for row in rows if condition(row))
        row.update({k: v(row) for k, v in values.items()})
    return change


def all_displacements(copy, change):
    """A change of single vectors, u(place, u), in all files."""
    def of_rows(rows):
        for row in rows:
            names = [n for n in row if n.startswith("displacement")]
            place = [row[a] for a in "xyz" if a in row]
            new = change(place, [row[n] for n in names])
            row.update(zip(names, new))

    def of_field(values, places, width):
        for i, place in enumerate(places):
            values[width * i:width * (i + 1)] = change(
                place, values[width * i:width * (i + 1)])
    copy.nodes(of_rows)
    for series in ("fields", "contact"):
        if list(copy.folder.glob(f"{series}_*.vtu")):
            copy.fields(series, "displacement", of_field)


def shift_at(where, by):
    """A displacement with one node shifted."""
    def change(place, u):
        near = all(abs(a - b) < 1e-5 for a, b in zip(place, where))
        return [v + d for v, d in zip(u, by + [0.])] if near else u
    return change


def poke(index, value):
    def change(values, places, width):
        values[index] = value(values[index])
    return change


def negate_largest(values, places, width):
    i = max(range(len(values)), key=lambda k: abs(values[k]))
    values[i] = -values[i]


def truncate(name, part):
    def change(copy):
        path = (copy.folder / name if "." in name else copy.last(name))
        data = path.read_bytes()
        path.write_bytes(data[:int(part * len(data))])
    return change


def key(name, change):
    def of(copy):
        copy.summary(lambda s: s.update({name: change(s[name])}))
    return of


def opposite(name):
    return key(name, lambda v: [-x for x in v])


def energy(copy):
    copy.summary(lambda s: s.update(energy=s["energy"] * 1.01))
    copy.table("levels.csv", scale("energy", 1.01))


def swap_sides(copy):
    def change(values, places, width):
        values[:] = [3. - v for v in values]
    copy.fields("contact", "body", change)


def forgotten_load(copy):
    """Loads put among the reactions: all sums stay as they were."""
    def change(rows):
        for row in rows:
            for a in "xyz":
                if f"load_{a}" in row:
                    row[f"reaction_{a}"] += row[f"load_{a}"]
                    row[f"load_{a}"] = 0.
    copy.nodes(change)


def reaction_of_contact(rows):
    """What contact presses on supports counted as their reaction, which leaves
    all sums as they were."""
    for row in rows:
        for a in "xy":
            if row[f"held_{a}"] != 0:
                row[f"reaction_{a}"] += row[f"contact_{a}"]
                row[f"contact_{a}"] = 0.


def moved_reaction(rows):
    held = [row for row in rows if row["reaction_y"] != 0]
    a, b = held[0], held[-1]
    for name in ("reaction_x", "reaction_y"):
        a[name], b[name] = b[name], a[name]
    a["reaction_y"] += 0.01
    b["reaction_y"] -= 0.01


def on_plane(row, state):
    return row["y"] == 0. and row["status"] == state


def moved_friction(rows):
    """From what sticks to what slips: all sums stay as they were."""
    slip = next(row for row in rows if on_plane(row, 2))
    stick = next(row for row in rows if on_plane(row, 1))
    stick["contact_x"] -= 0.1 * slip["contact_x"]
    slip["contact_x"] *= 1.1


def turned_friction(rows):
    """Along the slip, the difference given to what sticks."""
    slip = next(row for row in rows if on_plane(row, 2))
    stick = next(row for row in rows if on_plane(row, 1))
    stick["contact_x"] += 2. * slip["contact_x"]
    slip["contact_x"] *= -1.


def friction_sums(copy):
    """More friction than mu N in the tables, the ratio as well."""
    for name in ("friction_force", "friction_ratio"):
        key(f"pair_1_{name}", lambda v: 1.2 * v)(copy)
    key("pair_1_friction", lambda v: [1.2 * x for x in v])(copy)


def moment_at_rest(copy):
    """Of the contact forces at the undeformed places."""
    with open(copy.folder / "nodal.csv", newline="", encoding="utf-8") as file:
        moment = sum(float(row["x"]) * float(row["contact_y"])
                     - float(row["y"]) * float(row["contact_x"])
                     for row in csv.DictReader(file))
    copy.summary(lambda s: s.update(
        pair_1_moment=[*s["pair_1_moment"][:-1], moment]))


def pair_of_forces(copy):
    """A millionth of a moment more about the axis of the hull."""
    def change(rows):
        held = [row for row in rows if row["reaction_x"] != 0]
        a = min(held, key=lambda row: row["y"])
        b = max(held, key=lambda row: row["y"])
        size = 1e-6 * sum(abs(row["reaction_y"]) for row in held)
        a["reaction_z"] += size
        b["reaction_z"] -= size
    copy.nodes(change)


def shifted_hanging_node(copy):
    """By a ten-thousandth: forces and other displacements stay."""
    nodes = read_nodes(copy.folder, 3, 1)
    number = min(HangingNodes(nodes, Fields(copy.folder, "fields",
                                            nodes).cells).parents)
    all_displacements(copy, shift_at(nodes.place[number], [0., 5e-7, 0.]))


def turned_forces(rows):
    """Contact forces of two nodes turned the opposite way: sums are kept."""
    a, b = [row for row in rows if row["contact_y"] < -0.01][:2]
    turn = 0.05 * a["contact_y"]
    a["contact_x"] += turn
    b["contact_x"] -= turn


def closed(row):
    return row.get("status", 0) > 0.5


def work_of_weight(copy):
    """More work in the last step and the summary, balanced by springs."""
    for name in ("external_work", "strain_energy"):
        copy.table("levels.csv", lambda rows, n=name: rows[-1].update(
            {n: rows[-1][n] + 0.1}))
        key(name, lambda v: v + 0.1)(copy)


def slips(row):
    return row["state"] == 2


# Name, scene, falsification.
FALSIFICATIONS = [
    ("sign of one pressure in the fields", "blocks",
     lambda c: c.fields("contact", "pressure", negate_largest)),
    ("a tension", "blocks",
     key("pair_1_largest_tension", lambda v: 0.01)),
    ("node shifted in the fields", "blocks",
     lambda c: c.fields("fields", "displacement",
                        poke(4, lambda v: v + 1e-3))),
    ("node shifted on the contact surface", "cubes",
     lambda c: c.fields("contact", "displacement",
                        poke(5, lambda v: v - 1e-3))),
    ("node of nodal.csv shifted", "quadratic",
     lambda c: c.nodes(first(lambda r: r["displacement_y"] != 0,
                             displacement_y=lambda r: 0.))),
    ("node pressed into the other body in all files", "blocks",
     lambda c: all_displacements(c, shift_at((1.3, 1.), [0., -0.2]))),
    ("inner node shifted in all files", "blocks",
     lambda c: all_displacements(c, shift_at((1.5, 2 / 3), [0.01, 0.]))),
    ("displacements scaled in all files", "cubes",
     lambda c: all_displacements(c, lambda x, u: [1.01 * v for v in u])),
    ("contact force scaled in the summary", "blocks",
     key("contact_force", lambda v: 1.001 * v)),
    ("force of one side scaled", "blocks",
     key("pair_1_force", lambda v: [1.001 * x for x in v])),
    ("sides of the force swapped", "disc", opposite("pair_1_force")),
    ("force of both sides scaled", "cubes", lambda c: (
        key("pair_1_force", lambda v: [1.01 * x for x in v])(c),
        key("pair_1_primary_force", lambda v: [1.01 * x for x in v])(c))),
    ("nodal contact forces scaled", "blocks",
     lambda c: c.nodes(scale("contact", 1.001))),
    ("contact force of one node gone", "quadratic",
     lambda c: c.nodes(first(lambda r: r["contact_y"] != 0,
                             contact_y=lambda r: 0.))),
    ("bodies swapped on the contact surfaces", "blocks", swap_sides),
    ("body dropped from the fields", "blocks",
     lambda c: c.cells("fields", lambda piece, i: piece.fields["body"][
         piece.cells[i][0]] < 1.5)),
    ("body dropped from nodal.csv", "cubes",
     lambda c: c.nodes(lambda rows: [r for r in rows if r["body"] < 1.5])),
    ("facet dropped from the contact surface", "cubes",
     lambda c: c.cells("contact", lambda piece, i: piece.fields["body"][
         piece.cells[i][0]] < 1.5)),
    ("loads forgotten", "blocks", lambda c: c.nodes(scale("load", 0.))),
    ("loads forgotten, sums kept", "cubes", forgotten_load),
    ("weight forgotten, sums kept", "disc", forgotten_load),
    ("another load in the scene", "disc",
     lambda c: c.edit("Body force = 0, -0.01", "Body force = 0, -0.02")),
    ("sign of the reactions", "disc",
     lambda c: c.nodes(scale("reaction", -1.))),
    ("contact on supports among the reactions", "corner",
     lambda c: c.nodes(reaction_of_contact)),
    ("reaction moved along the support", "blocks",
     lambda c: c.nodes(moved_reaction)),
    ("energy scaled in all tables", "blocks", energy),
    ("energy scaled in the summary", "disc",
     key("energy", lambda v: 1.001 * v)),
    ("softer material in the scene", "blocks",
     lambda c: c.edit("Young modulus = 70", "Young modulus = 60")),
    ("obstacle deeper in the scene", "disc",
     lambda c: c.edit("-0.05*t", "-0.25*t")),
    ("surfaces apart in the scene", "blocks",
     lambda c: c.edit("set Primary = 1: 3",
                      "set Primary = 1: 3\n  set Initial gap = 0.05")),
    ("force across a gap", "disc",
     lambda c: c.nodes(first(lambda r: closed(r) and r["contact_y"] < 0,
                             gap=lambda r: 0.1))),
    ("work of the initial gaps doubled", "disc",
     key("pair_1_initial_gap_work", lambda v: 2 * v)),
    ("part of a file of fields missing", "blocks", truncate("fields", 0.5)),
    ("part of nodal.csv missing", "cubes", truncate("nodal.csv", 0.7)),
    ("summary broken off", "disc", truncate("summary.json", 0.5)),
    ("a value that is no number", "blocks",
     lambda c: c.fields("fields", "displacement",
                        poke(7, lambda v: float("nan")))),
    ("sign of one pressure of the membrane", "membrane",
     lambda c: c.nodes(first(closed, pressure=lambda r: -r["pressure"]))),
    ("membrane below the obstacle in all files", "membrane",
     lambda c: all_displacements(c, shift_at((0., 0.), [-0.1]))),
    ("gap of the membrane shifted", "membrane",
     lambda c: c.nodes(first(closed, gap=lambda r: r["gap"] + 1e-4))),
    ("pressures of the membrane scaled", "membrane", lambda c: (
        c.nodes(scale("pressure", 1.01)),
        c.fields("fields", "pressure", lambda v, x, w: v.__setitem__(
            slice(None), [1.01 * p for p in v])))),
    ("obstacle of the membrane higher in the scene", "membrane",
     lambda c: c.edit("-0.3 - 0.2*x^2", "-0.25 - 0.2*x^2")),
    ("load of the membrane forgotten", "membrane",
     lambda c: c.nodes(scale("load", 0.))),
    ("traction above mu p, sums kept", "dragged",
     lambda c: c.nodes(moved_friction)),
    ("traction along the slip, sums kept", "dragged",
     lambda c: c.nodes(turned_friction)),
    ("a node that slips told as stick", "dragged",
     lambda c: c.nodes(first(lambda r: on_plane(r, 2),
                             status=lambda r: 1.))),
    ("a node that sticks told as slip", "dragged",
     lambda c: c.nodes(first(lambda r: on_plane(r, 1),
                             status=lambda r: 2.))),
    ("slip of a node scaled", "dragged",
     lambda c: c.nodes(first(lambda r: on_plane(r, 2),
                             slip_x=lambda r: 1.01 * r["slip_x"]))),
    ("slip of a node turned round", "rubbed",
     lambda c: c.nodes(first(lambda r: r["status"] == 2,
                             slip_x=lambda r: -r["slip_x"]))),
    ("slip of an open node", "dragged",
     lambda c: c.nodes(first(lambda r: on_plane(r, 0),
                             slip_x=lambda r: 1e-3))),
    ("more dissipation of the bodies", "dragged",
     key("dissipation", lambda v: 1.01 * v)),
    ("dissipation of the bodies of the other sign", "dragged",
     key("dissipation", lambda v: -v)),
    ("dissipation of the other sign between bodies", "rubbed",
     key("dissipation", lambda v: -v)),
    ("less friction of the plane in the scene", "dragged",
     lambda c: c.edit("Friction = 0.7", "Friction = 0.69")),
    ("more friction of the plane in the scene", "dragged",
     lambda c: c.edit("Friction = 0.7", "Friction = 0.71")),
    ("more friction between bodies in the scene", "rubbed",
     lambda c: c.edit("Friction = 0.3", "Friction = 0.31")),
    ("friction above mu N in the summary", "rubbed", friction_sums),
    ("ratio of friction in the summary", "rubbed",
     key("pair_1_friction_ratio", lambda v: 1.01 * v)),
    ("a resultant of friction above its sum", "rubbed",
     key("pair_1_friction_force", lambda v: 0.9 * v)),
    ("friction of one mass scaled", "masses",
     lambda c: c.table("masses.csv", first(
         slips, friction_x=lambda r: 1.01 * r["friction_x"]))),
    ("sign of all friction and of its sum", "masses", lambda c: (
        c.table("masses.csv", scale("friction", -1.)),
        c.table("levels.csv", scale("friction", -1.)),
        opposite("friction_force")(c))),
    ("slip turned round, ways kept", "masses",
     lambda c: c.table("masses.csv", scale("slip", -1.))),
    ("a slip told as stick", "masses",
     lambda c: c.table("masses.csv", first(slips, state=lambda r: 1.))),
    ("a stick told as slip", "masses",
     lambda c: c.table("masses.csv", first(
         lambda r: r["state"] == 1, state=lambda r: 2.))),
    ("a mass above the plane told as stick", "masses",
     lambda c: c.table("masses.csv", first(
         lambda r: r["state"] == 0, state=lambda r: 1.))),
    ("friction across a gap", "masses",
     lambda c: c.table("masses.csv", first(
         lambda r: r["state"] == 0, friction_y=lambda r: 0.1))),
    ("a mass that pulls at the plane", "masses",
     lambda c: c.table("masses.csv", first(
         lambda r: r["state"] == 0, normal_force=lambda r: -0.1))),
    ("a mass shifted", "masses",
     lambda c: c.table("masses.csv", first(
         slips, u_y=lambda r: r["u_y"] + 1e-4))),
    ("dissipation of the other sign", "masses",
     key("dissipated_energy", lambda v: -v)),
    ("less friction in the scene", "masses",
     lambda c: c.edit("set Scene", "subsection Friction\n"
                      "  set Coefficient = 0.29\nend\nset Scene")),
    ("another spring in the scene", "masses",
     lambda c: c.edit("set Spring = 5", "set Spring = 5.1")),
    ("a cell turned inside out in all files", "rubber",
     lambda c: all_displacements(c, shift_at((0.5, 0.5), [0.2, 0.]))),
    ("an inner node shifted a little in all files", "rubber",
     lambda c: all_displacements(c, shift_at((0.5, 0.5), [1e-5, 0.]))),
    ("a pair of reactions on the hull, sums kept", "hull", pair_of_forces),
    ("a node on the hull between others, aside in all files", "hull",
     shifted_hanging_node),
    ("a node pressed into the disc in all files", "rubber",
     lambda c: all_displacements(c, shift_at((0.25, 1.), [0., 0.05]))),
    ("moment at the undeformed places", "rubber", moment_at_rest),
    ("contact forces along other normals, sums kept", "rubber",
     lambda c: c.nodes(turned_forces)),
    ("energy of large strain scaled", "rubber", energy),
    ("another law in the scene", "rubber",
     lambda c: c.edit("neo-hooke", "st venant-kirchhoff")),
    ("another volume ratio in the scene", "rubber",
     lambda c: c.edit("Poisson ratio = 0.3", "Poisson ratio = 0.301")),
    ("volume of points in the scene", "pad",
     lambda c: c.edit("mean dilatation", "full integration")),
    ("another volume ratio of cells in the scene", "pad",
     lambda c: c.edit("Poisson ratio = 0.4999", "Poisson ratio = 0.4995")),
    ("the disc deeper in the scene", "rubber",
     lambda c: c.edit("-0.3*t", "-0.35*t")),
    ("part of masses.csv missing", "masses", truncate("masses.csv", 0.7)),
    ("momentum of one step of masses", "thrown",
     lambda c: c.table("levels.csv", first(
         lambda r: r["step"] == 20,
         momentum_x=lambda r: 1.001 * r["momentum_x"]))),
    ("force of one step of masses", "thrown",
     lambda c: c.table("levels.csv", first(
         lambda r: r["force_height"] > 0,
         force_height=lambda r: 1.01 * r["force_height"]))),
    ("masses that are pulled", "thrown",
     lambda c: c.table("levels.csv", first(
         lambda r: r["force_height"] > 0,
         force_height=lambda r: -r["force_height"]))),
    ("a mass below the plane", "thrown",
     lambda c: c.table("masses.csv", first(
         lambda r: r["mass"] == 2, u_height=lambda r: -0.201))),
    ("a mass that is faster", "thrown",
     lambda c: c.table("masses.csv", first(
         lambda r: r["mass"] == 2, v_x=lambda r: r["v_x"] + 1e-4))),
    ("work of the weight, balance kept", "thrown", work_of_weight),
    ("energy of masses from nowhere", "thrown",
     lambda c: c.table("levels.csv", first(
         lambda r: r["step"] == 20,
         strain_energy=lambda r: r["strain_energy"] + 1,
         energy_balance=lambda r: r["energy_balance"] + 1))),
    ("energy of masses that impacts give", "thrown",
     lambda c: c.table("levels.csv", first(
         lambda r: r["step"] == 20,
         strain_energy=lambda r: r["strain_energy"] + 1,
         energy_lost_in_impacts=lambda r: r["energy_lost_in_impacts"] - 1))),
    ("less friction of the plane below masses", "thrown",
     lambda c: c.edit("Friction = 0.1", "Friction = 0.09")),
    ("another mass in the scene", "thrown",
     lambda c: c.edit("Mass = 2", "Mass = 2.01")),
    ("more weight in the scene", "thrown",
     lambda c: c.edit("0; -5", "0; -5.01")),
    ("the motion goes on in the scene", "thrown",
     lambda c: c.edit("End = 1", "End = 1.03")),
    ("momentum of one step", "motion", lambda c: c.table("levels.csv", first(
        lambda r: r["load_step"] == 80,
        momentum_x=lambda r: 1.001 * r["momentum_x"]))),
    ("force of one step", "motion", lambda c: c.table("levels.csv", first(
        lambda r: r["load_step"] == 85,
        pair_1_force_x=lambda r: 1.01 * r["pair_1_force_x"]))),
    ("kinetic energy of one step", "motion",
     lambda c: c.table("levels.csv", first(
         lambda r: r["load_step"] == 80,
         kinetic_energy=lambda r: r["kinetic_energy"] + 1e-3))),
    ("energy from nowhere", "motion", lambda c: c.table("levels.csv", first(
        lambda r: r["load_step"] == 80,
        kinetic_energy=lambda r: r["kinetic_energy"] + 5,
        balance=lambda r: r["balance"] + 5))),
    ("another stiffness of what moves in the scene", "rubber in motion",
     lambda c: c.edit("modulus = 100", "modulus = 101")),
    ("momentum of one step of rubber", "rubber in motion",
     lambda c: c.table("levels.csv", first(
         lambda r: r["load_step"] == 20,
         momentum_y=lambda r: 1.001 * r["momentum_y"]))),
    ("two hundredths of the energy from nowhere", "rubber in motion",
     lambda c: c.table("levels.csv", first(
         lambda r: r["load_step"] == 20,
         kinetic_energy=lambda r: r["kinetic_energy"] + 0.03,
         balance=lambda r: r["balance"] + 0.03))),
    ("gravity in the scene of a motion", "motion",
     lambda c: c.edit("subsection Body 1", "subsection Solid\n"
                      "  set Gravity = -0.1, 0\nend\nsubsection Body 1")),
    ("tension of the membrane in the scene", "membrane",
     lambda c: c.edit("set Body force = -4", "set Body force = -4\n"
                      "  set Conductivity = 1.1")),
]


def run(abut, folder, name):
    """A true output."""
    scene = folder / f"{name}.prm"
    scene.write_text(SCENES[name], encoding="utf-8")
    words = [abut, "run", scene, "--output", folder / name, "--set",
             "Output/Pictures=false"]
    if has_mesh(Scene(scene)):
        words += ["--set", "Output/Nodal values=true"]
    done = subprocess.run(words, capture_output=True, text=True,
                          env=dict(os.environ, OMP_NUM_THREADS="1"))
    if done.returncode != 0:
        raise SystemExit(f"{name}: exit code {done.returncode}\n{done.stderr}")


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--abut", type=pathlib.Path,
                        default=ROOT / "build/release/abut")
    abut = parser.parse_args().abut.resolve()
    faults = 0
    with tempfile.TemporaryDirectory(prefix="abut-judge-") as name:
        folder = pathlib.Path(name)
        for scene in SCENES:
            run(abut, folder, scene)
            code, findings, reason = judge.verdict(folder / scene,
                                                   folder / f"{scene}.prm")
            if code != 0:
                faults += 1
                print(f"FAILED true output of {scene}: {reason}")
                findings.print()
            else:
                print(f"ok     {scene}: {len(findings.rows)} checks")
        for what, scene, falsify in FALSIFICATIONS:
            copy = Copy(folder / "copy", folder / "copy.prm")
            shutil.rmtree(copy.folder, ignore_errors=True)
            shutil.copytree(folder / scene, copy.folder)
            shutil.copy(folder / f"{scene}.prm", copy.scene)
            falsify(copy)
            code, findings, reason = judge.verdict(copy.folder, copy.scene)
            by = reason or "; ".join(row[0] for row in findings.wrong)
            faults += code != 1
            print(f"{'found ' if code == 1 else 'FAILED'} {what} ({scene}): "
                  f"{by or 'nothing was found'}")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
