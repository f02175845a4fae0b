// Contacts of a bed, by the kind of its grains: the rows that the solver works on, and the impulses
// that they carry from step to step.
//
// Whatever the kind, contacts have the columns that the solver reads (blocks of rows, `shares`,
// `impulse`, `extrapolated`), in masses times d: an impulse p stands for a force p / dt^2, in m g.
// How rows follow from candidates differs: rows of spheres persist while their candidates do
// (sphere_contacts.hpp), contacts of polyhedra are found anew in each step
// (polyhedron_contacts.hpp).
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace grainsweep {

template <class Kind, class Real>
struct Contacts;

/// Entries of grains, sorted by grain.
template <class Entry>
struct ByGrain {
  std::vector<std::size_t> begin;  ///< where each grain's entries begin; one more at the end
  std::vector<Entry> entries;

  std::span<const Entry> of(std::int32_t grain) const {
    const auto a = static_cast<std::size_t>(grain);
    return {entries.data() + begin[a], begin[a + 1] - begin[a]};
  }
};

/// Sorts entries by grain, those of each grain in their order. `visit_all(put)` calls put(grain,
/// entry) for all entries, those of a grain never at the same time, and does so twice.
template <class Entry, class VisitAll>
void collect(std::size_t grains, const VisitAll& visit_all, ByGrain<Entry>& sorted) {
  std::vector<std::size_t>& begin = sorted.begin;
  begin.assign(grains + 2, 0);
  visit_all([&](std::int32_t a, const Entry&) { ++begin[static_cast<std::size_t>(a) + 2]; });
  for (std::size_t i = 2; i < begin.size(); ++i) begin[i] += begin[i - 1];
  sorted.entries.resize(begin.back());
  visit_all([&](std::int32_t a, const Entry& entry) {
    sorted.entries[begin[static_cast<std::size_t>(a) + 1]++] = entry;
  });
}

/// A contact that bore a force in the last step.
struct ForceContact {
  std::int32_t a = 0;  ///< grain
  std::int32_t b = 0;  ///< grain, or Grains::wall_name of a wall
  double force = 0.0;  ///< sum over its points, m g
};

/// Forces below this do not make a contact force-bearing, m g.
inline constexpr double least_force = 1e-6;

/// A contact counts only once it is closed to this gap, d, at which grains are said to touch.
/// Forces on light grains can be small against every tolerance while their gaps are still open.
inline constexpr double closed_gap = 1e-4;

/// The gap of a row that nothing closes, d.
inline constexpr double open_gap = 1e6;

/// How a contact is closed with the grains where they are now.
struct Closure {
  /// Least of its points, of two polyhedra at least PairContact::parted, d; of polyhedra infinite
  /// if above closed_gap.
  double gap = 0.0;
  int constraints = 0;  ///< 1 at a point, 2 along a line, 3 over an area; 0 if it is open
  /// Further directions in which it holds because its normal turns: 1 for a sphere at a round wall,
  /// which goes back to where the wall is farthest; for a polyhedron that a sphere pushes, 2 on a
  /// face and 1 on an edge, as turning it would bring the sphere nearer.
  int by_turning = 0;
};

}  // namespace grainsweep
