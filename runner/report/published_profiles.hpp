// Published profiles as the figure of profiles shows them.
#pragma once

#include <cstddef>
#include <set>
#include <string>
#include <vector>

#include "runner/compare/comparison.hpp"
#include "runner/report/figure.hpp"
#include "runner/tables/groups.hpp"

namespace grainsweep {

inline const std::string published_profiles_table = "profiles-published.csv";

/// A published profile of what a panel shows.
struct PublishedPoints {
  std::size_t column = 0;  ///< of the panel, from 0
  bool is_of_z = false;    ///< else of the solid fraction
  bool is_curve = false;   ///< of a formula; else points are all that is known
  std::string name;        ///< for the key
  std::vector<PublishedProfile::Point> points;
};

/// The numbers of the groups that published profiles are set beside.
std::set<std::size_t> groups_with_published(const std::vector<Comparison>& comparisons);

/// The published profiles of these groups, as solid fractions and coordination numbers.
std::vector<PublishedPoints> published_of(const std::vector<GroupWithCurves>& groups,
                                          const std::vector<Comparison>& comparisons);

/// A table of the figure: a line for each point.
std::string published_csv(const std::vector<PublishedPoints>& published);

/// Appends the published profiles that a panel shows.
void append_published(std::size_t column, bool is_of_z,
                      const std::vector<PublishedPoints>& published,
                      std::vector<std::string>& parts);

/// Appends an entry for each name of a published profile.
void append_key(const std::vector<PublishedPoints>& published, std::vector<KeyEntry>& key);

/// Appends the published values to those that the range of a row of panels holds.
void append_values(const std::vector<PublishedPoints>& published, bool is_of_z,
                   std::vector<double>& ends);

}  // namespace grainsweep
