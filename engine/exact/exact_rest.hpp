// Exact rest of spheres: the state next to a settled bed in which all forces balance.
//
// A bed at rest is a minimum of its potential energy: no grain can sink without a gap closing
// beyond contact. A nonlinear interior-point method goes there from a settled bed, with gaps as
// they are: every pair and wall within reach has a slack s, its gap, and a force f, and f s goes to
// 0 for all of them together while grains sink along the valleys between their neighbours. A round
// takes one factorisation of the bed's stiffness matrix (engine/exact/stiffness.hpp), in which a
// contact is a spring of stiffness f / s. At the end a factor of 1e8 and more separates the
// contacts that push from gaps, and there are as many as hold the bed: their forces are unique, and
// follow from the weight.
//
// How well grains are solved while they fall and creep matters as before: this finds the rest, not
// the packing.
#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/context.hpp"
#include "engine/exact/stiffness.hpp"
#include "engine/results.hpp"
#include "engine/rows/contacts.hpp"
#include "engine/scene/bed.hpp"
#include "engine/units.hpp"

namespace grainsweep {

/// What exact rest promises.
inline constexpr double exact_imbalance = 1e-10;  ///< most that forces leave on a grain, m g
inline constexpr double exact_overlap = 1e-12;    ///< deepest overlap, d

struct ExactRest {
  std::string failure;                 ///< why exact rest was not found; empty if it was
  int rounds = 0;                      ///< factorisations
  std::vector<ForceContact> contacts;  ///< those that push
  double imbalance = 0.0;              ///< most that their forces leave on a grain, m g
  Imbalance of_weight;                 ///< the same, each grain in its own weight
  double overlap_max = 0.0;            ///< d
  double overlap_mean = 0.0;           ///< over the contacts, d
};

/// Gives a search as bytes, only during the call that it is given in.
using SaveSearch = std::function<std::string()>;

struct ExactRestLimits {
  /// Asked before every round and within long ones; if it returns false the failure is "cancelled".
  std::function<bool(const SaveSearch&)> keep_going = [](const SaveSearch&) { return true; };
  /// Multiplications of a round after which it is asked again.
  double asked_after = asks_seldom;
  /// Most multiplications of all rounds, including what they do besides factorisations; no round is
  /// begun if they are too few for a usual search.
  double operations = infinity;
  /// Bytes of a search of the same bed, which goes on from them with the same bits; if empty, it
  /// begins anew.
  std::string_view saved = {};
};

/// Moves a settled bed, whose contacts are `from`, to exact rest. The bed is wrapped; if the search
/// fails, its grains are left anywhere.
ExactRest rest_exactly(const ExecutionContext& context, const std::vector<ForceContact>& from,
                       SphereBed& bed, const ExactRestLimits& limits = {});

}  // namespace grainsweep
