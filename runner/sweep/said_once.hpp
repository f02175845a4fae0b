// What many points of a sweep have in common is said once.
#pragma once

#include <set>
#include <string>

#include "runner/sweep/assignments.hpp"
#include "runner/sweep/diagnostic.hpp"

namespace grainsweep {

class SaidOnce {
 public:
  /// The diagnostics must outlive it.
  explicit SaidOnce(Diagnostics& diagnostics) : diagnostics_(diagnostics) {}

  /// What is wrong with a value: of several messages at its place the first.
  void problem(const Assignment& value, const std::string& message) {
    if (said_.insert(value.pointer).second) diagnostics_.push_back({value.pointer, message});
  }
  /// What is worth knowing at `pointer`: of each kind the first message. It hides no problem there.
  void remark(const std::string& pointer, const std::string& kind, const std::string& message) {
    if (!said_.insert(pointer + " " + kind).second) return;
    diagnostics_.push_back({pointer, message, Anchor::value, "", true});
  }

 private:
  Diagnostics& diagnostics_;
  std::set<std::string> said_;
};

}  // namespace grainsweep
