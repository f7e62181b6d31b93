# SPDX-License-Identifier: LGPL-2.1-or-later
"""What the judge holds a run to: one table, with the reason of each number."""
from typing import NamedTuple


class Threshold(NamedTuple):
    value: float
    reason: str


THRESHOLDS = {
    "penetration, weighted": Threshold(
        0.05, "of a facet, beside what the law allows and the chord heights: "
        "mortar and quadrature points see the whole facet, what is left is "
        "the difference of two polygons"),
    "penetration, nodes": Threshold(
        0.2, "of a facet, likewise: rows at nodes see nothing between them"),
    "penetration, membrane": Threshold(
        0.05, "of the largest displacement, if that is more: the displacement "
        "of a membrane has a unit of its own, and facets tell nothing of it"),
    "fitting": Threshold(
        0.5, "of a facet: surfaces whose gaps are left out are no farther apart "
        "where they are looked at"),
    "strain": Threshold(
        0.5, "shapes of small-strain theory are of no use beyond"),
    "tension": Threshold(
        1e-6, "of the largest pressure: contact cannot pull; what is left is "
        "the tolerance of the linear solver"),
    "sides": Threshold(
        1e-8, "of the sum of magnitudes: each force acts on both sides, "
        "by the same coefficients"),
    "balance, direct": Threshold(
        1e-8, "of the sum of magnitudes: contact, loads and reactions of a "
        "body in equilibrium"),
    "balance, iterative": Threshold(
        1e-5, "the same where linear systems are solved iteratively, with the "
        "default tolerances"),
    "hanging": Threshold(
        1e-12, "of the largest displacement: a node of small cells on an edge "
        "or face of a large one goes where that goes"),
    "complementarity": Threshold(
        1e-3, "of a facet, mean gap under pressure beside what the law allows: "
        "there is no force across a gap"),
    "clearance": Threshold(
        1e-3, "of a facet, beside what the law leaves and sliding: where there is "
        "a force, the surfaces touch somewhere"),
    "energy": Threshold(
        1e-6, "of the sum of magnitudes of the works: twice the stored energy "
        "is the work of loads and supports, minus that on the initial gaps; "
        "of large strain the change of the energy along the displacement, by "
        "differences, is the work of all forces on it"),
    "stored energy": Threshold(
        1e-3, "of the energy that the judge integrates itself: another "
        "quadrature on curved cells"),
    "agreement": Threshold(
        1e-6, "of the largest value: fields are written as 32-bit numbers"),
    "momentum": Threshold(
        1e-7, "of the largest momentum that the kinetic energy could be: what a "
        "step changes of it is the outer forces times the step"),
    "obstacle": Threshold(
        1e-5, "of the force of contact: what is left of the balance of an "
        "obstacle that forces move; with default tolerances 1e-9, of large "
        "strain that of Newton's method"),
    "gain": Threshold(
        2e-3, "of the energy at the start or the work done: what implicit "
        "schemes with modified mass may gain"),
    "kept": Threshold(
        1e-10, "of the energy at the start or the work done: what is kept to "
        "round-off by definition of the scheme"),
    "large gain": Threshold(
        1e-2, "of the energy at the start or the work done: what schemes may "
        "gain at large strain before it is told"),
    "explicit gain": Threshold(
        1e-2, "of the energy at the start or the work done: what explicit "
        "schemes may gain"),
    "tables": Threshold(
        1e-12, "the same number in two files with all digits"),
    "gap": Threshold(
        1e-9, "of the largest value: displacement minus obstacle, by the "
        "judge's own evaluation of the formula"),
    "friction": Threshold(
        1e-8, "of the largest force, and of the largest force times the largest "
        "slip: Coulomb's law at a mass, whose dense problems are solved to "
        "round-off"),
    "coulomb": Threshold(
        1e-6, "of the largest nodal force, and of that times the largest "
        "displacement: |tau| <= mu p, and tau against the slip"),
    "springs": Threshold(
        1e-4, "of the largest displacement: what sticks may move and what "
        "presses may penetrate by the tolerance of methods of multipliers"),
    "weights": Threshold(
        1e-3, "of the contact force: weight times pressure, with the judge's "
        "own integrals of the shape functions"),
}

# Laws that may pull, by the name of the law in summary.json.
ADHESIVE = {"adhesive"}

# Smaller numbers are 0 in files of fields, or have few digits.
LEAST_OF_FIELDS = 1.2e-38
