#include "runner/jobs/growing_fits.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <optional>
#include <set>

#include "engine/units.hpp"
#include "runner/analysis/fit.hpp"
#include "runner/analysis/student.hpp"
#include "runner/jobs/replicate_means.hpp"

namespace grainsweep {
namespace {

/// A coefficient whose error is requested.
struct Target {
  bool is_coordination = false;
  bool is_slope = false;
  double half_interval = 0.0;  ///< what is left for the scatter; 0 if nothing is: never met
};

std::vector<Target> targets_of(const FitWish& wish, const std::optional<ProtocolBias>& bound) {
  const ProtocolBias bias = bound.value_or(ProtocolBias());
  std::vector<Target> targets;
  const auto add = [&](bool is_coordination, bool is_slope, double asked, double known) {
    const double left = std::max(0.0, asked - known);
    if (asked > 0.0) targets.push_back({is_coordination, is_slope, left});
  };
  add(false, false, wish.phi_bulk, bias.solid_fraction);
  add(false, true, wish.c, 0.0);
  add(true, false, wish.z_bulk, bias.coordination);
  add(true, true, wish.c_z, 0.0);
  return targets;
}

/// Sums over the packings of a line, of 1, x and x^2 with x = 1 / W, each with its weight, one over
/// its variance.
struct Design {
  double n = 0.0, x = 0.0, xx = 0.0;

  void add(double weight, double at) {
    n += weight;
    x += weight * at;
    xx += weight * at * at;
  }
  double determinant() const { return n * xx - x * x; }

  /// Variance of a coefficient.
  double variance(bool is_slope) const { return (is_slope ? n : xx) / determinant(); }

  /// What one more packing takes from that variance, over its weight.
  double gain(bool is_slope, double weight, double at) const {
    const double to_both = (is_slope ? n * at - x : xx - x * at) / determinant();
    const double leverage = (xx - 2.0 * x * at + n * at * at) / determinant();
    return to_both * to_both / (1.0 + weight * leverage);
  }
};

/// One for each quantity.
struct Designs {
  Design phi, z;

  Design& of(bool is_coordination) { return is_coordination ? z : phi; }
  const Design& of(bool is_coordination) const { return is_coordination ? z : phi; }
};

/// The first packings of each group, which are made.
class Round {
 public:
  Round(const std::vector<FitGroup>& groups, const std::vector<int>& replicates)
      : groups_(groups), replicates_(replicates) {
    std::map<std::size_t, std::vector<const Outcome*>> made;  // of each mean
    for (std::size_t k = 0; k < groups.size(); ++k) {
      settled_.push_back(means_of(groups[k].made, replicates[k]).solid_fraction.n);
      std::vector<const Outcome*>& of_mean = made[groups[k].mean];
      of_mean.insert(of_mean.end(), groups[k].made.begin(), groups[k].made.begin() + replicates[k]);
    }
    for (const auto& [mean, outcomes] : made) {
      means_[mean] = means_of(outcomes, static_cast<int>(outcomes.size()));
    }
    find_line();
    for (std::size_t k = 0; k < groups.size(); ++k) {
      volumes_.try_emplace(groups[k].mean, volume_of(k));
      if (are_on_line_[k] && settled_[k] > 0) widths_[groups[k].mean] = groups[k].width;
    }
    moderate(&Means::solid_fraction);
    moderate(&Means::coordination);
    for (std::size_t k = 0; k < groups.size(); ++k) {
      if (are_on_line_[k] && settled_[k] > 0) add_to(design_, k, settled_[k]);
    }
    std::set<double> widths;
    for (const auto& [mean, width] : widths_) widths.insert(width);
    has_widths_ = widths.size() >= least_widths_of_line;
    has_line_ = has_widths_ && std::any_of(means_.begin(), means_.end(), [](const auto& one) {
                  return one.second.solid_fraction.degrees_of_freedom > 0.0;
                });
  }

