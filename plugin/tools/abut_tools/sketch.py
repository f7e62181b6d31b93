# SPDX-License-Identifier: LGPL-2.1-or-later
"""A sketch of the problem: outlines with boundary ids, supports and loads as
symbols, pairs coloured, obstacles. From outline.json, obstacles.vtu and
parameters.json. `abut check --draw` makes a file of it, `abut report` a part of
its page."""
import ast
import json
import math
import operator
import os
import re

import numpy
from matplotlib import lines
from matplotlib.collections import LineCollection
from matplotlib.patches import PathPatch, Polygon
from matplotlib.path import Path
from mpl_toolkits.mplot3d.art3d import Poly3DCollection

from . import style
from .errors import InputError, Words
from .run_folder import RunFolder
from .vtu import read_mesh

# Width of the picture, and its largest height, in mm.
WIDTH, HEIGHT = 120, 120

PAIRS = (style.VERMILION, style.BLUE, style.GREEN, style.PURPLE, style.ORANGE,
         style.SKY)
SUPPORT, LOAD, BODY = "#404040", "#a0522d", "#eef1f4"


class Surface:
    """A part of a boundary with one id."""

    def __init__(self, entry, dimension):
        self.body = entry["body"]
        self.id = entry["id"]
        self.names = entry["names"]
        self.points = numpy.array(entry["points"]).reshape(-1, dimension)
        self.facets = numpy.array(entry["facets"], dtype=int).reshape(
            -1, int(entry["points_of_facet"]))

    def is_called(self, word):
        """Whether a word of a list of boundaries means it."""
        return word in ("*", str(self.id)) or f"'{word}'".lower() in \
            self.names.lower()

    def samples(self, n):
        """About n points on it, with unit normals in the plane (to the right
        of the facet's direction)."""
        corners = self.points[self.facets]
        ends, starts = corners[:, 1], corners[:, 0]
        lengths = numpy.linalg.norm(ends - starts, axis=1)
        along = numpy.concatenate([[0], numpy.cumsum(lengths)])
        result = []
        for place in (numpy.arange(n) + 0.5) / n * along[-1]:
            i = min(int(numpy.searchsorted(along, place, "right")) - 1,
                    len(lengths) - 1)
            part = (place - along[i]) / lengths[i]
            tangent = (ends[i] - starts[i]) / lengths[i]
            result.append((starts[i] + part * (ends[i] - starts[i]),
                           numpy.array([tangent[1], -tangent[0]])))
        return result


def read_surfaces(run):
    """Surfaces of the outline, and the dimension."""
    if not run.has("outline.json"):
        return [], 0
    data = json.loads((run.path / "outline.json").read_text(encoding="utf-8"))
    dimension = data["dimension"]
    return ([Surface(entry, dimension) for entry in data["surfaces"].values()],
            dimension)


def read_obstacles(run, dimension):
    """Facets of rigid obstacles at time 0 by number, from obstacles.vtu."""
    if not run.has("obstacles.vtu"):
        return {}
    mesh = read_mesh(run.path / "obstacles.vtu")
    if not mesh.cells:
        return {}
    motion = numpy.column_stack([mesh.fields[f"motion_{axis}"]
                                 for axis in "xyz"[:dimension]])
    cells = numpy.array(mesh.cells)
    corners = (mesh.points[:, :dimension] - motion)[cells]
    numbers = mesh.fields["obstacle"][cells[:, 0]].astype(int)
    return {int(number): corners[numbers == number]
            for number in numpy.unique(numbers)}


def entries(text):
    """Boundary words and values of a list '1, 2: a, b; *: c'."""
    result = []
    for part in text.split(";"):
        if ":" in part:
            names, values = part.split(":", 1)
            result.append(([word.strip() for word in names.split(",")],
                           values.strip()))
    return result


def components(text):
    """The formulas of a vector; commas in parentheses separate arguments."""
    parts, depth, begin = [], 0, 0
    for i, letter in enumerate(text):
        depth += (letter == "(") - (letter == ")")
        if letter == "," and depth == 0:
            parts.append(text[begin:i].strip())
            begin = i + 1
    return parts + [text[begin:].strip()]


def named(surfaces, text, body):
    """Surfaces with the values that a list of a body gives them; * means those
    that are not named."""
    result, taken = [], set()
    listed = entries(text)
    for words, value in sorted(listed, key=lambda entry: "*" in entry[0]):
        for i, surface in enumerate(surfaces):
            if surface.body == body and i not in taken and any(
                    surface.is_called(word) for word in words):
                taken.add(i)
                result.append((surface, value))
    return result


