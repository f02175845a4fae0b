#include <catch2/catch.hpp>

#include "engine/dynamics/presets.hpp"
#include "engine/dynamics/workspace.hpp"
#include "engine/packing.hpp"
#include "tests/support/instruction_sets.hpp"
#include "tests/support/keep_going.hpp"

namespace grainsweep {
namespace {

using testing::always;

PackingSpec small_bed(std::int64_t grains, double width, Precision precision) {
  PackingSpec spec;
  spec.box = {6, width, Boundary::periodic, Boundary::walls};
  spec.fill = GrainCount{grains};
  spec.accuracy = *preset("fast");
  spec.accuracy.precision = precision;
  spec.random_key = 11;
  return spec;
}

/// The same in fresh memory and in what earlier packings have left; leaves a stopped one behind.
void check_same(const PackingSpec& spec, const ExecutionContext& used) {
  const PackingResult fresh = make_packing(spec, kernels_for(best_isa()), always).result;
  const PackingResult again = make_packing(spec, used, always).result;
  CHECK(again.state_hash == fresh.state_hash);
  CHECK(again.iterations == fresh.iterations);
  CHECK(again.rest.contacts == fresh.rest.contacts);
  CHECK(again.status == fresh.status);
  make_packing(spec, used, [](const Progress& progress) { return progress.step < 30; });
}

// Larger, smaller, another number type, and one that was stopped half-way: all leave rows and
// impulses behind.
TEST_CASE("a packing has the same bits in the memory that others have left") {
  Workspace workspace;
  const ExecutionContext used(kernels_for(best_isa()), serial_for, &workspace);
  for (const PackingSpec& spec :
       {small_bed(300, 5, Precision::f32), small_bed(80, 3, Precision::f32),
        small_bed(80, 3, Precision::f64), small_bed(300, 5, Precision::f32)}) {
    check_same(spec, used);
  }
}

// As many grains in another box, of another shape, in another number type.
TEST_CASE("a packing of shapes has the same bits in the memory that others have left") {
  Workspace workspace;
  const ExecutionContext used(kernels_for(best_isa()), serial_for, &workspace);
  PackingSpec walled = small_bed(36, 5, Precision::f32);
  walled.shape = PinacoidSize{};
  PackingSpec open = walled, hulls = walled, fine = walled;
  open.box.y = Boundary::periodic;
  hulls.shape = HullVertices{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0.8, 0.8, 0.8}}};
  fine.accuracy.precision = Precision::f64;
  for (const PackingSpec& spec : {walled, open, walled, hulls, open, fine, walled}) {
    check_same(spec, used);
  }
}

}  // namespace
}  // namespace grainsweep
