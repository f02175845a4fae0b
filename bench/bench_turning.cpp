// Rows with levers, on a bed of pinacoids frozen in mid-fall: items are rows.
#include <benchmark/benchmark.h>

#include "engine/dynamics/step.hpp"
#include "engine/scene/start.hpp"
#include "engine/shape/pinacoid.hpp"

namespace grainsweep::bench {
namespace {

template <class Real>
struct FrozenShapes {
  PolyhedronBed bed;
  StepState<Polyhedron, Real> state;
};

/// A bed W = 5 wide of about so many pinacoids, 60 steps after its start.
template <class Real>
FrozenShapes<Real> frozen_shapes(double grains) {
  PackingSpec spec;
  spec.box = {20, 5, Boundary::periodic, Boundary::walls};
  spec.fill = GrainCount{static_cast<std::int64_t>(grains)};
  spec.shape = PinacoidSize{};
  FrozenShapes<Real> frozen{*start<Polyhedron>(spec), {}};
  StepSettings settings{0.2, 0.95, 0.2, 0.05, 0.05, {}};
  settings.limits.iterations = 40;
  for (int k = 0; k < 60; ++k) {
    step(settings, kernels_for(best_isa()), frozen.bed, frozen.state);
  }
  return frozen;
}

template <class Real>
void count_rows(benchmark::State& run, const FrozenShapes<Real>& frozen, Isa isa) {
  const auto rows = static_cast<double>(frozen.state.contacts.parts.front().found.points.size());
  run.SetItemsProcessed(run.iterations() * static_cast<std::int64_t>(rows));
  run.counters["per_row"] = benchmark::Counter(
      rows, benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
  run.SetLabel(name_of(isa));
}

/// Calls sweep(kernels, rows, blocks, state) again and again.
template <class Real, class Sweep>
void over_rows(benchmark::State& run, Sweep sweep) {
  static FrozenShapes<Real> frozen = frozen_shapes<Real>(3600);
  const auto isa = static_cast<Isa>(run.range(0));
  auto& rows = frozen.state.contacts;
  for (auto _ : run) {
    sweep(kernels_of<Real>(kernels_for(isa)).bodies,
          BodyRows<Real>{rows.blocks.data(), rows.points.data()}, rows.blocks.size(), frozen.state);
  }
  count_rows(run, frozen, isa);
}

template <class Real>
void body_gauss_seidel_sweep(benchmark::State& run) {
  over_rows<Real>(run, [](const auto& kernels, auto rows, std::size_t blocks, auto& state) {
    benchmark::DoNotOptimize(kernels.gauss_seidel_sweep(
        rows, blocks, state.motion.u.data(), state.contacts.impulse.data(),
        state.contacts.extrapolated.data(), SweepRule<Real>{Real(0.9), Real(0.5)}));
  });
}

void isas(benchmark::internal::Benchmark* benchmark) {
  for (const Isa isa : {Isa::sse2, Isa::avx2, Isa::avx512}) {
    if (is_supported(isa)) benchmark->Arg(static_cast<int>(isa));
  }
}

BENCHMARK_TEMPLATE(body_gauss_seidel_sweep, float)->Apply(isas);
BENCHMARK_TEMPLATE(body_gauss_seidel_sweep, double)->Apply(isas);

void shape_step(benchmark::State& run) {
  const FrozenShapes<float> frozen = frozen_shapes<float>(static_cast<double>(run.range(0)));
  StepSettings settings{0.2, 0.9, 0.1, 0.03, 0.05, {}};
  settings.limits = {Solver::accelerated_gauss_seidel, 40, 0.0};
  for (auto _ : run) {
    run.PauseTiming();
    FrozenShapes<float> f = frozen;
    run.ResumeTiming();
    step(settings, kernels_for(best_isa()), f.bed, f.state);
  }
  run.SetItemsProcessed(run.iterations() * run.range(0));
}
BENCHMARK(shape_step)->Arg(600)->Arg(3600)->ArgName("grains")->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace grainsweep::bench
