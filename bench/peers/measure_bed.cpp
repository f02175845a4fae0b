// Measures one settled bed of bench/peers/run.sh, from whatever code it comes.
//
//   peers_measure_bed BED.csv LENGTH WIDTH      BED.csv names x,y,z,r (or radius), in d;
//                                               periodic along x, walls along y, floor at z = 0
#include <cstdio>
#include <cstdlib>

#include "bench/peers/bed_measures.hpp"
#include "kernels/kernels.hpp"
#include "runner/sweep/grains_csv.hpp"
#include "runner/sweep/job.hpp"

namespace grainsweep::bench {
namespace {

int measure_file(const char* path, const Box& box) {
  const GrainsReading reading = read_grains(path);
  for (const Diagnostic& error : reading.errors) {
    std::fprintf(stderr, "%s\n", to_string(error).c_str());
  }
  if (!reading.errors.empty()) return 2;
  SphereBed bed = make_bed(box, reading.grains);
  const BedMeasures measures = measures_of(bed, MeasureSpec{}, kernels_for(best_isa()));
  std::printf("%s%s", csv_header().c_str(), csv_row(measures).c_str());
  return 0;
}

}  // namespace
}  // namespace grainsweep::bench

int main(int argc, char** argv) {
  const double length = argc == 4 ? std::atof(argv[2]) : 0.0;
  const double width = argc == 4 ? std::atof(argv[3]) : 0.0;
  if (!(length >= 2.0 && width >= 1.0)) {
    std::fprintf(stderr,
                 "usage: peers_measure_bed BED.csv LENGTH WIDTH    (length and width in d)\n");
    return 2;
  }
  return grainsweep::bench::measure_file(argv[1], {length, width});
}
