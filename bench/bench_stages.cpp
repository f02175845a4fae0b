// The stages of a step on a bed frozen in mid-fall: items are grains for stages that pass over
// grains, rows for those that pass over rows, row-iterations for the solve.
#include <cmath>

#include "bench/beds.hpp"

namespace grainsweep::bench {
namespace {

const Kernels& kernels() { return kernels_for(best_isa()); }

std::int64_t rows_of(const SphereContacts<float>& contacts) {
  return static_cast<std::int64_t>(contacts.rows.size() * block_width);
}

void sizes(benchmark::internal::Benchmark* benchmark) {
  benchmark->Arg(2000)->Arg(8000)->Arg(30000)->ArgName("grains");
}

void still_complete(benchmark::State& run) {
  FrozenBed<float> f = frozen_bed<float>(run.range(0));
  for (auto _ : run) {
    benchmark::DoNotOptimize(
        still_complete({f.bed, f.bed.position}, f.settings.near, f.state.candidates));
  }
  run.SetItemsProcessed(run.iterations() * run.range(0));
}

void find_candidates(benchmark::State& run) {
  FrozenBed<float> f = frozen_bed<float>(run.range(0));
  const double reach = f.settings.near + f.settings.margin;
  for (auto _ : run) {
    wrap(f.bed);
    find_candidates({f.bed, f.bed.position}, reach, kernels(), f.state.candidates);
  }
  run.SetItemsProcessed(run.iterations() * run.range(0));
}

void lay_out(benchmark::State& run) {
  FrozenBed<float> f = frozen_bed<float>(run.range(0));
  for (auto _ : run) {
    lay_out(f.bed, f.state.candidates, f.state.contacts);
  }
  run.SetItemsProcessed(run.iterations() * rows_of(f.state.contacts));
}

/// Moves every grain by 0.004 d, and one in fifty by 0.03 d, in directions that differ each time.
void creep_on(int turn, SphereBed& bed) {
  for (std::size_t i = 0; i < bed.grains(); ++i) {
    const double way = i % 50 == 7 ? 0.03 : 0.004;
    const double angle = static_cast<double>(turn + 1) * static_cast<double>(i + 1);
    bed.position[i].x += way * std::cos(angle);
    bed.position[i].z += way * std::sin(angle);
  }
}

/// What candidates and rows cost in a step of a bed that creeps.
void rows_of_a_step(benchmark::State& run) {
  const FrozenBed<float>& frozen = frozen_bed<float>(run.range(0));
  constexpr int steps = 50;
  for (auto _ : run) {
    run.PauseTiming();
    FrozenBed<float> f = frozen;
    run.ResumeTiming();
    for (int turn = 0; turn < steps; ++turn) {
      run.PauseTiming();
      creep_on(turn, f.bed);
      run.ResumeTiming();
      renew_rows(f.settings.near, f.settings.near + f.settings.margin, kernels(), f.bed,
                 f.state.candidates, f.state.contacts);
    }
  }
  run.SetItemsProcessed(run.iterations() * steps * run.range(0));
}

void update_gaps(benchmark::State& run) {
  FrozenBed<float> f = frozen_bed<float>(run.range(0));
  for (auto _ : run) {
    update_gaps(f.bed, kernels(), f.settings.correction, f.state.contacts);
  }
  run.SetItemsProcessed(run.iterations() * rows_of(f.state.contacts));
}

void solve(benchmark::State& run) {
  const FrozenBed<float>& frozen = frozen_bed<float>(run.range(0));
  const SolveLimits limits{Solver::accelerated_gauss_seidel, 80, 0.0};
  std::int64_t done = 0;
  for (auto _ : run) {
    run.PauseTiming();
    FrozenBed<float> f = frozen;
    run.ResumeTiming();
    done += solve(limits, kernels(), f.state.contacts, f.state.motion).iterations;
  }
  run.SetItemsProcessed(done * rows_of(frozen.state.contacts));
}

void step(benchmark::State& run) {
  const FrozenBed<float>& frozen = frozen_bed<float>(run.range(0));
  std::uint64_t hash = 0;
  for (auto _ : run) {
    run.PauseTiming();
    FrozenBed<float> f = frozen;
    run.ResumeTiming();
    step(f.settings, kernels(), f.bed, f.state);
    run.PauseTiming();
    hash = state_hash(f.bed);
    run.ResumeTiming();
  }
  run.SetItemsProcessed(run.iterations() * run.range(0));
  run.counters["state_hash"] = as_counter(hash);
}

BENCHMARK(still_complete)->Apply(sizes);
BENCHMARK(find_candidates)->Apply(sizes);
BENCHMARK(lay_out)->Apply(sizes);
BENCHMARK(rows_of_a_step)->Apply(sizes)->Unit(benchmark::kMillisecond);
BENCHMARK(update_gaps)->Apply(sizes);
BENCHMARK(solve)->Apply(sizes)->Unit(benchmark::kMillisecond);
BENCHMARK(step)->Apply(sizes)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace grainsweep::bench
