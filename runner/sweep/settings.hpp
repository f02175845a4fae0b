// Settings: values for parameters, each with the place where it was written.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "runner/sweep/json_text.hpp"
#include "runner/sweep/parameters.hpp"
#include "runner/sweep/problem.hpp"

namespace grainsweep {

struct Setting {
  std::size_t parameter = 0;  ///< index into parameters()
  Value value;
  std::string pointer;  ///< where it is written
};
using Settings = std::vector<Setting>;

/// Reads `value`, written at `pointer` for the parameter or group `path`, and appends the settings
/// in it: one for a parameter, any number for a group written as an object. "accuracy" may also be
/// the name of a preset.
void read_settings(const std::string& path, const Json& value, const std::string& pointer,
                   Settings& settings, Problems& problems);

/// The settings of one object of parameters (nested, dotted or both), in which nothing may be set
/// twice, and the box be filled in one way and the shape named once only.
Settings read_layer(const Json& object, const std::string& pointer, Problems& problems);

/// Whether `path` names a parameter or a group; otherwise a problem at the key is noted.
bool is_known_path(const std::string& path, const std::string& pointer, Problems& problems);

/// Notes every parameter that is set twice in `settings`, every second way to fill the box and a
/// second shape.
void refuse_double_settings(const Settings& settings, Problems& problems);

/// For every parameter the setting that holds, or null for the default.
using Resolved = std::vector<const Setting*>;

/// Writes the parts of one layer, which must outlive `resolved`, over what holds so far. A layer
/// that fills the box replaces the fill written before it; one that names another shape replaces
/// that one with all its parts.
void overlay(const std::vector<const Settings*>& layer, Resolved& resolved);

/// The draft that `resolved` describes. A preset fills in the parts of the accuracy that nobody
/// writes, in whatever layer it is named.
Draft draft_of(const Resolved& resolved);

}  // namespace grainsweep
