// Tables as the texts that stand in their files.
#pragma once

#include <string>
#include <vector>

#include "runner/tables/decays.hpp"
#include "runner/tables/distributions.hpp"
#include "runner/tables/packings.hpp"
#include "runner/tables/profiles.hpp"
#include "runner/tables/sizes.hpp"

namespace grainsweep {

inline std::string text_of(const CurveTable& table, const std::vector<Group>& groups) {
  std::string text = table.header;
  for (const Group& group : groups) text += table.lines(group);
  return text;
}

inline std::string profiles_csv(const std::vector<Group>& groups) {
  return text_of(profiles_table(varied_of(groups)), groups);
}

inline std::string decays_csv(const std::vector<Group>& groups) {
  return text_of(decays_table(varied_of(groups)), groups);
}

inline std::string distributions_csv(const std::vector<Group>& groups) {
  return text_of(distributions_table(varied_of(groups)), groups);
}

inline std::string sizes_csv(const std::vector<Group>& groups) {
  return text_of(sizes_table(varied_of(groups)), groups);
}

inline std::string packings_csv(const std::vector<Row>& rows, const std::vector<Group>& groups,
                                const GivenUnits& units = {}) {
  std::string text;
  write_packings_csv(rows, groups, units, [&](const std::string& line) { text += line; });
  return text;
}

}  // namespace grainsweep
