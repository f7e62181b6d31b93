# SPDX-License-Identifier: LGPL-2.1-or-later
"""`abut draw`: which pictures each kind of run has, the data that are drawn
against formulas, and what is said of folders that are none, broken, or of runs
that were killed, and where there is no Python with the packages."""
import base64
import importlib.util
import json
import math
import os
import shutil
import struct
import sys
import zlib

if not importlib.util.find_spec("matplotlib") \
        and sys.executable != "/usr/bin/python3":
    os.execv("/usr/bin/python3", ["/usr/bin/python3", *sys.argv])

import numpy  # noqa: E402

import vtu  # noqa: E402
from program import Program, set_words  # noqa: E402

p = Program()
sys.path.insert(0, str(p.source / "plugin/tools"))
from abut_tools import draw, sketch, style  # noqa: E402
from abut_tools.run_folder import RunFolder  # noqa: E402
from abut_tools.vtu import read_mesh  # noqa: E402


def run(scene, settings=(), folder="out"):
    shutil.rmtree(p.folder / folder, ignore_errors=True)
    result = p.call("run", p.source / "prm" / scene, "--output", folder,
                    "--quiet", *set_words(settings))
    p.expect(result.returncode == 0, f"{scene}: {result.stderr}")
    return p.folder / folder


def texts(figure):
    """The words of a drawn figure, and the numbers at plane axes."""
    for axes in figure.axes:
        for axis in () if axes.name == "3d" else (axes.xaxis, axes.yaxis):
            low, high = sorted(axis.get_view_interval())
            yield from (text for at, text in zip(axis.get_majorticklocs(),
                                                 axis.get_majorticklabels())
                        if low <= at <= high)
            yield axis.label
        yield from (axes.title, *axes.texts)
    for legend in figure.findobj(style.matplotlib.legend.Legend):
        yield from (legend.get_title(), *legend.get_texts())


def expect_legible(figure, what):
    """Words within the figure, and apart."""
    boxes = [(text.get_text(), text.get_window_extent()) for text in texts(figure)
             if text.get_visible() and text.get_text()]
    for i, (text, box) in enumerate(boxes):
        p.expect(box.x0 >= 0 and box.y0 >= 0 and box.x1 <= figure.bbox.x1
                 and box.y1 <= figure.bbox.y1, f"{what}: '{text}' is cut off")
        for other, of_other in boxes[:i]:
            p.expect(box.x1 <= of_other.x0 or of_other.x1 <= box.x0
                     or box.y1 <= of_other.y0 or of_other.y1 <= box.y0,
                     f"{what}: '{text}' is on '{other}'")


def drawn(folder):
    """Data of the pictures of a run by picture and name."""
    for width in (84, 174):
        result = {}
        for name, figure in draw.pictures(RunFolder(folder), width):
            figure.canvas.draw()
            expect_legible(figure, f"{name}, {width} mm")
            result[name] = style.drawn_data(figure)
            style.pyplot.close(figure)
    return result


def near(found, expected, tolerance, what):
    found, expected = numpy.asarray(found), numpy.asarray(expected)
    size = max(abs(expected).max(), 1e-300)
    good = found.shape == expected.shape and numpy.isfinite(found).all() \
        and abs(found - expected).max() <= tolerance * size
    p.expect(good, f"{what}: {found} is not {expected}")


