# SPDX-License-Identifier: LGPL-2.1-or-later
"""CalculiX: writes its input, runs it, reads displacements, contact pressure
and force.

Contact is told to converge in one increment of one step, as a linear-elastic
problem of small strain is (no NLGEOM).
"""
import os
import re
import shutil

import hexmesh
import problems
import process

# Words of *CONTACT PAIR, and whether the surface behaviour is a penalty.
METHODS = {"node to surface": ("NODE TO SURFACE", True),
           "surface to surface": ("SURFACE TO SURFACE", True),
           "mortar": ("MORTAR", False),
           "linear mortar": ("LINMORTAR", False)}


def version():
    """Name and version, or None if it is not installed."""
    if not shutil.which("ccx"):
        return None
    import subprocess
    text = subprocess.run(["ccx", "-v"], capture_output=True, text=True).stdout
    found = re.search(r"Version (\S+)", text)
    return "CalculiX " + (found.group(1) if found else "")


def _plate(problem):
    """The rigid plane z = 0 as one cell that is held everywhere."""
    nodes = problem["bodies"][0]["nodes"]
    end = 1.5 * max(max(point) for point in nodes)
    across = [-0.5 * end, end]
    return hexmesh.block(hexmesh.grid(across, across, [-0.5 * end, 0.0]))


def _wrap(numbers):
    """Lines of up to eight numbers."""
    return [", ".join(map(str, numbers[i:i + 8])) + ","
            for i in range(0, len(numbers), 8)]


class Model:
    """All bodies with CalculiX's numbers."""

    def __init__(self, problem):
        self.problem = problem
        self.bodies = list(problem["bodies"])
        self.rigid = problem["contact"]["primary"] is None
        if self.rigid:
            self.bodies.append(_plate(problem))
        self.first_node, self.first_cell = [1], [1]
        for body in self.bodies:
            self.first_node.append(self.first_node[-1] + len(body["nodes"]))
            self.first_cell.append(self.first_cell[-1] + len(body["cells"]))

    def node_set(self, name, body, nodes):
        first = self.first_node[body]
        return [f"*NSET, NSET={name}"] + _wrap([first + n for n in nodes])

    def surface(self, name, body, faces):
        first = self.first_cell[body]
        return [f"*SURFACE, NAME={name}, TYPE=ELEMENT"] + [
            f"{first + cell}, S{face + 1}" for cell, face in faces]

    def mesh(self):
        lines = ["*NODE, NSET=ALL"]
        for body, first in zip(self.bodies, self.first_node):
            lines += [f"{first + i}, {x:.12g}, {y:.12g}, {z:.12g}"
                      for i, (x, y, z) in enumerate(body["nodes"])]
        lines.append("*ELEMENT, TYPE=C3D8, ELSET=CELLS")
        for body, node, cell in zip(self.bodies, self.first_node,
                                    self.first_cell):
            lines += [", ".join(map(str, [cell + i] + [node + n
                                                       for n in corners]))
                      for i, corners in enumerate(body["cells"])]
        return lines

    def supports(self, method):
        """Each component of a node once (edges belong to several faces).

        The mortar methods find their matrix singular if a node of the
        secondary surface is held in two directions: only the first is kept
        at such nodes (here one on the axis where two planes of symmetry meet).
        """
        held = {}
        for support in self.problem["supports"]:
            body = self.problem["bodies"][support["body"]]
            for node in hexmesh.face_nodes(body, support["face"]):
                for component, text in zip(support["components"],
                                           support["values"]):
                    key = (self.first_node[support["body"]] + node,
                           component + 1)
                    held[key] = problems.value(text, body["nodes"][node])
        if not METHODS[method][1]:
            body, face = self.problem["contact"]["secondary"]
            for node in hexmesh.face_nodes(self.bodies[body], face):
                number = self.first_node[body] + node
                if (number, 1) in held:
                    held.pop((number, 2), None)
        if self.rigid:
            for node in range(self.first_node[1], self.first_node[2]):
                held.update({(node, c): 0.0 for c in (1, 2, 3)})
        return ["*BOUNDARY"] + [f"{node}, {c}, {c}, {held[node, c]:.12g}"
                                for node, c in sorted(held)]

    def loads(self):
        lines = []
        for load in self.problem["loads"]:
            lines.append("*DLOAD")
            first = self.first_cell[load["body"]]
            faces = self.problem["bodies"][load["body"]]["faces"]
            lines += [f"{first + cell}, P{face + 1}, {load['pressure']:.12g}"
                      for cell, face in faces[load["face"]]]
        return lines

    def base(self):
        """Body and nodes whose reactions balance the contact force."""
        if self.rigid:
            return 0, sorted({
                node for support in self.problem["supports"]
                if 2 in support["components"]
                for node in hexmesh.face_nodes(self.bodies[0],
                                               support["face"])})
        return 1, hexmesh.face_nodes(self.bodies[1], "zmin")

    def contact(self, method, kappa):
        words, penalty = METHODS[method]
        body, face = self.problem["contact"]["secondary"]
        if words.startswith("NODE"):
            lines = ["*SURFACE, NAME=SECONDARY, TYPE=NODE", "SECNODES,"]
        else:
            lines = self.surface("SECONDARY", body,
                                 self.bodies[body]["faces"][face])
        other, side = self.problem["contact"]["primary"] or (1, "zmax")
        lines += self.surface("PRIMARY", other,
                              self.bodies[other]["faces"][side])
        lines += [f"*CONTACT PAIR, INTERACTION=LAW, TYPE={words}",
                  "SECONDARY, PRIMARY", "*SURFACE INTERACTION, NAME=LAW"]
        if penalty:
            slope = kappa * self.problem["young"] / self.problem["size"]
        else:
            slope = 1e6 * self.problem["young"] / self.problem["size"]
        tension = 1e-3 * self.problem["pressure"]
        return lines + ["*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=LINEAR",
                        f"{slope:.9g}, {tension:.9g}"]

    def text(self, method, kappa, solver):
        problem = self.problem
        body, face = problem["contact"]["secondary"]
        lines = self.mesh()
        lines += self.node_set("SECNODES", body, hexmesh.face_nodes(
            self.bodies[body], face))
        lines += self.node_set("BASE", *self.base())
        lines += ["*MATERIAL, NAME=SOLID", "*ELASTIC",
                  f"{problem['young']:.12g}, {problem['poisson']:.12g}",
                  "*SOLID SECTION, ELSET=CELLS, MATERIAL=SOLID"]
        lines += self.contact(method, kappa)
        lines += ["*STEP, INC=100",
                  "*STATIC" + (f", SOLVER={solver}" if solver else ""),
                  "1., 1.", "*CONTROLS, PARAMETERS=FIELD",
                  "1e-6, 1e-4, , , 1e-6"]
        lines += self.supports(method) + self.loads()
        lines += ["*NODE PRINT, NSET=ALL", "U",
                  "*NODE PRINT, NSET=BASE, TOTALS=ONLY", "RF",
                  "*CONTACT FILE", "CDIS, CSTR", "*END STEP"]
        return "\n".join(lines) + "\n"

    def read(self, folder):
        """Displacements per body, node -> pressure, contact force."""
        tables = _tables(os.path.join(folder, "job.dat"))
        moved = tables["displacements"]
        displacements = [
            [moved[n] for n in range(self.first_node[b],
                                     self.first_node[b + 1])]
            for b in range(len(self.problem["bodies"]))]
        force = abs(tables["total force"][None][2])
        body, face = self.problem["contact"]["secondary"]
        values = _pressure(os.path.join(folder, "job.frd"))
        pressure = {node: values.get(self.first_node[body] + node, 0.0)
                    for node in hexmesh.face_nodes(self.bodies[body], face)}
        return {"displacements": displacements, "pressure": pressure,
                "force": force}


