// Grains joined by necks where they nearly touch, as closed surfaces. Lengths in d.
#pragma once

#include <vector>

#include "runner/export/surfaces.hpp"

namespace grainsweep {

/// A surface for all grains, or images of them, that necks join, and for each other grain.
///
/// Necks lie at the contacts of treated_contacts (runner/export/caps.hpp). Grains joined across a
/// periodic side have flat ends there unless images are asked for; then all grains and necks
/// within the box have theirs, and grains that only a neck within the box calls for are there, too.
std::vector<GrainSurface> bridged_surfaces(const ExportedBed& exported);

}  // namespace grainsweep
