# SPDX-License-Identifier: LGPL-2.1-or-later
"""Figures of a run: those with expected values, of contact pairs, bodies and
points; and the examination of the answer."""
import re

from . import labels
from .report_page import (details, labelled, number, pointer, quoted, table,
                          values)

# Of PAIR, what most readers look for.
MAIN = ("force", "moment", "pressure", "contact_area", "penetration", "slip",
        "normal_force", "friction", "friction_ratio", "active", "slipping")

# Of the whole run, in the order of the page.
RUN = ("contact_force", "largest_contact_force", "contact_impulse",
       "first_contact_time", "last_contact_time", "n_touches",
       "max_penetration", "allowed_penetration", "max_complementarity",
       "active", "constraints", "lambda", "displacement", "velocity",
       "momentum", "friction_force", "friction_over_normal", "n_slipping",
       "dissipation", "energy", "kinetic_energy", "strain_energy",
       "contact_energy", "dissipated_energy", "external_work",
       "initial_energy", "energy_balance", "energy_gain", "energy_loss",
       "energy_lost_in_impacts", "l2_error", "h1_error", "energy_norm_error",
       "nodal_error", "energy_error", "estimate", "relative_estimate",
       "estimated_error", "target_error", "effectivity", "energy_order", "time", "dofs", "cells",
       "nodes", "facets", "candidates", "contact_elements", "pairs",
       "pairs_with_area", "common_area", "uncovered_area", "smallest_gap",
       "largest_gap", "initial_overlaps", "largest_overlap", "ns_per_node",
       "bytes_per_facet")


# Areas of pairs in plane scenes.
WIDTHS = {"contact_area": ("contact width", "", "length"),
          "covered_area": ("width with a partner opposite", "", "length"),
          "area": ("length of the secondary surface", "", "length")}


def is_plane(run):
    return run.kind == "solid" and run.parameter("Dimension") != "3" and \
        run.parameter("Solid/Plane") != "axisymmetric"


def pair_labels(run):
    return {**labels.PAIR, **WIDTHS} if is_plane(run) else labels.PAIR


def results(run):
    parts = [expected(run), pairs(run),
             numbered(run, "body", "Bodies",
                      ("reaction", "body_moved", "body_rotated")),
             numbered(run, "obstacle", "Obstacles moved by forces",
                      ("obstacle_displacement", "obstacle_velocity",
                       "obstacle_force")),
             numbered(run, "point", "Points", ("point_node", "point")),
             figures(run, RUN, "Whole run")]
    if is_plane(run):
        parts.append('<p class="soft">In the plane, forces and energies are '
                     "per unit of thickness.</p>")
    return "\n".join(part for part in parts if part)


def look_up(summary, key):
    """A figure and its path; `key[1]` is an entry of a vector."""
    name, bracket, entry = key.partition("[")
    value = summary.get(name)
    if bracket and isinstance(value, list):
        index = int(entry.rstrip("]"))
        return (value[index] if index < len(value) else None,
                pointer(name, index))
    if isinstance(value, list) and len(value) == 1:
        return value[0], pointer(name, 0)
    return value, pointer(name)


def expected(run):
    """Results beside the values that the scene expects."""
    rows = []
    for key, value in run.summary.get("expected", {}).items():
        found, where = look_up(run.summary, key)
        of = [f"summary.json#{where}",
              f'summary.json#{pointer("expected", key)}']
        if not isinstance(found, (int, float)):
            error = '<span class="soft">no such result</span>'
            found = None
        elif value == 0:
            error = "off by " + number(found - value, of, "difference", 2)
        else:
            error = number(abs((found - value) / value), of, "error", 2)
        rows.append([expected_label(run, key), number(found, of[0]), number(value, of[1]),
                     error])
    return rows and "<h3>Compared with expected values</h3>\n" + table(
        ["", "result", "expected", "relative error"], rows,
        numeric=(1, 2, 3))


def expected_label(run, key):
    match = re.fullmatch(r"pair_(\d+)_(\w+_area|area)", key)
    if not match or not is_plane(run):
        return labelled(key)
    text, _, dimension = WIDTHS[match[2]]
    return labelled(key, {key: (f"{text} of pair {match[1]}", "", dimension)})


