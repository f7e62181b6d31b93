# SPDX-License-Identifier: LGPL-2.1-or-later
"""Judges bodies in motion: momentum and energy of each step, by the table."""
import csv
import math

from driven import judge_driven_motion
from formula import Formula, split
from thresholds import THRESHOLDS
from verdict import says

# Weight gamma of the new acceleration in the velocity of a step.
GAMMAS = {"hht": lambda number: 0.5 - number("HHT alpha", -0.1),
          "trapezoid": lambda number: 0.5, "midpoint": lambda number: 1.,
          "newmark": lambda number: number("Newmark gamma", 0.5),
          # Contact acts by a jump of the velocity, and at the middle.
          "contact stabilised": lambda number: 1.,
          "central difference with projection": lambda number: 1.}

# What the bound of a gain is called, where it is not that of modified mass.
GAINS = {"central difference with projection": "explicit gain"}
PROJECTING = ("contact stabilised", "central difference with projection")


def in_motion(scene):
    return scene.get("Time stepping/Scheme", "quasi-static") != "quasi-static"


class MotionJudge:
    """What a run of the scene `solid` with Time stepping/Scheme wrote step by step."""

    def __init__(self, solid):
        self.solid, self.scene = solid, solid.scene
        with open(solid.folder / "levels.csv", newline="",
                  encoding="utf-8") as file:
            self.rows = [{k: float(v) for k, v in row.items() if v}
                         for row in csv.DictReader(file)]

    def judge(self):
        self.sums()
        self.gain()
        judge_driven_motion(self, GAMMAS)
        reason = self.unknown_forces()
        if says(self.solid.summary, "ABUT-F30"):
            reason = "the run says that forces are out of balance"
        if reason:
            self.solid.findings.leave("momentum of each step", reason)
        else:
            self.momentum()

    def sums(self):
        """The balance is that of its parts, in each row."""
        worst = size = 0.
        for row in self.rows:
            parts = [row[k] for k in ("kinetic_energy", "strain_energy",
                                      "contact_energy", "dissipated")]
            parts.append(-row["external_work"])
            worst = max(worst, abs(math.fsum(parts) - row["balance"]))
            size = max([size, *map(abs, parts)])
        limit = THRESHOLDS["tables"]
        self.solid.findings.check("balance of energies of levels.csv", worst,
                                  limit.value * size, limit.reason)

    def gain(self):
        """No step has more than there was at the start and the scheme gains."""
        start = self.solid.summary["initial_energy"]
        scale = max([abs(start)] + [abs(r["external_work"]) for r in self.rows])
        scheme = self.scene.get("Time stepping/Scheme")
        exact = (self.scene.get("Time stepping/Mass matrix", "auto") in ("auto", "modified")
                 or scheme in PROJECTING or not self.solid.pairs)
        if not exact:
            self.solid.findings.leave(
                "gain of energy", "impacts on nodes with mass have no bound")
            return
        # what is told is not silent: steps that are long beside an impact
        if says(self.solid.summary, "ABUT-F43"):
            self.solid.findings.leave("gain of energy", "the run tells of it")
            return
        # forces that are not linear in the displacement, where there are
        large = getattr(self.solid, "large", False)
        limit = THRESHOLDS["large gain" if large
                           else GAINS.get(scheme, "gain")]
        # what central differences keep is less than the energy at ends of steps
        highest = max(min(r["balance"], r.get("kept_balance", r["balance"]))
                      for r in self.rows)
        self.solid.findings.check("gain of energy", highest - start,
                                  limit.value * scale, limit.reason)

    def unknown_forces(self):
        """Why the table does not have all outer forces, or nothing."""
        if self.scene.get("Time stepping/Scheme") not in GAMMAS:
            return "the scheme weights accelerations"
        if self.solid.plane == "axisymmetric":
            return "radial forces have no resultant"
        for body in range(1, self.solid.n_bodies + 1):
            for name in ("Prescribed displacement", "Traction", "Pressure", "Body force"):
                if self.scene.get(f"Body {body}/{name}"):
                    return "supports and loads are not in the table"
        if self.scene.number("Time stepping/Mass damping", 0.):
            return "damping is not in the table"
        if any("t" in part for part in split(self.scene.get("Solid/Gravity"),
                                             ",")):
            return "gravity changes"
        return ""

    def forces(self):
        """By component: column of the momentum, and the outer forces in a
        row, which may cancel."""
        gravity = [Formula(part)((0., 0., 0.), 0.) for part in split(
            self.scene.get("Solid/Gravity"), ",")] or [0.] * self.solid.dim
        walls = [p.number for p in self.solid.pairs if p.obstacle]
        result = []
        for k, axis in enumerate("xyz"[:self.solid.dim]):
            weight = self.solid.summary["mass"][k] * gravity[k]
            result.append((f"momentum_{axis}",
                           lambda row, weight=weight, axis=axis: [weight] + [
                               row[f"pair_{n}_force_{axis}"] for n in walls]))
        return result

    def momentum(self):
        """What obstacles and weight give in each step: between bodies forces
        cancel."""
        number = lambda name, default: self.scene.number(f"Time stepping/{name}",
                                                         default)
        gamma = GAMMAS[self.scene.get("Time stepping/Scheme")](number)
        worst = size = longest = 0.
        for mass, (column, forces) in zip(self.solid.summary["mass"],
                                          self.forces()):
            for before, now in zip(self.rows, self.rows[1:]):
                step = now["time"] - before["time"]
                longest = max(longest, step)
                given = ([step * (1 - gamma) * f for f in forces(before)]
                         + [step * gamma * f for f in forces(now)])
                worst = max(worst, abs(now[column] - before[column]
                                       - math.fsum(given)))
                # what swings within the bodies has momentum, too
                size = max(size, sum(map(abs, given)), math.sqrt(
                    2 * mass * max(0., now["kinetic_energy"])))
        limit = THRESHOLDS["momentum"]
        # of forces of what is stiff and has moved
        noise = longest * self.solid.round_off()
        self.solid.findings.check("momentum of each step", worst,
                                  limit.value * size + noise, limit.reason)


class MembraneMotionJudge(MotionJudge):
    """The same of the scene `obstacle`."""

    def unknown_forces(self):
        if self.scene.get("Time stepping/Scheme") not in GAMMAS:
            return "the scheme weights accelerations"
        if (self.scene.get("Membrane/Prescribed displacement", "*: 0")
                or self.scene.get("Membrane/Traction")):
            return "what holds and pulls the edge is not in the table"
        if self.scene.number("Time stepping/Mass damping", 0.):
            return "damping is not in the table"
        if "t" in self.scene.get("Membrane/Body force", "0"):
            return "the load may change"
        return ""

    def forces(self):
        load = math.fsum(self.solid.load)
        names = [name for name in ("obstacle_force", "upper_obstacle_force")
                 if name in self.rows[0]]
        return [("momentum",
                 lambda row: [load] + [row[name] for name in names])]
