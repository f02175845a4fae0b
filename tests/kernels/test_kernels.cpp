#include <catch2/catch.hpp>

#include "kernels/kernels.hpp"
#include "tests/support/instruction_sets.hpp"

namespace grainsweep {
namespace {

constexpr Isa all[] = {Isa::sse2, Isa::avx2, Isa::avx512};

TEST_CASE("an instruction set is read back from its name") {
  for (const Isa isa : all) {
    Isa read = isa == Isa::sse2 ? Isa::avx2 : Isa::sse2;
    CHECK(isa_from_name(name_of(isa), read));
    CHECK(read == isa);
  }
}

TEST_CASE("an unknown name is refused and changes nothing") {
  for (const char* name : {"", "neon", "AVX2", "avx", "avx5120"}) {
    INFO(name);
    Isa isa = Isa::avx2;
    CHECK_FALSE(isa_from_name(name, isa));
    CHECK(isa == Isa::avx2);
  }
}

TEST_CASE("the best instruction set is the widest that runs here") {
  CHECK(is_supported(Isa::sse2));  // part of every x86-64 processor
  CHECK(is_supported(best_isa()));
  for (const Isa isa : all) {
    CHECK((!is_supported(isa) || isa <= best_isa()));
  }
}

TEST_CASE("each table holds the kernels of its own instruction set") {
  for (const Isa isa : all) {
    INFO(name_of(isa));
    const Kernels& own = kernels_for(isa);
    CHECK(own.isa == isa);
    for (const Isa other : all) {
      const Kernels& theirs = kernels_for(other);
      CHECK((own.sphere_pairs == theirs.sphere_pairs) == (isa == other));
      CHECK((own.f32.fronts.factor == theirs.f32.fronts.factor) == (isa == other));
      CHECK((own.f64.fronts.factor == theirs.f64.fronts.factor) == (isa == other));
      CHECK((own.f32.rows.gauss_seidel_sweep == theirs.f32.rows.gauss_seidel_sweep) ==
            (isa == other));
      CHECK((own.f64.rows.gauss_seidel_sweep == theirs.f64.rows.gauss_seidel_sweep) ==
            (isa == other));
      CHECK((own.f32.rows.accumulate_impulses == theirs.f32.rows.accumulate_impulses) ==
            (isa == other));
      CHECK((own.f64.rows.residual == theirs.f64.rows.residual) == (isa == other));
      CHECK((own.f64.rows.sphere_gaps == theirs.f64.rows.sphere_gaps) == (isa == other));
    }
  }
}

TEST_CASE("the kernels of a table are found by their number type") {
  const Kernels& kernels = kernels_for(Isa::sse2);
  CHECK(&kernels_of<float>(kernels) == &kernels.f32);
  CHECK(&kernels_of<double>(kernels) == &kernels.f64);
}

/// Names grains 3 and 5 in lane 2 of a block and reads them back.
template <class Block>
void check_grains(std::uint32_t grain_bytes) {
  Block block{};
  block.set_grains(2, 3, 5);
  CHECK(block.offset_a[2] == 3 * grain_bytes);
  CHECK(block.offset_b[2] == 5 * grain_bytes);
  CHECK(block.a(2) == 3);
  CHECK(block.b(2) == 5);
  CHECK(block.a(1) == 0);
}

TEST_CASE("blocks name grains by where their records begin, which bodies have two of") {
  check_grains<RowBlock<float>>(16);
  check_grains<RowBlock<double>>(32);
  check_grains<BodyBlock<float>>(32);
  check_grains<BodyBlock<double>>(64);
  check_grains<PinacoidBlock>(32);
}

}  // namespace
}  // namespace grainsweep
