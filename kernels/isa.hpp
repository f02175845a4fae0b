// Instruction sets the kernels are compiled for, and the choice among them at run time.
#pragma once

namespace grainsweep {

enum class Isa { sse2, avx2, avx512 };

/// "sse2", "avx2", "avx512".
const char* name_of(Isa isa);

/// Whether this processor and its operating system can run kernels compiled for `isa`.
bool is_supported(Isa isa);

/// The widest supported instruction set.
Isa best_isa();

/// Sets `isa` from its name, as `name_of` prints it; false if there is no such name.
bool isa_from_name(const char* name, Isa& isa);

}  // namespace grainsweep
