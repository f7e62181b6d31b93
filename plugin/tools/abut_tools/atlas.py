# SPDX-License-Identifier: LGPL-2.1-or-later
"""`abut atlas`: scenes of known failures and their cures, run and compared with
what they are expected to show."""
import json
import pathlib
import re
import shutil
from dataclasses import dataclass, field

from .atlas_entry import AtlasEntry, read_atlas
from .atlas_report import atlas_page
from .errors import InputError, Words
from .run_figures import RunFigures, read_json
from .run_store import make_output_folder
from .serial_program import SerialProgram, this_program

TIME_LIMIT = 300  # processor seconds after which a run counts as hanging
MARK = "abut: "


@dataclass
class AtlasRun:
    """What one run of an entry has shown."""
    exit_code: int  # negative: minus the signal that ended it
    figures: RunFigures
    messages: list  # warnings and errors, a line each
    codes: set      # of the failures that it names


@dataclass
class AtlasResult:
    """Both runs of an entry, and what was expected but did not hold."""
    entry: AtlasEntry
    failing: AtlasRun
    cure: AtlasRun
    varied: list      # pairs of figures, by value
    complaints: list = field(default_factory=list)
    picture: str = ""  # of both runs, seen from the page


def has_fields(program, scene):
    """Whether a scene can write fields, of which pictures are drawn."""
    values = program.ask("check", scene.path, "--values").stdout
    return "Output/Fields" in json.loads(values or "{}").get("parameters", {})


def run_scene(program, entry, scene, folder, value=None, fields=False):
    # What an earlier run has left must not be taken for this one's.
    shutil.rmtree(folder, ignore_errors=True)
    make_output_folder(folder)
    log = folder / "log.txt"
    words = ["run", scene.path, "--quiet", "--output", folder, "--set",
             "Output/Pictures=false", "--set", "Output/Report=false"]
    if fields and has_fields(program, scene):
        words += ["--set-if-used", "Output/Fields=true"]
    if value is not None:
        words += ["--set", f"{entry.varied}={value}"]
    ending = program.run(words, log, TIME_LIMIT)
    messages = [line[len(MARK):] for line in log.read_text().splitlines()
                if line.startswith(MARK)]
    figures = RunFigures(folder)
    # The failure of an error, which ends a run before it has a summary.
    of_error = read_json(folder / "run.json").get("code")
    return AtlasRun(ending.code, figures, messages,
                    {*figures.summary.get("codes", ()),
                     *filter(None, [of_error])})


def check_run(scene, run, other):
    """What was expected but does not hold."""
    if run.exit_code != scene.exit_code:
        yield (f"{scene.path.name}: exit code {run.exit_code} instead of "
               f"{scene.exit_code}")
    for symptom in scene.symptoms:
        if not symptom.holds(run.figures, other.figures):
            yield f"{scene.path.name}: does not hold: {symptom.text}"


def check_codes(entry, failing, cure):
    if not entry.failure:
        if failing.codes:
            yield "a run that does not fail names a code"
        if cure.codes:
            yield "the cure still says a code"
        return
    if entry.failure not in failing.codes:
        yield f"the run that fails does not say {entry.failure}"
    if entry.failure in cure.codes:
        yield f"the cure still says {entry.failure}"


def run_entry(program, entry, folder, fields):
    """Run both files of an entry as processes of their own.
    fields: write fields, too"""
    failing, cure = (
        run_scene(program, entry, scene, folder / name, fields=fields)
        for scene, name in ((entry.failing, "failing"), (entry.cure, "cure")))
    varied = [[run_scene(program, entry, scene, folder / f"{name}-varied",
                         value).figures
               for scene, name in ((entry.failing, "failing"),
                                   (entry.cure, "cure"))]
              for value in entry.values]
    return AtlasResult(entry, failing, cure, varied,
                       [*check_run(entry.failing, failing, cure),
                        *check_run(entry.cure, cure, failing),
                        *check_codes(entry, failing, cure)])


def draw_entry(result, runs, report):
    """Draw both runs into a folder beside the page."""
    from .atlas_pictures import draw_pair  # Matplotlib takes a while
    folder = pathlib.Path("pictures") / report.stem
    make_output_folder(report.parent / folder)
    picture = folder / f"{result.entry.name}.png"
    names = result.entry.run_names
    if draw_pair([runs / "failing", runs / "cure"],
                 [f"{name} run" for name in names], report.parent / picture):
        result.picture = picture.as_posix()


def read_failures(program):
    """Name and remedy of each failure, by code, in order."""
    rows = re.findall(r"^\| (ABUT-F\d+) \| (.*?) \| (.*?) \|$",
                      program.ask("help", "failures").stdout, re.M)
    return {code: (name, remedy) for code, name, remedy in rows}


def main(words):
    parser = Words("atlas")
    parser.add_argument("path", nargs="?", type=pathlib.Path,
                        default=pathlib.Path("prm/failures"))
    parser.add_argument("--output", type=pathlib.Path,
                        default=pathlib.Path("output/atlas"))
    parser.add_argument("--report", type=pathlib.Path)
    parser.add_argument("--no-pictures", action="store_true")
    parser.add_argument("--quiet", action="store_true")
    arguments = parser.parse_args(words)
    program = SerialProgram(this_program())
    failures = read_failures(program)
    report = arguments.report or arguments.output / "failures.md"
    results = []
    for entry in read_atlas(arguments.path, failures):
        runs = arguments.output / entry.name
        result = run_entry(program, entry, runs, not arguments.no_pictures)
        results.append(result)
        if not arguments.no_pictures:
            draw_entry(result, runs, report)
        if not arguments.quiet or result.complaints:
            seen = "UNEXPECTED   " if result.complaints else "as expected  "
            print(f"{entry.failure or 'none':8}  {seen}{entry.name}",
                  flush=True)
        for complaint in result.complaints:
            print(f"            {complaint}", flush=True)
    try:
        report.write_text(atlas_page(results, failures), encoding="utf-8")
    except OSError as error:
        raise InputError(f"cannot write '{report}': {error.strerror}.") from None
    if not arguments.quiet:
        print(f"{len(results)} entries, page in {report}")
    return 3 if any(result.complaints for result in results) else 0
