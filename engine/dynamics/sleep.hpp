// The deep part of a bed sleeps while the bed fills up.
//
// In the fall the deep bed has nothing to do but gather errors: what a solve leaves there is a
// small share of the forces, but makes a spurious motion in every step, and the repair of the
// overlaps pushes it out again; over a hundred layers the bed pumps itself denser than it was laid
// down. So grains far below the filling front stand still, as if they were the floor, until the
// fall is over.
//
//      falling     o   o    o     front: the lowest slice whose grains still fall
//                 oo oo  o o
//      settling   oooooooooo      sleep_depth below the front
//      asleep     oooooooooo      nothing moves them; contacts between two of them are no rows
#pragma once

#include <cstdint>

#include "engine/scene/bed.hpp"

namespace grainsweep {

/// How far below the filling front grains fall asleep, d. At 7 d the grains above would miss what
/// still settles beneath them (the solid fraction comes out 0.002 lower). Grains that have slid on
/// while little lay on them have less to do under the whole bed: at 15 d beds of 100 d took twice
/// as long. Deeper down the errors of loose solves add up: at 60 d the solid fraction comes out
/// 0.001 higher.
inline constexpr double sleep_depth = 40.0;

/// The front is looked for once in so many steps.
inline constexpr std::int64_t steps_between_looks = 5;

/// Whether grains of this bed may sleep: small ones that find their way down between large ones
/// must not find the bed frozen.
bool may_sleep(const Grains& bed);

/// Heaviest over lightest grain; 1 if there are none.
double mass_ratio(const Grains& bed);

/// Puts the grains to sleep whose centres lie further than sleep_depth below the filling front,
/// after a step of length `dt`. Returns whether any fell asleep.
bool put_to_sleep(double dt, Grains& bed);

/// Wakes all grains. Returns whether any slept.
bool wake(Grains& bed);

}  // namespace grainsweep
