"""Checks certificates of beds of spheres: python3 check_certificate.py FILE... (needs python3-numpy)

Each was written by `grainsweep export DIR --format certificate`. From centres, radii and forces alone
it finds anew: overlaps of all pairs and walls, the net force on every sphere, the sign of every force,
the free motions, and, of up to 1000 spheres, whether the forces are the only ones that balance."""
import json
import sys

import numpy


def check(file):
    bed = json.load(open(file))
    spheres, box = numpy.array(bed["spheres"]), bed["box"]
    places, radii, n = spheres[:, :3], spheres[:, 3], len(spheres)
    tube, sides = box.get("tube"), [box.get("length", 0), box.get("width", 0)]
    periods = [side if box.get(axis) == "periodic" else 0 for side, axis in zip(sides, "xy")] + [0]

    def between(a, b):  # from a to the nearest image of b
        way = places[b] - places[a]
        for axis, period in enumerate(periods):
            way[..., axis] -= period and period * numpy.round(way[..., axis] / period)
        return way

    def to_wall(i, wall):  # unit normal and distance
        from_axis = places[i, :2] - (tube or 0) / 2
        off_axis = numpy.hypot(*from_axis)
        return {"floor": ([0, 0, -1], places[i, 2]),
                "tube": ([*(from_axis / max(off_axis, 1e-300)), 0], (tube or 0) / 2 - off_axis),
                "x_low": ([-1, 0, 0], places[i, 0]), "x_high": ([1, 0, 0], sides[0] - places[i, 0]),
                "y_low": ([0, -1, 0], places[i, 1]), "y_high": ([0, 1, 0], sides[1] - places[i, 1])}[wall]

    walls = ["floor"] + (["tube"] if tube else [f"{axis}_{end}" for axis, period in zip("xy", periods)
                                                if not period for end in ("low", "high")])
    overlap = max([radii[i] - to_wall(i, wall)[1] for i in range(n) for wall in walls])
    for i in range(n - 1):
        gaps = numpy.linalg.norm(between(i, numpy.arange(i + 1, n)), axis=1) - radii[i] - radii[i + 1:]
        overlap = max(overlap, -gaps.min())

    columns = []  # what a force of 1 does to all spheres
    for a, b, _ in bed["forces"]:
        column, way = numpy.zeros((n, 3)), between(a, b)
        column[b] = way / numpy.linalg.norm(way)
        column[a] = -column[b]
        columns.append(column)
    for a, wall, _ in bed["wall_forces"]:
        column = numpy.zeros((n, 3))
        column[a] = -numpy.array(to_wall(a, wall)[0])
        columns.append(column)
    forces = numpy.array([force for *_, force in bed["forces"] + bed["wall_forces"]])
    contacts = numpy.array(columns).reshape(len(forces), 3 * n)
    net = (forces @ contacts).reshape(n, 3) - [0, 0, 1] * (8 * radii[:, None] ** 3)
    free = numpy.zeros((len(bed["free_motions"]), n, 3))
    for motion, field in zip(bed["free_motions"], free):
        x, y, _ = (places[motion["spheres"]] - (tube or 0) / 2).T
        field[motion["spheres"]] = numpy.stack([-y, x, 0 * x], 1) if "turn" in motion else motion["direction"]
    opened = numpy.abs(contacts @ free.reshape(len(free), 3 * n).T).max() if len(free) else 0
    found = {"overlap_max": overlap, "imbalance_max": numpy.linalg.norm(net, axis=1).max(),
             "least_force": forces.min(), "opened by free motions": opened,
             "contacts": len(forces), "degrees of freedom": 3 * n - len(free)}
    if n <= 1000:
        found["independent contacts"] = numpy.linalg.matrix_rank(contacts)
    is_exact = (overlap < 1e-12 and found["imbalance_max"] < 1e-10 and found["least_force"] > 0
                and opened < 1e-9 and found.get("independent contacts", len(forces)) == len(forces))
    print(file, "holds" if is_exact else "DOES NOT HOLD", found)
    return is_exact


if __name__ == "__main__":
    sys.exit(0 if all([check(file) for file in sys.argv[1:]]) else 1)
