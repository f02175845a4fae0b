#include "kernels/kernels.hpp"

#include <cstring>

namespace grainsweep {

// Each compiled for its instruction set, in table.cpp.
namespace sse2 {
extern const Kernels table;
}
namespace avx2 {
extern const Kernels table;
}
namespace avx512 {
extern const Kernels table;
}

namespace {

// All instruction sets that the kernels are compiled with.
constexpr Isa all[] = {Isa::sse2, Isa::avx2, Isa::avx512};

}  // namespace

const char* name_of(Isa isa) {
  constexpr const char* names[] = {"sse2", "avx2", "avx512"};  // in order of Isa
  return names[static_cast<int>(isa)];
}

// The compiler's test reads the processor and also asks whether the operating system saves the
// registers.
bool is_supported(Isa isa) {
  switch (isa) {
    case Isa::sse2:
      return __builtin_cpu_supports("sse2") != 0;
    case Isa::avx2:
      return __builtin_cpu_supports("avx2") != 0 && __builtin_cpu_supports("fma") != 0;
    case Isa::avx512:
      return __builtin_cpu_supports("avx512f") != 0 && __builtin_cpu_supports("avx512cd") != 0 &&
             __builtin_cpu_supports("avx512dq") != 0 && __builtin_cpu_supports("avx512bw") != 0 &&
             __builtin_cpu_supports("avx512vl") != 0 && __builtin_cpu_supports("avx2") != 0 &&
             __builtin_cpu_supports("fma") != 0;
  }
  return false;
}

Isa best_isa() {
  Isa best = Isa::sse2;
  for (const Isa isa : all) {
    best = is_supported(isa) ? isa : best;
  }
  return best;
}

bool isa_from_name(const char* name, Isa& isa) {
  for (const Isa candidate : all) {
    if (std::strcmp(name, name_of(candidate)) == 0) {
      isa = candidate;
      return true;
    }
  }
  return false;
}

const Kernels& kernels_for(Isa isa) {
  const Kernels* const tables[] = {&sse2::table, &avx2::table, &avx512::table};  // in order of Isa
  return *tables[static_cast<int>(isa)];
}

}  // namespace grainsweep
