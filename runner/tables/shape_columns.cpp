#include "runner/tables/shape_columns.hpp"

#include <algorithm>

namespace grainsweep {

std::array<double, shape_columns.size()> shape_values(const ShapeOrder& order) {
  std::array<double, shape_columns.size()> values{};
  auto next = values.begin();
  for (const auto& three : {order.contact_share, order.force_share, order.nematic}) {
    next = std::copy(three.begin(), three.end(), next);
  }
  return values;
}

std::vector<std::string> shape_header(bool with_sd) {
  std::vector<std::string> names;
  for (const std::string name : shape_columns) {
    names.push_back(name);
    if (with_sd) names.push_back(name + "_sd");
  }
  return names;
}

}  // namespace grainsweep
