// The trade of speed for accuracy: the same starts settled with one part of the accuracy changed at
// a time, against a reference: the accurate preset in f64 with well solved steps.
//
//   bench_trade [GRAINS] [STARTS] > trade.csv        progress goes to standard error
#include <algorithm>
#include <cmath>
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

/// The accurate preset in f64, its fall and creep straying a quarter as far, its rest solved ten
/// times as well.
Accuracy reference() {
  Accuracy a = preset("accurate").value();
  a.precision = Precision::f64;
  a.path_tolerance /= 4.0;
  a.rest_iterations *= 5;
  a.residual_tolerance /= 10.0;
  return a;
}

void add_solvers(std::vector<Setting>& settings) {
  const std::pair<Solver, const char*> solvers[] = {{Solver::projected_gauss_seidel, "pgs"},
                                                    {Solver::accelerated_gauss_seidel, "apgs"}};
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

/// One setting per value of a part of the accuracy.
template <class Change>
void add_range(std::vector<Setting>& settings, const char* group,
               std::initializer_list<double> values, Change change) {
  for (const double value : values) {
    char name[64];
    std::snprintf(name, sizeof name, "%s %g", group, value);
    settings.push_back(changed(group, name, [&](Accuracy& a) { change(a, value); }));
  }
}

std::vector<Setting> all_settings() {
  std::vector<Setting> settings = {{"reference", "reference", reference()}};
  for (const Preset& known : presets()) {
    settings.push_back({std::string(known.name), "preset", known.accuracy});
  }
  add_solvers(settings);
  add_range(settings, "path tolerance", {8e-4, 4e-4, 1e-4, 5e-5},
            [](Accuracy& a, double value) { a.path_tolerance = value; });
  add_range(settings, "creep steps", {0, 80, 160, 1280},
            [](Accuracy& a, double value) { a.creep_steps = static_cast<int>(value); });
  add_range(settings, "rest iterations", {25, 50, 200, 400},
            [](Accuracy& a, double value) { a.rest_iterations = static_cast<int>(value); });
  add_range(settings, "residual tolerance", {5e-2, 2e-2, 1e-3, 5e-4},
            [](Accuracy& a, double value) { a.residual_tolerance = value; });
  add_range(settings, "step", {0.1, 0.14, 0.28}, [](Accuracy& a, double value) { a.step = value; });
  settings.push_back(changed("protocol", "dynamic", [](Accuracy& a) {
    a.protocol = Protocol::dynamic;
    a.max_steps = 6000;
  }));
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
  outcome.residual += share * result.rest.step_residual;
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

double missing_contacts(const Outcome& o) { return std::abs(1.0 - o.contact_ratio); }

/// Whether no other setting is cheaper and nearer to the isostatic number of contacts.
bool is_on_front(const Outcome& o, const std::vector<Outcome>& all) {
  return std::none_of(all.begin(), all.end(), [&](const Outcome& other) {
    return other.cpu_seconds < o.cpu_seconds && missing_contacts(other) < missing_contacts(o);
  });
}

void print(const Setting& setting, const Outcome& o, const std::vector<Outcome>& all, int starts) {
  const Outcome& reference = all.front();
  std::printf("%s,%s,%.4g,%.5f,%.4f,%.2e,%.2e,%.4f,%.2e,%.2e,%.0f,%d,%d,%d\n", setting.name.c_str(),
              setting.group.c_str(), o.cpu_seconds, o.solid_fraction, o.coordination,
              o.solid_fraction - reference.solid_fraction, o.coordination - reference.coordination,
              o.contact_ratio, o.overlap_mean, o.residual, o.iterations, o.settled, starts,
              is_on_front(o, all) ? 1 : 0);
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
      "coordination_error,contact_ratio,overlap_mean,residual,iterations,settled,starts,on_"
      "front\n");
  const std::vector<Setting> settings = all_settings();
  std::vector<Outcome> outcomes;
  for (const Setting& setting : settings) {
    std::fprintf(stderr, "%2zu/%zu  %s\n", outcomes.size() + 1, settings.size(),
                 setting.name.c_str());
    outcomes.push_back(settle_all(setting, grains, starts));
  }
  for (std::size_t k = 0; k < settings.size(); ++k) {
    print(settings[k], outcomes[k], outcomes, starts);
  }
  return 0;
}
