// Where settling stops being right: the same starts over the step and the residual tolerance,
// against the tightest of all runs.
//
//   bench_stability_map [GRAINS] [STARTS] > stability-map.csv       progress goes to standard error
//
// A preset promises its contact tolerance; an error of Z beyond twice the share of contacts that
// may be missing is more than that. Rows named after a preset are the preset itself.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

#include "engine/dynamics/presets.hpp"
#include "engine/packing.hpp"

namespace grainsweep {
namespace {

struct Point {
  std::string name;
  Accuracy accuracy;
};

/// Means over the starts that gave numbers.
struct Outcome {
  double solid_fraction = 0.0, coordination = 0.0;
  int settled = 0, measured = 0, refused = 0;
};

/// Beds 3 d wide: the starts differ in their seed alone.
PackingSpec spec_of(std::int64_t grains, std::uint64_t start, const Accuracy& accuracy) {
  PackingSpec spec;
  spec.box = {static_cast<double>(grains) / 45.0, 3.0, Boundary::periodic, Boundary::walls};
  spec.fill = GrainCount{grains};
  spec.random_key = start;
  spec.accuracy = accuracy;
  return spec;
}

Outcome settle_all(const Point& point, std::int64_t grains, int starts) {
  Outcome outcome;
  for (int k = 1; k <= starts; ++k) {
    const PackingSpec spec = spec_of(grains, static_cast<std::uint64_t>(k), point.accuracy);
    const bool refused = !check(spec).empty();
    const PackingResult result =
        refused ? PackingResult{}
                : make_packing(spec, kernels_for(best_isa()), [](const Progress&) {
                    return true;
                  }).result;
    outcome.settled += result.status == PackingStatus::settled ? 1 : 0;
    outcome.refused += result.status == PackingStatus::failed ? 1 : 0;
    if (result.coordination.empty()) continue;
    ++outcome.measured;
    outcome.solid_fraction += result.solid_fraction;
    outcome.coordination += result.coordination.front().between_grains;
  }
  outcome.solid_fraction /= std::max(outcome.measured, 1);
  outcome.coordination /= std::max(outcome.measured, 1);
  return outcome;
}

/// The tightest run: `accurate` in f64, rows solved to 1e-5 m g.
Point reference() {
  Point point{"reference", preset("accurate").value()};
  point.accuracy.precision = Precision::f64;
  point.accuracy.residual_tolerance = 1e-5;
  point.accuracy.rest_iterations = 2000;
  return point;
}

std::vector<Point> all_points() {
  std::vector<Point> points = {reference()};
  for (const Preset& known : presets()) points.push_back({std::string(known.name), known.accuracy});
  for (const double step : {0.02, 0.05, 0.1, 0.14, 0.2, 0.28, 0.4, 0.56, 0.8, 1.2, 2.0}) {
    for (const double tolerance : {1e-1, 3e-2, 1e-2, 3e-3, 1e-3, 1e-4, 1e-5, 1e-6}) {
      Accuracy a = preset("balanced").value();
      a.step = step;
      a.residual_tolerance = tolerance;
      a.max_steps = 1000;
      points.push_back({"map", a});
    }
  }
  return points;
}

/// "right", "off", "not settled" or "refused".
const char* verdict(const Point& point, const Outcome& o, const Outcome& tightest, int starts) {
  if (o.refused > 0) return "refused";
  if (o.settled < starts) return "not settled";
  const double promised = 2.0 * point.accuracy.contact_tolerance * tightest.coordination;
  return std::abs(o.coordination - tightest.coordination) <= promised ? "right" : "off";
}

}  // namespace
}  // namespace grainsweep

int main(int argc, char** argv) {
  using namespace grainsweep;
  const std::int64_t grains = argc > 1 ? std::atoll(argv[1]) : 500;
  const int starts = argc > 2 ? std::atoi(argv[2]) : 4;
  if (grains < 300 || starts < 1) {
    std::fprintf(stderr, "usage: bench_stability_map [GRAINS >= 300] [STARTS >= 1] > map.csv\n");
    return 2;
  }
  std::printf(
      "name,step,residual_tolerance,verdict,settled,starts,solid_fraction_error,"
      "coordination_error\n");
  Outcome tightest;
  for (const Point& point : all_points()) {
    const Accuracy& a = point.accuracy;
    std::fprintf(stderr, "%s: step %g, tolerance %g\n", point.name.c_str(), a.step,
                 a.residual_tolerance);
    const Outcome o = settle_all(point, grains, starts);
    if (point.name == "reference") tightest = o;
    std::printf("%s,%g,%g,%s,%d,%d,%.5f,%.4f\n", point.name.c_str(), a.step, a.residual_tolerance,
                verdict(point, o, tightest, starts), o.settled, starts,
                o.solid_fraction - tightest.solid_fraction, o.coordination - tightest.coordination);
    std::fflush(stdout);
  }
  return 0;
}
