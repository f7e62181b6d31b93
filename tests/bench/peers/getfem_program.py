# SPDX-License-Identifier: LGPL-2.1-or-later
"""Solves one problem with GetFEM; called by getfem_peer.py with an interpreter
that has GetFEM:  getfem_program.py problem.json answer.json METHOD KAPPA

Displacements are Q1 as in the other programs. Methods: `lagrange`: Q1
multiplier on the secondary surface, augmented Lagrangian in the symmetric
form; `penalty`: at quadrature points. Linear systems: MUMPS.
"""
import json
import sys
import time

import getfem
import numpy

import hexmesh
import problems

CONTACT, OTHER = 1, 2
# Stiffness of supports in units of E times the size of facets.
HELD = 1e7
TO_LATTICE = [0, 1, 3, 2, 4, 5, 7, 6]


class Body:
    """Mesh, finite element, integration and regions of one body."""

    def __init__(self, body):
        self.body = body
        self.nodes = numpy.array(body["nodes"])
        cells = numpy.array(body["cells"])[:, TO_LATTICE]
        self.mesh = getfem.Mesh("empty", 3)
        # points, corner by corner: 3 x 8 x cells
        self.mesh.add_convex(getfem.GeoTrans("GT_QK(3,1)"),
                             self.nodes[cells].transpose(2, 1, 0))
        self.fem = getfem.MeshFem(self.mesh, 3)
        self.fem.set_fem(getfem.Fem("FEM_QK(3,1)"))
        self.integration = getfem.MeshIm(
            self.mesh, getfem.Integ("IM_GAUSS_PARALLELEPIPED(3,3)"))
        places = self.fem.basic_dof_nodes()[:, ::3].T
        self.dof_node = _match(places, self.nodes)
        self.point_node = _match(self.mesh.pts().T, self.nodes)
        self.node_point = numpy.empty(len(self.nodes), dtype=int)
        self.node_point[self.point_node] = numpy.arange(len(self.nodes))

    def region(self, number, name):
        points = self.node_point[hexmesh.face_nodes(self.body, name)]
        self.mesh.set_region(number, self.mesh.faces_from_pid(
            self.mesh.pid()[points]))

    def by_node(self, vector, components=3):
        """A vector of unknowns as an array node by node."""
        values = numpy.empty((len(self.nodes), components))
        values[self.dof_node] = numpy.reshape(vector, (-1, components))
        return values


def _match(places, nodes):
    """For each place the node that is there."""
    finder = hexmesh.Places(nodes, 1e-9 * numpy.abs(nodes).max())
    return numpy.array([finder.find(place) for place in places])


def add_bodies(model, problem):
    bodies = []
    e, nu = problem["young"], problem["poisson"]
    model.add_initialized_data("lambda", e * nu / ((1 + nu) * (1 - 2 * nu)))
    model.add_initialized_data("mu", e / (2 * (1 + nu)))
    for number, data in enumerate(problem["bodies"]):
        body = Body(data)
        bodies.append(body)
        model.add_fem_variable(f"u{number}", body.fem)
        model.add_isotropic_linearized_elasticity_brick(
            body.integration, f"u{number}", "lambda", "mu")
    return bodies


def _held(problem):
    return HELD * problem["young"] * problem["size"]


def add_supports(model, problem, bodies):
    """Held unknowns by a stiff penalty; returns, for each body, the unknowns
    of vertical direction with their prescribed values."""
    held = [{} for _ in bodies]
    for support in problem["supports"]:
        body = bodies[support["body"]]
        for node in hexmesh.face_nodes(body.body, support["face"]):
            for component, text in zip(support["components"],
                                       support["values"]):
                held[support["body"]][node, component] = problems.value(
                    text, problem["bodies"][support["body"]]["nodes"][node])
    vertical = []
    for number, (body, values) in enumerate(zip(bodies, held)):
        node_dof = numpy.empty(len(body.nodes), dtype=int)
        node_dof[body.dof_node] = numpy.arange(len(body.nodes))
        rows = [(3 * node_dof[node] + component, value)
                for (node, component), value in values.items()]
        matrix = getfem.Spmat("empty", len(rows), body.fem.nbdof())
        for row, (dof, _) in enumerate(rows):
            matrix.add(row, int(dof), 1.0)
        model.add_constraint_with_penalization(
            f"u{number}", _held(problem), matrix,
            numpy.array([value for _, value in rows]))
        vertical.append([pair for pair in rows if pair[0] % 3 == 2])
    return vertical


