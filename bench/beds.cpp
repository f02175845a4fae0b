#include "bench/beds.hpp"

#include <map>

#include "engine/dynamics/presets.hpp"
#include "engine/scene/start.hpp"

namespace grainsweep::bench {

namespace {

constexpr int steps_to_freeze = 100;

template <class Real>
FrozenBed<Real> freeze(std::int64_t grains) {
  FrozenBed<Real> frozen{start<Sphere>(walled_bed(grains)).value(), {}, {}};
  frozen.settings.limits = {Solver::accelerated_gauss_seidel, 80, 1e-3};
  for (int k = 0; k < steps_to_freeze; ++k) {
    step(frozen.settings, kernels_for(best_isa()), frozen.bed, frozen.state);
  }
  return frozen;
}

}  // namespace

PackingSpec walled_bed(std::int64_t grains) {
  PackingSpec spec;
  spec.box.width = grains < 250 ? 2.6 : grains < 5000 ? 5.0 : 20.0;
  // About 19 grains per d^2 of floor, the height of the reference study, down to a box of 2 d.
  spec.box.length = std::max(2.6, static_cast<double>(grains) / (19.0 * spec.box.width));
  spec.fill = GrainCount{grains};
  spec.accuracy = preset("balanced").value();
  spec.random_key = 1;
  return spec;
}

template <class Real>
const FrozenBed<Real>& frozen_bed(std::int64_t grains) {
  static std::map<std::int64_t, FrozenBed<Real>> made;
  const auto found = made.find(grains);
  return found != made.end() ? found->second
                             : made.emplace(grains, freeze<Real>(grains)).first->second;
}
template const FrozenBed<float>& frozen_bed(std::int64_t grains);
template const FrozenBed<double>& frozen_bed(std::int64_t grains);

void all_isas(benchmark::internal::Benchmark* benchmark) {
  for (const Isa isa : {Isa::sse2, Isa::avx2, Isa::avx512}) {
    if (is_supported(isa)) {
      for (const int grains : {2000, 8000, 30000}) {
        benchmark->Args({static_cast<int>(isa), grains});
      }
    }
  }
  benchmark->ArgNames({"isa", "grains"});
}

double as_counter(std::uint64_t hash) { return static_cast<double>(hash & 0xFFFFFFFFU); }

}  // namespace grainsweep::bench
