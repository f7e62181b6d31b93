# SPDX-License-Identifier: LGPL-2.1-or-later
"""Pictures of elastic bodies: plane ones deformed with mesh, obstacles, states
of contact and tractions along the contact lines; in space the surfaces."""
import numpy
from matplotlib import cm, collections, colors, lines, patches
from matplotlib.tri import Triangulation

from . import geometry, style
from .labels import label
from .vtu import read_mesh

MOST_EDGES = 1500   # more make the file large
MOST_FACES = 20000  # in space
LEAST_EDGE = 0.4    # mm on paper; smaller cells would hide the field
STATES = ((1, "sticks", style.STICK), (2, "slips", style.SLIP),
          (0, "open", style.GREY))
STRESS = "mean_von_mises_stress"


def pictures(run, width):
    mesh = run.last_field("fields")
    if mesh is None:
        return
    contact = run.last_field("contact")
    obstacles = read_mesh(run.path / "obstacles.vtu") \
        if run.has("obstacles.vtu") else None
    if obstacles is not None and not len(obstacles.points):
        obstacles = None  # none is near the bodies
    if run.input.get("dimension") == 3:
        yield "bodies", _in_space(mesh, contact, obstacles, width)
    else:
        yield "bodies", _plane(run, mesh, contact, obstacles, width)
        curves = _traction_curves(run)
        if curves:
            yield "tractions", _tractions(run, curves, width)


def _stress(mesh):
    return mesh.fields[STRESS if STRESS in mesh.fields
                       else "von_mises_stress"].astype(float)


def _range(values):
    low, high = float(values.min()), float(values.max())
    if not high - low > 1e-5 * abs(high):  # all but the same everywhere
        low -= 0.5 * abs(low)
        high = high + 0.5 * abs(high) if high > low else low + 1.0
    return colors.Normalize(low, high)


def _moved(mesh, factor):
    """The points of a deformed mesh, the displacement `factor` times."""
    return (mesh.points + factor * mesh.fields["displacement"]
            if "displacement" in mesh.fields else mesh.points)


# Plane bodies.

def _plane(run, mesh, contact, obstacles, width):
    # A small zone of contact is drawn to scale: larger displacements would push
    # curved bodies into each other.
    size = numpy.ptp(_moved(mesh, 1.0), axis=0).max()
    factor = (1.0 if _contact_zone(contact, size) is not None else
              geometry.exaggeration(mesh, mesh.fields["displacement"]))
    points = _moved(mesh, factor)[:, :2]
    surfaces = _obstacle_lines(obstacles, factor)
    low, high = _frame(points, surfaces)
    zoom = _contact_zone(contact, size)
    aspect = float(numpy.clip((high - low)[1] / (high - low)[0], 0.2, 1.5))
    if zoom is None and aspect > 0.7:
        width = min(width, 130 / aspect)
    # The zone beside the bodies, or below flat ones in a column.
    heights = [aspect]
    if zoom is not None and style.is_narrow(width) and aspect < 0.6:
        heights.append(0.6)
    columns = 1 if zoom is None else 3 - len(heights)
    is_below = style.is_narrow(width) or zoom is None and aspect < 0.3
    room = (width - 10 * columns - (0 if is_below else 20)) / columns
    figure, axes = style.pyplot.subplots(
        len(heights), columns, squeeze=False, height_ratios=heights,
        figsize=(width * style.MM, style.MM * (
            room * max(sum(heights), columns - 1) + 14 * len(heights)
            + (30 if is_below else 19))))
    axes = axes.ravel()
    norm = _range(_stress(mesh))
    views = [(low, high)] if zoom is None else [(low, high), zoom]
    for axis, (begin, end) in zip(axes, views):
        field = _draw_bodies(axis, mesh, points, norm,
                             0.2 * min(1, room / 60),
                             LEAST_EDGE * (end - begin)[0] / room)
        axis.add_collection(style.named(collections.LineCollection(
            surfaces, colors=style.BLACK, linewidths=1.8, zorder=3),
            "obstacles" if axis is axes[0] else None))
        states = _draw_states(axis, contact, factor)
        style.plane_map(axis)
        axis.set_xlim(begin[0], end[0])
        axis.set_ylim(begin[1], end[1])
    style.named(field, "von_mises_stress")
    if zoom is not None:
        axes[0].add_patch(patches.Rectangle(zoom[0], *(zoom[1] - zoom[0]),
                                            fill=False, linewidth=0.6,
                                            edgecolor=style.BLACK, zorder=4))
        axes[1].set_ylabel("")
    style.colour_bar(figure, field, list(axes), label("von_mises_stress"),
                     is_below, pad=0.02)
    handles = [lines.Line2D([], [], color=colour, linewidth=2.4, label=text)
               for _, text, colour in states]
    if len(_inside(surfaces, low, high)):
        handles.append(lines.Line2D([], [], color=style.BLACK, linewidth=1.8,
                                    label="obstacle"))
    title = (f"displacement drawn {factor:g} times" if factor > 1 else
             "displacement drawn to scale")
    style.legend_above(figure, handles, title)
    style.letters(axes)
    return figure


