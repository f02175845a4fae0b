// All contacts of a stored bed, and files of them. Lengths in d, forces in m g.
#pragma once

#include <string>
#include <vector>

#include "engine/measure/contact_places.hpp"
#include "runner/export/exported_bed.hpp"

namespace grainsweep {

/// A contact of grain a with grain b, or with wall b of walls_of(Box). Each vertex of a polyhedron
/// at a tube is a contact of its own.
struct Contact {
  std::size_t a = 0, b = 0;
  bool is_wall = false;
  double gap = 0.0;    ///< d, negative = overlap
  double force = 0.0;  ///< that the two exert on each other, m g; 0 if they only touch
  ContactPlace place;
};

/// Every contact with a gap below the tolerance, and every other one that bears a force: grains
/// first, a < b, then walls. Contacts of polyhedra that bear a force have the place and kind of the
/// force, as the bed stores it; all others have those of what is closed to the tolerance.
std::vector<Contact> contacts_of(const ExportedBed& exported);

/// "floor", "tube", "x_low", "x_high", "y_low" or "y_high".
std::string wall_name(const Box& box, std::size_t wall);

/// A line per contact: a and b, the ids of the grains; wall, its name, in place of b; size_class_a,
/// size_class_b; kind, point, line or area; gap; nx, ny, nz, the unit normal from a to b; x, y, z,
/// a point of the contact beside a; force.
std::string contacts_csv(const ExportedBed& exported);

/// Lines from centre to centre, or to a wall, with the arrays a, b (0 for a wall), size_class_a,
/// size_class_b (0 for a wall), kind (1, 2, 3), gap, force and normal. Lines across a periodic side
/// leave the box.
std::string contacts_vtp(const ExportedBed& exported);

}  // namespace grainsweep
