#include "bench/trade/comparison.hpp"

#include <algorithm>
#include <cmath>

#include "runner/analysis/decay.hpp"
#include "runner/tables/csv.hpp"

namespace grainsweep::bench {
namespace {

/// Groups of starts that the jackknife leaves out.
constexpr int jackknife_groups = 16;

/// Mean profile of each side over these starts: the fit takes the mean, and its own errors are not
/// used.
double lambda_of(const Setting& setting, const std::vector<int>& starts) {
  std::vector<std::vector<double>> sides;
  for (const int start : starts) {
    for (const std::vector<double>& side : setting.layers.at(start)) sides.push_back(side);
  }
  const DecayFit fit = fit_decay(sides, setting.bin_width, setting.half_gap);
  return fit.not_determined.empty() ? fit.length.value : no_number;
}

MeanError lambda_difference(const Setting& setting, const Setting& reference) {
  std::vector<int> starts;
  for (const auto& [start, sides] : setting.layers) {
    if (reference.layers.contains(start)) starts.push_back(start);
  }
  if (starts.size() < 2) return {no_number, no_number, 0};
  return jackknife(starts, jackknife_groups, [&](const std::vector<int>& kept) {
    return lambda_of(setting, kept) - lambda_of(reference, kept);
  });
}

Compared compared(const Setting& setting, const Setting& reference, double balanced_cost) {
  Compared row;
  row.setting = &setting;
  row.made = setting.made;
  row.settled = setting.settled;
  row.cpu_seconds = median(setting.cpu_seconds);
  row.relative_cost = row.cpu_seconds / balanced_cost;
  row.solid_fraction = paired_difference(setting.solid_fraction, reference.solid_fraction);
  row.coordination = paired_difference(setting.coordination, reference.coordination);
  row.force_square = paired_difference(setting.force_square, reference.force_square);
  row.lambda = lambda_difference(setting, reference);
  row.contact_ratio = mean(setting.contact_ratio);
  row.own_solid_fraction = mean_error(setting.solid_fraction);
  row.own_coordination = mean_error(setting.coordination);
  row.own_force_square = mean_error(setting.force_square);
  return row;
}

/// How much nearer to the reference `a` is than `b`, in standard errors of that.
double nearer(const MeanError& a, const MeanError& b) {
  return (std::abs(b.mean) - std::abs(a.mean)) / std::hypot(a.error, b.error);
}

}  // namespace

bool beats(const Compared& a, const Compared& b) {
  const double solid_fraction = nearer(a.solid_fraction, b.solid_fraction);
  const double coordination = nearer(a.coordination, b.coordination);
  return a.cpu_seconds < b.cpu_seconds && a.settled * b.made >= b.settled * a.made &&
         std::min(solid_fraction, coordination) >= -1.0 &&
         std::max(solid_fraction, coordination) > 2.0;
}

std::vector<Compared> compare_settings(const Scene& scene) {
  double balanced_cost = no_number;
  for (const Setting& setting : scene.settings) {
    if (setting.preset == "balanced") balanced_cost = median(setting.cpu_seconds);
  }
  std::vector<Compared> all;
  for (const Setting& setting : scene.settings) {
    if (setting.made > 0) all.push_back(compared(setting, scene.settings.front(), balanced_cost));
  }
  mark_front(all);
  return all;
}

void mark_front(std::vector<Compared>& rows) {
  for (Compared& row : rows) {
    row.on_front = std::none_of(rows.begin(), rows.end(),
                                [&](const Compared& other) { return beats(other, row); });
  }
}

std::vector<ExactChange> exact_changes(const Scene& scene) {
  std::vector<ExactChange> changes;
  for (const Setting& exact : scene.settings) {
    if (!exact.is_exact()) continue;
    Parts parts = exact.parts;
    parts["rest"] = "in_steps";
    const Setting* begins = find_setting(scene, parts);
    if (begins == nullptr) continue;
    changes.push_back({&exact, begins,
                       paired_difference(exact.solid_fraction, begins->solid_fraction),
                       paired_difference(exact.coordination, begins->coordination)});
  }
  return changes;
}

}  // namespace grainsweep::bench
