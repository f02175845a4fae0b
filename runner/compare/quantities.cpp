#include "runner/compare/quantities.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

#include "runner/compare/wall_zone.hpp"
#include "runner/sweep/suggest.hpp"
#include "runner/tables/csv.hpp"
#include "runner/tables/decays.hpp"
#include "runner/tables/fits.hpp"
#include "runner/tables/profiles.hpp"
#include "runner/text.hpp"

namespace grainsweep {
namespace {

std::string definition_of(const Group& group, Quantity quantity) {
  const MeasureSpec& measure = group.job.measure;
  const std::string slab = cell(measure.exclude_floor) + " d above the floor to " +
                           cell(measure.exclude_surface) + " d below the surface";
  if (quantity == Quantity::solid_fraction) return "exact solid volume from " + slab;
  return "neighbours per grain from " + slab + ", walls not counted, gap < " +
         cell(measure.gap_tolerances.front()) + " d; contacts / isostatic " +
         fixed(mean_of(group, "contact_ratio").mean, 3);
}

/// The mean of replicates.
template <Quantity quantity>
Measured mean_of(const Family& /*family*/, const Group& group) {
  const Spread& spread = spread_of(group, quantity);
  return {{spread.mean, spread.error},
          why_no_error(spread),
          definition_of(group, quantity),
          bias_bound(group, quantity).value_or(0.0)};
}

template <Quantity quantity>
Measured unconfined(const Family& family) {
  if (family.unconfined) return mean_of<quantity>(family, *family.unconfined);
  return {{}, "the sweep has no settled packing of these grains without walls", ""};
}

Measured fitted(const Family& family, const WallFit& fit, const Estimate& estimate) {
  const std::string left_out = fit.narrow_widths > 0 ? ", " + left_out_text(fit) : "";
  return {estimate, fit.not_determined,
          "line in 1/" + extent_symbol(family.walled) + " over " + std::to_string(fit.widths) +
              " widths" + left_out + ", χ²/dof " + fixed_or_power(fit.chi2_per_dof, 1) +
              (fit.doubt.empty() ? "" : ": ") + fit.doubt};
}

template <Quantity quantity>
Measured bulk_of_fit(const Family& family) {
  const WallFit fit = fit_walls(family, quantity);
  Measured bulk = fitted(family, fit, fit.bulk);
  bulk.bias_bound = fit.bias_bound.value_or(0.0);
  return bulk;
}

template <Quantity quantity>
Measured slope_of_fit(const Family& family) {
  const WallFit fit = fit_walls(family, quantity);
  return fitted(family, fit, fit.slope);
}

/// A quantity of a group from `measure`, for a solid fraction.
template <auto measure, class... Of>
Measured porosity(const Of&... of) {
  Measured measured = measure(of...);
  measured.estimate.value = 1.0 - measured.estimate.value;
  measured.definition = "1 - φ; " + measured.definition;
  return measured;
}

Measured zeta_difference(const Family& family) {
  const WallFit phi = fit_walls(family, Quantity::solid_fraction);
  const WallFit z = fit_walls(family, Quantity::coordination);
  return {{z.zeta.value - phi.zeta.value, std::hypot(z.zeta.error, phi.zeta.error)},
          phi.not_determined.empty() ? z.not_determined : phi.not_determined,
          "ζ_φ = C / φ_bulk = " + fixed(phi.zeta.value, 3) +
              " d, ζ_Z = C_Z / Z_bulk = " + fixed(z.zeta.value, 3) + " d, walls not counted"};
}

double mean_over(const Group& group, double PackingResult::*member) {
  double sum = 0.0;
  for (const Outcome& outcome : group.settled) sum += outcome.result.*member;
  return sum / static_cast<double>(group.settled.size());
}

/// "both walls", except in a tube.
std::string walls_text(const Group& group) {
  return group.job.box.is_tube ? "the wall" : "both walls";
}

/// How well the damped cosine describes the layers.
std::string quality_text(const DecayFit& fit) {
  return "R² " + fixed(fit.r_squared, 3) + ", misfit " + fixed(fit.misfit, 1);
}

/// lambda_L over one of the two mean diameters.
template <double PackingResult::*mean_diameter>
Measured decay_length(const Family& /*family*/, const Group& group) {
  const DecayFit fit = decay_of(group, GrainClass::large);
  const double diameter = mean_over(group, mean_diameter);
  return {{fit.length.value / diameter, fit.length.error / diameter},
          fit.not_determined,
          "damped cosine through the large grains' φ(y), y = " + cell(decay_window_start) +
              " d to " + cell(fit.window_end) + " d from " + walls_text(group) +
              "; d_avg = " + fixed(diameter, 3) + " d, " + quality_text(fit)};
}

Measured reach(const Family& /*family*/, const Group& group) {
  const DecayFit fit = decay_of(group, GrainClass::large);
  return {fit.reach, why_no_reach(fit),
          "where the damped cosine through the large grains' φ(y) has fallen to " +
              cell(100.0 * decay_reach_share) + " % of their bulk solid fraction; " +
              quality_text(fit)};
}

Measured decay_over_slope(const Family& family, const Group& group) {
  const DecayFit decay = decay_of(group, GrainClass::large);
  const WallFit phi = fit_walls(family, Quantity::solid_fraction);
  const double ratio = decay.length.value / phi.slope.value;
  const double error = std::abs(ratio) * std::hypot(decay.length.error / decay.length.value,
                                                    phi.slope.error / phi.slope.value);
  return {{ratio, error},
          decay.not_determined.empty() ? phi.not_determined : decay.not_determined,
          "decay length of the large grains' φ(y) over the slope C of φ; " + quality_text(decay)};
}

Measured zone_drop(const Family& /*family*/, const Group& group) {
  const WallZone zone = wall_zone(group);
  return {{zone.drop.mean, zone.drop.error},
          zone.not_determined,
          "grains farther than " + cell(core_distance) + " d from " + walls_text(group) +
              " less those nearer than " + cell(first_layer) + " d, walls not counted, gap < " +
              cell(group.job.measure.gap_tolerances.front()) + " d"};
}

Measured zone_width(const Family& /*family*/, const Group& group) {
  const WallZone zone = wall_zone(group);
  return {{zone.width.mean, zone.width.error},
          zone.not_determined,
          "of a layer with the wall's Z at each wall that has the packing's mean Z"};
}

struct NamedQuantity {
  std::string_view name, title;
  Measured (*of_family)(const Family&);               ///< null if it is one of a width
  Measured (*of_group)(const Family&, const Group&);  ///< between walls; null if it is not
};

constexpr auto of_phi = Quantity::solid_fraction, of_z = Quantity::coordination;
constexpr std::array<NamedQuantity, 18> quantities = {{
    {"phi_unconfined", "φ without walls (bi-periodic)", unconfined<of_phi>, nullptr},
    {"porosity_unconfined", "porosity without walls (bi-periodic)", porosity<unconfined<of_phi>>,
     nullptr},
    {"Z_unconfined", "Z without walls (bi-periodic)", unconfined<of_z>, nullptr},
    {"phi_bulk", "φ_bulk of the fit", bulk_of_fit<of_phi>, nullptr},
    {"porosity_bulk", "1 - φ_bulk of the fit", porosity<bulk_of_fit<of_phi>>, nullptr},
    {"C", "C / d", slope_of_fit<of_phi>, nullptr},
    {"Z_bulk", "Z_bulk of the fit", bulk_of_fit<of_z>, nullptr},
    {"C_Z", "C_Z / d", slope_of_fit<of_z>, nullptr},
    {"zeta_difference", "ζ_Z - ζ_φ, d", zeta_difference, nullptr},
    {"phi", "φ", nullptr, mean_of<of_phi>},
    {"porosity", "porosity", nullptr, porosity<mean_of<of_phi>>},
    {"Z", "Z", nullptr, mean_of<of_z>},
    {"lambda_by_number", "λ_L / d_avg by number", nullptr,
     decay_length<&PackingResult::mean_diameter>},
    {"lambda_by_volume", "λ_L / d_avg by volume", nullptr,
     decay_length<&PackingResult::mean_diameter_by_volume>},
    {"lambda_over_C", "λ_L / C", nullptr, decay_over_slope},
    {"reach", "reach of the wall / d", nullptr, reach},
    {"Z_drop", "drop of Z at the wall", nullptr, zone_drop},
    {"Z_drop_width", "width of the drop of Z / d", nullptr, zone_width},
}};

const NamedQuantity* find_quantity(const std::string& name) {
  const auto* const found = std::find_if(quantities.begin(), quantities.end(),
                                         [&](const auto& one) { return one.name == name; });
  return found == quantities.end() ? nullptr : found;
}

/// Of several groups of one width, which differ in their label: the mean over all packings of those
/// that have a value; the first one if none has.
Measured mean_of_groups(const std::vector<Measured>& groups, const std::vector<double>& packings) {
  Measured mean = groups.front();
  double sum = 0.0, all = 0.0, squares = 0.0;
  std::size_t count = 0;
  for (std::size_t k = 0; k < groups.size(); ++k) {
    const Measured& one = groups[k];
    if (!one.not_determined.empty()) continue;
    if (++count == 1) mean = one;
    sum += packings[k] * one.estimate.value;
    squares += std::pow(packings[k] * one.estimate.error, 2);
    all += packings[k];
    mean.bias_bound = std::max(mean.bias_bound, one.bias_bound);
  }
  if (count < 2) return mean;
  mean.estimate = {sum / all, std::sqrt(squares) / all};
  mean.definition += "; mean over the packings of " + std::to_string(count) + " groups";
  return mean;
}

/// The text that says that no packing of a family has a width.
std::string no_packings_at(double width, const Family& family) {
  return std::string("this family has no packings ") +
         (first_group(family).job.box.is_tube ? "in tubes at " : "between walls at ") +
         extent_symbol(family.walled) + " = " + cell(width) + " d";
}

/// Part of a mean over bins of a profile.
struct BinShare {
  std::size_t bin = 0;
  double share = 0.0;
};

/// The mean of a profile at `y`, linear between the middles of bins.
std::vector<BinShare> shares_at(double y, const std::vector<MeanBin>& bins) {
  const double bin_width = bins.front().high - bins.front().low;
  const double last = static_cast<double>(bins.size()) - 1.0;
  const double place = std::clamp(y / bin_width - 0.5, 0.0, last);
  const double lower = std::min(std::floor(place), std::max(last - 1.0, 0.0));
  const double share = place - lower;
  const auto below = static_cast<std::size_t>(lower);
  std::vector<BinShare> shares = {{below, 1.0 - share}};
  if (share > 0.0) shares.push_back({below + 1, share});
  return shares;
}

/// The same at a distance from the nearest wall: of a gap, the mean of both halves, which tell
/// apart from each other; bins of one half do not, nor does the bin in the middle of a gap, which
/// is in both.
Estimate value_from_wall(double distance, const Group& group, const std::vector<MeanBin>& bins,
                         Spread MeanBin::*spread) {
  std::vector<BinShare> shares = shares_at(distance, bins);
  if (!group.job.box.is_tube) {
    for (const BinShare& there : shares_at(group.job.box.width - distance, bins)) {
      shares.push_back(there);
    }
    for (BinShare& one : shares) one.share /= 2.0;
  }
  double value = 0.0, in_first_half = 0.0, in_second_half = 0.0, in_the_middle = 0.0;
  for (const auto& [bin, share] : shares) {
    const Spread& of_bin = bins[bin].*spread;
    value += share * of_bin.mean;
    const std::size_t twice = 2 * bin + 1;
    double& error = group.job.box.is_tube || twice < bins.size() ? in_first_half
                    : twice > bins.size()                        ? in_second_half
                                                                 : in_the_middle;
    error += share * of_bin.error;
  }
  return {value, std::hypot(in_first_half, in_second_half) + in_the_middle};
}

/// The values of one group at these distances.
std::vector<Measured> profile_of(const std::string& quantity, const std::vector<double>& distances,
                                 const Group& group, const std::string& folder) {
  const GroupWithCurves with_curves(group, folder);
  const std::vector<MeanBin> bins = mean_profile(*with_curves, profile_across(*with_curves));
  const bool is_z = quantity == "Z";
  const auto spread = is_z ? &MeanBin::coordination : &MeanBin::solid_fraction;
  constexpr double rounding = 1e-9;  // d
  std::vector<Measured> values;
  for (const double distance : distances) {
    Measured& one = values.emplace_back();
    const double first = bins.empty() ? 0.0 : (bins.front().low + bins.front().high) / 2.0;
    if (bins.empty()) {
      one.not_determined = "no packing has settled";
    } else if (distance < first - rounding) {
      one.not_determined = "it lies nearer to the wall than the middle of the first bin, " +
                           short_cell(first) + " d; measure.bin_width sets their width";
    } else if (distance > group.job.box.width / 2.0 + rounding) {
      one.not_determined = "it lies beyond the middle";
    }
    if (!one.not_determined.empty()) continue;
    one.estimate = value_from_wall(distance, *with_curves, bins, spread);
    if (!std::isfinite(one.estimate.value)) one.not_determined = "no grain has its centre there";
    if (quantity == "porosity") one.estimate.value = 1.0 - one.estimate.value;
    one.definition =
        std::string(is_z ? "neighbours of grains whose centres lie there, walls not counted"
                         : "exact solid volume") +
        ", in bins " + short_cell(bins.front().high - bins.front().low) +
        " d wide, of the measured slab" +
        (group.job.box.is_tube ? "" : ", mean of both halves of the gap");
  }
  return values;
}

}  // namespace

bool is_share(std::string_view quantity) {
  return quantity.starts_with("phi") || quantity.starts_with("porosity");
}

bool is_possible(std::string_view quantity, double value) {
  return std::isfinite(value) && (!is_share(quantity) || (value >= 0.0 && value <= 1.0));
}

bool is_of_family(const std::string& quantity) {
  const NamedQuantity* found = find_quantity(quantity);
  return found != nullptr && found->of_family != nullptr;
}

bool is_mean_of_width(std::string_view quantity) {
  return quantity == "phi" || quantity == "porosity" || quantity == "Z";
}

std::string fault_of_quantity(const std::string& quantity, double width) {
  const NamedQuantity* found = find_quantity(quantity);
  if (found == nullptr) {
    std::vector<std::string> names;
    names.reserve(std::size(quantities));
    for (const NamedQuantity& one : quantities) names.emplace_back(one.name);
    const std::string near = nearest(quantity, names);
    return "unknown quantity \"" + shortened(quantity) + "\"; " +
           (near.empty() ? "known are " + comma_list(names) : "did you mean \"" + near + "\"?");
  }
  if (found->of_group != nullptr && !(width > 0.0)) return quantity + " needs a \"width\"";
  if (found->of_family != nullptr && width > 0.0) return quantity + " belongs to no \"width\"";
  return "";
}

std::string title_of_quantity(const std::string& quantity, double width,
                              const std::string& symbol) {
  const std::string title(find_quantity(quantity)->title);
  return width > 0.0 ? title + " at " + symbol + " = " + cell(width) + " d" : title;
}

Measured measure_quantity(const std::string& quantity, const Family& family, const Group& group,
                          const std::string& folder) {
  const auto of_group = find_quantity(quantity)->of_group;
  return is_mean_of_width(quantity) ? of_group(family, group)
                                    : of_group(family, *GroupWithCurves(group, folder));
}

Measured measure_quantity(const std::string& quantity, double width, const Family& family,
                          const std::string& folder) {
  const NamedQuantity& named = *find_quantity(quantity);
  if (named.of_family != nullptr) return named.of_family(family);
  std::vector<Measured> of_groups;
  std::vector<double> packings;
  for (const Group& group : family.walled) {
    if (group.job.box.width != width) continue;
    of_groups.push_back(measure_quantity(quantity, family, group, folder));
    packings.push_back(static_cast<double>(group.counts.settled));
  }
  if (!of_groups.empty()) return mean_of_groups(of_groups, packings);
  return {{}, no_packings_at(width, family), ""};
}

MeasuredProfile measure_profile(const std::string& quantity, double width,
                                const std::vector<double>& distances, const Family& family,
                                const std::string& folder) {
  MeasuredProfile profile;
  std::vector<std::vector<Measured>> of_groups;
  std::vector<double> packings;
  for (const Group& group : family.walled) {
    if (group.job.box.width != width) continue;
    if (profile.group == nullptr) profile.group = &group;
    of_groups.push_back(profile_of(quantity, distances, group, folder));
    packings.push_back(static_cast<double>(group.counts.settled));
  }
  for (std::size_t k = 0; k < distances.size(); ++k) {
    std::vector<Measured> there;
    there.reserve(of_groups.size());
    for (const std::vector<Measured>& one : of_groups) there.push_back(one[k]);
    profile.values.push_back(there.empty() ? Measured{{}, no_packings_at(width, family), ""}
                                           : mean_of_groups(there, packings));
  }
  return profile;
}

Shared share_quantity(const std::string& quantity, double width,
                      const std::vector<Family>& families, const std::string& folder) {
  constexpr std::size_t least_families = 3;
  std::vector<Estimate> values;
  double weight = 0.0, sum = 0.0, bias_bound = 0.0;
  for (const Family& family : families) {
    const Measured one = measure_quantity(quantity, width, family, folder);
    if (!one.not_determined.empty()) continue;
    values.push_back(one.estimate);
    bias_bound = std::max(bias_bound, one.bias_bound);
    weight += std::pow(one.estimate.error, -2);
    sum += one.estimate.value * std::pow(one.estimate.error, -2);
  }
  Shared shared;
  if (values.size() < least_families) {
    shared.measured.not_determined =
        "needs it of 3 or more families, has " + std::to_string(values.size());
    return shared;
  }
  double& chi2_per_dof = shared.misfit.chi2_per_dof;
  shared.misfit.degrees_of_freedom = static_cast<int>(values.size()) - 1;
  for (const Estimate& one : values) {
    chi2_per_dof +=
        std::pow((one.value - sum / weight) / one.error, 2) / shared.misfit.degrees_of_freedom;
  }
  shared.measured.estimate = {sum / weight, std::sqrt(std::max(1.0, chi2_per_dof) / weight)};
  shared.measured.bias_bound = bias_bound;
  shared.measured.definition = "weighted mean of " + std::to_string(values.size()) +
                               " families, χ²/dof " + fixed_or_power(chi2_per_dof, 1) +
                               " (about 1 if one value holds for all)";
  return shared;
}

}  // namespace grainsweep