def side(run, surfaces, text):
    """Surfaces of one side of a pair, '1: 3, 4; pin: *'."""
    result = []
    for body, words in entries(text):
        for section in run.sections("Body"):
            number = section.split()[-1]
            if body[0] in (number, run.parameter(f"{section}/Name")):
                result += [surface for surface, _ in named(
                    surfaces, f"{words}: 0", int(number))]
    return result


def loops(surfaces):
    """Closed lines of facets in the plane, from all surfaces of a body."""
    nodes, size = {}, numpy.ptp(numpy.concatenate(
        [surface.points for surface in surfaces]), axis=0).max()

    def key(point):
        return tuple(numpy.round(point / (1e-7 * size)).astype(numpy.int64))

    for surface in surfaces:
        for a, b in surface.points[surface.facets]:
            nodes.setdefault(key(a), []).append((key(b), b))
            nodes.setdefault(key(b), []).append((key(a), a))
    seen, result = set(), []
    for start in nodes:
        if start in seen:
            continue
        line, here, previous = [], start, None
        while here is not None and here not in seen:
            seen.add(here)
            next_ = next(((there, point) for there, point in nodes[here]
                          if there != previous and there not in seen), None)
            line.append(numpy.array(here) * 1e-7 * size)
            previous, here = here, next_[0] if next_ else None
        if len(line) > 2:
            result.append(numpy.array(line))
    return result


def filled(lines_of_body):
    """The part of the plane between closed lines: holes run the other way
    round."""
    corners, codes = [], []
    for line in lines_of_body:
        depth = sum(Path(other).contains_point(line[0])
                    for other in lines_of_body if other is not line)
        x, y = line.T
        if (x @ numpy.roll(y, -1) > y @ numpy.roll(x, -1)) == (depth % 2 == 1):
            line = line[::-1]
        corners += [*line, line[0]]
        codes += [Path.MOVETO] + [Path.LINETO] * (len(line) - 1) + [
            Path.CLOSEPOLY]
    return Path(corners, codes)


