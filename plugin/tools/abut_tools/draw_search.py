# SPDX-License-Identifier: LGPL-2.1-or-later
"""Pictures of the scene `search`: time over bucket size, and the search of one
node: buckets, candidates, projection."""
import numpy
from matplotlib import collections, lines, patches

from . import style
from .labels import label
from .vtu import read_mesh


def pictures(run, width):
    sweep = run.table("sweep.csv")
    if sweep is not None and len(sweep["algorithm"]):
        yield "search", _sweep(run, sweep, width)
    if run.has("secondary.vtu") and run.has("candidates.csv"):
        figure = _one_node(run, width)
        if figure is not None:
            yield "detection", figure


def _sweep(run, sweep, width):
    figure, [[axes]] = style.figure(width)
    names = list(dict.fromkeys(sweep["algorithm"]))[::-1]
    sizes = []
    for i, name in enumerate(names):
        mine = sweep["algorithm"] == name
        chosen = mine & (sweep["automatic"] == 1)
        given = mine & (sweep["automatic"] == 0)
        key = name.replace(" ", "_")
        if name == "all pairs":
            axes.axhline(sweep["ns_per_node"][given][0], label=name,
                         **style.line_style(i))
            continue
        sizes += [*sweep["bucket_size"][given], *sweep["bucket_in_use"][chosen]]
        style.named(*axes.plot(sweep["bucket_size"][given],
                               sweep["ns_per_node"][given], label=name,
                               **style.curve_style(i)), key)
        x, y = sweep["bucket_in_use"][chosen], sweep["ns_per_node"][chosen]
        style.named(*axes.plot(x, y, "o", markersize=7, fillstyle="none",
                               markeredgewidth=1.2, color=style.BLACK),
                    f"{key}_automatic")
        for a, b in zip(x, y):
            axes.annotate(f"{b:.0f} ns", (a, b), textcoords="offset points",
                          xytext=(0, 7), ha="center", fontsize=7, bbox={
                              "color": "white", "pad": 0.3})
    axes.plot([], [], "o", markersize=7, fillstyle="none", color=style.BLACK,
              markeredgewidth=1.2, label="automatic choice")
    if sizes:
        axes.set_xlim(min(sizes) / 1.3, max(sizes) * 1.3)
    low, high = sweep["ns_per_node"].min(), sweep["ns_per_node"].max()
    axes.set_ylim(low / 1.6, high * 1.6)
    style.logarithmic(axes.xaxis)
    style.logarithmic(axes.yaxis)
    axes.set_xlabel(label("bucket_size"))
    axes.set_ylabel(label("ns_per_node"))
    style.legend(axes)
    return figure


def _facets(mesh):
    """Corners of facets around them, as VTK has them."""
    return [numpy.array(cell) for cell in mesh.cells]


def _plane(mesh, is_plane):
    """The two axes of the picture: those that the surface extends along most."""
    if is_plane:
        return [0, 1]
    return sorted(numpy.argsort(numpy.ptp(mesh.points, axis=0))[1:])


