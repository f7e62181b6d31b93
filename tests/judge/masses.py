# SPDX-License-Identifier: LGPL-2.1-or-later
"""Judges a chain of masses: equilibrium, contact and Coulomb's law at each mass
in each load step, by its own springs and loads."""
import csv
import math

from formula import Formula, split
from run_files import last_row
from thresholds import THRESHOLDS
from verdict import CannotJudge, Wrong

OPEN, STICK, SLIP = 0, 1, 2
EXACT = ("lagrange", "augmented lagrangian")
SPRINGS = ("penalty", "quadratic penalty")


class Chain:
    """Springs and loads of the scene."""

    def __init__(self, scene):
        self.dim = int(scene.get("Dimension", "2"))
        self.n = int(scene.get("Masses/Number", "1"))

        def number(name, default):
            return scene.number(f"Masses/{name}", default)
        self.spacing, self.spring = number("Spacing", 1), number("Spring", 1)
        self.end, self.wall = number("End spring", 0), number("Wall spring", 0)
        self.normal, self.share = (number("Normal spring", 1),
                                   number("Share of ends", 1))
        self.gap = Formula(scene.get("Masses/Gap", "0"))
        self.pressing = Formula(scene.get("Load/Pressing force", "1"))
        self.coefficient = Formula(scene.get("Friction/Coefficient", "0.3"))
        cap = scene.get("Friction/Cap", "")
        self.cap = Formula(cap) if cap else None
        self.force, self.first, self.driven = (
            self.along(scene.get(f"Load/{name}", "0"))
            for name in ("Force", "Force on first", "Driven end"))

    def along(self, text):
        """A formula for each direction along the plane."""
        parts = [p for part in split(text, ";") for p in split(part, ",")]
        parts += ["0"] * (self.dim - 1 - len(parts))
        return [Formula(part) for part in parts]

    def place(self, i):
        return (i * self.spacing, 0., 0.)

    def bound(self, i, pressure, time):
        rho = self.coefficient(self.place(i), time) * max(pressure, 0.)
        return min(rho, self.cap(self.place(i), time)) if self.cap else rho

    def share_of(self, i):
        return self.share if self.n > 1 and i in (0, self.n - 1) else 1.

    def loads(self, i, time):
        """Along the plane, then in height."""
        values = [self.share_of(i) * f(self.place(i), time)
                  for f in self.force]
        for d in range(self.dim - 1):
            if i == 0:
                values[d] += (self.first[d](self.place(0), time)
                              + self.end * self.driven[d](self.place(0), time))
        return values + [-self.share_of(i) * self.pressing(self.place(i), time)]

    def springs(self, i, u):
        """What the springs pull mass i back with."""
        pull = []
        for d in range(self.dim - 1):
            left = (self.spring * (u[i][d] - u[i - 1][d]) if i > 0
                    else self.end * u[i][d])
            right = (self.spring * (u[i][d] - u[i + 1][d]) if i + 1 < self.n
                     else self.wall * u[i][d])
            pull.append(left + right)
        return pull + [self.normal * u[i][self.dim - 1]]


class Step:
    """All masses after a load step."""

    def __init__(self, rows, dim):
        axes = "xy"[:dim - 1]
        try:
            self.time = float(rows[0]["time"])
            self.u = [[float(r[f"u_{a}"]) for a in axes] + [float(r["height"])]
                      for r in rows]
            self.normal = [float(r["normal_force"]) for r in rows]
            self.friction = [[float(r[f"friction_{a}"]) for a in axes]
                             for r in rows]
            self.slip = [[float(r[f"slip_{a}"]) for a in axes] for r in rows]
            self.state = [int(float(r["state"])) for r in rows]
        except ValueError as error:
            raise Wrong(f"masses.csv: {error}") from error
        numbers = [*self.normal, *(x for part in (self.u, self.friction,
                                                  self.slip)
                                   for row in part for x in row)]
        if not all(math.isfinite(x) for x in numbers):
            raise Wrong("masses.csv has values that are no numbers")