class Sketch:
    """Draws outlines; false where there are none."""

    def __init__(self, run):
        self.run = run
        self.surfaces, self.dimension = read_surfaces(run)
        self.obstacles = read_obstacles(run, self.dimension) \
            if self.surfaces else {}
        self.notes = []  # what symbols mean, and their colour or ""

    def __bool__(self):
        return bool(self.surfaces)

    def draw(self):
        """The sketch as a figure."""
        width, height = self.shape()
        figure = style.pyplot.figure(figsize=(width * style.MM,
                                              height * style.MM))
        if self.dimension == 2:
            self.draw_plane(figure.add_subplot())
        else:
            self.draw_space(figure.add_subplot(projection="3d"))
        return figure

    def note(self, text, colour=""):
        self.notes.append((text, colour))

    def box(self):
        points = numpy.concatenate([each.points for each in self.surfaces])
        return points.min(axis=0), points.max(axis=0)

    def shape(self):
        """Width and height of the picture in mm."""
        if self.dimension == 3:
            return WIDTH, 90
        low, high = self.box()
        size = (high - low) + 0.3 * (high - low).max()
        height = WIDTH * size[1] / size[0]
        return (WIDTH, max(35, height)) if height < HEIGHT else (
            max(50, HEIGHT * size[0] / size[1]), HEIGHT)

    def middle(self, body):
        """Of the surfaces of a body."""
        return numpy.concatenate([each.points for each in self.surfaces
                                  if each.body == body]).mean(axis=0)

    def pairs(self):
        """Number, sides and obstacle of each pair."""
        for section in self.run.sections("Pair"):
            yield (int(section.split()[-1]),
                   side(self.run, self.surfaces,
                        self.run.parameter(f"{section}/Secondary")),
                   side(self.run, self.surfaces,
                        self.run.parameter(f"{section}/Primary")),
                   self.run.parameter(f"{section}/Obstacle", "none"))

    def supports(self):
        """Surface and the words of its components."""
        for section in self.run.sections("Body"):
            for surface, value in named(
                    self.surfaces, self.run.parameter(
                        f"{section}/Prescribed displacement"),
                    int(section.split()[-1])):
                yield surface, components(value)
        for surface, value in named(
                self.surfaces, self.run.parameter(
                    "Membrane/Prescribed displacement"), 1):
            yield surface, [value]

    def loads(self):
        for section in self.run.sections("Body"):
            for name in ("Pressure", "Traction"):
                for surface, value in named(
                        self.surfaces, self.run.parameter(f"{section}/{name}"),
                        int(section.split()[-1])):
                    yield surface, name, components(value)

    # In the plane.

    def draw_plane(self, axes):
        low, high = self.box()
        self.size = (high - low).max()
        for body in sorted({each.body for each in self.surfaces}):
            of_body = [each for each in self.surfaces if each.body == body]
            closed = loops(of_body)
            if closed:
                axes.add_patch(PathPatch(filled(closed), facecolor=BODY,
                                         edgecolor="none"))
            for surface in of_body:
                axes.add_collection(LineCollection(
                    surface.points[surface.facets], colors="#808890",
                    linewidths=0.8))
        # What scales must know before symbols are drawn.
        margin = 0.16 * self.size
        axes.set_xlim(low[0] - margin, high[0] + margin)
        axes.set_ylim(low[1] - margin, high[1] + margin)
        axes.set_aspect("equal")
        axes.axis("off")
        self.draw_obstacles(axes)
        self.draw_pairs(axes)
        self.draw_supports(axes)
        self.draw_loads(axes)
        self.draw_ids(axes)

    def name(self, surface):
        """Its name in the mesh file or its id, with the body where there are
        several."""
        names = re.findall(r"'([^']*)'", surface.names)
        several = len(self.run.sections("Body")) > 1
        return names[0] if names else (
            f"{surface.body}: {surface.id}" if several else str(surface.id))

    def note_names(self):
        self.note("numbers: bodies and boundary ids"
                  if len(self.run.sections("Body")) > 1
                  else "numbers and names: boundary ids")

    def outward(self, surface, place, normal):
        """The normal that points away from the body's middle."""
        inside = self.middle(surface.body)
        loop_side = self.inside_at(surface, place + 1e-4 * self.size * normal)
        if loop_side is not None:
            return -normal if loop_side else normal
        return normal if normal @ (place - inside) > 0 else -normal

    def inside_at(self, surface, place):
        """Whether a point is inside of a body, by crossings."""
        crossings = 0
        for other in self.surfaces:
            if other.body != surface.body:
                continue
            a, b = (other.points[other.facets[:, i]] for i in (0, 1))
            across = (a[:, 1] > place[1]) != (b[:, 1] > place[1])
            a, b = a[across], b[across]
            x = a[:, 0] + (place[1] - a[:, 1]) * (b[:, 0] - a[:, 0]) \
                / (b[:, 1] - a[:, 1])
            crossings += int((x > place[0]).sum())
        return crossings % 2 == 1

    def draw_obstacles(self, axes):
        for number, facets in self.obstacles.items():
            axes.add_collection(LineCollection(facets, colors="#303030",
                                               linewidths=1.6))
            low, high = numpy.array(axes.get_xlim()), numpy.array(
                axes.get_ylim())
            seen = facets.mean(axis=1)
            seen = seen[(seen[:, 0] > low[0]) & (seen[:, 0] < low[1])
                        & (seen[:, 1] > high[0]) & (seen[:, 1] < high[1])]
            if len(seen):
                place = seen[numpy.argmax(seen @ [1.0, 0.3])]
                axes.annotate(f"obstacle {number}", place, fontsize=7,
                              xytext=(-2, 5), textcoords="offset points",
                              ha="right")
        if self.obstacles:
            self.note("black lines: rigid obstacles at time 0")

    def draw_pairs(self, axes):
        for number, secondary, primary, obstacle in self.pairs():
            colour = PAIRS[(number - 1) % len(PAIRS)]
            for surfaces, width, dashes in (
                    (secondary, 3.2, "-"), (primary, 2.2, (0, (2, 1)))):
                for surface in surfaces:
                    axes.add_collection(LineCollection(
                        surface.points[surface.facets], colors=colour,
                        linewidths=width, linestyles=dashes, zorder=3))
            self.note(
                f"pair {number}: secondary surface (full line)"
                + (" and primary surface (dashed)" if primary else
                   f" and obstacle {obstacle}" if obstacle != "none" else ""),
                colour)

    def draw_supports(self, axes):
        any_drawn = is_clamped = False
        for surface, words in self.supports():
            if "free" not in words:
                is_clamped = True
                self.clamp(axes, surface, any(value_of(word) != 0
                                              for word in words))
                continue
            for direction, word in enumerate(words):
                if word == "free":
                    continue
                any_drawn = True
                for place, normal in surface.samples(5):
                    out = self.outward(surface, place, normal)
                    unit = numpy.eye(2)[direction]
                    towards = unit * (1 if unit @ out >= 0 else -1)
                    self.triangle(axes, place, towards, value_of(word) != 0)
        if any_drawn:
            self.note("triangles: displacement prescribed along their axis, "
                      "filled where it is not 0")
        if is_clamped:
            self.note("hatched: displacement prescribed in all directions, "
                      "thick where it is not 0")

    def clamp(self, axes, surface, is_moved):
        """Short lines away from the body."""
        hatches = []
        for place, normal in surface.samples(15):
            out = self.outward(surface, place, normal)
            across = numpy.array([-out[1], out[0]])
            hatches.append([place, place + 0.03 * self.size * (out + across)])
        axes.add_collection(LineCollection(
            hatches, colors=SUPPORT, linewidths=1.6 if is_moved else 0.7,
            zorder=2))

    def triangle(self, axes, place, towards, is_moved):
        across = numpy.array([-towards[1], towards[0]])
        size = 0.022 * self.size
        corners = [place, place + size * (1.6 * towards + across),
                   place + size * (1.6 * towards - across)]
        axes.add_patch(Polygon(
            corners, closed=True, edgecolor=SUPPORT, linewidth=0.7, zorder=4,
            facecolor=SUPPORT if is_moved else "white"))

    def draw_loads(self, axes):
        any_drawn = any_dots = False
        time = self.run.number("Time stepping/End time", 1.0)
        for surface, name, words in self.loads():
            samples = surface.samples(7)
            loads = [[value_at(word, place, time) for word in words]
                     for place, _ in samples]
            largest = max((numpy.linalg.norm(load) for load in loads
                           if None not in load), default=0.0)
            if largest == 0 and all(value_of(word) == 0 for word in words):
                continue
            for (place, normal), load in zip(samples, loads):
                if None in load or largest == 0:
                    axes.plot(*place, "o", color=LOAD, markersize=3, zorder=4)
                    any_dots = True
                    continue
                out = self.outward(surface, place, normal)
                towards = (numpy.array(load) if name == "Traction"
                           else -load[0] * out)
                if not numpy.linalg.norm(towards) > 0.05 * largest:
                    continue
                arrow = 0.09 * self.size / largest * towards
                tail, head = ((place - arrow, place) if towards @ out < 0
                              else (place, place + arrow))
                axes.annotate("", head, tail, zorder=4, arrowprops={
                    "arrowstyle": "-|>", "color": LOAD, "linewidth": 0.8,
                    "shrinkA": 0, "shrinkB": 0, "mutation_scale": 6})
                any_drawn = True
        if any_drawn:
            self.note("arrows: pressure and traction at the end time, to a "
                      "scale for each boundary")
        if any_dots:
            self.note("dots: pressure and traction by other formulas, or 0 "
                      "at the end time")

    def draw_ids(self, axes):
        for surface in self.surfaces:
            place, normal = surface.samples(1)[0]
            out = self.outward(surface, place, normal)
            axes.annotate(self.name(surface), place - 0.035 * self.size * out,
                          ha="center", va="center", fontsize=7,
                          color="#1b1f24", zorder=5)
        self.note_names()

    # In space.

    def draw_space(self, axes):
        colours, dashed = {}, set()
        for number, secondary, primary, obstacle in self.pairs():
            colour = PAIRS[(number - 1) % len(PAIRS)]
            colours.update({id(each): colour for each in secondary + primary})
            dashed |= {id(each) for each in primary}
            self.note(
                f"pair {number}: secondary surface" + (
                    " and primary surface (paler)" if primary else
                    f"; obstacle {obstacle}" if obstacle != "none" else ""),
                colour)
        fixed = {id(surface) for surface, words in self.supports()
                 if any(word != "free" for word in words)}
        loaded = {id(surface) for surface, _, _ in self.loads()}
        n_facets = sum(len(each.facets) for each in self.surfaces)
        for surface in self.surfaces:
            colour = colours.get(id(surface), "#c3cad2")
            axes.add_collection3d(Poly3DCollection(
                surface.points[surface.facets], facecolors=colour,
                edgecolors="#808890", rasterized=n_facets > 400,
                linewidths=0.2 if n_facets < 3000 else 0,
                alpha=0.75 if id(surface) in colours
                and id(surface) not in dashed else 0.35))
            marks = (" ▲" if id(surface) in fixed else "") + (
                " ↓" if id(surface) in loaded else "")
            # Surfaces that touch have their names apart.
            place = (0.85 * surface.points.mean(axis=0)
                     + 0.15 * self.middle(surface.body))
            axes.text(*place, self.name(surface) + marks, fontsize=9,
                      ha="center", zorder=10)
        low, high = self.box()
        for corners in self.obstacles.values():
            axes.add_collection3d(Poly3DCollection(
                corners, facecolors="#303030", alpha=0.25, linewidths=0,
                rasterized=True))
        if self.obstacles:
            self.note("grey: rigid obstacles at time 0")
        for name, a, b in zip("xyz", low, high):
            getattr(axes, f"set_{name}lim")(a, b)
        axes.set_box_aspect(high - low)
        axes.set_axis_off()
        self.note_names()
        if fixed:
            self.note("▲: displacement prescribed")
        if loaded:
            self.note("↓: pressure or traction")


