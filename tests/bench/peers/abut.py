# SPDX-License-Identifier: LGPL-2.1-or-later
"""Abut: writes the meshes and a scene `solid`, runs it, reads its files."""
import json
import os
import pathlib
import sys

import gmsh_file
import hexmesh
import process

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "app"))
import vtu  # noqa: E402

# Files hold single precision, and refinement puts nodes of a curved body a bit
# elsewhere; they are much farther apart, in units of the size of facets.
NEAR = 0.1

PROGRAM = None  # set by compare.py

# Name of the method -> parameters of the scene.
METHODS = {
    "dual mortar, lagrange": {"Method/Discretisation": "dual mortar"},
    "mortar, augmented lagrangian": {
        "Method/Discretisation": "mortar",
        "Method/Enforcement": "augmented lagrangian"},
    "node to segment, penalty": {
        "Method/Discretisation": "node to segment",
        "Method/Enforcement": "penalty"}}


def version():
    """Its name, or None if no program was given."""
    return "Abut" if PROGRAM else None


def _supports(problem, number, ids):
    """`id: ux, uy, uz; ...` of a body."""
    parts = []
    for support in problem["supports"]:
        if support["body"] == number:
            values = dict(zip(support["components"], support["values"]))
            parts.append(f"{ids[support['face']]}: " + ", ".join(
                values.get(component, "free") for component in range(3)))
    return "; ".join(parts)


def _body(problem, number, folder):
    """The section of a body, and its boundary ids by name."""
    mesh = os.path.join(folder, f"body-{number + 1}.msh")
    ids = gmsh_file.write(
        mesh, problem.get("coarse", problem["bodies"])[number])
    sphere = problem.get("sphere", {"faces": []})
    curved = "; ".join(
        f"{ids[face]}: sphere: " + ", ".join(map(repr, sphere["centre"]))
        for face in sphere["faces"])
    pressure = "; ".join(f"{ids[load['face']]}: {load['pressure']!r}"
                         for load in problem["loads"]
                         if load["body"] == number)
    return f"""subsection Body {number + 1}
  subsection Mesh
    set File = {mesh}
    set Curved sides = {curved}
  end
  set Young modulus = {problem["young"]!r}
  set Poisson ratio = {problem["poisson"]!r}
  set Support = {_supports(problem, number, ids)}
  set Pressure = {pressure}
end
""", ids


def _scene(problem, folder):
    """Text of the scene."""
    sections, ids = [], []
    for number in range(len(problem["bodies"])):
        section, names = _body(problem, number, folder)
        sections.append(section)
        ids.append(names)
    body, face = problem["contact"]["secondary"]
    pair = f"  set Secondary = {body + 1}: {ids[body][face]}\n"
    rigid = problem["contact"]["primary"] is None
    if rigid:
        pair += "  set Obstacle = 1\n"
        sections.append("subsection Obstacle 1\n  set Kind = plane\nend\n")
    else:
        other, side = problem["contact"]["primary"]
        pair += f"  set Primary = {other + 1}: {ids[other][side]}\n"
    return f"""set Title = {problem["name"]}
set Scene = solid
set Dimension = 3
subsection Refinement
  set Level = {problem.get("levels", 0)}
end
subsection Solid
  set Bodies = {len(problem["bodies"])}
  set Pairs = 1
  set Obstacles = {int(rigid)}
end
""" + "".join(sections) + f"subsection Pair 1\n{pair}end\n"


def _read(path):
    """Points, and rows of fields by name."""
    points, fields = [], {}
    for piece in vtu.pieces(path):
        points += piece.points
        for name, values in piece.fields.items():
            width = len(values) // len(piece.points)
            fields.setdefault(name, []).extend(
                values[i:i + width] for i in range(0, len(values), width))
    return points, fields


def _displacements(problem, path):
    points, fields = _read(path)
    places = [hexmesh.Places(body["nodes"], NEAR * problem["size"])
              for body in problem["bodies"]]
    moved = [[None] * len(body["nodes"]) for body in problem["bodies"]]
    for point, body, value in zip(points, fields["body"],
                                  fields["displacement"]):
        number = round(body[0]) - 1
        moved[number][places[number].find(point)] = value
    return moved


def _pressure(problem, path):
    """node -> pressure on the secondary body, which is the upper one: the
    other side's traction points down."""
    points, fields = _read(path)
    number, face = problem["contact"]["secondary"]
    body = problem["bodies"][number]
    nodes = hexmesh.face_nodes(body, face)
    places = hexmesh.Places([body["nodes"][node] for node in nodes],
                            NEAR * problem["size"])
    pressure = dict.fromkeys(nodes, 0.0)
    for point, traction in zip(points, fields["traction"]):
        found = places.find(point)
        if found is not None:
            node = nodes[found]
            pressure[node] = max(pressure[node], traction[2])
    return pressure


def run(problem, method, folder, **limits):
    """The answer with wall time, memory and iterations."""
    scene = os.path.join(folder, "scene.prm")
    out = os.path.join(folder, "out")
    with open(scene, "w") as file:
        file.write(_scene(problem, folder))
    command = [PROGRAM, "run", scene, "--quiet", "--output", out]
    for name, value in METHODS[method].items():
        command += ["--set", f"{name}={value}"]
    answer = process.run(command, folder, "log", **limits)
    with open(os.path.join(out, "summary.json")) as file:
        summary = json.load(file)
    answer.update(
        force=summary["contact_force"],
        iterations=summary["nonlinear_iterations"],
        displacements=_displacements(
            problem, os.path.join(out, "fields_0000.0.vtu")),
        pressure=_pressure(
            problem, os.path.join(out, "contact_0000.0.vtu")))
    return answer
