#include <cstdlib>

#include <catch2/catch.hpp>

#include "runner/exit_codes.hpp"
#include "runner/instruction_set.hpp"

namespace grainsweep {
namespace {

/// GRAINSWEEP_ISA for the length of a test.
class ForcedIsa {
 public:
  explicit ForcedIsa(const char* name) { setenv("GRAINSWEEP_ISA", name, 1); }
  ForcedIsa(const ForcedIsa&) = delete;
  ForcedIsa& operator=(const ForcedIsa&) = delete;
  ~ForcedIsa() { unsetenv("GRAINSWEEP_ISA"); }
};

TEST_CASE("without a wish the widest instruction set is taken") {
  unsetenv("GRAINSWEEP_ISA");
  CHECK(choose_isa("") == best_isa());
  const ForcedIsa empty("");
  CHECK(choose_isa("") == best_isa());
}

TEST_CASE("the option wins over the environment, which wins over the widest") {
  const ForcedIsa forced("sse2");
  CHECK(choose_isa("") == Isa::sse2);
  const ForcedIsa unknown("mmx");
  CHECK(choose_isa("sse2") == Isa::sse2);
  CHECK_THROWS_WITH(choose_isa(""),
                    Catch::StartsWith("GRAINSWEEP_ISA: \"mmx\" is not an instruction"));
}

TEST_CASE("a name that does not exist or cannot run here is refused with those that can") {
  CHECK_THROWS_AS(choose_isa("avx9"), BadInput);
  CHECK_THROWS_WITH(choose_isa("avx9"), Catch::EndsWith("use one of " + supported_isas()));
  for (const Isa isa : {Isa::sse2, Isa::avx2, Isa::avx512}) {
    if (is_supported(isa)) {
      CHECK(choose_isa(name_of(isa)) == isa);
    } else {
      CHECK_THROWS_WITH(choose_isa(name_of(isa)), Catch::Contains("this machine cannot run"));
    }
  }
}

}  // namespace
}  // namespace grainsweep