def value_of(word):
    """Of a product of numbers and t, at t = 1; None of another formula, whose
    sign is not known."""
    result, divides = 1.0, False
    for part in re.split(r"\s*([*/])\s*", word.strip()):
        if part in ("*", "/"):
            divides = part == "/"
            continue
        try:
            value = {"t": 1.0, "pi": math.pi}.get(part) or float(part)
            result = result / value if divides else result * value
        except (ValueError, ZeroDivisionError):
            return None
    return result


FUNCTIONS = {**{name: getattr(math, name) for name in (
    "sin", "cos", "tan", "asin", "acos", "atan", "sinh", "cosh", "tanh",
    "sqrt", "exp", "log10")}, "ln": math.log, "abs": abs, "min": min,
    "max": max, "if_": lambda test, yes, no: yes if test else no}
OPERATIONS = {ast.Add: operator.add, ast.Sub: operator.sub,
              ast.Mult: operator.mul, ast.Div: operator.truediv,
              ast.Pow: operator.pow, ast.USub: operator.neg,
              ast.UAdd: operator.pos, ast.Lt: operator.lt, ast.Gt: operator.gt,
              ast.LtE: operator.le, ast.GtE: operator.ge}


def value_at(word, place, time):
    """A formula at a point, None where it has what is not evaluated here."""
    names = {**dict(zip("xyz", map(float, place))), "t": time, "pi": math.pi}

    def value(node):
        if isinstance(node, ast.Constant):
            return float(node.value)
        if isinstance(node, ast.Name):
            return names[node.id]
        if isinstance(node, ast.UnaryOp):
            return OPERATIONS[type(node.op)](value(node.operand))
        if isinstance(node, ast.BinOp):
            return OPERATIONS[type(node.op)](value(node.left),
                                             value(node.right))
        if isinstance(node, ast.Compare) and len(node.ops) == 1:
            return OPERATIONS[type(node.ops[0])](value(node.left),
                                                 value(node.comparators[0]))
        if isinstance(node, ast.Call) and isinstance(node.func, ast.Name):
            return FUNCTIONS[node.func.id](*map(value, node.args))
        raise ValueError

    try:
        text = re.sub(r"\bif\s*\(", "if_(", word.strip().replace("^", "**"))
        found = value(ast.parse(text, mode="eval").body)
        return found if math.isfinite(found) else None
    except (ValueError, KeyError, TypeError, SyntaxError, ArithmeticError):
        return None


