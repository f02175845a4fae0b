// The beds that benchmarks work on: always the same bits.
#pragma once

#include <benchmark/benchmark.h>

#include "engine/dynamics/step.hpp"
#include "engine/packing.hpp"

namespace grainsweep::bench {

/// A bed of `grains` spheres between walls 5 d apart (20 d from 5000 grains on), settled at
/// `balanced`.
PackingSpec walled_bed(std::int64_t grains);

/// A bed stopped in mid-fall, where a third of it already lies: the state a step works on.
template <class Real>
struct FrozenBed {
  SphereBed bed;
  StepState<Sphere, Real> state;
  StepSettings settings;
};

/// The frozen bed of that many grains, for rows of float or double; made once per process.
template <class Real>
const FrozenBed<Real>& frozen_bed(std::int64_t grains);

/// Instruction sets of this machine, as benchmark arguments.
void all_isas(benchmark::internal::Benchmark* benchmark);

/// The low 32 bits of a hash: exact as a counter, which is a double.
double as_counter(std::uint64_t hash);

}  // namespace grainsweep::bench
