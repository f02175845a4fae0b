// Whole packings, from the start to the measured values, on one thread. Items are packings.
#include "bench/beds.hpp"
#include "engine/dynamics/presets.hpp"

namespace grainsweep::bench {
namespace {

void make(benchmark::State& run, const PackingSpec& spec) {
  PackingResult result;
  for (auto _ : run) {
    result =
        make_packing(spec, kernels_for(best_isa()), [](const Progress&) { return true; }).result;
  }
  run.SetItemsProcessed(run.iterations());
  run.SetLabel(name_of(result.status));
  run.counters["state_hash"] = as_counter(result.state_hash);
  run.counters["iterations"] = static_cast<double>(result.iterations);
  run.counters["overlap_mean"] = result.rest.overlap_mean;
  run.counters["contact_ratio"] = static_cast<double>(result.rest.contacts) /
                                  static_cast<double>(result.rest.isostatic_contacts);
  run.counters["solid_fraction"] = result.solid_fraction;
  run.counters["coordination"] =
      result.coordination.empty() ? 0.0 : result.coordination.front().between_grains;
}

void packing(benchmark::State& run, const char* preset_name) {
  PackingSpec spec = walled_bed(run.range(0));
  spec.accuracy = preset(preset_name).value();
  make(run, spec);
}

BENCHMARK_CAPTURE(packing, fast, "fast")->Arg(2000)->Arg(8000)->Unit(benchmark::kSecond);
BENCHMARK_CAPTURE(packing, balanced, "balanced")
    ->Arg(100)
    ->Arg(200)
    ->Arg(500)
    ->Arg(1000)
    ->Arg(2000)
    ->Arg(8000)
    ->Arg(30000)
    ->Unit(benchmark::kSecond);
BENCHMARK_CAPTURE(packing, accurate, "accurate")->Arg(2000)->Unit(benchmark::kSecond);

}  // namespace
}  // namespace grainsweep::bench
