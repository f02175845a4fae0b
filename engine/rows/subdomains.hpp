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

namespace grainsweep {

/// Memory of a division, kept from one to the next.
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

  std::size_t subdomain_of(std::int32_t grain) const {
    if (count == 1) return 0;
    const std::int32_t own = slab[static_cast<std::size_t>(grain)];
    return static_cast<std::size_t>(of_slab[static_cast<std::size_t>(own)]);
  }
  /// Subdomain of the rows of a pair.
  std::size_t subdomain_of(GrainPair pair) const;
};

/// Divides the bed of `candidates` and sorts its pairs and grains by subdomain.
void divide(const SphereBed& bed, const Candidates& candidates, const ParallelFor& loop,
            Subdomains& subdomains);

/// Calls work(subdomain) for all subdomains: for 0, 2, 4 .. in any order, then for 1, 3, 5 ..
template <class Work>
void visit_subdomains(std::size_t count, const ParallelFor& loop, const Work& work) {
  parallel_for(loop, (count + 1) / 2, [&](std::size_t k) { work(2 * k); });
  if (count > 1) {
    parallel_for(loop, count / 2, [&](std::size_t k) { work(2 * k + 1); });
  }
}

}  // namespace grainsweep