def _tables(path):
    """The last table of each kind in a .dat file."""
    tables, current = {}, None
    with open(path) as file:
        for line in file:
            words = line.split()
            if not words:
                continue
            if "(" in line:
                current = line.split("(")[0].strip()
                tables[current] = {}
            elif len(words) == 4:
                tables[current][int(words[0])] = [float(w) for w in words[1:]]
            elif len(words) == 3:
                tables[current][None] = [float(w) for w in words]
    return tables


def _pressure(path):
    """node -> contact pressure, of the last such block of a .frd file."""
    pressure, reading = {}, False
    with open(path) as file:
        for line in file:
            if line.startswith(" -4"):
                reading = line.split()[1] == "CONTACT"
                if reading:
                    pressure = {}
            elif reading and line.startswith(" -1"):
                # node in columns 4-13, six numbers of 12: opening, two
                # slips, pressure, two shears
                pressure[int(line[3:13])] = float(line[49:61])
            elif line.startswith(" -3"):
                reading = False
    return pressure


def run(problem, method, folder, kappa=10.0, solver="", **limits):
    """The answer with wall time, memory and iterations."""
    model = Model(problem)
    with open(os.path.join(folder, "job.inp"), "w") as file:
        file.write(model.text(method, kappa, solver))
    measured = process.run(["ccx", "job"], folder, "job.log", **limits)
    with open(os.path.join(folder, "job.log"), errors="replace") as file:
        log = file.read()
    if "*ERROR" in log or "Job finished" not in log:
        raise process.Failure("no convergence")
    answer = model.read(folder)
    answer.update(measured, iterations=len(
        re.findall(r"^ iteration \d+", log, re.M)))
    return answer