def _one_node(run, width):
    """The search of the node that is nearest to the middle of those with a
    partner. Surfaces in space are seen along their normals."""
    secondary = read_mesh(run.path / "secondary.vtu")
    primary = (read_mesh(run.path / "primary.vtu")
               if run.has("primary.vtu") else secondary)
    is_plane = run.input.get("dimension") == 2
    axes_of = _plane(primary, is_plane)
    # Facets have their points for themselves; nodes are numbered as the run
    # does, in candidates.csv.
    points = secondary.points
    paired = numpy.flatnonzero(secondary.fields["facet"] >= 0)
    if not len(paired):
        return None
    middle = points[paired].mean(axis=0)
    point = paired[numpy.linalg.norm(points[paired] - middle, axis=1).argmin()]
    node = int(round(float(secondary.fields["node"][point])))
    table = run.table("candidates.csv")
    candidates = table["facet"][table["node"] == node].astype(int)
    chosen = int(secondary.fields["facet"][point])
    facets = _facets(primary)
    around = primary.points[numpy.concatenate(
        [facets[f] for f in (candidates if len(candidates) else [chosen])])]
    foot = points[point] + numpy.array(
        [float(secondary.fields[f"to_projection_{axis}"][point])
         if f"to_projection_{axis}" in secondary.fields else 0.0
         for axis in "xyz"])
    extent = max(numpy.ptp(numpy.vstack([around, points[[point]]]), axis=0))
    figure, [[axes]] = style.figure(min(width, 120), 0.9)
    low = points[point] - 1.6 * extent
    high = points[point] + 1.6 * extent
    i, j = axes_of

    def drawn(p):
        return numpy.asarray(p)[..., [i, j]]

    def draw(mesh, chosen_facets, name, **look):
        corners = [drawn(mesh.points[f]) for f in chosen_facets]
        corners = [c for c in corners
                   if (c.max(axis=0) >= drawn(low)).all()
                   and (c.min(axis=0) <= drawn(high)).all()]
        if is_plane:
            look["colors"] = look.pop("edgecolors")
            look.pop("facecolors", None)
            made = collections.LineCollection(corners, **look)
        else:
            made = collections.PolyCollection(corners, **look)
        axes.add_collection(style.named(made, name))

    draw(primary, facets, "primary", edgecolors=style.BLUE, facecolors="none",
         linewidths=0.7)
    draw(primary, [facets[f] for f in candidates], "candidates",
         edgecolors=style.ORANGE, facecolors=style.ORANGE + "60",
         linewidths=1.6)
    draw(primary, [facets[chosen]], "chosen", edgecolors=style.VERMILION,
         facecolors=style.VERMILION + "80", linewidths=2.2)
    if secondary is not primary:
        draw(secondary, _facets(secondary), "secondary",
             edgecolors=style.GREY, facecolors="none", linewidths=0.5)
    handles = [
        lines.Line2D([], [], color=style.BLUE, linewidth=0.7,
                     label="primary facets"),
        lines.Line2D([], [], color=style.GREY, linewidth=0.5,
                     label="secondary facets"),
        patches.Patch(color=style.ORANGE + "60",
                      label=f"{len(candidates)} candidates"),
        patches.Patch(color=style.VERMILION + "80", label="chosen facet")]
    edge = run.summary.get("bucket_edge") or 0.0
    if edge > 0:
        # Cells begin at the least centre of the boxes of facets.
        origin = numpy.min([(primary.points[f].min(axis=0)
                             + primary.points[f].max(axis=0)) / 2
                            for f in facets], axis=0)
        for axis, draw_line in ((i, axes.axvline), (j, axes.axhline)):
            first = numpy.ceil((low[axis] - origin[axis]) / edge)
            for k in range(int((high[axis] - low[axis]) / edge) + 1):
                draw_line(origin[axis] + (first + k) * edge, color=style.GREEN,
                          linewidth=0.8, linestyle="--", zorder=0.5)
        handles.append(lines.Line2D([], [], color=style.GREEN, linewidth=0.8,
                                    linestyle="--", label="buckets"))
    path = drawn([points[point], foot])
    style.named(*axes.plot(path[:, 0], path[:, 1], color=style.BLACK, zorder=4),
                "projection")
    axes.plot(*drawn(points[point]), "o", color=style.BLACK, markersize=5,
              zorder=5)
    axes.plot(*drawn(foot), "x", color=style.BLACK, markersize=6,
              markeredgewidth=1.4, zorder=5)
    handles += [lines.Line2D([], [], color=style.BLACK, marker="o", linestyle="",
                             markersize=5, label="secondary node"),
                lines.Line2D([], [], color=style.BLACK, marker="x", linestyle="",
                             markersize=6, label="its projection")]
    style.plane_map(axes)
    axes.set_xlim(low[i], high[i])
    axes.set_ylim(low[j], high[j])
    for name, axis in (("x", i), ("y", j)):
        getattr(axes, f"set_{name}label")(f"${'xyz'[axis]}$ [length]")
    style.legend(axes, handles)
    return figure
