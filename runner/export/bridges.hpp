// Grains joined by necks where they nearly touch, as closed surfaces. Lengths in d.
#pragma once

#include <vector>

#include "runner/export/surfaces.hpp"

namespace grainsweep {

/// A surface for each body of grains, or images of them, joined by necks, and for each other grain.
///
/// Necks lie at the contacts of treated_contacts (runner/export/caps.hpp). Grains joined across a
/// periodic side have flat ends there unless images are asked for; then all grains and necks within
/// the box have theirs, and images needed only by a neck within the box are there, too.
std::vector<GrainSurface> bridged_surfaces(const ExportedBed& exported);

}  // namespace grainsweep
