# SPDX-License-Identifier: LGPL-2.1-or-later
"""`abut report`: one page about a run, without any other file."""
import base64
import io
import os
import pathlib

from . import report_input, report_results, report_sketch, report_solution
from .errors import InputError, Words, warn
from .report_page import details, escape, figure, page, quoted
from .report_verdict import Verdict
from .run_folder import RunFolder

# Pictures with more text than this are stored as pixels.
LARGEST_SVG = 250_000
RESOLUTION = 130  # dots per inch

CAPTIONS = {
    "bodies": "Deformed bodies.",
    "tractions": "Contact pressure, and friction if there is any, along the "
                 "secondary surface.",
    "displacement": "Displacement of the membrane.",
    "active-set": "Where the membrane touches the obstacle.",
    "motion": "The motion over time.",
    "convergence": "Errors and effort over the number of unknowns.",
    "search": "Time of the search over the size of buckets.",
    "penalty": "Displacement and force over the penalty.",
    "energy": "Energy over the displacement.",
    "lagrangian": "The Lagrangian.",
    "path": "The way of the iteration.",
}


def main(words):
    parser = Words("report")
    parser.add_argument("folder")
    parser.add_argument("--output", type=pathlib.Path,
                        help="default: report.html in the folder")
    parser.add_argument("--quiet", action="store_true")
    arguments = parser.parse_args(words)
    run = RunFolder(arguments.folder)
    file = arguments.output or run.path / "report.html"
    text = report(run)
    try:
        next_ = file.with_name(file.name + ".new")
        next_.write_text(text, encoding="utf-8")
        os.replace(next_, file)
    except OSError as error:
        raise InputError(f"cannot write '{file}': {error.strerror}.") from error
    if not arguments.quiet:
        print(file)
    return 0


def report(run):
    """The page of a run."""
    verdict = Verdict(run)
    solved = verdict.has_results
    parts = [("", verdict.banner()), ("Problem", problem(run))]
    if solved:
        parts += [("Results", report_results.results(run)),
                  ("Pictures", pictures(run)),
                  ("Examination", report_results.examination(run)),
                  ("Solution process", report_solution.process(run)),
                  ("Cost", report_solution.cost(run))]
    parts += [("Parameters", report_input.parameters(run)),
              ("Files", report_solution.files(run))]
    if solved:
        text = (run.path / "summary.json").read_text(encoding="utf-8")
        parts.append(("All figures", details("summary.json", quoted(
            text, "summary.json", "pre"))))
    return page(f"{run.title[0]}: {verdict.word.lower()}",
                [part for part in parts if part[1]])


def problem(run):
    """The sketch beside the tables of bodies, obstacles and pairs."""
    sketch = report_sketch.Sketch(run)
    drawn = ""
    if sketch:
        svg, notes = sketch.svg()
        drawn = figure(svg, "; ".join(notes) + ".", "Sketch of the problem")
    content = report_input.tables(run)
    return (f'<div class="side">{drawn}<div>{content}</div></div>'
            if drawn or content else "")


def pictures(run):
    """Those of `abut draw`. A page without them is better than none."""
    from . import draw
    parts = []
    try:
        for name, drawn in draw.pictures(run, draw.style.PAGE):
            words = CAPTIONS.get(name, name.replace("-", " ") + ".")
            parts.append(figure(
                element(draw.style, drawn, f"picture{len(parts)}", words),
                words, words))
    except InputError as error:
        warn(f"pictures: {error}")
        parts.append(f"<p>No more pictures: {escape(error)}</p>")
    return "\n".join(parts)


def element(style, drawn, prefix, words):
    """A figure as <svg>, or as <img> where that would be large."""
    file = io.StringIO()
    drawn.savefig(file, format="svg", metadata={"Date": None, "Creator": None})
    text = file.getvalue()
    if len(text) <= LARGEST_SVG:
        style.pyplot.close(drawn)
        return report_sketch.inline(text, prefix)
    pixels = io.BytesIO()
    drawn.savefig(pixels, format="png", dpi=RESOLUTION,
                  metadata={"Software": None})
    style.pyplot.close(drawn)
    return (f'<img alt="{escape(words)}" src="data:image/png;base64,'
            f'{base64.b64encode(pixels.getvalue()).decode()}">')