def pairs(run):
    """A column for each contact pair."""
    found = {}
    for key, value in run.summary.items():
        match = re.fullmatch(r"pair_(\d+)_(.*)", key)
        if match and isinstance(value, (int, float, list)):
            found.setdefault(int(match.group(1)), {})[match.group(2)] = key
    if not found:
        return ""
    names = {name for of_pair in found.values() for name in of_pair}
    known = pair_labels(run)
    order = [name for name in known if name in names]
    order += sorted(names - set(order))

    def rows(main):
        return [[labelled(name, known)] + [
            values(run.summary[of_pair[name]],
                   f"summary.json#{pointer(of_pair[name])}")
            if name in of_pair else "" for of_pair in found.values()]
            for name in order if (name in MAIN) == main]

    head = [""] + [pair_name(run, pair) for pair in found]
    numeric = range(1, len(found) + 1)
    more = rows(False)
    return ("<h3>Contact</h3>\n" + table(head, rows(True), numeric=numeric)
            + (details("More measures of the pairs",
                       table(head, more, numeric=numeric)) if more else ""))


def pair_name(run, pair):
    sides = run.summary.get(f"pair_{pair}_sides")
    return f"pair {pair}" + (
        "<br>" + quoted(sides, f"summary.json#/pair_{pair}_sides")
        if isinstance(sides, str) else "")


def numbered(run, what, heading, names):
    """A row for each body, point or obstacle; `names` of keys without their
    number."""
    found, columns = {}, []
    for key, value in run.summary.items():
        match = re.fullmatch(r"([a-z]+)_(\d+)((?:_[a-z]+)*)", key)
        name = match and match.group(1) + match.group(3)
        if name in names and value is not None:
            found.setdefault(int(match.group(2)), {})[name] = key
            if name not in columns:
                columns.append(name)
    if not found:
        return ""
    columns.sort(key=names.index)
    rows = [[f"{what} {i}"] + [
        values(run.summary[keys[name]], f"summary.json#{pointer(keys[name])}")
        if name in keys else "" for name in columns]
        for i, keys in sorted(found.items())]
    return f"<h3>{heading}</h3>\n" + table(
        [""] + [labelled(name.partition("_")[2] or
                         ("displacement" if name == what else name))
                for name in columns], rows,
        numeric=range(1, len(columns) + 1))


def figures(run, keys, heading):
    """Figures of a list that the run has; long vectors are in the tables."""
    rows = []
    for key in keys:
        value = run.summary.get(key)
        if value is None or (isinstance(value, list) and len(value) > 6):
            continue
        where = f"summary.json#{pointer(key)}"
        rows.append([labelled(key),
                     quoted(value, where) if isinstance(value, str)
                     else values(value, where)])
    return rows and (f"<h3>{heading}</h3>\n" if heading else "") + table(
        [], rows, numeric=(1,))


def examination(run):
    """Measures of the answer with their limits."""
    rows = []
    for name, measure in run.summary.get("examination", {}).items():
        where = f'summary.json#{pointer("examination", name)}'
        value, warning, error = (measure[key] for key in (
            "value", "warning_above", "error_above"))
        tone, verdict = judged(value, warning, error)
        rows.append([labelled(name), number(value, f"{where}/value", digits=3),
                     number(warning, f"{where}/warning_above", digits=3),
                     number(error, f"{where}/error_above", digits=3),
                     f'<span class="{tone}">{verdict}</span>',
                     quoted(measure["code"], f"{where}/code")])
    if not rows:
        return ""
    return table(["measure", "value", "warning above", "error above", "",
                  "message"], rows, numeric=(1, 2, 3)) + (
        '<p class="soft">Limits of lengths follow from the deformation of the '
        "bodies. doc/failures.md explains the messages.</p>")


def judged(value, warning, error):
    if value is None:
        return "over", "not finite"
    if error is not None and value > error:
        return "over", "too large"
    if warning is not None and value > warning:
        return "near", "warning"
    return "ok", "good"