class MassesJudge:
    """Of a run's masses.csv, levels.csv and summary.json."""

    def __init__(self, folder, scene, summary, findings):
        self.folder, self.summary, self.findings = folder, summary, findings
        self.chain = Chain(scene)
        self.law = summary["method"]
        self.steps = self.read()
        self.force = max([max(map(abs, s.normal)) for s in self.steps] + [max(
            abs(x) for s in self.steps for i in range(self.chain.n)
            for x in self.chain.loads(i, s.time))]) or 1.
        self.length = max(abs(x) for s in self.steps for row in s.u
                          for x in row) or 1.
        self.worst = {}

    def read(self):
        path = self.folder / "masses.csv"
        if not path.exists():
            raise CannotJudge("masses.csv was not written")
        with open(path, newline="", encoding="utf-8") as file:
            rows = list(csv.DictReader(file))
        n = self.chain.n
        if not rows or len(rows) % n != 0:
            raise Wrong("masses.csv has rows of some masses only")
        return [Step(rows[k:k + n], self.chain.dim)
                for k in range(0, len(rows), n)]

    def note(self, name, value):
        """The largest of what is seen at all masses in all steps."""
        old = self.worst.get(name, 0.)
        self.worst[name] = value if value > old or math.isnan(value) else old

    def at_mass(self, step, before, i):
        chain, tau, slip = self.chain, step.friction[i], step.slip[i]
        contact = tau + [step.normal[i]]
        for load, pull, force in zip(chain.loads(i, step.time),
                                     chain.springs(i, step.u), contact):
            self.note("equilibrium", abs(load + force - pull) / self.force)
        bound = chain.bound(i, step.normal[i], step.time)
        size, way = math.hypot(*tau), math.hypot(*slip)
        power = sum(a * b for a, b in zip(tau, slip))
        self.note("traction within its bound", (size - bound) / self.force)
        self.note("no pull", -step.normal[i] / self.force)
        gap = chain.gap(chain.place(i)) + step.u[i][-1]
        state = step.state[i]
        if state == OPEN:
            self.note("nothing acts across a gap",
                      (size + abs(step.normal[i])) / self.force)
        else:
            for d, s in enumerate(slip):
                self.note("slip is the way since the last step",
                          abs(s - step.u[i][d] + before[i][d]) / self.length)
        if state == SLIP:
            self.note("traction at its bound", (bound - size) / self.force)
        if self.law in EXACT:
            self.note("penetration", -gap / self.length)
            if state != OPEN:
                self.note("closed", abs(gap) / self.length)
            if state == STICK:
                self.note("stick without slip", way / self.length)
            if state == SLIP:
                self.note("traction against slip",
                          (power + bound * way) / (self.force * self.length))

    def sums(self):
        """Of the last step, in the tables."""
        last = self.steps[-1]
        row = last_row(self.folder, "levels.csv")
        normal = sum(last.normal)
        tangential = [sum(t[d] for t in last.friction)
                      for d in range(self.chain.dim - 1)]
        given = self.summary["friction_force"]
        given = given if isinstance(given, list) else [given]
        for name, here, there in (
                [("contact force", normal, self.summary["contact_force"]),
                 ("contact force", normal, float(row["normal_force"]))]
                + [("friction", a, b) for a, b in zip(tangential, given)]
                + [("friction", a, float(row[f"friction_{axis}"]))
                   for a, axis in zip(tangential, "xy")]):
            self.note(f"sum: {name}", abs(here - there) / self.force)
        states = [last.state.count(s) for s in (OPEN, STICK, SLIP)]
        self.findings.require(
            "states are counted",
            states == [int(float(row[w])) for w in ("open", "stick", "slip")]
            and states[SLIP] == self.summary["n_slipping"],
            "open, stick and slip of masses.csv, levels.csv and the summary")

    def dissipation(self):
        """Of all steps: never negative, and what the summary says."""
        total = 0.
        for step in self.steps:
            part = -sum(a * b for i in range(self.chain.n)
                        if step.state[i] == SLIP
                        for a, b in zip(step.friction[i], step.slip[i]))
            self.note("dissipation is not negative",
                      -part / (self.force * self.length))
            total += part
        self.note("sum: dissipation",
                  abs(total - self.summary["dissipated_energy"])
                  / (self.force * self.length))

    def judge(self):
        before = [[0.] * self.chain.dim] * self.chain.n
        for step in self.steps:
            for i in range(self.chain.n):
                self.at_mass(step, before, i)
            before = step.u
        self.sums()
        if self.law in SPRINGS:
            self.findings.leave("stick, dissipation",
                                "springs of a penalty store work")
        else:
            self.dissipation()
        loose = ("penetration", "closed", "stick without slip")
        for name, value in self.worst.items():
            limit = THRESHOLDS["springs" if name in loose else "friction"]
            self.findings.check(name, value, limit.value, limit.reason)