def check_point_mass():
    """A mass of weight 3 on a spring of stiffness 1, 1 above a support."""
    folder = run("point-mass.prm", ["Output/Pictures=true"])
    for name in ("path", "energy", "penalty", "lagrangian"):
        for end in ("svg", "png"):
            p.expect((folder / f"{name}.{end}").stat().st_size > 1000, name)
    data = drawn(folder)
    u, energy = data["energy"]["free"].T
    near(energy, 0.5 * u ** 2 - 3 * u, 1e-12, "energy without obstacle")
    u, energy = data["energy"]["penalty_2"].T
    near(energy, 0.5 * u ** 2 - 3 * u + 5 * numpy.maximum(u - 1, 0) ** 2, 1e-12,
         "energy with penalty 10")
    near(data["energy"]["minima"][:, 0],
         [(3 + c) / (1 + c) for c in (1, 10, 1e3, 1e6)], 1e-10, "minima")
    penalty, force = data["penalty"]["force"].T
    near(force, 2 * penalty / (1 + penalty), 1e-12, "force over penalty")
    near(data["penalty"]["force_of_runs"][:, 1],
         [2 * c / (1 + c) for c in (1, 10, 1e3, 1e6)], 1e-10, "forces of runs")
    near(data["lagrangian"]["saddle"], [[1, -2]], 1e-12, "saddle point")
    # A mass pushed down by 8 on a floor at 0 (B = 1, k = 2): Newton's iterates
    # for the penalty spring 20 lie on p = 2 u + 8 and end at -8 / 22.
    data = drawn(run("point-mass.prm", {
        "Masses/Stiffness": 2, "Masses/Force": -8, "Constraints/B": 1,
        "Constraints/Initial gap": 0, "Sweep/Penalty factors": "",
        "Method/Enforcement": "penalty", "Method/Penalty factor": 10,
        "Output/Expected": ""}))
    p.expect(list(data) == ["path"], f"pictures without a sweep: {list(data)}")
    u, force = data["path"]["equilibrium"].T
    near(force, 2 * u + 8, 1e-12, "equilibrium on a floor")
    near(data["path"]["path"][-1], [-8 / 22, 160 / 22], 1e-10, "its end")
    near(drawn(run("method-of-multipliers.prm"))["path"]["path"][:5],
         [[x, x] for x in (0, 1 / 4, 3 / 8, 7 / 16, 15 / 32)], 1e-12, "path")
    # A later run without pictures leaves none of an earlier one.
    p.call("run", p.source / "prm/point-mass.prm", "--output",
           run("point-mass.prm", ["Output/Pictures=true"]), "--quiet",
           "--set", "Output/Pictures=false")
    left = [file.name for end in ("svg", "png")
            for file in (p.folder / "out").glob(f"*.{end}")]
    p.expect(not left, f"pictures of an earlier run: {left}")


def check_hertz():
    """Two cylinders: the closed form drawn is Hertz' for the force of the run,
    and the computed pressure is near it."""
    folder = run("two-cylinders.prm", {"Refinement/Adaptive cycles": 4})
    run_folder, data = RunFolder(folder), drawn(folder)
    force = run_folder.summary["pair_1_force"][1]
    stiffness = 200 / (2 * (1 - 0.3 ** 2))
    a = math.sqrt(8 * force * 4 / (math.pi * stiffness))
    largest = 4 * force / (math.pi * a)

    def hertz(x):
        return largest * numpy.sqrt(numpy.maximum(0, 1 - (x / a) ** 2))

    x, pressure = data["tractions"]["closed_pressure_1"].T
    near(pressure, hertz(x), 2e-3, "closed form")
    near(pressure[0], largest, 1e-12, "its largest pressure")
    x, pressure = data["tractions"]["pressure_1"].T
    near(pressure[x < 0.9 * a], hertz(x[x < 0.9 * a]), 0.05, "pressure")
    p.expect(run_folder.summary["pair_1_closed_form"] == "Hertz", "its name")
    p.expect(list(run_folder.pairs()) == [1] and "gap" in run_folder.pairs()[1],
             "the closed form is taken for the computed pressure")
    svg = folder / "tractions.svg"
    result = p.call("draw", folder, "--picture", "tractions", "--width", "84")
    p.expect(result.returncode == 0 and "Hertz" in svg.read_text(),
             "no Hertz in the picture " + result.stderr)
    first = svg.read_bytes()
    p.call("draw", folder, "--picture", "tractions", "--width", "84")
    p.expect(svg.read_bytes() == first, "a picture drawn again differs")
    # The state of each node on the contact line, and the deformed bodies.
    contact = RunFolder(folder).last_field("contact")
    closed = numpy.round(contact.fields["status"]) == 1
    x = contact.points[closed, 0]
    p.expect(0.8 * a < x.max() < 1.2 * a, f"contact up to {x.max()}, not {a}")
    ends = numpy.concatenate(data["bodies"]["state_1"])[:, 0]
    p.expect(0.8 * a < ends.max() < 1.2 * a, f"drawn up to {ends.max()}")
    corners, values = data["bodies"]["von_mises_stress"]
    p.expect(numpy.isfinite(values).all() and values.max() > 0.5 * largest,
             "stress")


