# SPDX-License-Identifier: LGPL-2.1-or-later
"""The lines of compare.py as CSV and as Markdown, one table per problem."""
import csv


def _columns(lines):
    """Names in the order in which they first appear; remarks last."""
    names = list(dict.fromkeys(name for line in lines for name in line
                               if name != "remark"))
    if any("remark" in line for line in lines):
        names.append("remark")
    return names


def write_csv(path, lines):
    with open(path, "w", newline="") as file:
        writer = csv.DictWriter(file, _columns(lines))
        writer.writeheader()
        writer.writerows(lines)


def markdown(lines):
    text = ""
    for problem in dict.fromkeys(line["problem"] for line in lines):
        part = [line for line in lines if line["problem"] == problem]
        names = [name for name in _columns(part) if name != "problem"]
        text += f"### {problem[0].upper()}{problem[1:]}\n\n"
        text += "| " + " | ".join(names) + " |\n"
        text += "|" + "---|" * len(names) + "\n"
        for line in part:
            text += "| " + " | ".join(str(line.get(name, "")).replace("|", "/")
                                      for name in names) + " |\n"
        text += "\n"
    return text
