#include "runner/report/published_profiles.hpp"

#include <algorithm>
#include <array>

#include "runner/report/plots.hpp"
#include "runner/tables/csv.hpp"

namespace grainsweep {
namespace {

/// The key of published profiles, an entry for each name: points have marks, formulas dashes, in
/// colours apart from those of what was measured.
std::vector<KeyEntry> key_of(const std::vector<PublishedPoints>& published) {
  constexpr std::array colours = {"#8a6d3b", "#303030", "#7a7a7a"};
  constexpr std::array marks = {3, 1, 2, 8};
  std::vector<KeyEntry> key;
  for (const PublishedPoints& one : published) {
    const bool is_known = std::any_of(
        key.begin(), key.end(), [&](const KeyEntry& entry) { return entry.title == one.name; });
    if (is_known) continue;
    const std::size_t k = key.size();
    const std::string colour = std::string(" lc rgb '") + colours.at(k % colours.size()) + "'";
    key.push_back({one.is_curve
                       ? "lines" + colour + " lw 1.4 dt " + cell(k % 4 + 2)
                       : "points" + colour + " pt " + cell(marks.at(k % marks.size())) + " ps 0.8",
                   one.name});
  }
  return key;
}

}  // namespace

std::set<std::size_t> groups_with_published(const std::vector<Comparison>& comparisons) {
  std::set<std::size_t> numbers;
  for (const Comparison& one : comparisons) {
    if (one.group > 0) numbers.insert(one.group);
  }
  return numbers;
}

std::vector<PublishedPoints> published_of(const std::vector<GroupWithCurves>& groups,
                                          const std::vector<Comparison>& comparisons) {
  std::vector<PublishedPoints> published;
  for (const Comparison& one : comparisons) {
    const auto group = std::find_if(groups.begin(), groups.end(),
                                    [&](const auto& of) { return of->number == one.group; });
    if (!one.published.profile || group == groups.end()) continue;
    const PublishedProfile& profile = *one.published.profile;
    PublishedPoints& points = published.emplace_back();
    points = {static_cast<std::size_t>(group - groups.begin()), one.published.quantity == "Z",
              !profile.formula.empty(), profile.name.empty() ? "published" : profile.name,
              profile.points};
    if (one.published.quantity != "porosity") continue;
    for (PublishedProfile::Point& point : points.points) point.value = 1.0 - point.value;
  }
  return published;
}

std::string published_csv(const std::vector<PublishedPoints>& published) {
  std::string text = csv_line({"profile", "panel", "quantity", "y", "value", "name"});
  for (std::size_t k = 0; k < published.size(); ++k) {
    const PublishedPoints& one = published[k];
    for (const PublishedProfile::Point& point : one.points) {
      text += csv_line({cell(k + 1), cell(one.column + 1), one.is_of_z ? "Z" : "solid_fraction",
                        cell(point.distance), cell(point.value), cell(one.name)});
    }
  }
  return text;
}

void append_published(std::size_t column, bool is_of_z,
                      const std::vector<PublishedPoints>& published,
                      std::vector<std::string>& parts) {
  const std::vector<KeyEntry> key = key_of(published);
  for (std::size_t k = 0; k < published.size(); ++k) {
    const PublishedPoints& one = published[k];
    if (one.column != column || one.is_of_z != is_of_z) continue;
    const auto entry = std::find_if(key.begin(), key.end(),
                                    [&](const KeyEntry& of) { return of.title == one.name; });
    parts.push_back(
        plot_part({published_profiles_table, "profile", k + 1, "y", "value", "", entry->style}));
  }
}

void append_key(const std::vector<PublishedPoints>& published, std::vector<KeyEntry>& key) {
  const std::vector<KeyEntry> own = key_of(published);
  key.insert(key.end(), own.begin(), own.end());
}

void append_values(const std::vector<PublishedPoints>& published, bool is_of_z,
                   std::vector<double>& ends) {
  for (const PublishedPoints& one : published) {
    if (one.is_of_z != is_of_z) continue;
    for (const PublishedProfile::Point& point : one.points) ends.push_back(point.value);
  }
}

}  // namespace grainsweep
