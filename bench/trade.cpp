// The trade of speed for accuracy: the same starts settled with one part of the accuracy changed at
// a time, against a reference that is solved an order of magnitude tighter.
//
//   bench_trade [GRAINS] [STARTS] > trade.csv        progress goes to standard error
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <string>
#include <vector>

#include "bench/beds.hpp"
#include "engine/dynamics/presets.hpp"

namespace grainsweep::bench {
namespace {

struct Setting {
  std::string name;
  std::string group;  ///< what was changed; "preset" and "reference" are drawn as such
  Accuracy accuracy;
};

/// Means over the starts.
struct Outcome {
  double cpu_seconds = 0.0;
  double solid_fraction = 0.0;
  double coordination = 0.0;
  double contact_ratio = 0.0;
  double overlap_mean = 0.0;
  double residual = 0.0;
  double iterations = 0.0;
  int settled = 0;
};

template <class Change>
Setting changed(const char* group, const std::string& name, Change change) {
  Setting setting{name, group, preset("balanced").value()};
  change(setting.accuracy);
  return setting;
}

/// Tight in every part but the step: long solves in f64, a long creep.
Accuracy reference() {
  Accuracy a = preset("accurate").value();
  a.precision = Precision::f64;
  a.fall_iterations *= 2;
  a.creep_steps *= 3;
  a.rest_iterations *= 2;
  a.residual_tolerance /= 10.0;
  return a;
}

void add_solvers(std::vector<Setting>& settings) {
  const std::pair<Solver, const char*> solvers[] = {
      {Solver::projected_gauss_seidel, "pgs"},
      {Solver::symmetric_gauss_seidel, "symmetric_pgs"},
      {Solver::nonsmooth_nonlinear_conjugate, "nncg"},
      {Solver::accelerated_projected_gradient, "apgd"}};
  for (const auto& [solver, name] : solvers) {
    for (const Precision precision : {Precision::f32, Precision::f64}) {
      const char* suffix = precision == Precision::f32 ? " f32" : " f64";
      settings.push_back(changed("solver", name + std::string(suffix), [&](Accuracy& a) {
        a.solver = solver;
        a.precision = precision;
        a.max_steps = 400;
      }));
    }
  }
}

std::vector<Setting> all_settings() {
  std::vector<Setting> settings = {{"reference", "reference", reference()}};
  for (const Preset& known : presets()) {
    settings.push_back({std::string(known.name), "preset", known.accuracy});
  }
  add_solvers(settings);
  for (const int iterations : {20, 40, 160, 320}) {
    settings.push_back(changed("fall iterations", "fall " + std::to_string(iterations),
                               [&](Accuracy& a) { a.fall_iterations = iterations; }));
  }
  for (const int steps : {0, 15, 120, 240}) {
    settings.push_back(changed("creep steps", "creep " + std::to_string(steps),
                               [&](Accuracy& a) { a.creep_steps = steps; }));
  }
  for (const int iterations : {75, 150, 600, 1200}) {
    settings.push_back(changed("rest iterations", "rest " + std::to_string(iterations),
                               [&](Accuracy& a) { a.rest_iterations = iterations; }));
  }
  settings.push_back(changed("protocol", "dynamic", [](Accuracy& a) {
    a.protocol = Protocol::dynamic;
    a.max_steps = 6000;
  }));
  for (const double step : {0.05, 0.1, 0.14, 0.28}) {
    settings.push_back(changed("step", "step " + std::to_string(step).substr(0, 4),
                               [&](Accuracy& a) { a.step = step; }));
  }
  return settings;
}

double cpu_seconds() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

void add(const PackingResult& result, double share, Outcome& outcome) {
  outcome.solid_fraction += share * result.solid_fraction;
  outcome.coordination +=
      share * (result.coordination.empty() ? 0.0 : result.coordination.front().between_grains);
  outcome.contact_ratio += share * static_cast<double>(result.rest.contacts) /
                           static_cast<double>(result.rest.isostatic_contacts);
  outcome.overlap_mean += share * result.rest.overlap_mean;
  outcome.residual += share * result.rest.residual;
  outcome.iterations += share * static_cast<double>(result.iterations);
  outcome.settled += result.status == PackingStatus::settled ? 1 : 0;
}

Outcome settle_all(const Setting& setting, std::int64_t grains, int starts) {
  Outcome outcome;
  for (int k = 0; k < starts; ++k) {
    PackingSpec spec = walled_bed(grains);
    spec.random_key = static_cast<std::uint64_t>(k) + 1;
    spec.accuracy = setting.accuracy;
    const double began = cpu_seconds();
    const Packing packing =
        make_packing(spec, kernels_for(best_isa()), [](const Progress&) { return true; });
    outcome.cpu_seconds += (cpu_seconds() - began) / starts;
    add(packing.result, 1.0 / starts, outcome);
  }
  return outcome;
}

void print(const Setting& setting, const Outcome& o, const Outcome& reference, int starts) {
  std::printf("%s,%s,%.4g,%.5f,%.4f,%.2e,%.2e,%.4f,%.2e,%.2e,%.0f,%d,%d\n", setting.name.c_str(),
              setting.group.c_str(), o.cpu_seconds, o.solid_fraction, o.coordination,
              o.solid_fraction - reference.solid_fraction, o.coordination - reference.coordination,
              o.contact_ratio, o.overlap_mean, o.residual, o.iterations, o.settled, starts);
  std::fflush(stdout);
}

}  // namespace
}  // namespace grainsweep::bench

int main(int argc, char** argv) {
  using namespace grainsweep::bench;
  const std::int64_t grains = argc > 1 ? std::atoll(argv[1]) : 2000;
  const int starts = argc > 2 ? std::atoi(argv[2]) : 3;
  if (grains < 100 || starts < 1) {
    std::fprintf(stderr, "usage: bench_trade [GRAINS >= 100] [STARTS >= 1] > trade.csv\n");
    return 2;
  }
  std::printf(
      "name,group,cpu_seconds,solid_fraction,coordination,solid_fraction_error,"
      "coordination_error,contact_ratio,overlap_mean,residual,iterations,settled,starts\n");
  Outcome reference;
  for (const Setting& setting : all_settings()) {
    std::fprintf(stderr, "%s\n", setting.name.c_str());
    const Outcome outcome = settle_all(setting, grains, starts);
    reference = setting.group == "reference" ? outcome : reference;
    print(setting, outcome, reference, starts);
  }
  return 0;
}
