// Shapes whose lengths were probably not written in d: every rule lets them pass, and the beds are
// of a few grains, or of thousands of specks.
#pragma once

#include "runner/sweep/diagnostic.hpp"
#include "runner/sweep/job.hpp"

namespace grainsweep {

/// A note if grains are far from 1 d, and what to write: if the sphere of equal volume has more
/// than 3 d or less than a third, and no length of the grain reaches 1 d. Needles and plates of 1 d
/// have one that does. Placed grains, whose radii a file gives, are not judged.
Diagnostics notes_on_far_shapes(const Sweep& sweep);

}  // namespace grainsweep
