// The instruction sets that a test can run on this machine.
#pragma once

#include <string>
#include <vector>

#include <catch2/catch.hpp>

#include "kernels/isa.hpp"
#include "kernels/kernels.hpp"

namespace grainsweep::testing {

/// All that are supported here; each other one is named in a warning, so that no test passes
/// without saying what it left out.
inline std::vector<Isa> testable_isas() {
  std::vector<Isa> testable;
  for (const Isa isa : {Isa::sse2, Isa::avx2, Isa::avx512}) {
    if (is_supported(isa)) {
      testable.push_back(isa);
    } else {
      WARN(std::string("not tested, this machine cannot run it: ") + name_of(isa));
    }
  }
  return testable;
}

/// The kernels of the widest instruction set that runs here.
inline const Kernels& kernels() { return kernels_for(best_isa()); }

}  // namespace grainsweep::testing
