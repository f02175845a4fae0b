"""Steps a bed of pinacoids in YADE and prints what a step costs; polyhedra.sh runs it.

Environment: GRAINS, a CSV of grainsweep's export (x, y, z, qx, qy, qz, qw; grains of one size, in d);
LENGTH and WIDTH of the walled box, d; STEP, sqrt(d/g); STIFFNESS, force per volume of overlap,
m g / d^3; STEPS, how many are timed after ten others. Lengths are in d, g and a grain's mass are 1.
"""

import csv
import math
import os
import time

from yade import polyhedra_utils  # the other names (O, Vector3, Polyhedra, ...) are YADE's own


def pinacoid_corners(length=1.0, width=1.0, height=1.0, angle=math.radians(60)):
    """The vertices that engine/shape/pinacoid.hpp gives."""
    a, b, e = length / 2, width / 2, height / 2
    c = a - e / math.tan(angle)
    signs = (1, -1)
    return [(s * a, t * b, 0) for s in signs for t in signs] + [
        (s * c, 0, t * e) for s in signs for t in signs
    ]


def placed(row, corners, material):
    turn = Quaternion(*(float(row[name]) for name in ("qw", "qx", "qy", "qz")))
    body = polyhedra_utils.polyhedra(material, v=[turn * Vector3(*corner) for corner in corners])
    body.state.pos += Vector3(*(float(row[name]) for name in "xyz"))
    return body


def kinetic_energy(bodies):
    """Mean over the grains, m g d."""
    return sum(b.state.vel.squaredNorm() / 2 for b in bodies) / len(bodies)


size = float(os.environ["LENGTH"]), float(os.environ["WIDTH"])
steps = int(os.environ["STEPS"])
corners = pinacoid_corners()
rough = PolyhedraMat(young=1, poisson=0, density=1, frictionAngle=0)
volume = polyhedra_utils.polyhedra(rough, v=corners).state.mass
material = PolyhedraMat(
    young=float(os.environ["STIFFNESS"]), poisson=0, density=1 / volume, frictionAngle=0
)
O.materials.append(material)
with open(os.environ["GRAINS"]) as file:
    grains = [placed(row, corners, material) for row in csv.DictReader(file)]
O.bodies.append(grains)
for axis, position, sense in (
    (0, 0, 1),
    (0, size[0], -1),
    (1, 0, 1),
    (1, size[1], -1),
    (2, 0, 1),
):
    O.bodies.append(utils.wall(position, axis=axis, sense=sense, material=material))
O.engines = [
    ForceResetter(),
    InsertionSortCollider([Bo1_Polyhedra_Aabb(), Bo1_Wall_Aabb()], verletDist=0.05),
    InteractionLoop(
        [Ig2_Wall_Polyhedra_PolyhedraGeom(), Ig2_Polyhedra_Polyhedra_PolyhedraGeom()],
        [Ip2_PolyhedraMat_PolyhedraMat_PolyhedraPhys()],
        [Law2_PolyhedraGeom_PolyhedraPhys_Volumetric()],
    ),
    NewtonIntegrator(damping=0.3, gravity=(0, 0, -1)),
]
O.dt = float(os.environ["STEP"])
O.run(10, True)
began = time.process_time()
O.run(steps, True)
seconds = time.process_time() - began
print("mass %.6f" % grains[0].state.mass)
print("seconds_per_step %.6g" % (seconds / steps))
print("kinetic_energy %.3g" % kinetic_energy(grains))
