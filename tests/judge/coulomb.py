# SPDX-License-Identifier: LGPL-2.1-or-later
"""Judges Coulomb's law between bodies, and bodies and planes, by the forces at the
nodes of the secondary surface."""
import math

from formula import Formula
from motion import in_motion
from thresholds import THRESHOLDS
from tolerances import of_balance
from vectors import dot, norm, scale, sub

STICK, SLIP = 1, 2


class PairFriction:
    """One pair with friction: sums of the summary, and the law at each node
    where the nodal force is that of one point."""

    def __init__(self, solid, pair):
        self.solid, self.pair = solid, pair
        section = f"Pair {pair.number}"
        text = solid.scene.get(f"{section}/Friction", "0")
        self.coefficient = Formula(text)
        self.constant = float(text) if is_number(text) else None
        self.cap = solid.scene.get(f"{section}/Largest friction", "")
        self.facets = pair.facets(pair.secondary, solid.facets)
        self.nodes = sorted({i for f in self.facets for i in f.nodes})
        # their forces are sums over pairs, and exact contact with another one
        # leaves a node no friction
        self.shared = {i for other in solid.pairs if other is not pair
                       for side in (other.secondary, other.primary) if side
                       for f in other.facets(side, solid.facets)
                       for i in f.nodes} & set(self.nodes)
        self.limit = max(THRESHOLDS["coulomb"].value,
                         (of_balance(solid.scene, solid.summary)
                          or THRESHOLDS["balance, iterative"]).value)

    def check(self, name, value):
        self.solid.findings.check(f"pair {self.pair.number}: {name}", value,
                                  self.limit, THRESHOLDS["coulomb"].reason)

    def judge(self):
        self.sums()
        normal = self.normal()
        if isinstance(normal, str):
            self.solid.findings.leave(
                f"Coulomb's law at the nodes of pair {self.pair.number}", normal)
            return
        self.at_nodes(normal)

    # The summary

    def sums(self):
        key, s = f"pair_{self.pair.number}", self.solid.summary
        force, friction = s[f"{key}_force"], s[f"{key}_friction"]
        size = s[f"{key}_normal_force"] + s[f"{key}_friction_force"] or 1.
        self.check("resultant of friction is at most the sum of its sizes",
                   (norm(friction) - s[f"{key}_friction_force"]) / size)
        self.check("resultant of all is at most the sums of both",
                   (norm(force) - s[f"{key}_normal_force"]
                    - s[f"{key}_friction_force"]) / size)
        self.check("ratio of the resultant and the sum of pressures",
                   abs(s[f"{key}_friction_ratio"] * s[f"{key}_normal_force"]
                       - norm(friction)) / size)
        if self.constant is not None:
            bound = self.constant * s[f"{key}_normal_force"]
            total = s[f"{key}_friction_force"]
            self.check("sum of friction below mu N", (total - bound) / size)
            if (s[f"{key}_slipping"] == s[f"{key}_active"] and not self.cap
                    and not self.shared):
                self.check("all slips: sum of friction is mu N",
                           (bound - total) / size)
        self.check("dissipation is not negative",
                   -s["dissipation"] / (self.solid.work_size or 1.))

    # At nodes

    def normal(self):
        """Out of the primary, or why nodal forces do not tell."""
        solid = self.solid
        if self.cap:
            return "a cap is a force per area"
        if self.constant is None and in_motion(solid.scene):
            return "its coefficient is that of the beginning of the step"
        if solid.by_stress:
            return "nitsche's points are those of a rule, not nodes"
        if solid.degree > 1 or solid.plane == "axisymmetric":
            return "nodes of quadratic and ring elements share points"
        if solid.scene.number("Refinement/Adaptive cycles", 0.) > 0:
            return "hanging nodes hand their forces on"
        if solid.discretisation not in ("auto", "node to segment",
                                        "dual mortar"):
            return "nodal forces are those of several points"
        if not self.pair.obstacle:
            if solid.large:
                return "nodal forces have the normals of several facets"
            if any(any(solid.held[i]) for i in self.nodes):
                return "supports hold nodes, which hand their share on"
            first = self.facets[0].normal
            facets = list(self.facets)
            if solid.discretisation == "node to segment":
                # the normals are those of the facets across
                facets += self.pair.facets(self.pair.primary, solid.facets)
            if any(abs(abs(dot(f.normal, first)) - 1.) > 1e-9
                   for f in facets):
                return "its normals differ from node to node"
            return scale(first, -1.)
        if solid.scene.get(f"Obstacle {self.pair.obstacle}/Kind",
                           "plane") != "plane":
            return "its obstacle is no plane"
        obstacle = solid.obstacle(self.pair)
        return obstacle.normal(solid.nodes.place[self.nodes[0]],
                               solid.nodes.extent)

    def knows_slips(self):
        """Whether the displacement along the obstacle is the slip."""
        return bool(self.pair.obstacle) and self.solid.slips_at_once()

    def tells_directions(self):
        """Whether tractions are exactly against the slips of the last step."""
        solid = self.solid
        return (solid.summary["method"] == "lagrange"
                and not solid.large and not in_motion(solid.scene)
                and solid.scene.get("Method/Contact geometry", "auto") != "current")

    def at_nodes(self, normal):
        solid = self.solid
        told = solid.nodes.vector("slip")
        force = max(max(norm(solid.contact[i]) for i in self.nodes), 1e-150)
        length = max(solid.largest, 1e-150)
        states = solid.nodes.columns["status"]
        worst, dissipated, counts = {}, 0., [0, 0]

        def note(name, value):
            worst[name] = max(worst.get(name, -math.inf), value)
            if math.isnan(value):
                worst[name] = value

        for i in self.nodes:
            pressing = dot(solid.contact[i], normal)
            tau = sub(solid.contact[i], scale(normal, pressing))
            size = norm(tau)
            mu = self.coefficient(solid.nodes.place[i], solid.time)
            slip = sub(solid.u[i], scale(normal, dot(solid.u[i], normal)))
            power = dot(tau, slip)
            if states[i] in (STICK, SLIP):
                counts[int(states[i]) - 1] += 1
            # a support's reaction is among the forces of its node
            if any(solid.held[i]) or i in self.shared:
                continue
            note("traction within mu p", (size - mu * max(pressing, 0.)) / force)
            if states[i] == SLIP:
                note("what slips has all of mu p",
                     (mu * pressing - size) / force)
                if self.tells_directions():
                    note("traction against the slip of the step",
                         (dot(tau, told[i]) + mu * pressing * norm(told[i]))
                         / (force * length))
            note("slip along the surface", abs(dot(told[i], normal)) / length)
            if states[i] not in (STICK, SLIP):
                note("no slip of what is open", norm(told[i]) / length)
            if not self.knows_slips():
                continue
            if states[i] in (STICK, SLIP):
                note("slip as the way along the obstacle",
                     norm(sub(told[i], slip)) / length)
            dissipated -= power
            if states[i] == STICK:
                note("no slip where it sticks", norm(slip) / length)
            if states[i] == SLIP:
                note("traction against the slip",
                     (power + mu * pressing * norm(slip)) / (force * length))
        for name, value in worst.items():
            self.check(name, value)
        if not self.shared:
            self.counts(counts)
        if self.knows_slips() and len(solid.pairs) == 1:
            self.check("dissipation is that of the nodes",
                       abs(dissipated - solid.summary["dissipation"])
                       / (force * length * len(self.nodes)))

    def counts(self, counts):
        key, s = f"pair_{self.pair.number}", self.solid.summary
        self.solid.findings.require(
            f"pair {self.pair.number}: states are counted",
            (sum(counts), counts[1]) == (s[f"{key}_active"],
                                         s[f"{key}_slipping"]),
            "nodes that stick and slip in nodal.csv and the summary")


def is_number(text):
    try:
        float(text)
    except ValueError:
        return False
    return True


def judge_friction(solid):
    """All pairs with friction of a SolidJudge."""
    for pair in solid.pairs:
        if f"pair_{pair.number}_friction_force" not in solid.summary:
            continue
        PairFriction(solid, pair).judge()
