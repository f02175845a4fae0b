// Kernels, each instruction set: items are rows for the row kernels, grains for the broad phase.
#include <algorithm>

#include "bench/beds.hpp"

namespace grainsweep::bench {
namespace {

const Kernels& table_of(const benchmark::State& run) {
  return kernels_for(static_cast<Isa>(run.range(0)));
}

void count_rows(benchmark::State& run, std::size_t blocks) {
  run.SetItemsProcessed(run.iterations() * static_cast<std::int64_t>(blocks * block_width));
  run.SetLabel(name_of(static_cast<Isa>(run.range(0))));
}

template <class Real>
void gauss_seidel_sweep(benchmark::State& run) {
  FrozenBed<Real> f = frozen_bed<Real>(run.range(1));
  const RowKernels<Real>& kernels = kernels_of<Real>(table_of(run)).rows;
  auto& contacts = f.state.contacts;
  auto& motion = f.state.motion;
  const SweepRule<Real> rule{Real(0.9), Real(0.5)};
  for (auto _ : run) {
    benchmark::DoNotOptimize(kernels.gauss_seidel_sweep(
        contacts.rows.data(), contacts.rows.size(), nullptr, motion.u.data(),
        contacts.impulse.data(), contacts.extrapolated.data(), rule));
    kernels.extrapolate(rule.momentum, motion.u.size(), motion.before.data(), motion.u.data());
  }
  count_rows(run, contacts.rows.size());
}

template <class Real>
void residual(benchmark::State& run) {
  FrozenBed<Real> f = frozen_bed<Real>(run.range(1));
  const RowKernels<Real>& kernels = kernels_of<Real>(table_of(run)).rows;
  const auto& contacts = f.state.contacts;
  for (auto _ : run) {
    benchmark::DoNotOptimize(kernels.residual(contacts.rows.data(), contacts.rows.size(), nullptr,
                                              f.state.motion.u.data(), contacts.impulse.data()));
  }
  count_rows(run, contacts.rows.size());
}

template <class Real>
void sphere_gaps(benchmark::State& run) {
  FrozenBed<Real> f = frozen_bed<Real>(run.range(1));
  const RowKernels<Real>& kernels = kernels_of<Real>(table_of(run)).rows;
  auto& contacts = f.state.contacts;
  for (auto _ : run) {
    kernels.sphere_gaps(contacts.rows.data(), contacts.pair_blocks, f.bed.position.data(),
                        f.bed.box.period_x(), f.bed.box.period_y(), 0.1);
    benchmark::ClobberMemory();
  }
  count_rows(run, contacts.pair_blocks);
}

/// With the sorting into cells: the broad phase as a step calls it.
void sphere_pairs(benchmark::State& run) {
  FrozenBed<float> f = frozen_bed<float>(run.range(1));
  Candidates candidates;
  for (auto _ : run) {
    wrap(f.bed);
    find_candidates({f.bed, f.bed.position}, 0.13, table_of(run), candidates);
    benchmark::DoNotOptimize(candidates.pairs.data());
  }
  run.SetItemsProcessed(run.iterations() * static_cast<std::int64_t>(f.bed.grains()));
  run.SetLabel(name_of(static_cast<Isa>(run.range(0))));
}

BENCHMARK_TEMPLATE(gauss_seidel_sweep, float)->Apply(all_isas);
BENCHMARK_TEMPLATE(gauss_seidel_sweep, double)->Apply(all_isas);
BENCHMARK_TEMPLATE(residual, float)->Apply(all_isas);
BENCHMARK_TEMPLATE(sphere_gaps, float)->Apply(all_isas);
BENCHMARK_TEMPLATE(sphere_gaps, double)->Apply(all_isas);
BENCHMARK(sphere_pairs)->Apply(all_isas);

}  // namespace
}  // namespace grainsweep::bench
