// Steps must not ask for memory: beds of a hundred grains take 50 microseconds a step.
#include <atomic>
#include <cstdlib>
#include <new>

#include <catch2/catch.hpp>

#include "engine/dynamics/workspace.hpp"
#include "engine/scene/start.hpp"
#include "tests/support/instruction_sets.hpp"

namespace {

std::atomic<long> allocations{0};

void* counted(std::size_t size, std::size_t alignment) {
  ++allocations;
  void* memory = std::aligned_alloc(alignment, (size + alignment - 1) / alignment * alignment);
  if (memory == nullptr) throw std::bad_alloc();
  return memory;
}

}  // namespace

void* operator new(std::size_t size) { return counted(size, __STDCPP_DEFAULT_NEW_ALIGNMENT__); }
void* operator new(std::size_t size, std::align_val_t alignment) {
  return counted(size, static_cast<std::size_t>(alignment));
}
[[gnu::noinline]] void operator delete(void* memory) noexcept { std::free(memory); }
[[gnu::noinline]] void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }
[[gnu::noinline]] void operator delete(void* memory, std::align_val_t) noexcept {
  std::free(memory);
}
[[gnu::noinline]] void operator delete(void* memory, std::size_t, std::align_val_t) noexcept {
  std::free(memory);
}

namespace grainsweep {
namespace {

SphereBed loose_bed(double small_share) {
  PackingSpec spec;
  spec.box = {5, 5, Boundary::periodic, Boundary::walls};
  spec.fill = GrainCount{300};
  spec.sizes.small_share = small_share;
  spec.random_key = 3;
  return *start<Sphere>(spec);
}

/// Allocations in steps first .. last of a bed that falls.
template <class Real>
long allocations_in_steps(int first, int last, SphereBed bed, StepState<Sphere, Real>& state) {
  StepSettings settings;
  settings.limits = {Solver::accelerated_gauss_seidel, 20, 1e-3};
  const ExecutionContext context(kernels_for(best_isa()));
  long before = 0;
  for (int k = 0; k < last; ++k) {
    if (k == first) before = allocations;
    step(settings, context, bed, state);
  }
  return allocations - before;
}

TEST_CASE("the counter sees what is allocated") {
  const long before = allocations;
  void* const memory = ::operator new(1);
  const long counted = allocations - before;
  ::operator delete(memory);
  CHECK(counted == 1);
}

TEMPLATE_TEST_CASE("a step allocates nothing, once lists have their size", "", float, double) {
  for (const double small_share : {0.0, 0.3}) {
    StepState<Sphere, TestType> state;
    CHECK(allocations_in_steps(0, 200, loose_bed(small_share), state) > 0);
    forget(state);
    CHECK(allocations_in_steps(0, 200, loose_bed(small_share), state) == 0);
  }
}

}  // namespace
}  // namespace grainsweep
