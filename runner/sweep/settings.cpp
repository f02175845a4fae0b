#include "runner/sweep/settings.hpp"

#include "runner/sweep/shape_kind.hpp"
#include "runner/sweep/suggest.hpp"
#include "runner/sweep/values.hpp"

namespace grainsweep {
namespace {

std::string dotted(const std::string& path, const std::string& key) {
  return path.empty() ? key : path + "." + key;
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

/// The shortest full path that ends in a misplaced key; "" if none does.
std::string path_that_ends_in(const std::string& key) {
  std::string found;
  for (const std::string& path : known_keys("")) {
    const bool is_shorter = found.empty() || path.size() < found.size();
    if (path.ends_with("." + key) && is_shorter) found = path;
  }
  return found;
}

/// Keys that the group knows, and the full path of what a misplaced key names.
std::string unknown_path(const std::string& group, const std::string& key) {
  const std::string elsewhere = path_that_ends_in(key);
  if (elsewhere.empty()) return unknown_key(key, known_keys(group));
  return "unknown key \"" + key + "\"; did you mean \"" + elsewhere + "\"?";
}

void read_group(const std::string& group, const Json& object, const std::string& pointer,
                Settings& settings, Problems& problems) {
  for (const auto& [key, value] : object.items()) {
    const std::string path = dotted(group, key);
    const std::string place = child_pointer(pointer, key);
    if (find_parameter(path) || (is_group(path) && !key.empty())) {
      read_settings(path, value, place, settings, problems);
    } else {
      problems.push_back({place, unknown_path(group, key), Anchor::key});
    }
  }
}

void unset(Choice choice, Resolved& resolved) {
  for (std::size_t i = 0; i < resolved.size(); ++i) {
    if (choice_of(parameters()[i]) == choice) resolved[i] = nullptr;
  }
}

ShapeKind shape_of(const Resolved& resolved) {
  ShapeKind shape = ShapeKind::none;
  for (const Setting* setting : resolved) {
    if (setting != nullptr) shape = more_exact(shape, shape_named_by(*setting));
  }
  return shape;
}

/// Whether all parameters of the group name the same shape as `part` does.
bool are_parts_of(const std::string& group, Role part) {
  const std::string& path = parameters()[parameter_with(part)].path;
  return path.substr(0, path.rfind('.')) == group;
}

/// An empty group says nothing, except that grains are pinacoids of the default size.
void read_empty_group(const std::string& group, const std::string& pointer, Settings& settings,
                      Problems& problems) {
  const std::size_t shape = parameter_with(Role::shape);
  if (are_parts_of(group, Role::pinacoid)) {
    read_parameter(shape, "pinacoid", pointer, settings, problems);
  } else if (are_parts_of(group, Role::hull_vertices)) {
    problems.push_back({pointer, "a hull needs its vertices: write \"vertices\" or \"file\""});
  } else if (find_parameter(group) == shape) {
    problems.push_back({pointer, "names no shape; must be " + wanted_value(parameters()[shape])});
  }
}

std::string wanted_group(const std::string& path) {
  const std::string preset = preset_of(path) ? "the name of a preset or " : "";
  return "must be " + preset + "an object with " + short_list(known_keys(path)) + ", is ";
}

/// Notes the first setting of a shape that excludes what was set before it.
void refuse_second_shape(const Settings& settings, Problems& problems) {
  const Setting* first = nullptr;
  ShapeKind kind = ShapeKind::none;
  for (const Setting& setting : settings) {
    const ShapeKind named = shape_named_by(setting);
    if (exclude_each_other(kind, named)) {
      problems.push_back({setting.pointer, "the grains already have the shape at " +
                                               first->pointer +
                                               "; keep one of sphere, pinacoid, hull.vertices, "
                                               "hull.file"});
      return;
    }
    if (first == nullptr && named != ShapeKind::none) first = &setting;
    kind = more_exact(kind, named);
  }
}

}  // namespace

void read_settings(const std::string& path, const Json& value, const std::string& pointer,
                   Settings& settings, Problems& problems) {
  const auto index = find_parameter(path);
  if (index && !(value.is_object() && is_group(path))) {
    read_parameter(*index, value, pointer, settings, problems);
  } else if (const auto preset = preset_of(path); preset && value.is_string()) {
    read_parameter(*preset, value, pointer, settings, problems);
  } else if (value.is_object()) {
    if (value.empty()) read_empty_group(path, pointer, settings, problems);
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
  refuse_second_shape(settings, problems);
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
  ShapeKind shape = ShapeKind::none;
  for (const Settings* part : layer) {
    for (const Setting& setting : *part) {
      fills = fills || is_fill(setting.parameter);
      shape = more_exact(shape, shape_named_by(setting));
    }
  }
  if (fills) unset(Choice::fill, resolved);
  const bool is_named = shape != ShapeKind::none;
  if (is_named && exclude_each_other(shape, shape_of(resolved))) unset(Choice::shape, resolved);
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