  /// The worst half of a 95 % interval over what is requested; at most 1 if all requests are met.
  double over(const std::vector<Target>& targets) const {
    double worst = 0.0;
    for (const Target& target : targets) worst = std::max(worst, over(target, design_));
    return worst;
  }

  /// The same with errors as fits.csv has them.
  double over_widened(const std::vector<Target>& targets) const {
    double worst = 0.0;
    for (const Target& target : targets) {
      const auto line = line_of(target.is_coordination);
      if (!line) return 0.0;
      const double error = target.is_slope ? line->slope_error : line->intercept_error;
      worst = std::max(worst, normal_quantile * error / target.half_interval);
    }
    return worst;
  }

  /// Whether the packings scatter, so that the requested errors can be known; see why_no_error.
  bool tells_errors(const std::vector<Target>& targets) const {
    if (!has_line_) return true;
    return std::all_of(targets.begin(), targets.end(), [&](const Target& target) {
      return std::all_of(widths_.begin(), widths_.end(), [&](const auto& point) {
        return why_no_error(spread_of(point.first, target.is_coordination)).empty();
      });
    });
  }

  /// Whether no packings would help, however many might be made: too few of them settle.
  bool settles_too_seldom() const {
    for (std::size_t k = 0; k < groups_.size(); ++k) {
      if (has_widths_ && goes_on(k)) return false;
    }
    return true;
  }

  /// As many replicates as these results call for; the same ones if none may be added. Where
  /// nothing settled at first nothing is added, so that fewer than three widths never become a
  /// line.
  std::vector<int> next(const std::vector<Target>& targets) const {
    std::vector<int> more = replicates_;
    int before = 0;
    for (std::size_t k = 0; k < more.size(); ++k) before += groups_[k].may_grow ? more[k] : 0;
    if (!has_line_) {
      for (std::size_t k = 0; has_widths_ && k < more.size(); ++k) {
        more[k] = std::min(2 * more[k], most(k));
      }
      return more;
    }
    Designs design = design_;
    for (int added = 0; added < before; ++added) {
      const Target& target = *std::max_element(
          targets.begin(), targets.end(),
          [&](const Target& a, const Target& b) { return over(a, design) < over(b, design); });
      const bool is_enough = added > 0 && over(target, design) <= 1.0;
      const auto best = is_enough ? std::nullopt : best_group(target, design, more);
      if (!best) break;
      ++more[*best];
      add_to(design, *best, 1);
    }
    return more;
  }

 private:
  /// Which groups are on the line, as fits.csv has it: of widths where something settles.
  void find_line() {
    std::vector<LineWidth> widths;
    for (std::size_t k = 0; k < groups_.size(); ++k) {
      const bool may_be = groups_[k].is_walled && settled_[k] > 0;
      widths.push_back({groups_[k].width, groups_[k].is_narrow || !may_be});
    }
    are_on_line_ = widths_on_line(widths);
    for (std::size_t k = 0; k < groups_.size(); ++k) {
      are_on_line_[k] = are_on_line_[k] && groups_[k].is_walled;
    }
  }

  /// Of the slab of a group's packings, d^3; NaN if none has settled.
  double volume_of(std::size_t k) const {
    return groups_[k].floor_area * means_.at(groups_[k].mean).slab_height.mean;
  }

  std::optional<LineFit> line_of(bool is_coordination) const {
    if (!has_line_) return std::nullopt;
    std::vector<LinePoint> points;
    for (const auto& [mean, width] : widths_) {
      const Spread& spread = spread_of(mean, is_coordination);
      points.push_back({1.0 / width, spread.mean, spread.error});
    }
    return fit_scattered_line(points);
  }

  /// Gives the means of a quantity the errors that they have in groups.csv.
  void moderate(Spread Means::*quantity) {
    std::vector<SlabMean> slab_means;
    for (auto& [mean, means] : means_) {
      slab_means.push_back({&(means.*quantity), volumes_.at(mean)});
    }
    moderate_errors(slab_means);
  }

