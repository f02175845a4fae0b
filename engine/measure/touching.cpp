#include "engine/measure/touching.hpp"

#include "engine/contact/candidates.hpp"
#include "engine/contact/contacts.hpp"

namespace grainsweep {

namespace {

void add_pairs(const SphereBed& bed, const Contacts<double>& contacts, double gap_tolerance,
               Touching& touching) {
  for (std::size_t block = 0; block < contacts.pair_blocks; ++block) {
    const RowBlock<double>& r = contacts.rows[block];
    for (std::size_t lane = 0; lane < block_width; ++lane) {
      if (!bed.is_void(r.a(lane)) && r.gap[lane] < gap_tolerance) {
        touching.pairs.push_back({r.a(lane), r.b(lane), r.gap[lane]});
      }
    }
  }
}

void add_walls(const SphereBed& bed, const Candidates& candidates, double gap_tolerance,
               Touching& touching) {
  for (std::size_t k = 0; k < candidates.walls.size(); ++k) {
    for (const std::int32_t grain : candidates.walls[k].grains) {
      const double gap =
          candidates.walls[k].wall.gap(bed.position[static_cast<std::size_t>(grain)]);
      if (gap < gap_tolerance) {
        touching.walls.push_back({grain, static_cast<std::int32_t>(k), gap});
      }
    }
  }
}

}  // namespace

Touching find_touching(SphereBed& bed, double gap_tolerance, const Kernels& kernels) {
  Candidates candidates;
  Contacts<double> contacts;
  Touching touching;
  find_candidates(bed, gap_tolerance, kernels, candidates);
  lay_out(bed, candidates, contacts);
  detect(bed, kernels, 1.0, contacts);
  add_pairs(bed, contacts, gap_tolerance, touching);
  add_walls(bed, candidates, gap_tolerance, touching);
  return touching;
}

}  // namespace grainsweep
