// Assignments: values for parameters, each with the place where it was written.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "runner/sweep/diagnostic.hpp"
#include "runner/sweep/json_text.hpp"
#include "runner/sweep/parameters.hpp"

namespace grainsweep {

struct Assignment {
  std::size_t parameter = 0;  ///< index into parameters()
  Value value;
  std::string pointer;  ///< where it is written
  /// From a group that is written without parts: this default holds unless another value of the
  /// parameter does.
  bool is_usual = false;
};
using Assignments = std::vector<Assignment>;

/// Reads `value`, written at `pointer` for the parameter or group `path`, and appends the
/// assignments in it: one for a parameter, any number for a group written as an object. "accuracy"
/// may also be the name of a preset.
void read_assignments(const std::string& path, const Json& value, const std::string& pointer,
                      Assignments& assignments, Diagnostics& diagnostics);

/// The assignments of one object of parameters (nested, dotted or both). Nothing in it may be set
/// twice, the box may be filled in one way only, and the shape named only once.
Assignments read_layer(const Json& object, const std::string& pointer, Diagnostics& diagnostics);

/// Whether `path` names a parameter or a group; otherwise a problem at the key is noted.
bool is_known_path(const std::string& path, const std::string& pointer, Diagnostics& diagnostics);

/// Message: what is to be chosen is described in another way at `pointer`, and what to keep.
std::string described_already(Choice choice, const std::string& pointer);

/// Notes every parameter that is set twice in `assignments`, every second way to fill the box, a
/// second shape, and what describes the container, the sizes or the accuracy in another way.
void refuse_double_assignments(const Assignments& assignments, Diagnostics& diagnostics);

/// For every parameter the assignment that holds, or null for the default.
using InEffect = std::vector<const Assignment*>;

/// Writes the parts of one layer, which must outlive `in_effect`, over what holds so far. A layer
/// that fills the box replaces the fill written before it; one that names another shape replaces
/// the earlier shape with all its parts.
void overlay(const std::vector<const Assignments*>& layer, InEffect& in_effect);

/// The specification that `in_effect` describes. A preset fills in the parts of the accuracy that
/// nobody writes, in whatever layer it is named.
ResolvedSpec resolve(const InEffect& in_effect);

/// The assignment that an error about `path` is about. For a group it is the part that is written
/// and that the message mentions first, or else the first part that is written; for a part of the
/// accuracy that is not written it is the preset.
const Assignment* assignment_of(const SpecError& error, const InEffect& in_effect);

}  // namespace grainsweep
