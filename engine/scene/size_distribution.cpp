#include "engine/scene/size_distribution.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "engine/interval.hpp"
#include "engine/portable.hpp"
#include "engine/scene/random.hpp"
#include "engine/text.hpp"

namespace grainsweep {

namespace {

constexpr double beyond_cut = 1e-3;  // share cut off at each end of a curve without ends
constexpr double cut_deviation = 3.0902323061678132;  // of a Gaussian: 0.1 % lie beyond it
constexpr int formula_steps = 500;  // keep rows within 2e-5 of a formula between its usual ends
constexpr double next_to_nothing = 1e-12;  // share that no bed is large enough to draw from
constexpr double far_deviation = 7.034483825301131;  // of a Gaussian: that share lies beyond it

struct Ends {
  double smallest, largest;
};

/// The ends of `chosen` where it gives them.
Ends ends_of(const SizeDistribution& chosen, double smallest, double largest) {
  return {chosen.smallest.value_or(smallest), chosen.largest.value_or(largest)};
}

/// Where a lognormal or Weibull curve begins and ends, d, if nothing else is asked for.
Ends usual_ends(const LognormalSizes& sizes) {
  const double factor = portable::exp(cut_deviation * sizes.sigma);
  return {sizes.median / factor, sizes.median * factor};
}
Ends usual_ends(const WeibullSizes& sizes) {
  const double power = 1.0 / sizes.shape;
  return {sizes.scale * portable::pow(-portable::log1p(-beyond_cut), power),
          sizes.scale * portable::pow(-portable::log(beyond_cut), power)};
}

/// Diameters below and above which there is next to nothing, by number and by volume: between the
/// two a share changes by the cube of a diameter, which moves a lognormal curve by 3 sigma^2.
Ends far_ends(const LognormalSizes& sizes) {
  const double factor = portable::exp((far_deviation + 3.0 * sizes.sigma) * sizes.sigma);
  return {sizes.median / factor, sizes.median * factor};
}
Ends far_ends(const WeibullSizes& sizes) {
  const double steepness = sizes.shape - 3.0;  // of the number below a small diameter
  return {steepness > 0.0 ? sizes.scale * portable::pow(next_to_nothing, 1.0 / steepness) : 0.0,
          sizes.scale * portable::pow(-portable::log(next_to_nothing), 1.0 / sizes.shape)};
}

double formula_at(const LognormalSizes& sizes, double diameter) {
  const double deviation = portable::log(diameter / sizes.median) / sizes.sigma;
  return 0.5 * portable::erfc(-deviation / std::sqrt(2.0));
}
double formula_at(const WeibullSizes& sizes, double diameter) {
  return -portable::expm1(-portable::pow(diameter / sizes.scale, sizes.shape));
}

SizeCurve one_size(double diameter) { return {{diameter, diameter}, {0.0, 1.0}}; }

/// Rows of a formula between two diameters, evenly spaced in their logarithm where there is any of
/// it: however far apart the two are, none is wasted beside a narrow curve.
template <class Formula>
SizeCurve rows_between(const Formula& formula, const Ends& asked) {
  const Ends far = far_ends(formula);
  const Ends within{std::max(asked.smallest, far.smallest), std::min(asked.largest, far.largest)};
  const Ends ends = within.smallest < within.largest ? within : asked;
  SizeCurve curve;
  if (ends.smallest > asked.smallest) curve = {{asked.smallest}, {0.0}};
  const double low = formula_at(formula, asked.smallest);
  const double whole = formula_at(formula, asked.largest) - low;
  for (int k = 0; k <= formula_steps; ++k) {
    const double share = static_cast<double>(k) / formula_steps;
    const double diameter =
        k == formula_steps ? ends.largest
                           : ends.smallest * portable::pow(ends.largest / ends.smallest, share);
    curve.diameters.push_back(diameter);
    curve.passing.push_back((formula_at(formula, diameter) - low) / whole);
  }
  if (ends.largest < asked.largest) {
    curve.diameters.push_back(asked.largest);
    curve.passing.push_back(1.0);
  }
  curve.passing.back() = 1.0;
  return curve;
}

template <class Formula>
SizeCurve curve_of(const Formula& formula, const SizeDistribution& distribution) {
  const Ends usual = usual_ends(formula);
  const Ends ends = ends_of(distribution, usual.smallest, usual.largest);
  return ends.smallest == ends.largest ? one_size(ends.smallest) : rows_between(formula, ends);
}

/// The rows of a curve between the ends asked for.
SizeCurve cut(const SizeCurve& curve, const SizeDistribution& distribution) {
  const auto [smallest, largest] =
      ends_of(distribution, curve.diameters.front(), curve.diameters.back());
  // A step at an end belongs to the part that is left.
  const double low = passing_at(curve, std::nextafter(smallest, 0.0));
  const double whole = passing_at(curve, largest) - low;
  SizeCurve left{{smallest}, {0.0}};
  for (std::size_t k = 0; k < curve.diameters.size(); ++k) {
    if (curve.diameters[k] < smallest || curve.diameters[k] > largest) continue;
    left.diameters.push_back(curve.diameters[k]);
    left.passing.push_back(std::max(0.0, (curve.passing[k] - low) / whole));
  }
  left.diameters.push_back(largest);
  left.passing.push_back(1.0);
  return left;
}

/// The rows of a table; shares are steps.
SizeCurve rows_of(const SizeTable& table) {
  if (table.shares.empty()) return {table.diameters, table.passing};
  SizeCurve curve;
  double whole = 0.0, passing = 0.0;
  for (const double share : table.shares) whole += share;
  for (std::size_t k = 0; k < table.shares.size(); ++k) {
    curve.diameters.insert(curve.diameters.end(), 2, table.diameters[k]);
    curve.passing.push_back(passing / whole);
    passing += table.shares[k];
    curve.passing.push_back(passing / whole);
  }
  return curve;
}

/// The rows from the last that nothing is finer than to the first that nothing is coarser than.
SizeCurve without_empty_ends(const SizeCurve& curve) {
  const auto& passing = curve.passing;
  const auto first = std::upper_bound(passing.begin(), passing.end(), 0.0) - 1 - passing.begin();
  const auto last = std::lower_bound(passing.begin(), passing.end(), 1.0) + 1 - passing.begin();
  return {{curve.diameters.begin() + first, curve.diameters.begin() + last},
          {passing.begin() + first, passing.begin() + last}};
}

struct MakeCurve {
  const SizeDistribution& distribution;

