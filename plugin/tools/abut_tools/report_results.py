# SPDX-License-Identifier: LGPL-2.1-or-later
"""Figures of a run: those with expected values, of contact pairs, bodies and
points; and the examination of the answer."""
import re

from . import report_labels as labels
from .report_page import details, number, pointer, quoted, table, values


def results(run):
    parts = [expected(run), pairs(run),
             numbered(run, "body", "Bodies",
                      {"reaction": ("reaction of its supports", "force"),
                       "body_moved": ("moved in the mean by", "length"),
                       "body_rotated": ("rotated in the mean by", "radian")}),
             numbered(run, "obstacle", "Obstacles moved by forces",
                      {"obstacle_displacement": ("displacement", "length"),
                       "obstacle_velocity": ("velocity", "length/time"),
                       "obstacle_force": ("force of contact", "force")}),
             numbered(run, "point", "Points",
                      {"point_node": ("nearest node", "length"),
                       "point": ("displacement", "length")}),
             figures(run, labels.RUN, "Whole run")]
    if run.kind == "solid" and run.parameter("Dimension") != "3" and \
            run.parameter("Solid/Plane") != "axisymmetric":
        parts.append('<p class="soft">In the plane, forces and energies are '
                     "per unit of thickness, and areas are lengths.</p>")
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


def words_of(key):
    """A key of the summary in words."""
    name, bracket, entry = key.partition("[")
    axis = " " + "xyz"[int(entry.rstrip("]"))] if bracket and \
        entry.rstrip("]") in "012" else ""
    pair = re.fullmatch(r"pair_(\d+)_(.*)", name)
    if pair:
        return (f"pair {pair.group(1)}: {labels.PAIR.get(pair.group(2), (pair.group(2).replace('_', ' '), ''))[0]}"
                + axis + labels.unit(labels.PAIR.get(pair.group(2),
                                                     ("", ""))[1]))
    known = labels.RUN.get(name, (name.replace("_", " "), ""))
    return known[0] + axis + labels.unit(known[1])


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
        rows.append([words_of(key), number(found, of[0]), number(value, of[1]),
                     error])
    return rows and "<h3>Compared with expected values</h3>\n" + table(
        ["", "result", "expected", "relative error"], rows,
        numeric=(1, 2, 3))


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
    order = [name for name in labels.PAIR if name in names]
    order += sorted(names - set(order))

    def rows(main):
        return [[labels.label(labels.PAIR, name)] + [
            values(run.summary[of_pair[name]],
                   f"summary.json#{pointer(of_pair[name])}")
            if name in of_pair else "" for of_pair in found.values()]
            for name in order if (name in labels.MAIN) == main]

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
    columns.sort(key=list(names).index)
    rows = [[f"{what} {i}"] + [
        values(run.summary[keys[name]], f"summary.json#{pointer(keys[name])}")
        if name in keys else "" for name in columns]
        for i, keys in sorted(found.items())]
    return f"<h3>{heading}</h3>\n" + table(
        [""] + [labels.label(names, name) for name in columns], rows,
        numeric=range(1, len(columns) + 1))


def figures(run, of_labels, heading):
    """Figures of a list that the run has; long vectors are in the tables."""
    rows = []
    for key in of_labels:
        value = run.summary.get(key)
        if value is None or (isinstance(value, list) and len(value) > 6):
            continue
        where = f"summary.json#{pointer(key)}"
        rows.append([labels.label(of_labels, key),
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
        pair = re.fullmatch(r"pair_(\d+)_(.*)", name)
        key = pair.group(2) if pair else name
        words, code = labels.EXAMINATION.get(key, (key.replace("_", " "), ""))
        if pair:
            words = f"pair {pair.group(1)}: {labels.label(labels.PAIR, key)}"
        rows.append([words, number(value, f"{where}/value", digits=3),
                     number(warning, f"{where}/warning_above", digits=3),
                     number(error, f"{where}/error_above", digits=3),
                     f'<span class="{tone}">{verdict}</span>', code])
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
