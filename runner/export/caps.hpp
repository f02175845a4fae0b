// Flat ends of grains where they nearly touch. Lengths in d.
#pragma once

#include <map>
#include <vector>

#include "runner/export/contacts.hpp"
#include "runner/export/surfaces.hpp"

namespace grainsweep {

/// How deep a cap of that share of the radius is, in radii: 1 - sqrt(1 - share^2).
double cap_depth(double share);

/// The contacts that are treated: those with a gap below the depth of a cap of a grain of radius
/// 1 d, and all of contacts_of.
std::vector<Contact> treated_contacts(const ExportedBed& exported);

/// Where grains end beside the wall of a tube.
struct TubeEnd {
  Vector centre = Vector::Zero();  ///< of the grain, from the axis, level
  double radius = 0.0;             ///< about the axis; nothing of the grain reaches beyond it
  int sides = 0;                   ///< of a prism inside that circle that leaves out little of it

  double from_axis(const Vector& of_grain) const { return (centre + of_grain).head<2>().norm(); }
};

/// Whether a contact is one with the wall of a tube.
bool is_at_tube(const Box& box, const Contact& contact);

/// The ends of all grains with treated contacts at the wall of a tube, by the grains' numbers: a
/// cap's depth before the wall, or before the gap to it.
std::map<std::size_t, TubeEnd> tube_ends(const ExportedBed& exported,
                                         const std::vector<Contact>& treated);

/// Cuts the caps of all treated contacts, also those with walls, off the surfaces about the centres
/// of the grains. Each is as deep as a cap of the grain's radius, counted for grains that overlap
/// from midway or from the wall, and a little deeper where a corner would lie nearer to the cut
/// than a thousandth of the radius, on spheres a ten-thousandth. At the wall of a tube grains get a
/// flat place for each side of their TubeEnd.
void cut_caps(const ExportedBed& exported, std::vector<Surface>& surfaces);

}  // namespace grainsweep
