#include "runner/sweep/point_problems.hpp"

#include <algorithm>
#include <variant>

#include "engine/text.hpp"
#include "runner/sweep/suggest.hpp"
#include "runner/sweep/values.hpp"

namespace grainsweep {
namespace {

/// `shape "cube"`.
std::string text_of(const Assignment& assignment) {
  const Parameter& parameter = parameters()[assignment.parameter];
  const auto* number = std::get_if<double>(&assignment.value);
  return parameter.path + " " +
         (number != nullptr ? bound_text(*number)
                            : shortened(written_value(parameter, assignment.value).dump()));
}

/// `block "plates"`; blocks without a label are numbered from one.
std::string name_of(const Block& block) {
  return block.label.starts_with("block ") ? block.label : "block \"" + block.label + "\"";
}

}  // namespace

void PointProblems::begin_point(const Block& block, const std::vector<const Assignments*>& entries,
                                const InEffect& in_effect) {
  ++point_;
  block_ = &block;
  entries_ = entries;
  ++points_with_[&block];
  for (const Assignment* assignment : in_effect) {
    if (assignment != nullptr) ++points_with_[assignment];
  }
}

void PointProblems::note(const std::string& key, const std::string& pointer,
                         const std::string& message, const Assignment* value, double asked) {
  const auto [entry, is_new] = said_.try_emplace(key_in_block(key, message));
  Said& said = entry->second;
  if (is_new) {
    said.block = block_;
    said.holder = value != nullptr ? static_cast<const void*>(value) : block_;
    said.first_point = point_;
    said.where = name_of_point();
    said.asked = asked;
  }
  if (said.last_point != point_) ++said.points;
  said.last_point = point_;
  if (has_said(said, message)) return;
  if (said.first_point != point_) {
    said.differs = true;
    if (asked > said.asked && said.diagnostics.size() == 1) tell_instead(said, message, asked);
    return;
  }
  said.diagnostics.push_back(diagnostics_.size());
  diagnostics_.push_back({pointer, message});
}

void PointProblems::tell_instead(Said& said, const std::string& message, double asked) {
  diagnostics_[said.diagnostics.front()].message = message;
  said.where = name_of_point();
  said.asked = asked;
}

bool PointProblems::has_said(const Said& said, const std::string& message) const {
  return std::any_of(said.diagnostics.begin(), said.diagnostics.end(),
                     [&](std::size_t index) { return diagnostics_[index].message == message; });
}

std::string PointProblems::key_in_block(const std::string& key, const std::string& message) const {
  const auto known = said_.find(key);
  if (known == said_.end() || known->second.block == nullptr || known->second.block == block_ ||
      has_said(known->second, message)) {
    return key;
  }
  return key + " of block " + std::to_string(block_ - definition_.blocks.data());
}

void PointProblems::name_points() {
  for (const auto& [key, said] : said_) {
    const bool is_of_all = said.points >= points_with_[said.holder] && !said.differs;
    if (is_of_all) continue;
    for (const std::size_t index : said.diagnostics) {
      diagnostics_[index].message += " (" + said.where + ")";
    }
  }
}

std::string PointProblems::name_of_point() const {
  std::string name = definition_.blocks.size() > 1 ? "in " + name_of(*block_) : "";
  const std::string values = values_of_point();
  if (values.empty()) return name;
  return name + (name.empty() ? "" : " ") + "with " + values;
}

std::string PointProblems::values_of_point() const {
  std::string values;
  for (const Assignments* entry : entries_) {
    for (const Assignment& assignment : *entry) {
      values += (values.empty() ? "" : ", ") + text_of(assignment);
    }
  }
  return values;
}

}  // namespace grainsweep
