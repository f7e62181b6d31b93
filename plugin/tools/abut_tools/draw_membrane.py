# SPDX-License-Identifier: LGPL-2.1-or-later
"""Pictures of membranes over obstacles: displacement and states of contact."""
import numpy
from matplotlib import collections, colors, patches
from matplotlib.tri import Triangulation

from . import geometry, style
from .labels import label

# Of the field `status`: word and colour.
STATES = {-1: ("no constraint", "#fafafa"), 0: ("open", "#c6dff0"),
          1: ("contact", style.VERMILION),
          2: ("contact with the upper obstacle", style.BLUE)}
MOST_EDGES = 6000  # more are not seen


def pictures(run, width):
    mesh = run.last_field("fields")
    if mesh is None:
        return
    title = ""
    if run.input.get("dimension") == 3:
        z = mesh.points[:, 2]
        height = 0.5 * (z.min() + z.max())
        mesh = geometry.cut(mesh, height)
        title = f"plane $z$ = {style.number(height)}"
    yield "displacement", _displacement(mesh, title, width)
    if "status" in mesh.fields:
        yield "active-set", _states(mesh, title, width)


def _aspect(mesh):
    return float(numpy.clip(numpy.ptp(mesh.points[:, 1])
                            / numpy.ptp(mesh.points[:, 0]), 0.15, 1.6))


def _displacement(mesh, title, width):
    """The membrane from the side, and a map with level lines."""
    points, values, corners = geometry.fine_triangles(
        mesh, mesh.points[:, :2], mesh.fields["displacement"].astype(float))
    mesh_of = Triangulation(points[:, 0], points[:, 1], corners)
    aspect = _aspect(mesh)
    narrow = style.is_narrow(width)
    figure = style.pyplot.figure(figsize=(width * style.MM, width * style.MM * (
        0.1 + 0.7 + 0.75 * aspect if narrow else
        0.08 + 0.36 * max(aspect, 0.6))))
    parts = (figure.add_gridspec(2, 1, height_ratios=(0.7, 0.75 * aspect))
             if narrow else figure.add_gridspec(1, 2, width_ratios=(1.25, 1)))
    figure.get_layout_engine().set(wspace=0.14)
    side = figure.add_subplot(parts[0], projection="3d")
    x, y = (numpy.linspace(part.min(), part.max(), 61)
            for part in mesh.points.T[:2])
    grid = numpy.meshgrid(x, y)
    surface = geometry.sample(points, corners, values, x, y)
    norm = colors.Normalize(values.min(), values.max())
    side.plot_surface(*grid, surface, rstride=1, cstride=1, linewidth=0.15,
                      edgecolor="#ffffff30", cmap=style.FIELD_MAP, norm=norm,
                      antialiased=True, rasterized=True)
    side.view_init(28, -50)
    side.set_box_aspect((1, aspect, 0.55), zoom=0.9)
    side.set_xlabel("$x$ [length]", labelpad=-4)
    side.set_ylabel("$y$ [length]", labelpad=-4)
    side.set_zlabel("$u$ [length]", labelpad=-3)
    side.tick_params(pad=-2)
    for axis in (side.xaxis, side.yaxis, side.zaxis):
        axis.set_major_locator(style.ticker.MaxNLocator(4))
        axis.pane.set_facecolor("white")
    top = figure.add_subplot(parts[1])
    field = style.named(top.tripcolor(mesh_of, values, shading="gouraud",
                                      cmap=style.FIELD_MAP, norm=norm,
                                      rasterized=True), "displacement")
    if numpy.ptp(values) > 0:
        levels = top.tricontour(mesh_of, values, 10, colors="white",
                                linewidths=0.4, alpha=0.7)
        # Matplotlib before 3.8 has an artist for each level.
        for level in getattr(levels, "collections", [levels]):
            level.set_rasterized(True)
    style.colour_bar(figure, field, top, label("displacement"))
    style.plane_map(top)
    top.set_title(title)
    return figure


def _states(mesh, title, width):
    """One colour for each state of the nodes, as far as half way to the next
    node."""
    aspect = _aspect(mesh)
    width = min(width, 120)
    figure, [[axes]] = style.figure(width, 0.15 + 0.85 * aspect)
    corners, states = node_patches(mesh, mesh.fields["status"])
    present = [state for state in STATES if (states == state).any()]
    palette = [STATES[int(state)][1] if state in STATES else "white"
               for state in states]
    axes.add_collection(style.named(collections.PolyCollection(
        corners, facecolors=palette, array=None, linewidths=0.0,
        antialiaseds=False, rasterized=True), "states"))
    axes.margins(0)
    axes.autoscale_view()
    edges = geometry.edges(mesh)
    if len(edges) <= MOST_EDGES:
        axes.add_collection(collections.LineCollection(
            mesh.points[edges][:, :, :2], colors="#00000030", linewidths=0.2))
    style.legend(axes, [patches.Patch(facecolor=STATES[state][1],
                                      edgecolor=style.GREY, linewidth=0.4,
                                      label=STATES[state][0])
                        for state in present])
    style.plane_map(axes)
    if title:
        axes.set_xlabel(f"$x$ [length], {title}")
    return figure


def node_patches(mesh, values):
    """Quadrilaterals around the corners of triangles, up to the middles of
    their edges, with the value of each corner."""
    triangles = geometry.triangles(mesh)
    points = mesh.points[triangles][:, :, :2]
    centre = points.mean(axis=1)
    parts = []
    for i in range(3):
        a, b, c = (points[:, (i + k) % 3] for k in range(3))
        parts.append(numpy.stack([a, (a + b) / 2, centre, (a + c) / 2], axis=1))
    return (numpy.concatenate(parts),
            numpy.round(numpy.concatenate([values[triangles[:, i]]
                                           for i in range(3)])).astype(int))
