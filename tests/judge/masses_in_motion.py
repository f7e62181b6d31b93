# SPDX-License-Identifier: LGPL-2.1-or-later
"""Judges masses and bars in motion: what their tables say of energy, momentum,
contact and friction in each step, and of each mass at the end."""
import csv
import math
import re

from formula import Formula, split
from thresholds import THRESHOLDS
from verdict import CannotJudge, Wrong

ENERGIES = ("kinetic_energy", "strain_energy", "contact_energy",
            "dissipated_energy", "energy_lost_in_impacts")
# Schemes whose contact is a condition on the displacement at a step's end.
AT_THE_END = {"hht", "trapezoid", "midpoint", "newmark", "generalised alpha",
              "central difference with projection", "velocity level"}


def numbers(path):
    if not path.exists():
        raise CannotJudge(f"{path.name} was not written")
    with open(path, newline="", encoding="utf-8") as file:
        try:
            rows = [{k: float(v) for k, v in row.items()}
                    for row in csv.DictReader(file)]
        except (TypeError, ValueError) as error:
            raise Wrong(f"{path.name}: {error}") from error
    if not rows or not all(math.isfinite(v) for r in rows for v in r.values()):
        raise Wrong(f"{path.name} has no rows, or values that are no numbers")
    return rows


class MassesInMotionJudge:
    """Of a run's levels.csv, masses.csv and summary.json."""

    def __init__(self, folder, scene, summary, findings):
        self.scene, self.summary, self.findings = scene, summary, findings
        self.rows = numbers(folder / "levels.csv")
        self.masses = numbers(folder / "masses.csv")
        self.dim = int(scene.get("Dimension", "1"))
        self.axes = ["x", "y"][:self.dim - 1] + ["height"]
        self.is_bar = scene.number("Bar/Elements", 0) > 0
        self.scheme = scene.get("Time stepping/Scheme", "velocity level")
        self.mass = scene.number("Masses/Mass", 1)
        self.total = (scene.number("Bar/Density", 1)
                      * scene.number("Bar/Length", 1) if self.is_bar
                      else self.mass * len(self.masses))
        self.force = max([abs(r[f"force_{a}"]) for r in self.rows
                          for a in self.axes])
        # a bar that lies on the plane is moved elsewhere
        self.length = max([abs(r["u_height"]) for r in
                           self.rows + self.masses]
                          + [scene.number("Motion/Gap", 0)]) or 1.
        self.energy = max(max(abs(r[n]) for n in ENERGIES + (
            "external_work",)) for r in self.rows)

    def check(self, name, value, kind, size):
        limit = THRESHOLDS[kind]
        self.findings.check(name, value, limit.value * size, limit.reason)

    def judge(self):
        self.tables()
        self.contact()
        self.last_masses()
        self.gain()
        self.momentum()

    def tables(self):
        """Sums of a row, and the last row in the summary."""
        self.check("balance of energies of levels.csv", max(
            abs(sum(r[n] for n in ENERGIES) - r["external_work"]
                - r["energy_balance"]) for r in self.rows), "tables",
            self.energy)
        last = self.rows[-1]
        for name in ENERGIES + ("external_work",):
            self.check(f"{name} of the summary",
                       abs(last[name] - self.summary[name]), "tables",
                       self.energy)
        self.check("time of the end", abs(
            last["time"] - self.scene.number("Time stepping/End time", 1)), "tables",
            2 * last["time"])

    def contact(self):
        """No pull, no penetration, no friction above mu N."""
        self.check("pull", max(-r["force_height"] for r in self.rows),
                   "friction", self.force)
        if self.scheme in AT_THE_END:
            gap = self.scene.number("Motion/Gap", 0)
            heights = [r["u_height"] for r in self.rows]
            if self.dim > 1 or not self.is_bar:
                heights += [m["u_height"] for m in self.masses[
                    :None if self.dim > 1 else 1]]
            self.check("penetration", max(-h - gap for h in heights),
                       "friction", self.length)
        bound = self.scene.number("Contact/Friction", 0)
        self.check("friction above mu N", max(
            math.hypot(*(r[f"force_{a}"] for a in self.axes[:-1]))
            - bound * r["force_height"] for r in self.rows), "friction",
            self.force)
        # by the sum: the step in which a velocity turns may give a little back
        # and what sticks creeps by the round-off of its velocity
        limit = THRESHOLDS["friction"]
        self.findings.check("dissipation is not negative",
                            max(-r["dissipated_energy"] for r in self.rows),
                            limit.value * self.energy + self.creep(),
                            limit.reason)

    def creep(self):
        """Energy by the round-off of what forces would make of velocities."""
        return 1e-15 * (self.force * self.rows[-1]["time"])**2 / self.total

    def last_masses(self):
        """Of masses.csv in the last row of levels.csv."""
        last = self.rows[-1]
        for axis in self.axes:
            self.check(f"sum of the forces, {axis}", abs(
                sum(m[f"force_{axis}"] for m in self.masses)
                - last[f"force_{axis}"]), "friction", self.force)
        if self.is_bar:
            return
        kinetic = sum(0.5 * self.mass * m[f"v_{a}"]**2 for m in self.masses
                      for a in self.axes)
        self.check("kinetic energy of the masses",
                   abs(kinetic - last["kinetic_energy"]), "friction",
                   self.energy)

    def gain(self):
        """No step has more than the start and the scheme gains; what goes by
        impulses never gains."""
        if self.summary["warnings"]:
            self.findings.leave("gain of energy", "the run has warned")
            return
        explicit = self.scheme.startswith("central difference")
        def kept(row):
            return row["energy_balance"] - row["energy_lost_in_impacts"]
        gain, least = 0., kept(self.rows[0])
        for row in self.rows:
            if self.scheme == "velocity level":
                least = min(least, kept(row))
            gain = max(gain, kept(row) - least)
        limit = THRESHOLDS["gain"]
        self.findings.check(
            "gain of energy", gain, limit.value
            * (5 if explicit else 1) * self.energy + self.creep(),
            limit.reason)
        if self.scheme == "energy momentum":
            first = self.rows[0]["energy_balance"]
            self.check("energy that is kept", max(
                abs(r["energy_balance"] - first) for r in self.rows),
                "kept", self.energy)

    def momentum(self):
        """What contact and loads give in each step, of masses that nothing
        else holds."""
        if (self.scheme != "velocity level" or self.is_bar
                or self.scene.number("Masses/Wall spring", 0)
                or self.scene.get("Motion/Force on first", "0") != "0"):
            self.findings.leave("momentum of each step",
                                "other forces, or weighted ones")
            return
        texts = split(self.scene.get("Motion/Acceleration", "0"), ";")
        if any(re.search(r"\b[tx]\b", text) for text in texts):
            self.findings.leave("momentum of each step", "the load changes")
            return
        weights = [Formula(t)((0., 0., 0.), 0.) for t in texts]
        weights += [0.] * (self.dim - len(weights))
        self.work(weights)
        worst = size = 0.
        for a, weight in zip(self.axes, weights):
            for before, now in zip(self.rows, self.rows[1:]):
                dt = now["time"] - before["time"]
                given = dt * (now[f"force_{a}"] + self.total * weight)
                change = now[f"momentum_{a}"] - before[f"momentum_{a}"]
                worst = max(worst, abs(change - given))
                size = max(size, dt * abs(self.total * weight),
                           abs(now[f"momentum_{a}"]),
                           abs(before[f"momentum_{a}"]))
        self.check("momentum of each step", worst, "momentum", size)

    def work(self, weights):
        """Of the weight, by the ways of the masses."""
        starts = split(self.scene.get("Motion/Initial displacement", "0"), ";")
        total = 0.
        for k, (axis, weight) in enumerate(zip(self.axes, weights)):
            start = Formula(starts[k]) if k < len(starts) else lambda x, t: 0.
            total += weight * self.mass * sum(
                m[f"u_{axis}"] - start((m["x"], 0., 0.), 0.)
                for m in self.masses)
        self.check("work of the weight",
                   abs(total - self.rows[-1]["external_work"]), "friction",
                   self.energy)
