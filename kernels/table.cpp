// The table of one instruction set. It is a constant: none of its code runs before it is chosen.
#include "kernels/tables.hpp"

namespace grainsweep::GRAINSWEEP_ISA_NAME {

// constinit proves what the check doubts: nothing here depends on an order of initialisation.
// NOLINTNEXTLINE(cppcoreguidelines-interfaces-global-init)
extern constinit const Kernels table = {Isa::GRAINSWEEP_ISA_NAME,
                                        {row_kernels_f32, body_kernels_f32, front_kernels_f32},
                                        {row_kernels_f64, body_kernels_f64, front_kernels_f64},
                                        hull_kernels,
                                        sphere_pairs,
                                        sphere_pairs_across,
                                        pinacoid_axes};

}  // namespace grainsweep::GRAINSWEEP_ISA_NAME