def _inside(surfaces, low, high):
    """The lines with an end in a frame."""
    if not len(surfaces):
        return surfaces
    return surfaces[((surfaces >= low) & (surfaces <= high)).all(axis=2)
                    .any(axis=1)]


def _frame(points, surfaces):
    """Corners of a frame around the bodies and what is near of obstacles."""
    low, high = points.min(axis=0), points.max(axis=0)
    size = (high - low).max()
    near = _inside(surfaces, low - 0.5 * size, high + 0.5 * size)
    if not len(near):
        return low - 0.02 * size, high + 0.02 * size
    ends = near.reshape(-1, 2)
    # Of an obstacle that goes on only its nearest point.
    apart = numpy.maximum(numpy.maximum(low - ends, ends - high), 0.0)
    nearest = ends[(apart ** 2).sum(axis=1).argmin()]
    strip = 0.08 * size
    return (numpy.minimum(low, nearest) - strip,
            numpy.maximum(high, nearest) + strip)


def _draw_bodies(axes, mesh, points, norm, linewidth, least):
    """The stress, the cells without edges below the length `least`, and the
    outline; returns the stress."""
    places, values, corners = geometry.fine_triangles(mesh, points,
                                                      _stress(mesh))
    field = axes.tripcolor(
        Triangulation(places[:, 0], places[:, 1], corners), values,
        shading="gouraud", cmap=style.FIELD_MAP, norm=norm, rasterized=True)
    edges = geometry.edges(mesh, points, least)
    axes.add_collection(collections.LineCollection(
        points[edges], colors="#ffffff90", linewidths=linewidth,
        rasterized=len(edges) > MOST_EDGES))
    axes.add_collection(style.named(collections.LineCollection(
        points[geometry.outline(mesh)], colors="#303030", linewidths=0.6),
        "outline"))
    return field


def _obstacle_lines(obstacles, factor):
    """Lines of the surfaces, moved as far as displacements are drawn."""
    if obstacles is None:
        return numpy.zeros((0, 2, 2))
    motion = numpy.column_stack([obstacles.fields[f"motion_{axis}"]
                                 for axis in "xy"])
    points = obstacles.points[:, :2] + (factor - 1) * motion
    return points[numpy.array(obstacles.cells)]


def _segments(contact, factor):
    """Lines of the contact boundaries between nodes with constraints, and the
    larger of the states of their ends."""
    points = _moved(contact, factor)[:, :2]
    pairs = numpy.array([pair for cell in contact.cells
                         for pair in zip(cell, cell[1:])]).reshape(-1, 2)
    state = numpy.round(contact.fields["status"]).astype(int)
    has_row = (state[pairs] >= 0).all(axis=1) \
        & ~numpy.isnan(contact.fields["gap"][pairs]).any(axis=1)
    return points[pairs[has_row]], state[pairs[has_row]]


