// Subdomains of a large bed, whose rows several cores may sweep.
//
// A subdomain is made of slabs of the search grid across an axis, and no pair reaches beyond the
// next slab. A row belongs to the first of its two grains' subdomains: rows of subdomains 0, 2, 4
// share no grain, nor do those of 1, 3, 5. Along a periodic axis subdomains are a ring of even
// number, and the first one follows the last. Small beds are one subdomain.
#pragma once

#include <cstdint>
#include <vector>

#include "engine/broad/candidates.hpp"
#include "engine/context.hpp"
#include "engine/rows/partition.hpp"

namespace grainsweep {

/// Memory of a division, kept from one division to the next.
struct Subdomains {
  std::size_t count = 1;
  bool is_ring = false;
  std::vector<std::int32_t> slab;        ///< slab of each grain
  std::vector<std::int32_t> of_slab;     ///< subdomain of each slab
  std::vector<std::size_t> slab_size;    ///< grains of each slab
  std::vector<GrainPair> pairs;          ///< candidates by subdomain, in their order
  std::vector<std::size_t> begin;        ///< first pair of each subdomain; one more at the end
  std::vector<std::int32_t> grains;      ///< all grains by subdomain, ascending in each
  std::vector<std::size_t> first_grain;  ///< of each subdomain in `grains`; one more at the end
  std::vector<std::size_t> place;        ///< next place in each subdomain of each part of a sort
  std::vector<std::vector<std::int32_t>> near_walls;  ///< see near_wall

  /// Grains of a subdomain that come near wall k: ascending, then those that strays have added.
  const std::vector<std::int32_t>& near_wall(std::size_t k, std::size_t subdomain) const {
    return near_walls[k * count + subdomain];
  }

  std::size_t subdomain_of(std::int32_t grain) const {
    if (count == 1) return 0;
    const std::int32_t own = slab[static_cast<std::size_t>(grain)];
    return static_cast<std::size_t>(of_slab[static_cast<std::size_t>(own)]);
  }
  /// Subdomain of the rows of a pair.
  std::size_t subdomain_of(GrainPair pair) const;
  /// Whether the grains of a pair lie in one subdomain or in two that follow one another.
  bool may_hold(GrainPair pair) const;
};

/// Divides the bed of `candidates` into subdomains of at least `min_grains` grains (the last one
/// may have fewer) and sorts its grains and those near walls by subdomain.
void divide_grains(const Grains& bed, std::size_t min_grains, const Candidates& candidates,
                   const ParallelFor& loop, Subdomains& subdomains);
/// Then sorts pairs by subdomain. May hold all of them: that of a pair which lay further apart than
/// the candidates reached, where its grains were looked up, is not certain.
void divide_pairs(const std::vector<GrainPair>& pairs, const ParallelFor& loop,
                  Subdomains& subdomains);

/// Calls work(subdomain) for all subdomains: for 0, 2, 4 .. in any order, then for 1, 3, 5 ..
template <class Work>
void visit_subdomains(std::size_t count, const ParallelFor& loop, const Work& work) {
  parallel_for(loop, (count + 1) / 2, [&](std::size_t k) { work(2 * k); });
  if (count > 1) {
    parallel_for(loop, count / 2, [&](std::size_t k) { work(2 * k + 1); });
  }
}

/// Parts that cores may sweep: every second subdomain, then those between. A part has the rows of a
/// subdomain, which `add_ranges(subdomain, ranges)` appends, and the grains of it and the subdomain
/// that follows: in both phases these are all grains. Where nothing follows the last subdomain, a
/// part of no rows names the grains of the first one in the second phase.
template <class AddRanges>
void share_out(const Subdomains& subdomains, RowShares& shares, const AddRanges& add_ranges) {
  const std::vector<std::size_t>& first = subdomains.first_grain;
  const auto add_part = [&](std::size_t k) {
    RowPart part{k % 2, shares.ranges.size(), 0, 0, 0};
    add_ranges(k, shares.ranges);
    part.ranges = shares.ranges.size() - part.first_range;
    if (subdomains.count > 1) {
      const bool is_last = k + 1 == subdomains.count;
      const std::size_t following = !is_last             ? first[k + 2] - first[k + 1]
                                    : subdomains.is_ring ? first[1]
                                                         : 0;
      part.first_grain = first[k];
      part.grains = first[k + 1] - first[k] + following;
    }
    shares.parts.push_back(part);
  };
  shares.clear();
  for (std::size_t k = 0; k < subdomains.count; k += 2) add_part(k);
  if (subdomains.count == 1) return;
  shares.grains = subdomains.grains;
  if (subdomains.is_ring) {
    shares.grains.insert(shares.grains.end(), subdomains.grains.begin(),
                         subdomains.grains.begin() + static_cast<std::ptrdiff_t>(first[1]));
  } else {
    shares.parts.push_back({1, shares.ranges.size(), 0, 0, first[1]});
  }
  for (std::size_t k = 1; k < subdomains.count; k += 2) add_part(k);
}

}  // namespace grainsweep
