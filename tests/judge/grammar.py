# SPDX-License-Identifier: LGPL-2.1-or-later
"""Kinds and limits of all parameters, from the reference that `abut
parameters` prints, and scenes made from others by changing them."""
import math
import re

from formula import split


class Parameter:
    """A parameter with what the reference says of its values."""

    def __init__(self, name, default, kind):
        self.name, self.default, self.kind = name, default, kind

    def choices(self):
        """The words that it may have, or none."""
        if self.kind == "true or false":
            return ["true", "false"]
        found = re.match(r"one of (.*)", self.kind)
        return [word.strip() for word in found[1].split(",")] if found else []

    def limits(self):
        """Least and largest number, and whether it is a whole one; None for
        text."""
        if not re.match(r"a (whole )?number", self.kind):
            return None
        low, high = -math.inf, math.inf
        for pattern, which in ((r"from (NUMBER)", 0), (r"at least (NUMBER)", 0),
                               (r"above (NUMBER)", 0), (r" to (NUMBER)", 1)):
            found = re.search(pattern.replace("NUMBER", r"[-+.\de]+"),
                              self.kind)
            if found:
                low, high = ((float(found[1]), high) if which == 0 else
                             (low, float(found[1])))
        return low, high, "whole" in self.kind

    def value(self, random):
        """A value that is legal by the reference, or (one in six) just outside
        or at its limits."""
        choices = self.choices()
        if choices:
            return random.choice(choices)
        limits = self.limits()
        if limits is None:
            return None
        low, high, whole = limits
        if random.random() < 1 / 6:
            edge = random.choice([v for v in limits[:2] if math.isfinite(v)]
                                 or [0.])
            outside = edge + random.choice([-1, 0, 0, 1]) * (1 if whole
                                                              else 1e-3)
            return f"{int(outside) if whole else outside:g}"
        if whole:
            return str(int(random.triangular(max(low, 0), min(
                high, max(low, 0) + 20), max(low, 0))))
        if re.match(r"-?\d", self.default) and float(self.default) != 0.:
            centre = float(self.default)
        else:
            centre = random.choice([0.1, 1., 10.])
        value = centre * 10**random.uniform(-2, 2)
        return f"{min(max(value, low), high):.6g}"


def read_reference(text):
    """Parameters of what `abut parameters --scene KIND` prints, by section;
    numbers of sections are 1."""
    result, section = {}, ""
    for line in text.split("\n"):
        found = re.match(r"### (.*)", line)
        if found:
            section = found[1].replace(" N", " 1")
        found = re.match(r"- \*\*(.*?)\*\* = (?:`(.*?)`|\(empty\)|\(required\)) "
                         r"\((.*?)(?:; [^;)]*)+\)\. ", line)
        if found:
            name = found[1] if section == "Scene" else f"{section}/{found[1]}"
            result[name] = Parameter(found[1], found[2] or "", found[3])
    return result


NUMBER = re.compile(r"(?<![\w.])\d+\.?\d*(?:[eE][-+]?\d+)?")

# What is not changed: it would only make runs longer, or files elsewhere.
KEPT = ("Scene", "Dimension", "Title", "Refinement/Level",
        "Refinement/Adaptive cycles", "Refinement/Maximum meshes",
        "Output/Fields", "Output/Nodal values", "Output/Pictures",
        "Output/Linear solves for comparison", "Method/Law file",
        "Method/Friction file",
        "Method/Maximum linear systems", "Checkpoint/Every minutes",
        "Checkpoint/Every steps")


