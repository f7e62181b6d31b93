# SPDX-License-Identifier: LGPL-2.1-or-later
"""Rigid obstacles of a scene: distances by the judge's own formulas."""
import math

from formula import Formula, numbers, split
from vectors import add, cross, dot, norm, scale, sub, unit


def _turn(x, angle, axis):
    """Rodrigues' rotation; in the plane about the third direction."""
    c, s = math.cos(angle), math.sin(angle)
    if len(x) == 2:
        return (c * x[0] - s * x[1], s * x[0] + c * x[1])
    axis = unit(axis)
    along = scale(axis, dot(axis, x) * (1 - c))
    return add(add(scale(x, c), scale(cross(axis, x), s)), along)


class Obstacle:
    """Signed distance at a time, positive outside of the material. Inside it is
    exact up to the nearest face; outside it is a lower bound."""

    def __init__(self, scene, number, dim, time, driven=None):
        self.scene, self.dim, self.time = scene, dim, time
        # What forces have moved it by.
        self.driven = tuple(driven or (0.,) * dim)
        self.section = f"Obstacle {number}"
        self.kind = self._text("Kind", "plane")
        self.sign = -1. if self._flag("Hollow") else 1.
        kind = self.kind.replace(" ", "_")
        if not hasattr(self, "_" + kind):
            raise ValueError(f"no formula for obstacles of kind {self.kind}")
        self.shape = getattr(self, "_" + kind)()

    def _text(self, name, default=""):
        return self.scene.get(f"{self.section}/{name}", default)

    def _flag(self, name):
        return self.scene.flag(f"{self.section}/{name}")

    def _points_move(self):
        """Whether gaps are measured where bodies are, normal to a height."""
        get = self.scene.get
        sliding = get("Method/Contact geometry", "auto")
        return sliding == "large" or (
            sliding == "auto" and get("Body 1/Material", "hooke") != "hooke"
            and get("Method/Discretisation", "auto") in
            ("auto", "node to segment", "quadrature point"))

    def _vector(self, name, last=False):
        values = numbers(self._text(name))
        if not values:
            values = [0.] * self.dim
            values[-1] = 1. if last else 0.
        return tuple(values)

    # Where it is

    def _formulas(self, name, n):
        text = self._text(name)
        if not text:
            return (0.,) * n
        parts = split(text, ";")
        if len(parts) != n:
            parts = split(text, ",")
        return tuple(Formula(part)((0., 0., 0.), self.time) for part in parts)

    def _motion(self):
        """Angle, centre, axis and translation of the motion."""
        angle = math.radians(self._formulas("Rotation angle", 1)[0])
        axis = tuple(numbers(self._text("Rotation axis", "0, 0, 1")))
        return (angle, self._vector("Rotation centre"), axis,
                add(self._formulas("Motion", self.dim), self.driven))

    def _first_turns(self):
        angles = [math.radians(a) for a in numbers(self._text("Rotate"))]
        if self.dim == 2:
            return [(a, (0, 0, 1)) for a in angles]
        return [(a, tuple(float(i == k) for i in range(3)))
                for k, a in enumerate(angles)]

    def own(self, x):
        """A point in the obstacle's own frame."""
        angle, centre, axis, shift = self._motion()
        x = sub(x, shift)
        x = add(_turn(sub(x, centre), -angle, axis), centre)
        x = sub(x, self._vector("Move"))
        for turn, about in reversed(self._first_turns()):
            x = _turn(x, -turn, about)
        return x

    def world(self, x):
        """The other way."""
        for turn, about in self._first_turns():
            x = _turn(x, turn, about)
        x = add(x, self._vector("Move"))
        angle, centre, axis, shift = self._motion()
        return add(add(_turn(sub(x, centre), angle, axis), centre), shift)

    def distance(self, x):
        return self.sign * self.shape(self.own(x))

    def normal(self, x, size):
        """Out of the material, by differences of the distance."""
        axes = [tuple(float(i == k) for i in range(self.dim))
                for k in range(self.dim)]
        return unit(tuple(self.distance(add(x, scale(e, size)))
                          - self.distance(sub(x, scale(e, size)))
                          for e in axes))

    def clearance(self, x, gap):
        """Distance beyond an initial gap, which is along the axis of a height
        whose points do not move."""
        return self.distance(x) + gap / self.steepness(self.own(x))

    @staticmethod
    def steepness(_):
        """What initial gaps are by those along the normal."""
        return 1.

    # Shapes: signed distances in their own frame

    def _plane(self):
        point, normal = self._vector("Point"), unit(self._vector("Normal", True))
        return lambda x: dot(sub(x, point), normal)

    def _sphere(self):
        centre, radius = self._vector("Centre"), self._number("Radius", 1)
        return lambda x: norm(sub(x, centre)) - radius

    def _number(self, name, default):
        return float(self._text(name, str(default)))

    @staticmethod
    def _of_slabs(defects):
        """Distance to the intersection of slabs with orthogonal normals."""
        if max(defects) <= 0:
            return max(defects)
        return math.sqrt(sum(max(d, 0.)**2 for d in defects))

    def _box(self):
        centre = self._vector("Centre")
        size = numbers(self._text("Size", "1"))
        size = size * self.dim if len(size) == 1 else size
        return lambda x: self._of_slabs([abs(a - c) - s / 2 for a, c, s in
                                         zip(x, centre, size)])

    def _cylinder(self):
        centre, axis = self._vector("Centre"), unit(self._vector("Axis", True))
        radius, length = self._number("Radius", 1), self._number("Length", 0)

        def distance(x):
            along = dot(sub(x, centre), axis)
            across = norm(add(sub(x, centre), axis, -along)) - radius
            if length == 0:
                return across
            return self._of_slabs([across, abs(along) - length / 2])
        return distance

    def _cone(self):
        tip, axis = self._vector("Point"), unit(self._vector("Axis", True))
        angle = math.radians(self._number("Angle", 45))
        length = self._number("Length", 0)

        def distance(x):
            along = dot(sub(x, tip), axis)
            across = norm(add(sub(x, tip), axis, -along))
            side = across * math.cos(angle) - along * math.sin(angle)
            return side if length == 0 else max(side, along - length)
        return distance

    def _slope(self, function, x):
        """Length of the gradient by differences."""
        total = 0.
        for d in range(self.dim):
            h = 1e-6 * max(abs(x[d]), 1e-3)
            ahead = tuple(v + h * (d == k) for k, v in enumerate(x))
            behind = tuple(v - h * (d == k) for k, v in enumerate(x))
            change = (function(ahead) - function(behind)) / (2 * h)
            # a formula may end at the place, as x^3.1 does at the axis
            for beside in (ahead, behind):
                if math.isnan(change):
                    change = (function(beside) - function(x)) / h
            total += change**2
        return math.sqrt(total)

    def _height(self):
        axis = self._vector("Axis", True)
        along = max(range(self.dim), key=lambda d: abs(axis[d]))
        sign = 1. if axis[along] > 0 else -1.
        formula = Formula(self._text("Expression"))

        def level(x):
            return formula(x, self.time)

        def steepness(x):
            return math.sqrt(1 + self._slope(level, x)**2)
        if self._text("Gap along", "axis") == "axis" and not self._points_move():
            self.steepness = steepness
        return lambda x: sign * (x[along] - level(x)) / steepness(x)

    def _distance(self):
        formula = Formula(self._text("Expression"))

        def value(x):
            return formula(x, self.time)

        return lambda x: value(x) / (self._slope(value, x) or 1.)

    def surface_points(self):
        """Points all over a closed shape, in the world; none of others."""
        if self.sign < 0 or self.kind not in ("sphere", "box", "cylinder"):
            return []
        n = 64 if self.dim == 2 else 12
        if self.kind == "box":
            points = self._box_points(n)
        else:
            points = self._round_points(n)
        return [self.world(point) for point in points]

    def _box_points(self, n):
        centre = self._vector("Centre")
        size = numbers(self._text("Size", "1"))
        size = size * self.dim if len(size) == 1 else size
        grid = [i / n - 0.5 for i in range(n + 1)]
        faces = []
        for d in range(self.dim):
            for side in (-0.5, 0.5):
                rest = [(a,) for a in grid] if self.dim == 2 else [
                    (a, b) for a in grid for b in grid]
                faces += [place[:d] + (side,) + place[d:] for place in rest]
        return [tuple(c + s * a for c, s, a in zip(centre, size, place))
                for place in faces]

    def _round_points(self, n):
        centre, radius = self._vector("Centre"), self._number("Radius", 1)
        if self.dim == 2:
            return [(centre[0] + radius * math.cos(2 * math.pi * i / n),
                     centre[1] + radius * math.sin(2 * math.pi * i / n))
                    for i in range(n)]
        if self.kind == "cylinder":
            return []
        return [add(centre, (radius * math.sin(a) * math.cos(b),
                             radius * math.sin(a) * math.sin(b),
                             radius * math.cos(a)))
                for a in (math.pi * i / n for i in range(n + 1))
                for b in (math.pi * k / n for k in range(2 * n))]