def _draw_states(axes, contact, factor):
    """Lines of the secondary surfaces by state; returns what is there."""
    if contact is None:
        return []
    segments, states = _segments(contact, factor)
    found = []
    for number, text, colour in STATES:
        # Each half of a line has the state of its end.
        chosen = []
        for end in (0, 1):
            some = segments[states[:, end] == number]
            chosen.append(numpy.stack([some[:, end], some.mean(axis=1)], axis=1))
        chosen = numpy.concatenate(chosen)
        if not len(chosen):
            continue
        axes.add_collection(style.named(collections.LineCollection(
            chosen, colors=colour, linewidths=2.4 if number else 1.2,
            zorder=3.5), f"state_{number}"))
        found.append((number, text, colour))
    if not any(number == 2 for number, _, _ in found):
        found = [(number, "contact" if number == 1 else text, colour)
                 for number, text, colour in found]
    return found


def _contact_zone(contact, size):
    """Corners of a square around what is in contact, if it is small."""
    if contact is None:
        return None
    closed = contact.fields["status"] > 0.5
    if not closed.any():
        return None
    points = _moved(contact, 1.0)[closed][:, :2]
    low, high = points.min(axis=0), points.max(axis=0)
    extent = (high - low).max()
    if not 0 < extent < 0.2 * size:
        return None
    centre = (low + high) / 2
    return centre - 1.3 * extent, centre + 1.3 * extent


# Tractions along contact lines.

def _traction_curves(run):
    """Of each pair its number, table, closed form and the name of this."""
    curves = []
    for number, table in run.pairs().items():
        key = f"pair_{number}_closed_form"
        name = run.summary.get(key)
        if len(table["arc"]):
            curves.append((number, table,
                           run.table(f"{key}.csv") if name else None, name))
    return curves


def _abscissa(curves):
    """x or y where the pressed lines run along it, else the length along
    them."""
    for name in ("x", "y"):
        if all(_runs_along(table, name) for _, table, _, _ in curves):
            return name
    return "arc"


def _runs_along(table, name):
    pressed = table["pressure"] > 1e-6 * table["pressure"].max()
    same_line = (numpy.diff(table["line"]) == 0) & pressed[1:] & pressed[:-1]
    steps = numpy.diff(table[name])[same_line]
    return (len(steps) > 0 and len(numpy.unique(table["line"][pressed])) == 1
            and (abs(steps) > 0.95 * numpy.diff(table["arc"])[same_line]).all()
            and ((steps > 0).all() or (steps < 0).all()))


def _broken(table, name, along):
    """Places and values, interrupted between lines."""
    ends = numpy.flatnonzero(numpy.diff(table["line"])) + 1
    return (numpy.insert(table[along], ends, numpy.nan),
            numpy.insert(table[name], ends, numpy.nan))


def _pressed_range(curves, along):
    """Lengths with pressure, and as much again on both sides."""
    largest = max(table["pressure"].max() for _, table, _, _ in curves)
    begin = min(table[along].min() for _, table, _, _ in curves)
    end = max(table[along].max() for _, table, _, _ in curves)
    pressed = numpy.concatenate([
        table[along][table["pressure"] > 1e-6 * largest]
        for _, table, _, _ in curves])
    if not len(pressed) or not numpy.ptp(pressed) > 0:
        return begin, end
    size = numpy.ptp(pressed)
    return max(begin, pressed.min() - size), min(end, pressed.max() + size)


def _tractions(run, curves, width):
    figure, [[axes]] = style.figure(width, 0.45)
    along = _abscissa(curves)
    low, high = _pressed_range(curves, along)
    shown = sum(((table[along] >= low) & (table[along] <= high)).sum()
                for _, table, _, _ in curves)
    marker = {} if shown < 150 else {"marker": ""}
    several = len(curves) > 1
    for i, (number, table, closed, name) in enumerate(curves):
        of = f", pair {number}" if several else ""
        for j, (part, text) in enumerate((("pressure", "pressure"),
                                          ("friction", "tangential traction"))):
            if closed is not None and abs(closed[part]).max() > 0:
                style.named(*axes.plot(
                    *_broken(closed, part, along), color=style.BLACK,
                    linestyle="-" if j == 0 else "--", linewidth=0.9, zorder=3,
                    label=f"{text}, {name}{of}"), f"closed_{part}_{number}")
            computed = {**style.curve_style(2 * i + j), **marker}
            if closed is not None and not marker:
                computed["linestyle"] = ""
            if j == 0 or abs(table[part]).max() > 0:
                style.named(*axes.plot(*_broken(table, part, along), **computed,
                                       label=text + of), f"{part}_{number}")
    axes.set_xlim(low, high)
    axes.set_xlabel(label("arc") if along == "arc" else f"${along}$ [length]")
    axes.set_ylabel("traction [force/area]")
    style.legend(axes)
    return figure