def main(words):
    """The sketch of a folder as a picture of its own."""
    parser = Words("check --draw")
    parser.add_argument("folder")
    parser.add_argument("file")
    arguments = parser.parse_args(words)
    sketch = Sketch(RunFolder(arguments.folder))
    if not sketch:
        raise InputError("--draw: there is nothing to draw. Sketches are of "
                         "bodies and membranes with at most 20000 facets at "
                         "their boundary.")
    figure = sketch.draw()
    handles = [lines.Line2D([], [], color=colour or "none", marker="s",
                            linestyle="", markersize=5, label=text)
               for text, colour in sketch.notes]
    width, height = figure.get_size_inches()
    figure.set_size_inches(width, height + 4.2 * len(handles) * style.MM)
    style.legend_above(figure, handles, columns=1)
    folder = os.path.dirname(arguments.file) or "."
    if not os.path.isdir(folder):
        raise InputError(f"--draw {arguments.file}: there is no folder {folder}.")
    try:
        # Words of the legend may be wider than a narrow sketch.
        figure.savefig(arguments.file, bbox_inches="tight",
                       metadata={"Date": None}
                       if arguments.file.endswith(".svg") else None)
    except (OSError, ValueError) as error:
        raise InputError(f"--draw {arguments.file}: {error}.") from error
    return 0
