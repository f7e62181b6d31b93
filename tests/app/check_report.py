# SPDX-License-Identifier: LGPL-2.1-or-later
"""Pages about runs: of each kind of scene, solved, without an answer, with an error
in the input, and killed."""
import json
import re
import signal
import subprocess
import time

from program import Program, set_words
from report_page import faults

p = Program()
prm = p.source / "prm"


def look(folder, verdict, *words, without=(), pictures=0):
    """Make the page of a run, and compare it with the run's files."""
    result = p.call("report", folder)
    p.expect(result.returncode == 0,
             f"report {folder}: exit code {result.returncode}\n{result.stderr}")
    file = p.folder / folder / "report.html"
    if not file.exists():
        p.expect(False, f"no page of {folder}")
        return "", None
    text = file.read_text(encoding="utf-8")
    found, page = faults(text, p.folder / folder)
    for fault in found[:8]:
        p.expect(False, f"{folder}: {fault}")
    shown = re.search(r'<div class="verdict">([A-Z ]+)', text)
    p.expect(shown and shown.group(1).strip() == verdict,
             f"{folder}: {shown and shown.group(1)} in place of {verdict}")
    # The verdict comes before anything else.
    first = next(kind for kind in page.order if kind)
    p.expect(first.startswith("banner"), f"{folder} begins with {first}")
    for word in words:
        p.expect(word in text, f"{folder}: no '{word}'")
    for word in without:
        p.expect(word not in text, f"{folder}: '{word}'")
    p.expect(page.n_pictures >= pictures,
             f"{folder}: {page.n_pictures} pictures")
    return text, page


def run(scene, folder, code, settings=()):
    result = p.call("run", prm / scene, "--output", folder, "--quiet",
                    *set_words({"Output/Pictures": "false", **settings}))
    p.expect(result.returncode == code,
             f"{scene}: exit code {result.returncode}\n{result.stderr}")
    record = json.loads((p.folder / folder / "run.json").read_text())
    p.expect(record["exit_code"] == code, f"{scene}: {record}")
    if record["has_results"]:
        summary = json.loads((p.folder / folder / "summary.json").read_text())
        for name, measure in summary["examination"].items():
            limit = measure["warning_above"] or measure["error_above"]
            p.expect(limit is None or (measure["value"] or 0) <= limit
                     or measure["code"] in summary["codes"],
                     f"{scene}: {name} is too large, without a message "
                     f"{measure['code']}")
    return result


coarse = {"Refinement/Level": 3, "Refinement/Adaptive cycles": 0}
solved = [
    ("two-cylinders.prm", "SOLVED WITH WARNINGS", coarse, 2),
    ("press-fit.prm", "SOLVED", {"Refinement/Level": 2}, 2),
    ("two-blocks-3d.prm", "SOLVED", {"Refinement/Level": 1,
                                     "Refinement/Coarsest level": 0}, 1),
    ("flat-obstacle.prm", "SOLVED", {"Refinement/Level": 3}, 1),
    ("point-mass.prm", "SOLVED", {}, 0),
    ("friction-bar.prm", "SOLVED", {}, 0),
    ("dynamics-bar-on-a-wall.prm", "SOLVED", {}, 0),
    ("search-flat.prm", "SOLVED", {}, 0)]
for scene, verdict, settings, pictures in p.some(solved, 5):
    folder = scene.removesuffix(".prm")
    run(scene, folder, 0, settings)
    look(folder, verdict, "To repeat it", *(
        f"--set &#x27;{path}={value}&#x27;" if " " in path else
        f"--set {path}={value}" for path, value in settings.items()),
        pictures=pictures)

# Sketch, supports and pairs; limits of the examination.
text, page = look("two-cylinders", "SOLVED WITH WARNINGS", "ABUT-F36",
                  "pair 1: secondary surface", "triangles: displacement",
                  "arrows: pressure", 'data-of="summary.json#/examination/')
p.expect({"Problem", "Results", "Examination", "Solution process", "Cost",
          "Files", "All figures"} <= set(page.headings),
         f"parts: {page.headings}")
# A number that is not the run's is found.
wrong = text.replace(">5.0", ">5.1", 1)
p.expect(wrong != text and faults(wrong, p.folder / "two-cylinders")[0],
         "a wrong number is not found")
p.expect(faults(text.replace("</table>", "", 1),
                p.folder / "two-cylinders")[0], "an open table is not found")

# No answer: the verdict and the reason come first.
for scene, settings in p.some([
        ("point-mass.prm", {"Method/Enforcement": "augmented lagrangian",
                            "Method/Maximum outer iterations": 2,
                            "Method/Gap tolerance": 1e-12}),
        ("failures/few-steps.prm", {}),
        ("failures/large-strain.prm", {}),
        ("failures/explicit-step.prm", {}),
        ("flat-obstacle.prm", {"Method/Maximum linear systems": 1,
                               "Refinement/Level": 3})], 2):
    run(scene, "none", 3, settings)
    look("none", "NO ANSWER", 'class="message bad"')

# Errors in the input before and after the folder was made, over the results of
# another run, which are not shown.
for scene in p.some(["press-fit.prm", "point-mass.prm", "flat-obstacle.prm",
                     "friction-bar.prm", "dynamics-bar-on-a-wall.prm",
                     "search-flat.prm"], 2):
    folder = scene.removesuffix(".prm")
    run(scene, folder, 2, {"Output/Nonsense": 1})
    look(folder, "INPUT ERROR", "Nonsense", "of an earlier run",
         without=("<h2>Results</h2>", "<h2>All figures</h2>"))
run("press-fit.prm", "press-fit", 2, {"Pair 1/Secondary": "1: 17"})
look("press-fit", "INPUT ERROR", "17", "Contact pairs",
     without=("<h2>Results</h2>",), pictures=1)

run("hertz-2d.prm", "hertz", 2, {"Pair 1/Secondary": "1: 17"})
look("hertz", "INPUT ERROR", "rigid obstacles at time 0", pictures=1)

# Output/Report writes the page by itself, where the scene has an error, too.
report = {"Output/Report": "true", "Refinement/Level": 1}
run("press-fit.prm", "own", 0, report)
p.expect((p.folder / "own/report.html").exists(), "no page by itself")
run("press-fit.prm", "own-error", 2, {**report, "Solid/Nonsense": 1})
p.expect("INPUT ERROR" in (p.folder / "own-error/report.html").read_text(),
         "no page of a scene with an error")
result = p.call("run", prm / "press-fit.prm", "--output", "no-folder",
                "--set", "Solid/Nonsense=1")
p.expect(not (p.folder / "no-folder").exists(),
         "a scene with an error makes a folder")

# Killed, and while it runs.
process = subprocess.Popen(
    [p.abut, "run", prm / "step-41.prm", "--output", "killed", "--quiet",
     "--set", "Refinement/Level=11"], cwd=p.folder, stderr=subprocess.DEVNULL)
begin = time.monotonic()
while not (p.folder / "killed/outline.json").exists() \
        and time.monotonic() < begin + 120:
    time.sleep(0.05)
look("killed", "RUNNING", without=("<h2>Results</h2>",))
process.send_signal(signal.SIGKILL)
process.wait()
look("killed", "KILLED", "was killed", without=("<h2>Results</h2>",))

p.expect_error(p.call("report", "nothing"), "is not a folder")
(p.folder / "empty").mkdir()
p.expect_error(p.call("report", "empty"), "not the output folder of a run")

p.finish()
