// The kernel tables of each instruction set, as the compiled sources define them.
#pragma once

#include "kernels/kernels.hpp"

namespace grainsweep {

using SpherePairs = std::size_t (*)(const SphereGrid& grid, GrainPair* pairs, std::size_t capacity);
using SpherePairsAcross = std::size_t (*)(const SphereGrid& grid, const SphereQueries& queries,
                                          GrainPair* pairs, std::size_t capacity);
using PinacoidAxes = void (*)(const PinacoidHalves& shape, PinacoidBlock* pairs, std::size_t blocks,
                              const Record<double>* centres, const Record<double>* orientations,
                              double period_x, double period_y);

namespace sse2 {
extern const RowKernels<float> row_kernels_f32;
extern const RowKernels<double> row_kernels_f64;
extern const BodyKernels<float> body_kernels_f32;
extern const BodyKernels<double> body_kernels_f64;
extern const SpherePairs sphere_pairs;
extern const SpherePairsAcross sphere_pairs_across;
extern const PinacoidAxes pinacoid_axes;
}  // namespace sse2
namespace avx2 {
extern const RowKernels<float> row_kernels_f32;
extern const RowKernels<double> row_kernels_f64;
extern const BodyKernels<float> body_kernels_f32;
extern const BodyKernels<double> body_kernels_f64;
extern const SpherePairs sphere_pairs;
extern const SpherePairsAcross sphere_pairs_across;
extern const PinacoidAxes pinacoid_axes;
}  // namespace avx2
namespace avx512 {
extern const RowKernels<float> row_kernels_f32;
extern const RowKernels<double> row_kernels_f64;
extern const BodyKernels<float> body_kernels_f32;
extern const BodyKernels<double> body_kernels_f64;
extern const SpherePairs sphere_pairs;
extern const SpherePairsAcross sphere_pairs_across;
extern const PinacoidAxes pinacoid_axes;
}  // namespace avx512

}  // namespace grainsweep