class Mutation:
    """Changes of a scene by a source of random numbers."""

    def __init__(self, scene, reference, random):
        self.scene, self.random = scene, random
        self.values = scene.values
        kind = scene.get("Scene", "obstacle")
        self.parameters = reference[kind]
        self.changes = []
        self.is_solid = kind == "solid"
        self.dim = int(scene.get("Dimension", "2"))
        steps = [self.number, self.number, self.parameter, self.parameter,
                 self.parameter]
        if kind != "motion":
            steps += [self.law, self.law, self.units, self.degree, self.mesh]
        if self.is_solid:
            steps += [self.pair, self.obstacle, self.obstacle, self.material,
                      self.plane, self.load_steps, self.discretisation,
                      self.friction]
        if kind == "motion" or self.values.get("Time stepping/Scheme"):
            steps += [self.time, self.time, self.time]
        for _ in range(random.choice([1, 1, 1, 2, 2, 3])):
            random.choice(steps)()
        while not self.changes:
            random.choice(steps)()

    def set(self, name, value):
        self.values[name] = str(value)
        self.changes.append(f"{name}={value}")

    def given(self, *words):
        """Parameters of the scene whose names have one of the words."""
        return [name for name, value in self.values.items()
                if value and any(word in name for word in words)]

    def changed(self, number):
        """Another number."""
        random = self.random
        value = float(number)
        choice = random.random()
        if choice < 0.2:
            return f"{value * 10**random.randint(-4, 4):.10g}"
        if choice < 0.3:
            return f"-{number}"
        if choice < 0.36:
            return random.choice(["0", "1e-12", "1e12", "1"])
        return f"{value * random.uniform(0.5, 2):.8g}"

    def in_text(self, name):
        """Change one of the numbers of a text."""
        text = self.values[name]
        found = list(NUMBER.finditer(text))
        if not found:
            return
        at = self.random.choice(found)
        new = self.changed(at[0])
        if re.fullmatch(r"\d+", at[0]) and self.random.random() < 0.7:
            new = str(max(0, int(at[0]) + self.random.choice([-1, 1, 2])))
        if new.startswith("-") and at.start() > 0:
            new = f"({new})" if text[at.start() - 1] in "*/^+-" else new
        self.set(name, text[:at.start()] + new + text[at.end():])

    # Steps

    def number(self):
        names = self.given("Prescribed displacement", "Traction", "Pressure", "Body force",
                           "Motion", "Expression", "Obstacle", "Centre", "Point", "Radius",
                           "Angle", "Initial", "Gravity", "Conductivity",
                           "Normal", "Friction", "Acceleration", "Gap",
                           "Force on first", "Density")
        names = [n for n in names if not n.startswith(("Output", "Solid/O"))
                 and not re.match(r"Pair \d+/Obstacle", n)]
        if names:
            self.in_text(self.random.choice(names))

    def parameter(self):
        names = [n for n in self.parameters if n.split("/")[0] in (
            "Method", "Solver", "Search", "Refinement", "Pair 1", "Obstacle 1",
            "Body 1", "Time stepping", "Masses", "Bar", "Motion",
            "Contact") and n not in KEPT]
        name = self.random.choice(names)
        section = name.split("/")[0]
        if section[-1] == "1" and not self.given(section + "/"):
            return
        value = self.parameters[name].value(self.random)
        if value is not None:
            self.set(name, value)

    def law(self):
        laws = [w for w in self.parameters["Method/Enforcement"].choices()
                if w != "user"]
        self.set("Method/Enforcement", self.random.choice(laws))
        if self.random.random() < 0.3:
            self.set("Method/Penalty factor",
                     f"{10**self.random.uniform(-1, 5):.4g}")

    def discretisation(self):
        self.set("Method/Discretisation", self.random.choice(
            self.parameters["Method/Discretisation"].choices()))

    def units(self):
        """Another unit of force, of length or both."""
        force = 10.**self.random.randint(-9, 9)
        names = (["Young modulus", "Traction", "Pressure", "Body force"]
                 if self.is_solid else ["Conductivity", "Body force", "Traction"])
        if not self.is_solid and not self.given("Conductivity"):
            self.set("Membrane/Conductivity", "1")
        for name in self.given(*("/" + n for n in names)):
            text = self.values[name]
            if "Young" in name:
                self.set(name, f"{float(text) * force:g}")
                continue
            parts = []
            for part in split(text, ";"):
                head, colon, tail = part.rpartition(":")
                parts.append(head + colon + ", ".join(
                    f"{force:g}*({f})" for f in split(tail, ",")))
            self.set(name, "; ".join(parts))
        if self.is_solid:
            for body in range(1, int(self.scene.get("Solid/Bodies", 1)) + 1):
                if not self.values.get(f"Body {body}/Young modulus"):
                    self.set(f"Body {body}/Young modulus", f"{force:g}")

    def degree(self):
        name = "Solid/Degree" if self.is_solid else "Membrane/Degree"
        self.set(name, self.random.choice([1, 2]))

    def mesh(self):
        names = self.given("Mesh/Arguments", "Mesh/Move", "Mesh/Rotate")
        if not names:
            return
        name = self.random.choice(names)
        choice = self.random.random()
        if choice < 0.6:
            self.in_text(name)
        elif choice < 0.75:
            section = name.rsplit("/", 1)[0]
            self.set(f"{section}/Scale", f"{self.random.uniform(.5, 2):.4g}")
        elif choice < 0.9:
            section = name.rsplit("/", 1)[0]
            angles = [f"{self.random.uniform(-40, 40):.4g}"
                      for _ in range(1 if self.dim == 2 else 3)]
            self.set(f"{section}/Rotate", ", ".join(angles))
        elif self.is_solid:
            body = name.split("/")[0]
            self.set(f"{body}/Refinements", 1)

    def pair(self):
        section = "Pair 1"
        if not self.given(section + "/"):
            return
        random = self.random
        choice = random.randrange(6)
        if choice == 0 and self.values.get(f"{section}/Primary"):
            one = self.values[f"{section}/Secondary"]
            self.set(f"{section}/Secondary", self.values[f"{section}/Primary"])
            self.set(f"{section}/Primary", one)
        elif choice == 1:
            self.set(f"{section}/Initial gap",
                     f"{random.choice([-1, 1]) * 10**random.uniform(-5, 0):.4g}"
                     + random.choice(["", "*t"]))
        elif choice == 2:
            self.set(f"{section}/Tied", random.choice(["true", "false"]))
        elif choice == 3:
            self.set(f"{section}/Reach", f"{10**random.uniform(-4, 1):.4g}")
        elif choice == 4:
            side = random.choice(["Secondary", "Primary"])
            text = self.values.get(f"{section}/{side}", "")
            if text:
                self.set(f"{section}/{side}", re.sub(r":.*", ": *", text))
        else:
            self.set(f"{section}/Use mesh gap", random.choice(["true", "false"]))

    def obstacle(self):
        section = "Obstacle 1"
        if not self.given(section + "/"):
            return
        random = self.random
        choice = random.randrange(5)
        if choice < 2:
            self.other_shape(section)
        elif choice == 2:
            self.set(f"{section}/Hollow", random.choice(["true", "false"]))
        elif choice == 3:
            self.set(f"{section}/Rotation angle",
                     f"{random.uniform(-20, 20):.4g}*t")
        else:
            shift = [f"{random.choice([-1, 1]) * 10**random.uniform(-4, 0):.4g}"
                     "*t" for _ in range(self.dim)]
            self.set(f"{section}/Motion", ", ".join(shift))

    def other_shape(self, section):
        """A shape of another kind about where the first was."""
        random = self.random
        motion = self.values.get(f"{section}/Motion")
        old = self.values.get(f"{section}/Point") or self.values.get(
            f"{section}/Centre") or ", ".join(["0"] * self.dim)
        for name in self.given(section + "/"):
            del self.values[name]
        kind = random.choice(["plane", "sphere", "box", "cone", "cylinder"])
        self.set(f"{section}/Kind", kind)
        if motion:
            self.set(f"{section}/Motion", motion)
        place = "Point" if kind in ("plane", "cone") else "Centre"
        self.set(f"{section}/{place}", old)
        if kind in ("sphere", "cylinder"):
            self.set(f"{section}/Radius", f"{10**random.uniform(-2, 1):.4g}")
        if kind == "box":
            self.set(f"{section}/Size", ", ".join(
                f"{10**random.uniform(-2, 1):.4g}" for _ in range(self.dim)))
        if kind == "cone":
            self.set(f"{section}/Angle", f"{random.uniform(5, 89):.4g}")

    def material(self):
        n_bodies = int(self.scene.get("Solid/Bodies", 1))
        body = f"Body {self.random.randint(1, n_bodies)}"
        which = self.random.random()
        if which < 0.2:
            # Of large strain are all bodies, or none.
            law = self.random.choice(["hooke", "neo-hooke",
                                      "st venant-kirchhoff"])
            for k in range(n_bodies):
                self.set(f"Body {k + 1}/Material", law)
        elif which < 0.35:
            self.set(f"{body}/Element", self.random.choice(
                ["full integration", "mean dilatation"]))
        elif which < 0.6:
            self.set(f"{body}/Poisson ratio",
                     f"{self.random.choice([0, -0.5, 0.2, 0.45, 0.49, 0.4999, 0.5])}")
        else:
            young = float(self.values.get(f"{body}/Young modulus") or 1)
            self.set(f"{body}/Young modulus",
                     f"{young * 10**self.random.uniform(-3, 3):.4g}")

    def plane(self):
        self.set("Solid/Plane", self.random.choice(
            self.parameters["Solid/Plane"].choices()))

    def load_steps(self):
        self.set("Time stepping/Number of steps", self.random.randint(1, 4))

    def friction(self):
        """Coefficient of a pair: none, a number or a formula."""
        section = f"Pair {self.random.randint(1, max(1, int(self.scene.get('Solid/Pairs', 1))))}"
        if self.given(section + "/"):
            value = f"{10**self.random.uniform(-2, 0.5):.3g}"
            self.set(f"{section}/Friction", self.random.choice(
                ["0", value, value, value + "*t",
                 value + "*(1 + 0.5*sin(7*x))"]))

    def time(self):
        """Another scheme, step, mass or end."""
        random = self.random
        choice = random.randrange(5)
        if choice < 2:
            self.set("Time stepping/Scheme", random.choice(
                [w for w in self.parameters["Time stepping/Scheme"].choices()
                 if w != "quasi-static"]))
            for name in ("HHT alpha", "Restitution"):
                self.values.pop(f"Time stepping/{name}", None)
        elif choice == 2 and "Time stepping/Step size" in self.values:
            step = float(self.values["Time stepping/Step size"])
            self.set("Time stepping/Step size", f"{step * 2**random.uniform(-1, 4):.6g}")
        elif choice == 3:
            self.set("Time stepping/Mass matrix", random.choice(
                self.parameters["Time stepping/Mass matrix"].choices()))
        else:
            end = float(self.values.get("Time stepping/End time", 1))
            self.set("Time stepping/End time", f"{end * random.uniform(0.2, 1.2):.6g}")
