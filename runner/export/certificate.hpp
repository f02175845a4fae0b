// A file from which anybody can check that a bed of spheres is at rest: centres, radii, forces, and
// how the whole bed may move.
#pragma once

#include <string>

#include "runner/export/exported_bed.hpp"

namespace grainsweep {

/// JSON with the members
///
///   job, state_hash       of the packing, as in packings.csv
///   units                 of all numbers: d, the weight m g and the mass m of a sphere of
///                         diameter d
///   box                   length and width, d, and what bounds x and y: walls or periodic; or
///                         tube, its diameter, about the axis x = y = diameter / 2. The floor is
///                         z = 0
///   spheres               [x, y, z, radius] of each
///   forces                [a, b, magnitude] of each contact of two spheres, numbered from 0
///   wall_forces           [a, wall, magnitude], with the name of the wall, as wall_name
///   free_motions          {direction, spheres}: these may move alike along the direction, and
///                         {turn: "axis", spheres}: these may turn about the axis of a tube,
///                         without any contact opening or closing
///   found                 what the program finds from these numbers: overlap_max, d;
///                         imbalance_max, the largest net force on a sphere, m g; least_force, m g;
///                         contacts, their number; degrees_of_freedom, 3 a sphere less the free
///                         motions
///
/// runner/python/check_certificate.py checks it without the program. Throws BadInput for polyhedra.
std::string certificate_json(const ExportedBed& exported);

/// Why a bed has no certificate; "" if it has one.
std::string fault_for_certificate(const StoredBed& bed);

}  // namespace grainsweep
