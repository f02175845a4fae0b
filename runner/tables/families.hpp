// Which packings belong to one wall-effect line, and what to call them.
#pragma once

#include <algorithm>
#include <iterator>
#include <optional>
#include <string>
#include <vector>

#include "runner/tables/groups.hpp"

namespace grainsweep {

/// Groups with equal parameters but for box.width and box.y.
struct Family {
  std::string labels;         ///< of its walled groups, or of all if none is walled: "MSP + open"
  std::string distinction;    ///< what tells it from families of the same labels, "solid_height=9"
  std::string name;           ///< both
  std::string parameters;     ///< canonical JSON without box.width and box.y
  std::vector<Group> walled;  ///< y walled, by ascending width
  std::vector<Group> periodic;  ///< y periodic, by ascending width
  /// Without any walls and with a settled packing, the widest such: of its own, or, as tubes and
  /// ducts have none, of another family that differs in nothing but its container and its fill.
  std::optional<Group> unconfined;
};

/// Its first group between walls, or without.
const Group& first_group(const Family& family);

/// The symbol for the extents of the containers of the groups that `group_of` gives for each of
/// `items`: W, the gap between walls, D, the diameter of a tube, or "W or D".
template <class Items, class GroupOf>
std::string extent_symbol(const Items& items, GroupOf group_of) {
  const auto tubes = std::count_if(
      items.begin(), items.end(), [&](const auto& item) { return group_of(item).job.box.is_tube; });
  if (tubes == 0) return "W";
  return tubes == std::ssize(items) ? "D" : "W or D";
}
std::string extent_symbol(const std::vector<Group>& groups);
std::string extent_symbol(const std::vector<Family>& families);

/// In the order in which they first appear.
std::vector<Family> families_of(const std::vector<Group>& groups);

/// What tables and report are made of.
struct Analysis {
  std::vector<Group> groups;
  std::vector<Family> families;
  std::string folder;  ///< as for GroupWithCurves
};

/// Refers to the rows, whose beds are stored in `folder`.
Analysis analyse(const std::vector<Row>& rows, const std::string& folder = "");
Analysis analyse(std::vector<Row>&& rows, const std::string& folder = "") = delete;

}  // namespace grainsweep