  SizeCurve operator()(const LognormalSizes& sizes) const {
    if (sizes.sigma == 0.0) return one_size(sizes.median);
    return curve_of(sizes, distribution);
  }
  SizeCurve operator()(const UniformSizes& sizes) const {
    return cut({{sizes.from, sizes.to}, {0.0, 1.0}}, distribution);
  }
  SizeCurve operator()(const WeibullSizes& sizes) const { return curve_of(sizes, distribution); }
  SizeCurve operator()(const SizeTable& table) const { return cut(rows_of(table), distribution); }
};

/// Power of the diameter to which a grain's weight is proportional.
int power_of(SizeWeight by) {
  return by == SizeWeight::number ? 0 : by == SizeWeight::area ? 2 : 3;
}

/// Mean of D^power over diameters spread evenly between two; powers -3, -2, 0, 1, 3, 4 and
/// 6.
double mean_power(double a, double b, int power) {
  switch (power) {
    case -3:
      return (a + b) / (2.0 * a * a * b * b);
    case -2:
      return 1.0 / (a * b);
    case 1:
      return (a + b) / 2.0;
    case 3:
      return (a + b) * (a * a + b * b) / 4.0;
    case 4:
      return (a * a * a * a + b * b * b * b + a * b * (a * a + a * b + b * b)) / 5.0;
    case 6:
      return ((a + b) * (a * a + b * b) * (a * a * a + b * b * b) - a * a * a * b * b * b) / 7.0;
    default:
      return 1.0;
  }
}

/// Sum over the segments of a curve of their share times the mean of D^power in them.
double sum_of_powers(const SizeCurve& curve, int power) {
  double sum = 0.0;
  for (std::size_t k = 1; k < curve.diameters.size(); ++k) {
    sum += (curve.passing[k] - curve.passing[k - 1]) *
           mean_power(curve.diameters[k - 1], curve.diameters[k], power);
  }
  return sum;
}

/// Share of the grains, by number, that are finer than each row; 1 where nothing follows.
std::vector<double> finer_by_number(const SizeCurve& curve) {
  const int power = power_of(curve.by);
  std::vector<double> finer = {0.0};
  for (std::size_t k = 1; k < curve.diameters.size(); ++k) {
    finer.push_back(finer.back() +
                    (curve.passing[k] - curve.passing[k - 1]) *
                        mean_power(curve.diameters[k - 1], curve.diameters[k], -power));
  }
  const double all = finer.back();
  for (double& share : finer) share /= all;
  return finer;
}

/// The diameter in a segment below which a share `t` of its grains, by number, lies. Between two
/// rows grains are spread evenly by weight, and as D^-power by number.
double diameter_within(double a, double b, int power, double t) {
  if (power == 0) return a + t * (b - a);
  if (power == 2) return a * b / (b - t * (b - a));
  return a * b / std::sqrt(b * b - t * (b * b - a * a));
}

std::string number_fault(const char* name, double value, const Interval& range) {
  if (range.holds(value)) return "";
  if (std::isinf(range.high))
    return std::string(name) + " must be positive, is " + bound_text(value);
  return std::string(name) + " must lie in " + range.text() + ", is " + bound_text(value);
}

std::string first_of(std::initializer_list<std::string> faults) {
  for (const std::string& fault : faults) {
    if (!fault.empty()) return fault;
  }
  return "";
}

constexpr Interval any_length{.low = 0.0, .low_open = true};

bool ascends(const std::vector<double>& values, bool strictly) {
  const auto falls = [&](double a, double b) { return strictly ? !(a < b) : !(a <= b); };
  return std::adjacent_find(values.begin(), values.end(), falls) == values.end();
}

std::string passing_fault(const std::vector<double>& passing) {
  const double first = passing.front(), last = passing.back();
  if (first == 0.0 && last == 1.0 && ascends(passing, false)) return "";
  const std::string rule =
      "table.passing must rise from 0 to 1, the share finer than each diameter; ";
  if (last > 1.0) return rule + "ends at " + number_text(last) + ": divide percentages by 100";
  const auto fall = std::adjacent_find(passing.begin(), passing.end(),
                                       [](double a, double b) { return !(a <= b); });
  if (fall != passing.end()) {
    return rule + "number " + std::to_string(fall - passing.begin() + 2) + " falls to " +
           number_text(fall[1]) + " from " + number_text(fall[0]);
  }
  if (!(first == 0.0)) {
    return rule + "begins at " + number_text(first) +
           ": add the largest diameter that nothing is finer than";
  }
  return rule + "ends at " + number_text(last) + ": add a diameter that all is finer than";
}

std::string shares_fault(const std::vector<double>& shares) {
  for (const double share : shares) {
    if (!(share >= 0.0)) return "table.shares must hold no negative number";
  }
  const std::string sum = sum_fault(shares);
  return sum.empty() ? "" : "table.shares " + sum;
}

/// What is wrong with the numbers of a formula.
struct FindFault {
  std::string operator()(const LognormalSizes& sizes) const {
    return first_of({number_fault("lognormal.median", sizes.median, any_length),
                     number_fault("lognormal.sigma", sizes.sigma, {0.0, 2.0})});
  }
  std::string operator()(const UniformSizes& sizes) const {
    const std::string order =
        sizes.to >= sizes.from ? "" : "uniform.to must be no smaller than uniform.from";
    return first_of({number_fault("uniform.from", sizes.from, any_length),
                     number_fault("uniform.to", sizes.to, any_length), order});
  }
  std::string operator()(const WeibullSizes& sizes) const {
    return first_of({number_fault("weibull.scale", sizes.scale, any_length),
                     number_fault("weibull.shape", sizes.shape, {0.1, 100.0})});
  }
  std::string operator()(const SizeTable& table) const {
    const bool has_shares = !table.shares.empty();
    if (has_shares == !table.passing.empty()) {
      return "table needs one of passing and shares beside its diameters";
    }
    const std::size_t rows = has_shares ? table.shares.size() : table.passing.size();
    if (rows != table.diameters.size() || rows > most_size_rows) {
      return "table.diameters must hold as many numbers as " +
             std::string(has_shares ? "table.shares" : "table.passing") + ", at most " +
             std::to_string(most_size_rows) + ", holds " + std::to_string(table.diameters.size()) +
             " for " + std::to_string(rows);
    }
    if (!(table.diameters.front() > 0.0) || !ascends(table.diameters, true)) {
      return "table.diameters must be positive and ascend";
    }
    return has_shares ? shares_fault(table.shares) : passing_fault(table.passing);
  }
};

/// Whether anything of the curve lies between the ends asked for.
bool leaves_grains(const SizeDistribution& distribution) {
  SizeDistribution whole = distribution;
  whole.smallest.reset();
  whole.largest.reset();
  const SizeCurve curve = curve_of(whole);
  const auto [smallest, largest] =
      ends_of(distribution, curve.diameters.front(), curve.diameters.back());
  if (smallest == largest && !curve.is_table) {  // one size of all that a formula has
    return curve.diameters.front() <= smallest && largest <= curve.diameters.back();
  }
  return smallest <= largest &&
         passing_at(curve, largest) > passing_at(curve, std::nextafter(smallest, 0.0));
}

/// The least number of three digits that is no smaller than a positive `value`.
std::string rounded_up(double value) {
  constexpr double rounding = 1e-9;
  const double last_digit = std::pow(10.0, std::floor(std::log10(value)) - 2.0);
  return number_text(std::ceil(value / last_digit - rounding) * last_digit);
}

/// In what unit lengths of a distribution are given.
std::string unit_text(double size) {
  return size == 1.0 ? "in d" : "in the unit in which d is " + number_text(size, 6);
}

/// Which ends to give to a curve whose largest grain is too many times the smallest.
std::string ends_advice(double largest, double size) {
  const double least = largest / most_size_ratio;
  if (least > 1.0) return "; largest must cut off more, too";
  return "; give smallest " + rounded_up(size * least) + " or more, " + unit_text(size);
}

/// What is wrong with the ends of a curve: a bed must be able to hold them, and d must lie between
/// them.
std::string ends_fault(const SizeCurve& curve, double size) {
  const double smallest = curve.diameters.front(), largest = curve.diameters.back();
  const std::string reach = number_text(smallest) + " to " + number_text(largest) + " d";
  if (!(smallest <= 1.0 && largest >= 1.0)) {
    return "size is missing or wrong: grains of " + reach +
           "; d, the unit of length, must be a length between the smallest and the largest";
  }
  constexpr double rounding = 1e-12;  // of lengths in another unit
  if (largest <= (1.0 + rounding) * most_size_ratio * smallest) return "";
  return "smallest must cut off more: the largest grain may be " + number_text(most_size_ratio) +
         " times the smallest, has " + reach + ends_advice(largest, size);
}

}  // namespace

std::string fault_of(const SizeDistribution& distribution) {
  std::string fault =
      first_of({std::visit(FindFault(), distribution.formula),
                number_fault("smallest", distribution.smallest.value_or(1.0), any_length),
                number_fault("largest", distribution.largest.value_or(1.0), any_length)});
  if (!fault.empty()) return fault;
  if (!leaves_grains(distribution)) {
    const SizeCurve whole = curve_of({distribution.formula, distribution.by, {}, {}});
    const double size = distribution.size;
    return "smallest and largest leave nothing of the curve, which runs from " +
           number_text(size * whole.diameters.front(), 6) + " to " +
           number_text(size * whole.diameters.back(), 6) + ", " + unit_text(size) +
           (size == 1.0 ? "; size says what d is where lengths are in another unit" : "");
  }
  return ends_fault(curve_of(distribution), distribution.size);
}

std::string sum_fault(const std::vector<double>& shares) {
  double whole = 0.0;
  for (const double share : shares) whole += share;
  constexpr double rounding = 0.001;  // of shares written with three digits
  if (std::abs(whole - 1.0) <= rounding) return "";
  const bool are_percentages = std::abs(whole / 100.0 - 1.0) <= 0.02;  // rounded to whole ones
  return "must add up to 1, add up to " + number_text(whole) +
         (are_percentages ? ": divide percentages by 100" : "");
}

SizeCurve curve_of(const SizeDistribution& distribution) {
  thread_local std::optional<std::pair<SizeDistribution, SizeCurve>> last;
  if (!last || last->first != distribution) {
    SizeCurve curve = without_empty_ends(std::visit(MakeCurve{distribution}, distribution.formula));
    curve.by = distribution.by;
    curve.is_table = std::holds_alternative<SizeTable>(distribution.formula);
    last.emplace(distribution, std::move(curve));
  }
  return last->second;
}

double passing_at(const SizeCurve& curve, double diameter) {
  const auto& rows = curve.diameters;
  const auto above = std::upper_bound(rows.begin(), rows.end(), diameter);
  if (above == rows.begin()) return 0.0;
  if (above == rows.end()) return 1.0;
  const auto k = static_cast<std::size_t>(above - rows.begin());
  const double share = (diameter - rows[k - 1]) / (rows[k] - rows[k - 1]);
  return curve.passing[k - 1] + share * (curve.passing[k] - curve.passing[k - 1]);
}

double mean_cube(const SizeCurve& curve) {
  const int power = power_of(curve.by);
  return sum_of_powers(curve, 3 - power) / sum_of_powers(curve, -power);
}

double mean_cube_by_volume(const SizeCurve& curve) {
  const int power = power_of(curve.by);
  return sum_of_powers(curve, 6 - power) / sum_of_powers(curve, 3 - power);
}

std::vector<double> draw_diameters(const SizeCurve& curve, std::int64_t count, std::uint64_t key) {
  const int power = power_of(curve.by);
  const std::vector<double> finer = finer_by_number(curve);
  std::vector<double> diameters(static_cast<std::size_t>(count));
  std::size_t row = 1;
  for (std::size_t i = 0; i < diameters.size(); ++i) {
    const double within = unit_interval(random_words(key, Purpose::size, i, 0)[0]);
    const double wanted = (static_cast<double>(i) + within) / static_cast<double>(count);
    while (finer[row] < wanted) ++row;
    const double t = (wanted - finer[row - 1]) / (finer[row] - finer[row - 1]);
    diameters[diameters.size() - 1 - i] =
        diameter_within(curve.diameters[row - 1], curve.diameters[row], power, t);
  }
  return diameters;
}

double weight_of(SizeWeight by, double diameter) {
  return by == SizeWeight::number ? 1.0
         : by == SizeWeight::area ? diameter * diameter
                                  : diameter * diameter * diameter;
}

}  // namespace grainsweep
