# SPDX-License-Identifier: LGPL-2.1-or-later
"""What `abut check` prints of loads, against sums by hand; and what a run says
where a sign, a unit or the quantity of a target error is wrong."""
import math
import re

from program import Program, set_words

p = Program()
PRM = p.source / "prm"
QUICK = ["Output/Pictures=false", "Output/Fields=false"]


def call(command, scene, *settings):
    return p.call(command, scene, *set_words(settings),
                  *(["--output", "out", "--quiet"] if command == "run" else []))


def loads(scene, *settings):
    """By body: the force, and the moment and its centre if there are any."""
    result = call("check", scene, *settings)
    p.expect(result.returncode == 0, f"{scene}: {result.stderr}")
    number = r"[-+.\de]+"
    found = {}
    for body, force, moment, centre in re.findall(
            rf"^  ((?:body|obstacle) \d+): loads(?: at time {number})?: "
            rf"(?:none|force \(([^)]*)\))"
            rf"(?:, moment (.*) about the centre \(([^)]*)\))?$",
            result.stdout, re.M):
        found[body] = tuple(
            [float(x) for x in text.strip("()").split(",")] if text else None
            for text in (force, moment, centre))
    return found


def near(found, expected, what):
    p.expect(found is not None and len(found) == len(expected)
             and all(abs(a - b) <= 1e-5 * max(1., abs(b))
                     for a, b in zip(found, expected)),
             f"{what}: {found} is not {expected}")


# Pressure 10 on a side of length 2, from above; the lower body has no loads.
p.call("new", "two-bodies")
found = loads("two-bodies.prm")
p.expect(found["body 1"] == (None, None, None), f"no loads: {found}")
near(found["body 2"][0], (0, -20), "pressure")
near(loads("two-bodies.prm", "Body 2/Pressure=3: -10")["body 2"][0], (0, 20),
     "pressure of the wrong sign")
# Weight of two unit squares, and a traction on one side; without supports along
# x the body may rotate: about its centre (1, 1.5) the traction t = (0, 3) on
# x = 2 of length 1 has the moment 3.
found = loads("two-bodies.prm", "Body 2/Prescribed displacement=",
              "Body 2/Traction=1: 0, 3", "Body 2/Pressure=",
              "Body 2/Density=0.5", "Solid/Gravity=0, -9.81",
              "Body 1/Density=0.5")
near(found["body 1"][0], (0, -0.5 * 2 * 9.81), "weight")
p.expect(found["body 1"][1] is None, "moment on a body that cannot rotate")
near(found["body 2"][0], (0, 3 - 0.5 * 2 * 9.81), "weight and traction")
near(found["body 2"][1], (3,), "moment")
near(found["body 2"][2], (1, 1.5), "centre")
# Loads of the first step of ten.
near(loads("two-bodies.prm", "Body 2/Pressure=3: 10*t",
           "Time stepping/Number of steps=10")["body 2"][0], (0, -2),
     "first load step")
# Quadratic elements, hanging nodes, and a force that is not constant:
# int_0^2 x dx = 2.
near(loads("two-bodies.prm", "Solid/Degree=2", "Body 2/Pressure=3: x",
           "Refinement/Coarsest level=1")["body 2"][0], (0, -2), "Degree 2")
# Full circle: 2 pi int r p dr over a disc of the scene's pipe or ball.
p.write("disc.prm", """
set Scene = solid
set Dimension = 2
subsection Solid
  set Plane = axisymmetric
end
subsection Body 1
  subsection Mesh
    set Generator = subdivided_hyper_rectangle
    set Arguments = 3, 2 : 0, 0 : 1.5, 1 : true
  end
  set Young modulus = 1
  set Prescribed displacement = 2: free, 0
  set Pressure = 3: 2; 1: 7
end
""")
near(loads("disc.prm")["body 1"][0], (0, -2 * math.pi * 1.5**2), "disc")
# In space, with a moment: traction (0, 0, -4) on the face x = 1 of the cube
# [0, 1]^3: force (0, 0, -4), moment (1/2, 0, 0) x F = (0, 2, 0).
p.write("cube.prm", """
set Scene = solid
set Dimension = 3
subsection Solid
  set Pairs = 1
  set Obstacles = 1
end
subsection Body 1
  subsection Mesh
    set Generator = subdivided_hyper_rectangle
    set Arguments = 2, 2, 2 : 0, 0, 0 : 1, 1, 1 : true
  end
  set Young modulus = 1
  set Traction = 1: 0, 0, -4
end
subsection Obstacle 1
  set Kind = plane
end
subsection Pair 1
  set Secondary = 1: 4
  set Obstacle = 1
end
""")
result = call("check", "cube.prm")
p.expect("body 1: loads: force (0, 0, -4), moment (0, 2, 0) about the centre "
         "(0.5, 0.5, 0.5)" in result.stdout, f"cube: {result.stdout}")

# Loads away from the obstacle, a plane or a formula of the wrong sign.
PULLED = PRM / "failures/floating-pulled.prm"
result = call("run", PULLED, *QUICK)
p.expect(result.returncode == 3 and "ABUT-F12" in result.stderr
         and "(0, -1)" in result.stderr and "Check the signs" in result.stderr,
         f"pulled: {result.stderr}")
result = call("run", "two-bodies.prm", "Body 2/Pressure=3: -10", *QUICK)
p.expect(result.returncode == 3 and "Check the signs" in result.stderr
         and re.search(r"body 2 can slide along \(0, 1\)", result.stderr),
         f"lifted: {result.stderr}")
# Pushed along the obstacle: the signs do not matter, a support is missing.
result = call("run", PRM / "failures/floating-sideways.prm", *QUICK)
p.expect(result.returncode == 3 and "ABUT-F12" in result.stderr
         and "sign" not in result.stderr, f"sideways: {result.stderr}")

# A body in millimetres on one in metres; the same distance without a scale.
for settings, is_unit in ((("Body 2/Mesh/Scale=1000",
                            "Body 2/Mesh/Move=-500, 600"), True),
                          (("Body 2/Mesh/Move=0, 600",), False)):
    result = call("check", "two-bodies.prm", "Output/Points=",
                  "Output/Expected=", *settings)
    p.expect(result.returncode == 2 and "ABUT-F24" in result.stderr
             and ("same unit of length" in result.stderr) == is_unit,
             f"units {settings}: {result.stderr}")

# The contact force follows from loads: no mesh changes it. Prescribed
# displacements leave it to the mesh.
p.call("new", "hertz")
TARGET = ["Refinement/Target error=0.02",
          "Refinement/Target quantity=contact force", *QUICK]
for scene in ("two-bodies.prm", "hertz.prm"):
    p.expect_error(call("run", scene, *TARGET), "Refinement/Target quantity",
                   "loads prescribe", "supports leave body 2 a translation "
                   "along y", "energy norm")
MOVED = ["Body 2/Prescribed displacement=1: 0, free; 2: free, -0.1",
         "Body 2/Pressure=", "Output/Expected="]
result = call("run", "hertz.prm", *TARGET, *MOVED)
p.expect(result.returncode == 0, f"moved: {result.stderr}")

p.finish()
