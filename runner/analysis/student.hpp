// Student's distribution, for intervals whose width comes from few values.
#pragma once

namespace grainsweep {

/// Quantile 0.975 of the normal distribution.
inline constexpr double normal_quantile = 1.959963984540054;

/// Quantile 0.975 of Student's distribution of so many degrees of freedom, above 0.
double student_quantile(double degrees_of_freedom);

}  // namespace grainsweep
