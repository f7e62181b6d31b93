# SPDX-License-Identifier: LGPL-2.1-or-later
"""What a run was given: bodies, obstacles, pairs, and parameters that are not
the defaults."""
from .report_page import details, escape, pointer, quoted, table

# Rows of the tables of bodies, obstacles and pairs.
TABLES = (
    ("Body", "Bodies", ("Name", "Material", "Element", "Young modulus",
                        "Poisson ratio", "Density",
                        "Prescribed displacement", "Traction", "Pressure",
                        "Body force")),
    ("Obstacle", "Rigid obstacles", ("Kind", "Point", "Normal", "Centre",
                                     "Radius", "Axis", "Size", "Expression",
                                     "Motion", "Free directions", "Force",
                                     "Mass")),
    ("Pair", "Contact pairs", ("Secondary", "Primary", "Obstacle",
                               "Initial gap", "Tied", "Friction",
                               "Largest friction")),
)


def value_of(run, path):
    """The value of a parameter, as HTML."""
    return quoted(run.parameter(path),
                  f'parameters.json#{pointer("parameters", path, "value")}',
                  "code") if run.parameter(path) else ""


def tables(run):
    parts = [section_table(run, *entry) for entry in TABLES]
    return "\n".join(part for part in parts if part)


def section_table(run, beginning, heading, names):
    """Values of each section, a column for each while these are fewer than the
    names; names of which something was given."""
    sections = run.sections(beginning)
    shown = [name for name in names
             if any(is_given(run, f"{section}/{name}") for section in sections)]
    if not sections or not shown:
        return ""
    head = [escape(section).replace(" ", "&nbsp;") for section in sections]
    rows = [[escape(name)] + [value_of(run, f"{section}/{name}")
                              for section in sections] for name in shown]
    if len(sections) > len(shown):
        rows = [list(row) for row in zip(head, *(row[1:] for row in rows))]
        head = [escape(name) for name in shown]
    return f"<h3>{heading}</h3>\n" + table(["", *head], rows)


def is_given(run, path):
    return run.parameters.get(path, {}).get("given", False)


def name(path):
    """A parameter; lines may break behind its sections."""
    return f'<code>{escape(path).replace("/", "/<wbr>")}</code>'


def parameters(run):
    """Parameters with other values than the defaults, the others folded."""
    given, others = [], []
    # "Section/Name: reason"
    not_used = {line.partition(": ")[0]
                for line in run.summary.get("not_used", [])}
    for path, parameter in run.parameters.items():
        where = pointer("parameters", path)

        def text(key):
            value = parameter[key]
            return quoted(value, f"parameters.json#{where}/{key}", "code") \
                if value else '<span class="soft">(empty)</span>'
        if parameter["value"] == parameter["default"]:
            others.append([name(path), text("value")])
        else:
            note = ' <span class="soft">not used by this run</span>' \
                if path in not_used else ""
            given.append([name(path),
                          text("value") + note, text("default"),
                          quoted(parameter["origin"],
                                 f"parameters.json#{where}/origin")])
    if not given and not others:
        return ""
    parts = [table(["parameter", "value", "default", "set in"], given,
                   "Parameters that differ from their defaults")
             if given else "<p>All have their defaults.</p>"]
    if others:
        parts.append(details("Parameters with their defaults",
                             table(["parameter", "value"], others)))
    return "\n".join(parts)