def add_loads(model, problem, bodies):
    for number, load in enumerate(problem["loads"]):
        body = bodies[load["body"]]
        region = 200 + number
        body.region(region, load["face"])
        model.add_initialized_data(f"load{number}",
                                   [0, 0, -load["pressure"]])
        model.add_source_term_brick(body.integration, f"u{load['body']}",
                                    f"load{number}", region)


def add_contact(model, problem, bodies, method, kappa):
    """The contact brick; returns what reads the nodal pressure."""
    number, face = problem["contact"]["secondary"]
    body = bodies[number]
    body.region(CONTACT, face)
    scalar = getfem.MeshFem(body.mesh, 1)
    scalar.set_fem(getfem.Fem("FEM_QK(3,1)"))
    stiffness = kappa * problem["young"] / problem["size"]
    model.add_initialized_data("r", stiffness)
    rigid = problem["contact"]["primary"] is None
    if rigid:
        model.add_initialized_fem_data("obstacle", scalar,
                                       scalar.basic_dof_nodes()[2])
    else:
        other, side = problem["contact"]["primary"]
        bodies[other].region(OTHER, side)
    if method == "lagrange":
        multiplier = getfem.MeshFem(body.mesh, 1)
        multiplier.set_fem(getfem.Fem("FEM_QK(3,1)"))
        model.add_filtered_fem_variable("p", multiplier, CONTACT)
        if rigid:
            model.add_integral_contact_with_rigid_obstacle_brick(
                body.integration, "u0", "p", "obstacle", "r", CONTACT, 2)
        else:
            model.add_integral_contact_between_nonmatching_meshes_brick(
                body.integration, f"u{number}", f"u{other}", "p", "r",
                CONTACT, OTHER, 2)
    elif method == "penalty":
        if rigid:
            model.add_penalized_contact_with_rigid_obstacle_brick(
                body.integration, "u0", "obstacle", "r", CONTACT)
        else:
            model.add_penalized_contact_between_nonmatching_meshes_brick(
                body.integration, f"u{number}", f"u{other}", "r", CONTACT,
                OTHER)
    return scalar


def nodal_pressure(model, problem, bodies, method, scalar):
    """Multiplier, or the penalty's pressure at the nodes."""
    number, face = problem["contact"]["secondary"]
    body = bodies[number]
    nodes = hexmesh.face_nodes(body.body, face)
    if method == "lagrange":
        values = numpy.zeros(len(body.nodes))
        values[body.dof_node] = -model.interpolation("p", scalar)
        return {node: float(values[node]) for node in nodes}
    lift = body.by_node(model.variable(f"u{number}"))[nodes, 2]
    if problem["contact"]["primary"] is None:
        gap = body.nodes[nodes, 2] + lift
    else:
        other = problem["contact"]["primary"][0]
        moved = model.interpolation(f"u{other}", body.nodes[nodes].T,
                                    bodies[other].mesh, -1, 1)
        gap = lift - numpy.reshape(moved, (-1, 3))[:, 2]
    pressure = model.variable("r")[0] * numpy.maximum(0.0, -gap)
    return dict(zip(nodes, pressure.tolist()))


def contact_force(model, problem, vertical):
    """Sum of the vertical reactions below (above a rigid plane)."""
    body = 0 if problem["contact"]["primary"] is None else 1
    solution = model.variable(f"u{body}")
    return abs(_held(problem) * sum(
        solution[dof] - value for dof, value in vertical[body]))


def main():
    problem_file, answer_file, method, kappa = sys.argv[1:5]
    with open(problem_file) as file:
        problem = json.load(file)
    begin = time.perf_counter()
    getfem.util_trace_level(1)
    model = getfem.Model("real")
    bodies = add_bodies(model, problem)
    vertical = add_supports(model, problem, bodies)
    add_loads(model, problem, bodies)
    scalar = add_contact(model, problem, bodies, method, float(kappa))
    # Relative to the loads; without loads GetFEM takes it as a force.
    tolerance = 1e-7 * (1.0 if problem["loads"] else problem["force"])
    steps, converged = model.solve("max_res", tolerance, "max_iter", 60,
                                   "lsolver", "mumps", "noisy")[:2]
    seconds = time.perf_counter() - begin
    if not converged:
        sys.exit(f"no convergence in {steps} steps")
    answer = {
        "displacements": [
            body.by_node(model.variable(f"u{number}")).tolist()
            for number, body in enumerate(bodies)],
        "pressure": nodal_pressure(model, problem, bodies, method, scalar),
        "force": contact_force(model, problem, vertical),
        "iterations": int(steps), "inside": seconds}
    with open(answer_file, "w") as file:
        json.dump(answer, file)


if __name__ == "__main__":
    main()
