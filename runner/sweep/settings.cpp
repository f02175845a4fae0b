#include "runner/sweep/settings.hpp"

#include "runner/sweep/suggest.hpp"
#include "runner/sweep/values.hpp"

namespace grainsweep {
namespace {

std::string joined(const std::string& path, const std::string& key) {
  return path.empty() ? key : path + "." + key;
}

bool is_preset_name(const std::string& path, const Json& value) {
  return path == "accuracy" && value.is_string();
}

void read_parameter(std::size_t index, const Json& value, const std::string& pointer,
                    Settings& settings, Problems& problems) {
  ValueReading reading = read_value(parameters()[index], value);
  if (reading.value) {
    settings.push_back({index, std::move(*reading.value), pointer});
  } else {
    problems.push_back({pointer, reading.error});
  }
}

/// Keys that the group knows, and the full paths of parameters that end like a misplaced key.
std::string unknown_path(const std::string& group, const std::string& key) {
  if (joined(group, key).starts_with("shape.")) {
    return "this version packs spheres only; write \"shape\": \"sphere\"";
  }
  for (const Parameter& parameter : parameters()) {
    if (parameter.path.ends_with("." + key)) {
      return "unknown key \"" + key + "\"; did you mean \"" + parameter.path + "\"?";
    }
  }
  return unknown_key(key, known_keys(group));
}

void read_group(const std::string& group, const Json& object, const std::string& pointer,
                Settings& settings, Problems& problems) {
  for (const auto& [key, value] : object.items()) {
    const std::string path = joined(group, key);
    const std::string place = child_pointer(pointer, key);
    if (find_parameter(path) || (is_group(path) && !key.empty())) {
      read_settings(path, value, place, settings, problems);
    } else {
      problems.push_back({place, unknown_path(group, key), Anchor::key});
    }
  }
}

std::string wanted_group(const std::string& path) {
  const std::string preset = path == "accuracy" ? "the name of a preset or " : "";
  return "must be " + preset + "an object with " + comma_list(known_keys(path)) + ", is ";
}

}  // namespace

void read_settings(const std::string& path, const Json& value, const std::string& pointer,
                   Settings& settings, Problems& problems) {
  if (const auto index = find_parameter(path)) {
    read_parameter(*index, value, pointer, settings, problems);
  } else if (is_preset_name(path, value)) {
    read_parameter(*find_parameter("accuracy.preset"), value, pointer, settings, problems);
  } else if (value.is_object()) {
    read_group(path, value, pointer, settings, problems);
  } else {
    problems.push_back({pointer, wanted_group(path) + describe(value)});
  }
}

bool is_known_path(const std::string& path, const std::string& pointer, Problems& problems) {
  if (find_parameter(path) || (is_group(path) && !path.empty())) return true;
  problems.push_back({pointer, unknown_path("", path), Anchor::key});
  return false;
}

void refuse_double_settings(const Settings& settings, Problems& problems) {
  Resolved seen(parameters().size(), nullptr);
  const Setting* fill = nullptr;
  for (const Setting& setting : settings) {
    const Setting*& first = seen[setting.parameter];
    const std::string& path = parameters()[setting.parameter].path;
    if (first != nullptr) {
      problems.push_back({setting.pointer, path + " is already set at " + first->pointer});
    } else if (is_fill(setting.parameter) && fill != nullptr) {
      problems.push_back({setting.pointer, "the box is already filled by " +
                                               parameters()[fill->parameter].path +
                                               "; keep one of solid_height, grains, file"});
    }
    if (first == nullptr) first = &setting;
    if (fill == nullptr && is_fill(setting.parameter)) fill = &setting;
  }
}

Settings read_layer(const Json& object, const std::string& pointer, Problems& problems) {
  Settings settings;
  if (!object.is_object()) {
    problems.push_back({pointer, "must be an object of parameters, is " + describe(object)});
    return settings;
  }
  read_settings("", object, pointer, settings, problems);
  refuse_double_settings(settings, problems);
  return settings;
}

void overlay(const std::vector<const Settings*>& layer, Resolved& resolved) {
  bool fills = false;
  for (const Settings* part : layer) {
    for (const Setting& setting : *part) fills = fills || is_fill(setting.parameter);
  }
  for (std::size_t i = 0; fills && i < resolved.size(); ++i) {
    if (parameters()[i].path.starts_with("fill.")) resolved[i] = nullptr;
  }
  for (const Settings* part : layer) {
    for (const Setting& setting : *part) resolved[setting.parameter] = &setting;
  }
}

Draft draft_of(const Resolved& resolved) {
  Draft draft;
  for (std::size_t i = 0; i < resolved.size(); ++i) {
    if (resolved[i] != nullptr) parameters()[i].set(draft, resolved[i]->value);
  }
  return draft;
}

}  // namespace grainsweep
