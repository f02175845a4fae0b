// The start that all codes settle: loose random spheres between two walls, as the engine's own
// `start` stage makes them, in a box of the reference study's height: 20 grains per d^2 of floor.
//
//   peers_write_start GRAINS SEED > start.csv        columns x,y,z,r in d
#include <cstdio>
#include <cstdlib>

#include "bench/peers/peer_bed.hpp"
#include "engine/scene/start.hpp"
#include "runner/tables/csv.hpp"

namespace grainsweep::bench {
namespace {

void print(const SphereBed& bed) {
  std::printf("x,y,z,r\n");
  for (std::size_t i = 0; i < bed.grains(); ++i) {
    const Record<double>& p = bed.position[i];
    std::printf("%s", csv_line({cell(p.x), cell(p.y), cell(p.z), cell(p.w)}).c_str());
  }
}

}  // namespace
}  // namespace grainsweep::bench

int main(int argc, char** argv) {
  using namespace grainsweep::bench;
  const std::int64_t grains = argc == 3 ? std::atoll(argv[1]) : 0;
  const grainsweep::PackingSpec spec =
      peer_bed(grains, std::strtoull(argc == 3 ? argv[2] : "0", nullptr, 10));
  if (grains < 1 || !grainsweep::check(spec).empty()) {
    std::fprintf(stderr,
                 "usage: peers_write_start GRAINS SEED > start.csv    (at least 300 grains)\n");
    return 2;
  }
  print(grainsweep::start<grainsweep::Sphere>(spec).value());
  return 0;
}