def check_friction():
    """Cattaneo and Mindlin: the formulas of the scene are those of theory."""
    folder = run("cattaneo-cylinders.prm", {"Refinement/Adaptive cycles": 6})
    summary, data = RunFolder(folder).summary, drawn(folder)
    normal, pull = -summary["pair_1_force"][1], summary["pair_1_friction"][0]
    a = math.sqrt(16 * normal / (math.pi * 200 / (2 * (1 - 0.3 ** 2))))
    c = a * math.sqrt(1 - pull / (0.2 * normal))
    table = RunFolder(folder).table("pair_1_closed_form.csv")
    x = table["x"]
    near(table["friction"], 0.2 * 2 * normal / (math.pi * a) * (
        numpy.sqrt(numpy.maximum(0, 1 - (x / a) ** 2))
        - c / a * numpy.sqrt(numpy.maximum(0, 1 - (x / c) ** 2))), 1e-8,
        "closed form of friction")
    p.expect({"state_1", "state_2"} <= set(data["bodies"]),
             f"stick and slip: {list(data['bodies'])}")


def check_kinds():
    """What each kind of scene draws."""
    quick = {"Refinement/Level": 1, "Refinement/Adaptive cycles": 0}
    for scene, settings, names in (
            ("step-41.prm", {"Refinement/Level": 4},
             {"displacement", "active-set", "convergence"}),
            ("flat-obstacle-3d.prm", {"Refinement/Level": 3},
             {"displacement", "active-set", "convergence"}),
            ("hertz-2d.prm", {"Refinement/Adaptive cycles": 1},
             {"bodies", "tractions", "convergence"}),
            ("patch-3d.prm", {}, {"bodies", "convergence"}),
            ("bar-impact.prm", {"Time stepping/End time": 0.05},
             {"bodies", "tractions", "motion"}),
            ("dynamics-bouncing-ball.prm", {}, {"motion"}),
            ("search-flat.prm", {"Sweep/Bucket sizes": "1 2"},
             {"search", "detection"})):
        found = drawn(run(scene, {**settings, "Output/Pictures": "false"}))
        p.expect(set(found) == names, f"{scene}: {set(found)}, not {names}")
    # Nothing of an earlier run in the same folder.
    run("bar-impact.prm", {"Time stepping/End time": 0.05}, "again")
    p.call("run", p.source / "prm/hertz-2d.prm", "--output", "again", "--quiet",
           *set_words(quick))
    p.expect(set(drawn(p.folder / "again"))
             == {"bodies", "tractions"}, f"again: {set(drawn(p.folder / 'again'))}")
    # Without fields of its own a run with pictures writes the last state.
    folder = run("hertz-2d.prm", {**quick, "Output/Fields": "false",
                                  "Output/Pictures": "true"}, "fieldless")
    for name in ("bodies.svg", "fields_0000.pvtu", "obstacles.vtu"):
        p.expect((folder / name).exists(), f"no {name} without Output/Fields")
    obstacle = read_mesh(folder / "obstacles.vtu")
    p.expect(len(obstacle.points) > 0
             and (obstacle.fields["obstacle"] == 1).all(), "obstacle")
    result = p.call("draw", run("friction-bar.prm"))
    p.expect(result.returncode == 3 and "nothing to draw" in result.stderr,
             "a chain of masses: " + result.stderr)


def check_sketch():
    """The sketch of a check, also with a wrong id; what it is made of."""
    scene, before = p.source / "prm/hertz-2d.prm", set(p.folder.iterdir())
    for words, code in (([], 0), (["--set", "Pair 1/Secondary=1: 17"], 2)):
        result = p.call("check", scene, "--draw", "sketch.svg", *words)
        p.expect(result.returncode == code, f"check --draw: {result.stderr}")
        file = p.folder / "sketch.svg"
        p.expect(file.exists() and file.stat().st_size > 1000, "no sketch")
        file.unlink()
    p.expect(set(p.folder.iterdir()) == before, "a check leaves other files")
    p.expect_error(p.call("check", p.source / "prm/point-mass.prm", "--draw",
                          "no.svg"), "nothing to draw")
    p.expect_error(p.call("check", scene, "--draw", "sketch.txt"), "--draw")
    # A square of side 4 with a hole of side 2, whichever way they are given.
    outer = numpy.array([[0, 0], [4, 0], [4, 4], [0, 4]])
    for hole in (outer / 2 + 1, (outer / 2 + 1)[::-1]):
        parts = sketch.filled([hole, outer]).to_polygons()
        area = sum(0.5 * (x @ numpy.roll(y, -1) - y @ numpy.roll(x, -1))
                   for x, y in (part.T for part in parts))
        near(area, 16 - 4, 1e-12, "area with a hole")
    for text, value in (("-5/8 * t", -0.625), ("0.0", 0), ("2*pi", 2 * math.pi),
                        ("if(y > 5, -350, 0)", None), ("1.5 * (1 - y)", None)):
        p.expect(sketch.value_of(text) == value, f"{text} is not {value}")


