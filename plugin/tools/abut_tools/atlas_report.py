# SPDX-License-Identifier: LGPL-2.1-or-later
"""The failure atlas as a page."""

HEAD = """# Where methods fail

Written by `abut atlas`; do not edit. Each entry is two scenes of `prm/failures`, one that
fails and one that is cured. Both were run, and what they showed was compared with what
they were expected to show. A warning or an error about a known failure begins with its
code. Exit code 3 means that the answer is unusable, 2 that the input was refused, and 0
with a warning that the answer is as accurate as the settings allow and no more. Where a pair
would be refused, the scene has `Solid/Solve known failures = true`, so that its failure can be measured.
Names of numbers are those of `summary.json` and `levels.csv`. How to add an entry stands at the end.

"""

NEW_ENTRY = """
## A new entry

is two files in a folder that `abut atlas` is given: NAME.prm and NAME.cure.prm, the
second usually with a line `include NAME.prm`. Comments at their beginning say what is
expected, each in one line (`done` and `cure` may go on in more):

| in | comment | |
|---|---|---|
| first | `# failure: ABUT-F06` | code that a warning or an error must name; `none`: no code may be named |
| first | `# avoids: ABUT-F04` | with `none`: the failure that does not occur; may be left out |
| first | `# title: ...`, `# done: ...` | for this page |
| second | `# cure: ...` | for this page |
| both | `# exit: 3` | exit code; 0 if left out |
| both | `# symptom: contact_force < 0.5 * cure` | a number of `summary.json`, or `order(...)` or `growth(...)` of the last two rows of a column of `levels.csv`, or `starts(...)`, how often it leaves 0, or `mean(...)`, `ripple(...)` or `largest(...)` of a column or the ratio of two, within times or not, `ripple(pair_1_force_y,1,2)`; one of < <= = >= >; and a number, `true`, `false`, or the same number of the other run, `cure` |
| first | `# vary: Method/Penalty = 1; 10` and `# table: condition, active` | run both files with these values, too, and table these numbers |

The run that fails must say the code, the cured one must not. A failure of a new kind is one
more line of the list in `abut/failure.h`, and a place that notices it.
"""


def number_text(number):
    return "-" if number is None else f"{number:.3g}"


def cell(text):
    """Text inside a cell of a table."""
    return text.replace("|", "\\|")


def codes_table(results, failures):
    lines = ["| code | failure | what helps | entries below |",
             "|---|---|---|---|"]
    for code, (name, remedy) in failures.items():
        entries = [result.entry for result in results]
        named = ", ".join(entry.name for entry in entries
                          if entry.failure == code)
        avoided = ", ".join(entry.name for entry in entries
                            if entry.avoided == code)
        places = "; ".join(filter(None, [
            named, avoided and f"avoided: {avoided}"]))
        lines.append(f"| {code} | {name} | {remedy} | {places} |")
    return "\n".join(lines) + "\n"


def messages_text(run, folder):
    lines = [f"> {message.replace(f'{folder}/', '', 1)}\n>\n"
             for message in run.messages]
    return "".join(lines) or "> (nothing)\n"


def figures_table(result):
    entry, lines = result.entry, {}
    for number, scene in enumerate((entry.failing, entry.cure)):
        for symptom in scene.symptoms:
            expected = lines.setdefault(symptom.quantity, ([], []))
            expected[number].append(symptom.expected)
    if not lines:
        return ""
    names = entry.run_names
    text = (f"\n| measured | {names[0]} | expected | {names[1]} | expected |\n"
            "|---|---|---|---|---|\n")
    for quantity, expected in lines.items():
        cells = (f"{number_text(run.figures.value(quantity))} | "
                 f"{cell(', '.join(relations))}"
                 for run, relations in zip((result.failing, result.cure),
                                           expected))
        text += f"| `{quantity}` | {' | '.join(cells)} |\n"
    return text


def variation_table(result):
    entry = result.entry
    if not entry.values:
        return ""
    head = "".join(f" | `{quantity}` | cured" for quantity in entry.table)
    lines = ["", f"| {entry.varied}{head} |",
             "|---" + "|---|---" * len(entry.table) + "|"]
    for value, runs in zip(entry.values, result.varied):
        cells = (number_text(run.value(quantity)) for quantity in entry.table
                 for run in runs)
        lines.append(f"| {value} | {' | '.join(cells)} |")
    return "\n".join(lines) + "\n"


def picture_text(result):
    if not result.picture:
        return ""
    one, other = result.entry.run_names
    return (f"\n![{result.entry.title}: the {one} and the {other} run]"
            f"({result.picture})\n")


def entry_text(result):
    entry = result.entry
    folder = entry.failing.path.parent
    kind = (entry.failure or (f"{entry.avoided} avoided" if entry.avoided
                              else "No failure"))
    text = (f"\n## {kind}: {entry.title}\n\n"
            f"Files `{entry.failing.path.name}` and `{entry.cure.path.name}`."
            f"\n\n**Done.** {entry.failing.text}\n\n"
            f"**The program said** (exit code {result.failing.exit_code}):\n\n"
            + messages_text(result.failing, folder) + figures_table(result)
            + picture_text(result)
            + variation_table(result)
            + ("\n**Cure.** " if entry.failure else "\n**Second run.** ")
            + f"{entry.cure.text} Exit code {result.cure.exit_code}.\n")
    if result.cure.messages:
        text += "\nIt says:\n\n" + messages_text(result.cure, folder)
    return text + "".join(f"\n**Not as expected:** {complaint}\n"
                          for complaint in result.complaints)


def atlas_page(results, failures):
    """What was done, what the program said, what was measured and what cures
    it, as Markdown.
    failures: name and remedy by code"""
    return (HEAD + codes_table(results, failures)
            + "".join(map(entry_text, results)) + NEW_ENTRY)
