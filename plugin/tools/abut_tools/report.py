# SPDX-License-Identifier: LGPL-2.1-or-later
"""`abut report`: one page about a run, without any other file."""
import base64
import io
import pathlib

from . import draw, report_input, report_results, report_solution, style
from .errors import InputError, Words, warn
from .report_page import details, escape, figure, page, quoted
from .report_verdict import Verdict
from .run_folder import RunFolder
from .run_store import write_at_once
from .sketch import Sketch

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
        write_at_once(file, text)
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
    sketch, drawn = Sketch(run), ""
    if sketch:
        svg = style.svg_element(sketch.draw(), "sketch")
        notes = (f'<span style="color:{colour}">&#9632;</span> {escape(text)}'
                 if colour else escape(text) for text, colour in sketch.notes)
        drawn = figure(svg, "; ".join(notes) + ".", "Sketch of the problem")
    elif run.has("outline.json"):
        drawn = "<p>No sketch: the mesh has too many facets at its boundary.</p>"
    content = report_input.tables(run)
    return (f'<div class="side">{drawn}<div>{content}</div></div>'
            if drawn or content else "")


def pictures(run):
    """Those of `abut draw`. A page without them is better than none."""
    parts = []
    try:
        for name, drawn in draw.pictures(run, style.PAGE):
            words = CAPTIONS.get(name, name.replace("-", " ") + ".")
            parts.append(figure(
                element(drawn, f"picture{len(parts)}", words), words, words))
    except InputError as error:
        warn(f"pictures: {error}")
        parts.append(f"<p>No more pictures: {escape(error)}</p>")
    return "\n".join(parts)


def element(drawn, prefix, words):
    """A figure as <svg>, or as <img> where that would be large."""
    text = style.svg_element(drawn, prefix)
    if len(text) <= LARGEST_SVG:
        return text
    pixels = io.BytesIO()
    drawn.savefig(pixels, format="png", dpi=RESOLUTION,
                  metadata={"Software": None})
    return (f'<img alt="{escape(words)}" src="data:image/png;base64,'
            f'{base64.b64encode(pixels.getvalue()).decode()}">')
