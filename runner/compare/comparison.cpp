#include "runner/compare/comparison.hpp"

#include <algorithm>
#include <cmath>

#include "runner/compare/proportionality.hpp"
#include "runner/compare/wall_zone.hpp"
#include "runner/tables/csv.hpp"
#include "runner/tables/decays.hpp"
#include "runner/text.hpp"

namespace grainsweep {
namespace {

using Rows = std::vector<Comparison>;

const PaperValue not_printed{"not printed", std::nullopt};
PaperValue words(const char* text) { return {text, std::nullopt}; }
PaperValue about(double value, const char* text) {
  return {text, PaperValue::Range{value, value, 0.0}};
}

/// The gap at which the paper gives the reach of the walls, d.
constexpr double profile_width = 10.0;

const JobFacts& job_of(const Family& family) {
  return (family.walled.empty() ? family.periodic : family.walled).front().job;
}

double chunk_of(const Family& family) { return job_of(family).small_share; }

/// What the paper prints of a family.
struct Printed {
  PaperValue bulk = not_printed;          ///< solid fraction without walls, of the fit
  PaperValue slope = not_printed;         ///< C, d
  PaperValue coordination = not_printed;  ///< without walls
  PaperValue decay = not_printed;         ///< lambda_L over the mean diameter
  PaperValue reach = not_printed;         ///< of the wall, d
  PaperValue drop = not_printed;          ///< of the coordination number at the wall
};

Printed printed_of_spheres(double share) {
  if (share == 0.0) {
    return {about(0.64, "about 0.64"),
            words("falls with x_S"),
            {"6.027 ± 0.012", PaperValue::Range{6.027, 6.027, 0.012}},
            about(1.4, "1.4"),
            {"3 to 4", PaperValue::Range{3, 4, 0}},
            about(1.4, "1.4")};
  }
  return {words("above MSP"),
          words("falls with x_S"),
          not_printed,
          share == 0.4 ? about(0.85, "0.85") : not_printed,
          {"1.5 to 2", PaperValue::Range{1.5, 2, 0}},
          not_printed};
}

/// Those of length, width and height d and 60 degrees, all of one size.
bool are_the_papers_pinacoids(const JobFacts& job) {
  return job.small_share == 0.0 &&
         job.parameters.find(
             R"("shape":{"pinacoid":{"angle_deg":60,"height":1,"length":1,"width":1}})") !=
             std::string::npos;
}

Printed printed_of(const Family& family) {
  const JobFacts& job = job_of(family);
  if (job.shape == "sphere") return printed_of_spheres(job.small_share);
  if (!are_the_papers_pinacoids(job)) return {};
  return {
      words("above MSP"), not_printed,   {"8.581 ± 0.068", PaperValue::Range{8.581, 8.581, 0.068}},
      about(1.2, "1.2"),  about(2, "2"), about(1.5, "1.5")};
}

const Group* group_at(const Family& family, double width) {
  for (const Group& group : family.walled) {
    if (group.job.box.width == width) return &group;
  }
  return nullptr;
}

std::string no_group_at(double width) {
  return "the sweep has no packings between walls at W = " + cell(width) + " d";
}

std::string gap_text(const Group& group) {
  const auto& gaps = group.job.measure.gap_tolerances;
  return gaps.empty() ? "" : ", gap < " + cell(gaps.front()) + " d";
}

std::string definition_of(const Group& group, Quantity quantity) {
  const MeasureSpec& measure = group.job.measure;
  const std::string slab = cell(measure.exclude_floor) + " d above the floor to " +
                           cell(measure.exclude_surface) + " d below the surface";
  if (quantity == Quantity::solid_fraction) return "exact solid volume from " + slab;
  return "neighbours per grain from " + slab + ", walls not counted" + gap_text(group) +
         "; contacts / isostatic " + fixed(group.contact_ratio.mean, 3);
}

/// A row whose value is the mean of replicates.
Comparison row_of_mean(const Family& family, std::string quantity, const PaperValue& paper,
                       const Group& group, Quantity measured) {
  const Spread& spread = spread_of(group, measured);
  const double error = pooled_error(family, measured, spread.n);
  Comparison row{family.name, std::move(quantity),           paper, {spread.mean, error},
                 "",          definition_of(group, measured)};
  if (spread.n == 0) {
    row.not_determined = "no packing has settled";
  } else if (!std::isfinite(error)) {
    row.not_determined = "one settled replicate leaves the error unknown";
  }
  return row;
}

const char* symbol_of(Quantity quantity) {
  return quantity == Quantity::solid_fraction ? "φ" : "Z";
}

void add_reference(const Family& family, Quantity quantity, const PaperValue& paper, Rows& rows) {
  const std::string name = std::string(symbol_of(quantity)) + " without walls (bi-periodic)";
  const Group* group = unconfined_reference(family);
  if (group != nullptr) {
    rows.push_back(row_of_mean(family, name, paper, *group, quantity));
  } else {
    rows.push_back(
        {family.name, name, paper, {}, "the sweep has no settled packing with periodic y", ""});
  }
}

void add_width(const Family& family, Quantity quantity, double width, Rows& rows) {
  const std::string name = std::string(symbol_of(quantity)) + " at W = " + cell(width) + " d";
  const Group* group = group_at(family, width);
  if (group != nullptr) {
    rows.push_back(row_of_mean(family, name, not_printed, *group, quantity));
  } else {
    rows.push_back({family.name, name, not_printed, {}, no_group_at(width), ""});
  }
}

std::string definition_of(const WallFit& fit) {
  return "line in 1/W over " + std::to_string(fit.widths) + " widths, χ²/dof " +
         fixed(fit.chi2_per_dof, 1) + ", errors widened by its root where above 1";
}

Comparison row_of_fit(const Family& family, std::string quantity, const PaperValue& paper,
                      const WallFit& fit, const Estimate& parameter) {
  return {family.name,
          std::move(quantity),
          paper,
          {parameter.value, widened(parameter.error, fit)},
          fit.not_determined,
          definition_of(fit)};
}

void add_fits(const Family& family, Rows& rows) {
  const WallFit phi = fit_walls(family, Quantity::solid_fraction);
  const WallFit z = fit_walls(family, Quantity::coordination);
  const Printed printed = printed_of(family);
  rows.push_back(row_of_fit(family, "φ_bulk of the fit", printed.bulk, phi, phi.bulk));
  rows.push_back(row_of_fit(family, "C / d", printed.slope, phi, phi.slope));
  rows.push_back(row_of_fit(family, "Z_bulk of the fit", not_printed, z, z.bulk));
  rows.push_back(row_of_fit(family, "C_Z / d", not_printed, z, z.slope));
  Comparison gap{family.name,
                 "ζ_Z - ζ_φ, d",
                 words("close to 0"),
                 {z.zeta.value - phi.zeta.value,
                  std::hypot(widened(z.zeta.error, z), widened(phi.zeta.error, phi))},
                 phi.not_determined.empty() ? z.not_determined : phi.not_determined,
                 ""};
  gap.definition = "ζ_φ = C / φ_bulk = " + fixed(phi.zeta.value, 3) +
                   " d, ζ_Z = C_Z / Z_bulk = " + fixed(z.zeta.value, 3) + " d";
  rows.push_back(gap);
}

/// lambda_L over one of the two mean diameters.
Comparison row_of_decay(const Family& family, const DecayFit& fit, const PaperValue& paper,
                        const std::string& by, double diameter) {
  return {family.name,
          "λ_L / d_avg at W = 10 d, " + by,
          paper,
          {fit.length.value / diameter, fit.length.error / diameter},
          fit.not_determined,
          "damped cosine through the large grains' φ(y), y = " + cell(decay_window_start) +
              " d to " + cell(fit.window_end) +
              " d from both walls; d_avg = " + fixed(diameter, 3) + " d, R² " +
              fixed(fit.r_squared, 3) + ", misfit " + fixed(fit.misfit, 1)};
}

double mean_over(const Group& group, double PackingResult::*member) {
  double sum = 0.0;
  for (const PackingResult& result : group.settled) sum += result.*member;
  return sum / static_cast<double>(group.settled.size());
}

void add_reach(const Family& family, const Group& group, Rows& rows) {
  const DecayFit fit = decay_of(group, GrainClass::large);
  const Printed printed = printed_of(family);
  rows.push_back(row_of_decay(family, fit, printed.decay, "by number",
                              mean_over(group, &PackingResult::mean_diameter)));
  if (chunk_of(family) > 0.0) {
    rows.push_back(row_of_decay(family, fit, printed.decay, "by volume",
                                mean_over(group, &PackingResult::mean_diameter_by_volume)));
  }
  rows.push_back({family.name,
                  "reach of the wall / d at W = 10 d",
                  printed.reach,
                  {fit.reach.value, fit.reach.error},
                  fit.not_determined,
                  "where that oscillation has fallen to " + cell(100.0 * decay_reach_share) +
                      " % of the bulk solid fraction; the paper's is read from its profiles"});
}

void add_zone(const Family& family, const Group& group, Rows& rows) {
  const WallZone zone = wall_zone(group);
  rows.push_back({family.name,
                  "drop of Z at the wall, W = 10 d",
                  printed_of(family).drop,
                  {zone.drop.mean, standard_error(zone.drop)},
                  zone.not_determined,
                  "grains farther than " + cell(core_distance) + " d from both walls less those " +
                      "nearer than " + cell(first_layer) + " d, walls not counted" +
                      gap_text(group)});
  rows.push_back({family.name,
                  "width of the drop of Z / d, W = 10 d",
                  not_printed,
                  {zone.width.mean, standard_error(zone.width)},
                  zone.not_determined,
                  "of a layer with the wall's Z at each wall that has the packing's mean Z"});
}

void add_profiles(const Family& family, Rows& rows) {
  const Group* group = group_at(family, profile_width);
  if (group != nullptr) {
    add_reach(family, *group, rows);
    add_zone(family, *group, rows);
    return;
  }
  for (const char* quantity : {"λ_L / d_avg at W = 10 d", "reach of the wall / d at W = 10 d",
                               "drop of Z at the wall, W = 10 d"}) {
    rows.push_back({family.name, quantity, not_printed, {}, no_group_at(profile_width), ""});
  }
}

void add_family(const Family& family, Rows& rows) {
  add_reference(family, Quantity::solid_fraction, not_printed, rows);
  add_reference(family, Quantity::coordination, printed_of(family).coordination, rows);
  if (family.walled.empty()) return;
  add_fits(family, rows);
  for (const double width : {5.0, 10.0, 20.0}) {
    add_width(family, Quantity::solid_fraction, width, rows);
    add_width(family, Quantity::coordination, width, rows);
  }
  add_profiles(family, rows);
}

/// lambda_L at W = 10 d against C, for the families that have both.
std::vector<ErrorPoint> decays_and_slopes(const std::vector<Family>& families) {
  std::vector<ErrorPoint> points;
  for (const Family& family : families) {
    const Group* group = group_at(family, profile_width);
    const WallFit phi = fit_walls(family, Quantity::solid_fraction);
    if (group == nullptr || !phi.not_determined.empty()) continue;
    const DecayFit decay = decay_of(*group, GrainClass::large);
    if (!decay.not_determined.empty()) continue;
    points.push_back(
        {phi.slope.value, widened(phi.slope.error, phi), decay.length.value, decay.length.error});
  }
  return points;
}

void add_line_of_families(const std::vector<Family>& families, Rows& rows) {
  constexpr std::size_t least_families = 3;
  const std::vector<ErrorPoint> points = decays_and_slopes(families);
  Comparison row{"all families", "λ_L / C", words("one line through 0"), {}, "", ""};
  if (points.size() < least_families) {
    row.not_determined =
        "needs C, and λ_L at W = 10 d, of 3 or more families, has " + std::to_string(points.size());
  } else {
    const Proportionality line = fit_proportionality(points);
    row.ours = {line.slope, line.error};
    row.definition = "λ_L = slope C over " + std::to_string(points.size()) + " families, χ²/dof " +
                     fixed(line.chi2_per_dof, 1) + " (about 1 if one line holds them)";
  }
  rows.push_back(row);
}

/// Two significant digits of the error.
int decimals_for(double error) {
  if (!(error > 0.0) || !std::isfinite(error)) return 3;
  return std::clamp(1 - static_cast<int>(std::floor(std::log10(error))), 0, 6);
}

std::string row_text(const Comparison& row) {
  const int decimals = decimals_for(row.ours.error);
  const std::string start = "  " + pad_right(row.quantity, 35) + pad_left(row.paper.text, 19);
  if (!row.not_determined.empty()) return start + "  not determined: " + row.not_determined + "\n";
  const auto miss = difference(row), in_errors = difference_in_errors(row);
  return start +
         pad_left(fixed(row.ours.value, decimals) + " ± " + fixed(row.ours.error, decimals), 20) +
         pad_left(miss ? fixed(*miss, decimals) : "-", 11) +
         pad_left(in_errors ? fixed(*in_errors, 1) : "-", 11) + "\n      " + row.definition + "\n";
}

}  // namespace

std::optional<double> difference(const Comparison& comparison) {
  if (!comparison.paper.range || !comparison.not_determined.empty()) return std::nullopt;
  const PaperValue::Range& range = *comparison.paper.range;
  return comparison.ours.value - std::clamp(comparison.ours.value, range.low, range.high);
}

std::optional<double> difference_in_errors(const Comparison& comparison) {
  const auto miss = difference(comparison);
  if (!miss) return std::nullopt;
  return *miss / std::hypot(comparison.ours.error, comparison.paper.range->error);
}

std::vector<Comparison> compare_with_paper(const std::vector<Family>& families) {
  Rows rows;
  for (const Family& family : families) add_family(family, rows);
  add_line_of_families(families, rows);
  return rows;
}

std::string comparison_text(const std::vector<Comparison>& comparisons) {
  std::string text, family;
  for (const Comparison& row : comparisons) {
    if (row.family != family) {
      family = row.family;
      text += (text.empty() ? "" : "\n") + family + "\n  " + pad_right("", 35) +
              pad_left("paper", 19) + pad_left("here ± std. error", 20) +
              pad_left("difference", 11) + pad_left("in errors", 11) + "\n";
    }
    text += row_text(row);
  }
  return text;
}

}  // namespace grainsweep
