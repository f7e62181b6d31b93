# SPDX-License-Identifier: LGPL-2.1-or-later
"""What ends without a usable answer names its own reason: obstacles that are
narrower than facets, motions whose inertia vanishes, curved surfaces of few
facets, coefficients of friction without bound, walls that a force reaches."""
import random

from program import Program, set_words

p = Program()
random.seed(37)
plate = p.source / "prm/rigid-plate.prm"


def run(scene, *settings, command="run"):
    words = set_words(settings)
    if command == "run":
        words += ["--set", "Output/Pictures=false", "--output", "out", "--quiet"]
    (p.folder / "out/summary.json").unlink(missing_ok=True)
    return p.call(command, scene, *words)


expect = p.expect_run


def narrow(x, y, size, round_):
    """A box or disc in place of the plate of rigid-plate.prm."""
    shape = ([f"Obstacle 1/Radius={size / 2}"] if round_
             else [f"Obstacle 1/Size={size}, {size}"])
    return ["Obstacle 1/Point=", "Obstacle 1/Normal=",
            f"Obstacle 1/Kind={'sphere' if round_ else 'box'}",
            f"Obstacle 1/Centre={x}, {y}", *shape]


# Between the nodes of facets of 1/4, before and behind the surface; by a single
# step, or by several. No node can feel it.
for k in range(8):
    size = 10**random.uniform(-2.3, -1.3)
    x = 0.25 * random.randrange(1, 7) + random.uniform(0.07, 0.18)
    depth = random.uniform(0.2, 1.8) * size  # of the lower end
    begin = 1 + random.choice((0.6, 0.4, -0.3)) * size
    drop = begin - size / 2 - (1 - depth)
    shape = narrow(x, begin, size, k % 2 == 1)
    motion = [f"Obstacle 1/Motion=0, -{max(drop, 0.)}*t",
              f"Time stepping/Number of steps={random.choice((1, 3))}"]
    expect(run(plate, *shape, *motion), (2, 3), "ABUT-F37", "several facets",
           without=("ABUT-F23", "ABUT-F24", "ABUT-F12"))
    expect(run(plate, *shape, *motion, command="check"), (0, 2), "ABUT-F37",
           without=("ABUT-F23", "ABUT-F24"))

# Over a node, which alone is constrained: the force is that of a wider box over
# the same node, by the same displacement.
forces = [expect(run(plate, *narrow(0.5, 1 + size / 2, size, False),
                     "Obstacle 1/Motion=0, -4e-4*t"), (0,), "ABUT-F37",
                 without=("ABUT-F23", "ABUT-F24")).get("contact_force", 0.)
          for size in (0.3, 0.02, 0.002)]
p.expect(forces[0] > 0., "no force of the wide box")
for force in forces[1:]:
    p.close(force, forces[0], 1e-9, "force of a narrow box over a node")

# Through the surface at a node, all of it.
expect(run(plate, *narrow(0.5, 1.001, 0.002, False),
           "Obstacle 1/Motion=0, -0.002*t"), (2, 3), "ABUT-F37")

# In the inside of the body, or through another side, it is not the mesh.
for x, y, motion in ((0.63, 0.4, "0, 0"), (2.06, 0.9, "-0.1*t, 0")):
    expect(run(plate, *narrow(x, y, 0.05, True), f"Obstacle 1/Motion={motion}"),
           (2, 3), "ABUT-F23", "the body is in the obstacle")

# A bar whose slowest oscillation takes 4 L sqrt(rho/E) is damped away where a
# step is longer; where steps resolve it, not.
bar = p.source / "prm/dynamics-periodic-bar.prm"
for change in ("Density=1e-20", "Stiffness=1e20", "Density=1e-7",
               "Stiffness=1e8"):
    expect(run(bar, f"Bar/{change}"), (3,), "ABUT-F45", "inertia is negligible",
           "Time stepping/Step size", without=("ABUT-F12",))
expect(run(bar), (0,), without=("inertia is",))
# A mass that an impact stops has not lost its motion by itself.
expect(run(p.source / "prm/dynamics-falling-bar.prm"), (0,),
       without=("inertia is",))

# Polygons of few facets in place of two circles. Facets that match fit, and are
# as good as their stiffness: p = 1.28777 of the exact solution within a fifth.
fit = p.source / "prm/press-fit.prm"


def rings(inner, outer):
    return [f"Body 1/Mesh/Arguments=0, 0 : 1 : 2 : {inner} : true",
            f"Body 2/Mesh/Arguments=0, 0 : 2 : 3 : {outer} : true",
            "Pair 1/Use mesh gap=true",
            "Refinement/Level=0"]


for inner, outer in ((3, 2), (2, 3), (5, 3)):
    expect(run(fit, *rings(inner, outer)), (3,), "ABUT-F21",
           "their curve", "Use mesh gap = false")
for n in (4, 8):
    summary = expect(run(fit, *rings(n, n)), (0,),
                     without=("their curve",))
    p.close(summary.get("pair_1_pressure"), 1.28777, 0.2,
            f"pressure of {n} facets that match")

# Friction without bound stops a sliding block at once: no state of stick and
# slip is found, but the matrix is not to blame.
slide = p.source / "prm/sliding-block.prm"
for mu in ("1e6", "1e9"):
    expect(run(slide, f"Pair 1/Friction={mu}", "Time stepping/End time=0.02"), (0, 3),
           without=("ABUT-F30",))

# A wall that a force reaches is no pair without partners.
walls = """
set Scene = solid
set Dimension = 2
subsection Solid
  set Pairs = 2
  set Obstacles = 2
end
subsection Body 1
  subsection Mesh
    set Generator = subdivided_hyper_rectangle
    set Arguments = 2, 2 : 0, 0 : 1, 1 : true
  end
  set Young modulus = 100
  set Poisson ratio = 0
  set Support = 2: free, 0
  set Body force = t, 0
end
subsection Obstacle 1
  set Kind = plane
  set Point = 0, 0
  set Normal = 1, 0
end
subsection Obstacle 2
  set Kind = plane
  set Point = GAP, 0
  set Normal = -1, 0
end
subsection Pair 1
  set Secondary = 1: 0
  set Obstacle = 1
end
subsection Pair 2
  set Secondary = 1: 1
  set Obstacle = 2
end
subsection Refinement
  set Level = 0
end
"""
for gap in (0.01, 0.5, 3.):
    scene = p.write("walls.prm", walls.replace("GAP", str(1. + gap)))
    expect(run(scene, command="check"), (0,), without=("ABUT-F24",))
    summary = expect(run(scene), (0,))
    # The force 1 of the body is the wall's.
    p.close(-summary.get("pair_2_force", [0.])[0], 1., 1e-9, "force of the wall")
# A body that is held does not come to it.
expect(run(p.write("held.prm", walls.replace("GAP", "1.5")),
           "Body 1/Prescribed displacement=2: 0, 0", command="check"), (0,), "ABUT-F24")
p.finish()