  /// One over the variance of a packing of group k.
  double weight_of(std::size_t k, bool is_coordination) const {
    const Spread& spread = spread_of(groups_[k].mean, is_coordination);
    return 1.0 / (spread.error * spread.error * spread.n);
  }

  void add_to(Designs& designs, std::size_t k, int packings) const {
    for (const bool is_coordination : {false, true}) {
      designs.of(is_coordination)
          .add(packings * weight_of(k, is_coordination), 1.0 / groups_[k].width);
    }
  }

  const Spread& spread_of(std::size_t mean, bool is_coordination) const {
    const Means& means = means_.at(mean);
    return is_coordination ? means.coordination : means.solid_fraction;
  }

  double over(const Target& target, const Designs& designs) const {
    if (!has_line_) return infinity;
    const double variance = designs.of(target.is_coordination).variance(target.is_slope);
    return normal_quantile * std::sqrt(variance) / target.half_interval;
  }

  /// Whether packings may be added to a group.
  bool goes_on(std::size_t k) const {
    return groups_[k].may_grow && are_on_line_[k] &&
           !settle_too_seldom(settled_[k], replicates_[k]);
  }

  int most(std::size_t k) const {
    return goes_on(k) ? static_cast<int>(groups_[k].made.size()) : replicates_[k];
  }

  /// Where one more packing gains most; nothing if no group may have more.
  std::optional<std::size_t> best_group(const Target& target, const Designs& designs,
                                        const std::vector<int>& replicates) const {
    std::optional<std::size_t> best;
    double most_gained = -1.0;
    for (std::size_t k = 0; k < groups_.size(); ++k) {
      if (replicates[k] >= most(k)) continue;
      const double weight = weight_of(k, target.is_coordination);
      const double gained =
          designs.of(target.is_coordination).gain(target.is_slope, weight, 1.0 / groups_[k].width) *
          weight / volumes_.at(groups_[k].mean);
      if (gained <= most_gained) continue;
      most_gained = gained;
      best = k;
    }
    return best;
  }

  const std::vector<FitGroup>& groups_;
  const std::vector<int>& replicates_;
  std::vector<int> settled_;               ///< of each group
  std::vector<bool> are_on_line_;          ///< of each group
  std::map<std::size_t, Means> means_;     ///< of groups.csv
  std::map<std::size_t, double> volumes_;  ///< of their slabs, d^3
  std::map<std::size_t, double> widths_;   ///< of those on the line, d
  Designs design_;
  bool has_widths_ = false;  ///< so many that there may be a line
  bool has_line_ = false;
};

bool are_made(const std::vector<FitGroup>& groups, const std::vector<int>& replicates) {
  for (std::size_t k = 0; k < groups.size(); ++k) {
    const auto end = groups[k].made.begin() + replicates[k];
    if (std::find(groups[k].made.begin(), end, nullptr) != end) return false;
  }
  return true;
}

}  // namespace

CalledFit called_for_fit(const std::vector<FitGroup>& groups, const FitWish& wish,
                         const std::optional<ProtocolBias>& bound) {
  const std::vector<Target> targets = targets_of(wish, bound);
  CalledFit called;
  for (const FitGroup& group : groups) {
    const int most = static_cast<int>(group.made.size());
    called.replicates.push_back(group.may_grow ? std::min(first_replicates, most) : most);
  }
  while (are_made(groups, called.replicates)) {
    const Round round(groups, called.replicates);
    std::vector<int> next = called.replicates;
    called.tells_errors = round.tells_errors(targets);
    called.is_met = called.tells_errors && round.over(targets) <= 1.0;
    if (called.tells_errors && !called.is_met) next = round.next(targets);
    if (next == called.replicates) {
      called.is_made = true;
      called.settles_too_seldom =
          called.tells_errors && !called.is_met && round.settles_too_seldom();
      called.over_widened = round.over_widened(targets);
      return called;
    }
    called.replicates = std::move(next);
  }
  called.is_met = false;
  return called;
}

}  // namespace grainsweep
