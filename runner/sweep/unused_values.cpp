#include "runner/sweep/unused_values.hpp"

#include <algorithm>
#include <vector>

#include "runner/sweep/parameter_row.hpp"
#include "runner/sweep/suggest.hpp"
#include "runner/sweep/values.hpp"

namespace grainsweep {

namespace {

/// The parameters that a block varies.
std::vector<std::size_t> varied_by(const Block& block) {
  std::vector<std::size_t> varied;
  for (const Axis& axis : block.axes) {
    for (const Assignments& entry : axis.entries) {
      for (const Assignment& assignment : entry) varied.push_back(assignment.parameter);
    }
  }
  for (const RandomPath& path : block.random) {
    if (path.choices.empty()) varied.push_back(path.parameter);
    for (const Assignments& choice : path.choices) {
      for (const Assignment& assignment : choice) varied.push_back(assignment.parameter);
    }
  }
  return varied;
}

/// Which of `parameters_written` holds in the place of a value: itself, or another way to say the
/// same.
std::string held_instead(const Assignment& value,
                         const std::vector<std::size_t>& parameters_written) {
  const auto& written = parameters_written;
  const Parameter& set = parameters()[value.parameter];
  if (std::find(written.begin(), written.end(), value.parameter) != written.end()) return set.path;
  const auto other = std::find_if(written.begin(), written.end(), [&](std::size_t parameter) {
    return choice_of(set) != Choice::none && choice_of(parameters()[parameter]) == choice_of(set);
  });
  return other != written.end() ? parameters()[*other].path : set.path;
}

/// Why a value of "base" never holds.
std::string overridden_in_blocks(const Assignment& value, const std::vector<Block>& blocks) {
  const std::string& path = parameters()[value.parameter].path;
  std::vector<std::string> instead;
  for (const Block& block : blocks) {
    std::vector<std::size_t> written = varied_by(block);
    for (const Assignment& assignment : block.set) written.push_back(assignment.parameter);
    const std::string other = held_instead(value, written);
    const bool is_new = std::find(instead.begin(), instead.end(), other) == instead.end();
    if (other != path && is_new) instead.push_back(other);
  }
  if (instead.empty()) return "every block sets it itself";
  return "the blocks have " + comma_list(instead) + " in its place";
}

}  // namespace

void UnusedValues::note_use(const Block& block, const InEffect& in_effect,
                            const PackingSpec& spec) {
  const auto note_in = [&](auto& uses, const auto& key, std::size_t parameter) {
    const auto [use, is_new] = uses.try_emplace(key);
    if (is_new || !use->second.empty()) use->second = idle_reason(parameters()[parameter], spec);
  };
  const std::string drawn = block.random.empty() ? "" : block.pointer + "/random/";
  for (const Assignment* assignment : in_effect) {
    if (assignment == nullptr) continue;
    if (!drawn.empty() && assignment->pointer.starts_with(drawn)) {
      note_in(idle_drawn_, assignment->pointer, assignment->parameter);
    } else {
      note_in(idle_, assignment, assignment->parameter);
    }
  }
}

void UnusedValues::tell(const SweepDefinition& definition) {
  tell(definition.base, definition.blocks, nullptr);
  for (const Block& block : definition.blocks) {
    tell(block.set, {}, &block);
    for (const Axis& axis : block.axes) {
      for (const Assignments& entry : axis.entries) tell(entry, {}, &block);
    }
    for (const RandomPath& path : block.random) {
      note_choices_out_of_range(path);
      note_idle(path.pointer, idle_drawn_[path.pointer]);
    }
  }
}

void UnusedValues::note_idle(const std::string& pointer, const std::string& reason) {
  if (reason.empty()) return;
  diagnostics_.push_back({pointer, "has no effect: " + reason, Anchor::value, "", true});
}

void UnusedValues::note_choices_out_of_range(const RandomPath& path) {
  const auto is_told = [&](const std::string& pointer) {
    return std::any_of(diagnostics_.begin(), diagnostics_.end(),
                       [&](const Diagnostic& told) { return told.pointer == pointer; });
  };
  for (const Assignments& choice : path.choices) {
    for (const Assignment& assignment : choice) {
      const std::string error = range_error(parameters()[assignment.parameter], assignment.value);
      if (error.empty() || is_told(assignment.pointer)) continue;
      diagnostics_.push_back({assignment.pointer, error});
    }
  }
}

void UnusedValues::tell(const Assignments& assignments, const std::vector<Block>& overriding,
                        const Block* block) {
  for (const Assignment& assignment : assignments) {
    if (assignment.is_usual) continue;
    const auto use = idle_.find(&assignment);
    const Parameter& parameter = parameters()[assignment.parameter];
    if (use != idle_.end()) {
      note_idle(assignment.pointer, use->second);
      continue;
    }
    const std::string error = range_error(parameter, assignment.value);
    if (!error.empty()) {
      diagnostics_.push_back({assignment.pointer, error});
    } else if (block != nullptr) {
      diagnostics_.push_back(
          {assignment.pointer, "the block varies " + held_instead(assignment, varied_by(*block)) +
                                   ", so that this value is never used; take one of them out"});
    } else {
      diagnostics_.push_back({assignment.pointer,
                              "is never used: " + overridden_in_blocks(assignment, overriding),
                              Anchor::value, "", true});
    }
  }
}

}  // namespace grainsweep