# Bodies in space.

def _in_space(mesh, contact, obstacles, width):
    factor = geometry.exaggeration(mesh, mesh.fields["displacement"])
    pressed = [] if contact is None else _secondary_faces(contact)
    n = 2 if pressed else 1
    rows, height = (n, 0.8 * n) if style.is_narrow(width) else (1, 0.52)
    figure = style.pyplot.figure(figsize=(width * style.MM,
                                          width * height * style.MM))
    axes = [figure.add_subplot(rows, n // rows, i + 1, projection="3d")
            for i in range(n)]
    points = _moved(mesh, factor)
    faces = geometry.surface(mesh)
    _draw_faces(figure, axes[0], points, faces, _stress(mesh),
                label("von_mises_stress"), "von_mises_stress")
    if pressed:
        _draw_faces(figure, axes[1], _moved(contact, factor), pressed,
                    contact.fields["pressure"].astype(float),
                    label("pressure"), "pressure")
        axes[1].view_init(60, -60)
    for axis in axes:
        axis.tick_params(pad=-2)
        for name in "xyz":
            getattr(axis, f"set_{name}label")(f"${name}$", labelpad=-6)
            getattr(axis, f"{name}axis").pane.set_facecolor("white")
    if factor > 1:
        style.legend_above(figure, [], f"displacement drawn {factor:g} times")
    return figure


def _secondary_faces(contact):
    """Corners of the faces with constraints at some of them."""
    corners = [cell[:3] if kind in geometry.TRIANGLE else cell[:4]
               for kind, cell in zip(contact.types, contact.cells)]
    return [face for face in corners
            if not numpy.isnan(contact.fields["gap"][face]).all()]


def _brightness(corners):
    """Light from above and the side, so that edges are seen."""
    light = numpy.array([0.4, -0.6, 0.7])
    normals = numpy.array([numpy.cross(face[1] - face[0], face[2] - face[0])
                           for face in corners])
    lengths = numpy.linalg.norm(normals, axis=1)
    return 0.7 + 0.3 * abs(normals @ light) / numpy.where(lengths > 0, lengths,
                                                          1.0)


def _draw_faces(figure, axes, points, faces, values, text, name):
    from mpl_toolkits.mplot3d.art3d import Poly3DCollection
    norm = _range(values[numpy.concatenate(faces)])
    corners = [points[face] for face in faces]
    of_faces = numpy.array([values[face].mean() for face in faces])
    many = len(faces) > MOST_FACES
    mapped = cm.ScalarMappable(norm, style.FIELD_MAP)
    colour = mapped.to_rgba(of_faces)
    colour[:, :3] *= _brightness(corners)[:, None]
    shown = Poly3DCollection(
        corners, facecolors=colour, linewidths=0.0 if many else 0.2,
        edgecolors=colour if many else "#00000060", rasterized=True)
    shown.drawn_values = of_faces
    axes.add_collection3d(style.named(shown, name))
    used = points[numpy.unique(numpy.concatenate(faces))]
    low, high = used.min(axis=0), used.max(axis=0)
    size = numpy.maximum(high - low, 0.05 * (high - low).max())
    centre = (low + high) / 2
    for axis, c, s in zip("xyz", centre, size):
        getattr(axes, f"set_{axis}lim")(c - s / 2, c + s / 2)
        getattr(axes, f"{axis}axis").set_major_locator(style.ticker.MaxNLocator(
            max(1, round(3 * s / size.max()))))
    axes.set_box_aspect(size, zoom=0.95)
    style.colour_bar(figure, mapped, axes, text, shrink=0.6, aspect=25, pad=0.08)
