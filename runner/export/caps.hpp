// Flat ends of grains where they nearly touch. Lengths in d.
#pragma once

#include <vector>

#include "runner/export/contacts.hpp"
#include "runner/export/surfaces.hpp"

namespace grainsweep {

/// How deep a cap of that share of the radius is, in radii: 1 - sqrt(1 - share^2).
double cap_depth(double share);

/// The contacts that are treated: those with a gap below the depth of a cap of a grain of radius
/// 1 d, and all of contacts_of.
std::vector<Contact> treated_contacts(const ExportedBed& exported);

/// Cuts the caps of all treated contacts off the surfaces about the centres of the grains, with
/// walls, too: each as deep as a cap of the grain's radius, and a little deeper where a corner
/// would lie nearer to the cut than a thousandth of it, on spheres a ten-thousandth.
void cut_caps(const ExportedBed& exported, std::vector<Surface>& surfaces);

}  // namespace grainsweep
