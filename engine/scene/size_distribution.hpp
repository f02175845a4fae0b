// Distributions of grain sizes: which share of the grains is finer than each diameter.
//
// Every distribution becomes one thing, a curve of rows (as a sieve analysis gives it), and grains
// are drawn from that curve alone. Diameters are in d, which need not be a mean: it is a length
// between the smallest and the largest grain.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace grainsweep {

/// What the shares of a distribution are shares of.
enum class SizeWeight {
  number,  ///< "number": of the grains
  area,    ///< "area": of their surface
  volume,  ///< "volume": of their volume, and so of their mass
};

/// The logarithm of the diameter is Gaussian.
struct LognormalSizes {
  double median = 1.0;  ///< d
  double sigma = 0.3;   ///< standard deviation of the logarithm
  bool operator==(const LognormalSizes&) const = default;
};
/// All diameters between two, d, are equally likely.
struct UniformSizes {
  double from = 0.5, to = 1.5;
  bool operator==(const UniformSizes&) const = default;
};
/// The share 1 - exp(-(D / scale)^shape) is finer than D; by volume also known as the Rosin-Rammler
/// distribution.
struct WeibullSizes {
  double scale = 1.0;  ///< d
  double shape = 3.0;
  bool operator==(const WeibullSizes&) const = default;
};
/// Diameters, d, ascending, and for each either `passing`, the share that is finer, from 0 to 1,
/// linear between two diameters; or `shares`, the share that has just this diameter. The other list
/// is empty.
struct SizeTable {
  std::vector<double> diameters, passing, shares;
  bool operator==(const SizeTable&) const = default;
};
using SizeFormula = std::variant<LognormalSizes, UniformSizes, WeibullSizes, SizeTable>;

struct SizeDistribution {
  SizeFormula formula;
  SizeWeight by = SizeWeight::volume;
  /// Where the curve is cut, d; what is left counts as the whole. Without these bounds lognormal
  /// and Weibull curves, which have no ends, are cut where 0.1 % lie beyond.
  std::optional<double> smallest = {}, largest = {};
  double size = 1.0;  ///< d in the unit in which people gave all these lengths: for messages
  bool operator==(const SizeDistribution&) const = default;
};

/// Share of the grains, by weight, that are finer than each diameter, from 0 to 1, linear in the
/// diameter between two rows. Diameters ascend; two equal ones are a step.
struct SizeCurve {
  std::vector<double> diameters, passing;
  SizeWeight by = SizeWeight::volume;
  bool is_table = false;  ///< whether its rows are those that were given
};

/// Largest ratio of two diameters of a bed.
inline constexpr double most_size_ratio = 50.0;

/// Most rows of a table.
inline constexpr std::size_t most_size_rows = 1000;

/// What is wrong with a distribution, the part first: "lognormal.sigma must ..."; empty if nothing
/// is.
std::string fault_of(const SizeDistribution& distribution);

/// Whether shares add up to 1, to the rounding of three digits: "must add up to 1, add up to 0.9";
/// empty if they do.
std::string sum_fault(const std::vector<double>& shares);

/// The curve of a distribution without fault. Lognormal curves lie within 1e-5 of their formula and
/// Weibull curves within 2e-5 with the default ends, wide ones with given ends within 5e-3, narrow
/// ones within 2e-4 however far apart their ends are. A curve takes 4 ms, unless it is the one that
/// the thread asked for last.
SizeCurve curve_of(const SizeDistribution& distribution);

/// Share of the grains of `curve`, by its own weight, that are no larger than `diameter`.
double passing_at(const SizeCurve& curve, double diameter);

/// Mean of the cube of the diameter, each grain counted once, d^3.
double mean_cube(const SizeCurve& curve);
/// The same, each grain weighted with its volume.
double mean_cube_by_volume(const SizeCurve& curve);

/// Diameters of `count` grains, d, the largest first: one from each of `count` parts of the curve
/// that hold equally many grains. So the share of those finer than any diameter is that of the
/// curve within 1 / count by number, and by volume within the share of the largest grain. Same key,
/// same diameters.
std::vector<double> draw_diameters(const SizeCurve& curve, std::int64_t count, std::uint64_t key);

/// The weight of a grain in shares of this kind: 1, D^2 or D^3.
double weight_of(SizeWeight by, double diameter);

}  // namespace grainsweep