def check_motion():
    """The bouncing ball: energies of the picture add up to the work of gravity."""
    data = drawn(run("dynamics-bouncing-ball.prm"))["motion"]
    whole = sum(data[name][:, 1] for name in
                ("kinetic_energy", "strain_energy", "contact_energy",
                 "energy_lost_in_impacts") if name in data)
    near(whole, data["external_work"][:, 1], 1e-10, "balance of energies")
    # At the end it lies on the floor, and the impacts have taken m g h.
    near(data["energy_lost_in_impacts"][-1, 1], 9.81, 1e-9, "lost in impacts")


def check_broken():
    """One error with exit code 2 that names the file; a killed run is drawn."""
    for words, text in (
            (["nowhere"], "'nowhere' is not a folder"),
            (["."], "not the output folder of a run"),
            ([], "the following arguments are required: folder"),
            (["out", "--width", "100"], "--width"),
            (["out", "--picture", "face"], "no picture 'face'"),
            (["out", "--colour"], "--colour")):
        p.expect_error(p.call("draw", *words), text)
    folder = run("hertz-2d.prm", {"Refinement/Adaptive cycles": 1})
    copy = p.folder / "copy"
    for name, text in (("summary.json", "summary.json is not complete"),
                       ("parameters.json", "parameters.json is not complete"),
                       ("fields.pvd", "fields.pvd is not complete"),
                       ("fields_0000.0.vtu", "is not complete"),
                       ("obstacles.vtu", "obstacles.vtu is not complete")):
        shutil.rmtree(copy, ignore_errors=True)
        shutil.copytree(folder, copy)
        file = copy / name
        file.write_bytes(file.read_bytes()[:-40 - file.stat().st_size // 3])
        p.expect_error(p.call("draw", copy), text)
    shutil.rmtree(copy)
    shutil.copytree(folder, copy)
    for name in ("summary.json", "levels.csv", "steps.csv", "obstacles.vtu"):
        (copy / name).unlink()
    result = p.call("draw", copy, "--quiet")
    p.expect(result.returncode == 0
             and "did not come to its end" in result.stderr
             and (copy / "bodies.svg").exists(), "killed " + result.stderr)


def check_without_python():
    """No Python with the packages: an error of `draw`, a warning of `run`."""
    lacking = p.folder / "lacking"
    lacking.write_text("#!/bin/sh\nexit 120\n")
    lacking.chmod(0o755)
    for python in ("no-such-python", str(lacking)):
        settings = {"environment": {"ABUT_PYTHON": python}}
        p.expect_error(p.call("draw", "out", **settings), "python3-matplotlib",
                       python)
        result = p.call("run", p.source / "prm/point-mass.prm", "--output",
                        "bare", "--quiet", "--set", "Output/Pictures=true",
                        **settings)
        p.expect(result.returncode == 0 and "python3-matplotlib"
                 in result.stderr, "no warning: " + result.stderr)
        summary = json.loads((p.folder / "bare/summary.json").read_text())
        p.expect(summary["converged"] is True and summary["energy"] == -2.5
                 and any("python3-matplotlib" in text
                         for text in summary["warnings"]), "summary")
        p.expect(not (p.folder / "bare/energy.svg").exists(), "a picture")
    # A tool that fails leaves its words.
    failing = p.folder / "failing"
    failing.write_text("#!/bin/sh\necho 'abut: error: no ink' >&2\nexit 2\n")
    failing.chmod(0o755)
    result = p.call("run", p.source / "prm/point-mass.prm", "--output", "bare",
                    "--quiet", "--set", "Output/Pictures=true",
                    environment={"ABUT_PYTHON": str(failing)})
    p.expect(result.returncode == 0 and "no ink" in result.stderr
             and (p.folder / "bare/draw.log").exists(), result.stderr)


def data_array(name, values, how, offset=0, components=1):
    """A DataArray element, and its appended bytes."""
    kind = {"f": "Float64", "i": "Int32", "u": "UInt8"}[values.dtype.kind]
    head = f'<DataArray type="{kind}" Name="{name}" ' \
           f'NumberOfComponents="{components}" '
    raw = values.astype({"f": "<f8", "i": "<i4", "u": "u1"}[values.dtype.kind]
                        ).tobytes()
    if how == "ascii":
        return (head + 'format="ascii">' + " ".join(map(str, values.ravel()))
                + "</DataArray>", b"")
    if how == "binary":
        return (head + 'format="binary">' + base64.b64encode(
            struct.pack("<I", len(raw)) + raw).decode() + "</DataArray>", b"")
    if how == "raw":
        return (head + f'format="appended" offset="{offset}"/>',
                struct.pack("<I", len(raw)) + raw)
    packed = zlib.compress(raw)  # appended, base64, packed
    header = struct.pack("<4I", 1, len(raw), 0, len(packed))
    return (head + f'format="appended" offset="{offset}"/>',
            base64.b64encode(header) + base64.b64encode(packed))


def check_reader():
    """All ways in which numbers are in files; files of ranks."""
    points = numpy.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, .5]], float)
    field = numpy.array([1.5, -2, 1e-30, 4e5])
    for how in ("ascii", "binary", "raw", "packed"):
        parts, appended = {}, b""
        for name, values, components in (
                ("points", points, 3), ("u", field, 1),
                ("connectivity", numpy.array([0, 1, 2, 3], "i4"), 1),
                ("offsets", numpy.array([4], "i4"), 1),
                ("types", numpy.array([9], "u1"), 1)):
            parts[name], more = data_array(name, values, how, len(appended),
                                           components)
            appended += more
        packed = ' compressor="vtkZLibDataCompressor"' if how == "packed" else ""
        text = (f'<VTKFile type="UnstructuredGrid" byte_order="LittleEndian"'
                f'{packed}><UnstructuredGrid><Piece NumberOfPoints="4" '
                f'NumberOfCells="1"><Points>{parts["points"]}</Points><Cells>'
                f'{parts["connectivity"]}{parts["offsets"]}{parts["types"]}'
                f'</Cells><PointData>{parts["u"]}</PointData></Piece>'
                "</UnstructuredGrid>")
        encoding = "raw" if how == "raw" else "base64"
        file = p.folder / f"{how}.vtu"
        file.write_bytes(text.encode() + (
            f'<AppendedData encoding="{encoding}">_'.encode() + appended
            + b"</AppendedData>" if appended else b"") + b"</VTKFile>")
        mesh = read_mesh(file)
        near(mesh.points, points, 0, f"points, {how}")
        near(mesh.fields["u"], field, 0, f"field, {how}")
        p.expect(list(mesh.cells[0]) == [0, 1, 2, 3] and mesh.types[0] == 9, how)
    # Against the other reader, a file of two ranks.
    result = p.call("run", p.source / "prm/step-41.prm", "--output", "two",
                    "--quiet", *set_words({"Refinement/Level": 4}), ranks=2)
    p.expect(result.returncode == 0 and (p.folder / "two/displacement.svg")
             .exists(), "pictures of two ranks " + result.stderr)
    mesh = RunFolder(p.folder / "two").last_field("fields")
    pieces = vtu.pieces(p.folder / "two/fields_0000.0.vtu")
    p.expect(len(pieces) == 2, f"{len(pieces)} pieces")
    near(mesh.points, [x for piece in pieces for x in piece.points], 0, "points")
    near(mesh.fields["displacement"],
         [x for piece in pieces for x in piece.fields["displacement"]], 0, "u")
    p.expect_error(p.call("draw", "two", ranks=2), "without mpirun")


check_point_mass()
check_broken()
check_without_python()
check_sketch()
if not p.short:
    check_hertz()
    check_friction()
    check_kinds()
    check_motion()
    check_reader()
p.finish()
