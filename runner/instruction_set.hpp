// The instruction set the kernels run with: the widest one, or the one that was asked for.
#pragma once

#include <string>

#include "kernels/isa.hpp"

namespace grainsweep {

/// `option` is the value of --isa, empty if not given; then the environment variable GRAINSWEEP_ISA
/// decides, and without it the widest supported set. Throws BadInput for a name that does not exist
/// or that this machine cannot run.
Isa choose_isa(const std::string& option);

/// "sse2, avx2": those this machine can run.
std::string supported_isas();

}  // namespace grainsweep
