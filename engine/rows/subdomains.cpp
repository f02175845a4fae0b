#include "engine/rows/subdomains.hpp"

#include <algorithm>
#include <utility>

namespace grainsweep {

namespace {

bool is_periodic(const Box& box, int axis) {
  return (axis == 0 && box.x == Boundary::periodic) || (axis == 1 && box.y == Boundary::periodic);
}

/// The slab of each grain and the size of each slab: where the grain was looked up, which is where
/// its pairs are within reach. It may since have moved out of the box.
void count_slabs(const Grains& bed, const Candidates& candidates, const ParallelFor& loop,
                 Subdomains& subdomains) {
  const Cells& cells = candidates.levels.front().cells;
  subdomains.slab.resize(bed.grains());
  parallel_chunks(loop, bed.grains(), bed.subdomains, [&](std::size_t, IndexRange share) {
    for (std::size_t i = share.first; i < share.last; ++i) {
      subdomains.slab[i] = cells.place_along(bed.subdomain_axis, candidates.built_at[i]);
    }
  });
  subdomains.slab_size.assign(static_cast<std::size_t>(cells.inner(bed.subdomain_axis)), 0);
  for (const std::int32_t slab : subdomains.slab) {
    ++subdomains.slab_size[static_cast<std::size_t>(slab)];
  }
}

/// A subdomain ends with the slab that fills it, unless that is the last one. If a ring has an odd
/// number of them, the last two are joined.
void cut(std::size_t min_grains, Subdomains& subdomains) {
  const std::vector<std::size_t>& slab_size = subdomains.slab_size;
  subdomains.of_slab.assign(slab_size.size(), 0);
  subdomains.count = 1;
  std::size_t grains = 0;
  for (std::size_t k = 0; k < slab_size.size(); ++k) {
    subdomains.of_slab[k] = static_cast<std::int32_t>(subdomains.count - 1);
    grains += slab_size[k];
    if (grains >= min_grains && k + 1 < slab_size.size()) {
      ++subdomains.count;
      grains = 0;
    }
  }
  if (subdomains.is_ring && subdomains.count % 2 == 1 && subdomains.count > 1) {
    --subdomains.count;
    for (std::int32_t& subdomain : subdomains.of_slab) {
      subdomain = std::min(subdomain, static_cast<std::int32_t>(subdomains.count - 1));
    }
  }
}

/// Calls put(k, place) for items 0 .. count - 1, whose places follow one another subdomain by
/// subdomain: a counting sort, stable and linear. `begin`: first place of each subdomain; one more
/// at the end.
template <class SubdomainOf, class Put>
void sort_by_subdomain(const ParallelFor& loop, std::size_t count, SubdomainOf subdomain,
                       Subdomains& subdomains, std::vector<std::size_t>& begin, Put put) {
  const std::size_t parts = subdomains.count;
  std::vector<std::size_t>& place = subdomains.place;
  place.assign(parts * subdomains.count, 0);
  const auto visit = [&](const auto& work) {
    parallel_chunks(loop, count, parts, [&](std::size_t part, IndexRange share) {
      std::size_t* const own = place.data() + part * subdomains.count;
      for (std::size_t k = share.first; k < share.last; ++k) work(k, own[subdomain(k)]);
    });
  };
  visit([](std::size_t, std::size_t& items) { ++items; });
  begin.assign(1, 0);
  for (std::size_t s = 0; s < subdomains.count; ++s) {
    std::size_t next = begin.back();
    for (std::size_t part = 0; part < parts; ++part) {
      next += std::exchange(place[part * subdomains.count + s], next);
    }
    begin.push_back(next);
  }
  visit([&](std::size_t k, std::size_t& next) { put(k, next++); });
}

void sort_grains(const ParallelFor& loop, Subdomains& subdomains) {
  subdomains.grains.resize(subdomains.slab.size());
  sort_by_subdomain(
      loop, subdomains.grains.size(),
      [&](std::size_t k) { return subdomains.subdomain_of(static_cast<std::int32_t>(k)); },
      subdomains, subdomains.first_grain,
      [&](std::size_t k, std::size_t place) {
        subdomains.grains[place] = static_cast<std::int32_t>(k);
      });
}

void sort_near_walls(const Candidates& candidates, Subdomains& subdomains) {
  std::vector<std::vector<std::int32_t>>& near = subdomains.near_walls;
  near.resize(std::max(near.size(), candidates.walls.size() * subdomains.count));
  for (std::vector<std::int32_t>& grains : near) grains.clear();
  for (std::size_t k = 0; k < candidates.walls.size(); ++k) {
    for (const std::int32_t grain : candidates.walls[k]) {
      near[k * subdomains.count + subdomains.subdomain_of(grain)].push_back(grain);
    }
  }
}

}  // namespace

std::size_t Subdomains::subdomain_of(GrainPair pair) const {
  const std::size_t a = subdomain_of(pair.a), b = subdomain_of(pair.b);
  const std::size_t first = std::min(a, b), second = std::max(a, b);
  return is_ring && second - first + 1 == count && count > 2 ? second : first;
}

bool Subdomains::may_hold(GrainPair pair) const {
  const std::size_t a = subdomain_of(pair.a), b = subdomain_of(pair.b);
  const std::size_t apart = std::max(a, b) - std::min(a, b);
  return apart <= 1 || (is_ring && apart + 1 == count);
}

void divide_grains(const Grains& bed, std::size_t min_grains, const Candidates& candidates,
                   const ParallelFor& loop, Subdomains& subdomains) {
  subdomains.is_ring = is_periodic(bed.box, bed.subdomain_axis);
  subdomains.count = 1;
  if (bed.subdomains > 1) {
    count_slabs(bed, candidates, loop, subdomains);
    cut(min_grains, subdomains);
    sort_grains(loop, subdomains);
  }
  sort_near_walls(candidates, subdomains);
}

void divide_pairs(const std::vector<GrainPair>& pairs, const ParallelFor& loop,
                  Subdomains& subdomains) {
  subdomains.pairs.resize(pairs.size());
  sort_by_subdomain(
      loop, pairs.size(), [&](std::size_t k) { return subdomains.subdomain_of(pairs[k]); },
      subdomains, subdomains.begin,
      [&](std::size_t k, std::size_t place) { subdomains.pairs[place] = pairs[k]; });
}

}  // namespace grainsweep
