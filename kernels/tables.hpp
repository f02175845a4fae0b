// What the kernel sources of one instruction set give its table, which table.cpp puts together. For
// kernel sources only: GRAINSWEEP_ISA_NAME is the instruction set they are compiled for.
#pragma once

#include "kernels/kernels.hpp"

namespace grainsweep::GRAINSWEEP_ISA_NAME {

extern const RowKernels<float> row_kernels_f32;
extern const RowKernels<double> row_kernels_f64;
extern const BodyKernels<float> body_kernels_f32;
extern const BodyKernels<double> body_kernels_f64;
extern const FrontKernels<float> front_kernels_f32;
extern const FrontKernels<double> front_kernels_f64;
extern const HullKernels hull_kernels;

// As the members of Kernels.
std::size_t sphere_pairs(const SphereGrid& grid, GrainPair* pairs, std::size_t capacity);
std::size_t sphere_pairs_across(const SphereGrid& grid, const SphereQueries& queries,
                                GrainPair* pairs, std::size_t capacity);
void pinacoid_axes(const PinacoidHalves& shape_a, const PinacoidHalves& shape_b,
                   PinacoidBlock* pairs, std::size_t blocks, const Record<double>* centres,
                   const Record<double>* orientations, double period_x, double period_y);

}  // namespace grainsweep::GRAINSWEEP_ISA_NAME
