// Student's distribution, for intervals whose width comes from few values.
#pragma once

namespace grainsweep {

/// Quantile 0.975 of the normal distribution.
inline constexpr double normal_quantile = 1.959963984540054;

/// Quantile 0.975 of Student's distribution of one degree of freedom or more; right to 1e-5.
double student_quantile(int degrees_of_freedom);

}  // namespace grainsweep
