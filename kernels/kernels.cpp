#include "kernels/kernels.hpp"

#include <cstring>

#include "kernels/tables.hpp"

namespace grainsweep {

namespace {

constexpr Isa all[] = {Isa::sse2, Isa::avx2, Isa::avx512};

}  // namespace

const char* name_of(Isa isa) {
  switch (isa) {
    case Isa::sse2:
      return "sse2";
    case Isa::avx2:
      return "avx2";
    case Isa::avx512:
      return "avx512";
  }
  return "unknown";
}

// The compiler's test reads the processor and also asks whether the operating system saves the
// registers.
bool is_supported(Isa isa) {
  switch (isa) {
    case Isa::sse2:
      return __builtin_cpu_supports("sse2") != 0;
    case Isa::avx2:
      return __builtin_cpu_supports("avx2") != 0;
    case Isa::avx512:
      return __builtin_cpu_supports("avx512f") != 0 && __builtin_cpu_supports("avx512cd") != 0 &&
             __builtin_cpu_supports("avx512dq") != 0 && __builtin_cpu_supports("avx512bw") != 0 &&
             __builtin_cpu_supports("avx512vl") != 0;
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
  static const Kernels tables[] = {
      {Isa::sse2, sse2::row_kernels_f32, sse2::row_kernels_f64, sse2::body_kernels_f32,
       sse2::body_kernels_f64, sse2::sphere_pairs, sse2::sphere_pairs_across, sse2::pinacoid_axes},
      {Isa::avx2, avx2::row_kernels_f32, avx2::row_kernels_f64, avx2::body_kernels_f32,
       avx2::body_kernels_f64, avx2::sphere_pairs, avx2::sphere_pairs_across, avx2::pinacoid_axes},
      {Isa::avx512, avx512::row_kernels_f32, avx512::row_kernels_f64, avx512::body_kernels_f32,
       avx512::body_kernels_f64, avx512::sphere_pairs, avx512::sphere_pairs_across,
       avx512::pinacoid_axes}};
  return tables[static_cast<int>(isa)];
}

}  // namespace grainsweep
