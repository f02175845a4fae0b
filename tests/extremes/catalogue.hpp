// All extreme scenes, family by family.
#pragma once

#include <vector>

#include "tests/extremes/scene.hpp"

namespace grainsweep::extremes {

/// Towers between walls, whose forces follow from statics, of 2 to 1000 grains.
std::vector<Scene> towers();
/// Two grains of masses 1 to 1e8 apart.
std::vector<Scene> masses();
/// Starts that overlap, balance on a point, lie far away or rest already.
std::vector<Scene> starts();
/// Steps, tolerances, iterations and number types far from the presets.
std::vector<Scene> accuracies();
/// Whole packings in boxes at the limits of what is allowed, of few and many grains.
std::vector<Scene> boxes();
/// The sweeps of configs/extremes, read as a user's.
std::vector<Scene> sweep_files();
/// Scaled lengths.
std::vector<Scene> units();
/// Crystals, slabs and wedges with answers in closed form.
std::vector<Scene> exact_answers();
/// Shifts, mirrors and other names of the same bed.
std::vector<Scene> symmetries();
/// Energy from step to step.
std::vector<Scene> energies();
/// Numbers that are none, and states that blow up.
std::vector<Scene> not_numbers();
/// Pairs of polyhedra in the positions that narrow phases fail in.
std::vector<Scene> polyhedron_pairs();
/// Stacks of polyhedra, step by step.
std::vector<Scene> stacks();

/// All of them.
std::vector<Scene> catalogue();

}  // namespace grainsweep::extremes
