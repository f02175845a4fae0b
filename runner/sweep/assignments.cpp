#include "runner/sweep/assignments.hpp"

#include <algorithm>
#include <string_view>
#include <utility>

#include "runner/sweep/misplaced_keys.hpp"
#include "runner/sweep/mixture_components.hpp"
#include "runner/sweep/shape_kind.hpp"
#include "runner/sweep/size_formulas.hpp"
#include "runner/sweep/suggest.hpp"
#include "runner/sweep/values.hpp"

namespace grainsweep {
namespace {

void read_parameter(std::size_t index, const Json& value, const std::string& pointer,
                    Assignments& assignments, Diagnostics& diagnostics) {
  if (parameters()[index].kind == ValueKind::components) {  // each has a place of its own
    auto components = read_components(value, pointer, diagnostics);
    if (components) assignments.push_back({index, std::move(*components), pointer});
    return;
  }
  ValueReading reading = read_value(parameters()[index], value);
  if (reading.value) {
    assignments.push_back({index, std::move(*reading.value), pointer});
  } else {
    const bool is_one_value =
        pointer.starts_with("/base/") || pointer.find("/set/") < pointer.size();
    const bool is_list = value.is_array() && reading.error.ends_with(describe(value));
    const char* const hint = is_one_value && is_list && !value.empty()
                                 ? "; a list of values belongs into the \"grid\" of a block"
                                 : "";
    diagnostics.push_back({pointer, reading.error + hint});
  }
}

constexpr const char* how_high =
    "; fill.solid_height says how much is filled in: a bed of height h is about 0.6 h of solid "
    "(its "
    "solid fraction times h), and plan prints the height to expect";

/// Why there is no parameter for what people of the field look for at `path`; "" for other paths.
/// "*.mu" stands for "mu" in any group.
std::string absence_of(const std::string& path) {
  if (path.starts_with("shape.mixture.")) {
    return "components cannot be varied one by one; list whole mixtures: "
           R"("grid": {"shape.mixture": [[...], [...]]})";
  }
  if (path.starts_with("shape.") && !why_not_packed(path.substr(6)).empty()) {
    return why_not_packed(path.substr(6));
  }
  using Reason = std::pair<std::string, std::vector<std::string_view>>;
  static const std::vector<Reason> reasons = {
      {"grains are frictionless", {"*.friction", "*.mu"}},
      {"grains do not bounce", {"*.restitution"}},
      {"grains are rigid", {"*.stiffness", "*.young_modulus"}},
      {"grains do not stick", {"*.cohesion"}},
      {"no result depends on the density of the grains; units.density, at the top of the file, "
       "is for bulk densities",
       {"*.density", "*.mass"}},
      {"gravity is the unit of acceleration and points down", {"*.gravity", "*.g"}},
      {"\"units\" stands at the top of the file; here lengths are in d, the mean diameter of the "
       "large grains, times in sqrt(d/g)",
       {"*.unit", "*.units"}},
      {std::string("the box is open at the top") + how_high,
       {"height", "depth", "box.height", "box.depth", "box.z", "fill.height"}},
      {std::string("a tube is open at the top") + how_high, {"tube.height", "tube.length"}},
      {"the box is open at the top", {"*.lid"}},
      {"write \"tube\": {\"diameter\": 7} in the place of the box", {"cylinder", "box.cylinder"}},
      {"a tube has a diameter; d is the mean diameter of the large grains",
       {"radius", "box.radius", "tube.radius"}},
      {"write \"diameter\", twice the radius", {"shape.cylinder.radius", "shape.prism.radius"}},
      {"shape.cylinder.chord_error sets how many sides a cylinder has; a prism has \"sides\"",
       {"shape.cylinder.sides"}},
      {"write \"height\"", {"shape.cylinder.length", "shape.prism.length"}},
      {"the mean diameter of the large grains is d, the unit of length",
       {"mean", "diameter", "sizes.mean", "sizes.diameter"}},
      {"write \"median\"; the mean is exp(sigma^2 / 2) times it",
       {"sizes.distribution.lognormal.mean"}},
      {"write \"sigma\", the standard deviation of the logarithm of the diameter",
       {"sizes.distribution.lognormal.std"}},
      {"a regular solid has a height, which is its edge times what configs/README.md says",
       {"shape.tetrahedron.edge", "shape.octahedron.edge", "shape.dodecahedron.edge",
        "shape.icosahedron.edge"}},
      {"sizes of a class are Gaussian; sizes.spread is their deviation over the mean",
       {"std", "sizes.std", "polydispersity", "sizes.polydispersity"}},
      {"write \"shape\": \"sphere\"; a sphere has no parts", {"shape.sphere"}},
      {"it stands beside \"base\", or in a block beside \"set\"", {"replicates"}},
      {"it stands in a block, beside \"set\"", {"label"}}};
  const std::string in_any_group = "*." + path.substr(path.rfind('.') + 1);
  for (const auto& [reason, paths] : reasons) {
    for (const std::string_view absent : paths) {
      if (absent == path || absent == in_any_group) return reason;
    }
  }
  return "";
}

/// What is wrong with a key "box.gap", if there is such a group, as with "gap" in it; else "".
std::string unknown_in_its_group(const std::string& path) {
  const std::size_t dot = path.rfind('.');
  if (dot == std::string::npos) return "";
  const std::string home = path.substr(0, dot), key = path.substr(dot + 1);
  const std::vector<std::string> known = known_keys(home);
  if (known.empty()) return "";
  const std::string near = nearest(key, known);
  const std::string meant = near.empty() ? path_that_ends_in(key, home) : dotted(home, near);
  return meant.empty() ? "known in " + home + ": " + short_list(known)
                       : "did you mean \"" + meant + "\"?";
}

/// What is wrong with a key of `group` that does not exist: why there is none, a word near it, the
/// full path of a key that is only misplaced, or the keys that `pointer` leads to.
std::string unknown_path(const std::string& group, const std::string& key,
                         const std::string& pointer) {
  const std::string start = "unknown key \"" + shortened(key) + "\"; ";
  if (auto reason = absence_of(dotted(group, key)); !reason.empty()) return start + reason;
  const std::string whole = path_with_members(dotted(group, key));
  if (!whole.empty()) return start + "did you mean \"" + whole + "\"?";
  const std::string in_its_group = group.empty() ? unknown_in_its_group(key) : "";
  if (!in_its_group.empty()) return start + in_its_group;
  std::vector<std::string> known = known_keys(group);
  if (pointer.starts_with("/base/")) std::erase(known, "seed");  // belongs beside it
  const bool is_misspelt = !group.empty() && !nearest(key, known).empty();
  const std::string elsewhere = is_misspelt ? "" : path_that_ends_in(key, group);
  if (!elsewhere.empty()) return start + "did you mean \"" + elsewhere + "\"?";
  return unknown_key(key, known);
}

void unset(Choice choice, InEffect& in_effect) {
  for (std::size_t i = 0; i < in_effect.size(); ++i) {
    if (choice_of(parameters()[i]) == choice) in_effect[i] = nullptr;
  }
}

std::string_view shape_of(const InEffect& in_effect) {
  std::string_view shape;
  for (const Assignment* assignment : in_effect) {
    if (assignment != nullptr) shape = more_exact(shape, shape_named_by(*assignment));
  }
  return shape;
}

/// The name of the shape that a group holds the parts of, if that has defaults; "" if not.
std::string usual_shape_of(const std::string& group) {
  const Parameter& shape = parameters()[parameter_with(Role::shape)];
  for (const std::string& name : shape.choices) {
    if (group == dotted(shape.path, name)) return name;
  }
  return "";
}

/// Sets the first part of an empty group, by which the group takes the place of another.
void read_usual_part(const std::string& group, const std::string& pointer,
                     Assignments& assignments) {
  const std::size_t part = *find_parameter(dotted(group, known_keys(group).front()));
  assignments.push_back({part, default_of(parameters()[part]).value(), pointer, true});
}

/// An empty group says nothing, except that a shape or a curve of sizes with its defaults takes the
/// place of another.
void read_empty_group(const std::string& group, const std::string& pointer,
                      Assignments& assignments, Diagnostics& diagnostics) {
  const std::size_t shape = parameter_with(Role::shape);
  const SizeFormulaKind* kind = size_formula_kind_of(group);
  if (kind != nullptr && kind->usual) return read_usual_part(group, pointer, assignments);
  if (const std::string name = usual_shape_of(group); !name.empty()) {
    read_parameter(shape, name, pointer, assignments, diagnostics);
  } else if (group == "shape.hull") {
    diagnostics.push_back({pointer, "a hull needs its vertices: write \"vertices\" or \"file\""});
  } else if (group.starts_with("sizes.distribution")) {
    diagnostics.push_back(
        {pointer, "describes no sizes; name at least one of " + short_list(known_keys(group))});
  } else if (find_parameter(group) == shape) {
    diagnostics.push_back(
        {pointer, "names no shape; must be " + wanted_value(parameters()[shape])});
  }
}

/// Reads what an object says about the parts of a group. An empty box takes the place of a tube
/// here; in a list, where other rows may be tubes, it says nothing.
void read_group(const std::string& group, const Json& object, const std::string& pointer,
                Assignments& assignments, Diagnostics& diagnostics) {
  for (const auto& [key, value] : object.items()) {
    const std::string path = dotted(group, key);
    const std::string place = child_pointer(pointer, key);
    const bool is_empty = value.is_object() && value.empty();
    if (is_empty && path == "box") {
      read_usual_part(path, place, assignments);
    } else if (is_empty && path == "tube") {
      diagnostics.push_back({place, R"(a tube needs its diameter: write {"diameter": 7})"});
    } else if (find_parameter(path) || (is_group(path) && !key.empty())) {
      read_assignments(path, value, place, assignments, diagnostics);
    } else {
      diagnostics.push_back({place, unknown_path(group, key, place), Anchor::key});
    }
  }
}

std::string wanted_group(const std::string& path) {
  const std::string preset = preset_of(path) ? "the name of a preset or " : "";
  return "must be " + preset + "an object with " + short_list(known_keys(path)) + ", is ";
}

/// Notes the first assignment of a shape that excludes one set before it.
void refuse_second_shape(const Assignments& assignments, Diagnostics& diagnostics) {
  const Assignment* first = nullptr;
  std::string_view kind;
  for (const Assignment& assignment : assignments) {
    const std::string_view named = shape_named_by(assignment);
    if (exclude_each_other(kind, named)) {
      diagnostics.push_back({assignment.pointer, "the grains already have the shape at " +
                                                     first->pointer + "; keep one of them"});
      return;
    }
    if (first == nullptr && !named.empty()) first = &assignment;
    kind = more_exact(kind, named);
  }
}

/// Notes the first assignment that describes the container, sizes or the accuracy in another way
/// than one before it.
void refuse_alternatives(const Assignments& assignments, Diagnostics& diagnostics) {
  for (std::size_t i = 0; i < assignments.size(); ++i) {
    const Parameter& parameter = parameters()[assignments[i].parameter];
    const auto end = assignments.begin() + static_cast<std::ptrdiff_t>(i);
    const auto other = std::find_if(assignments.begin(), end, [&](const Assignment& assignment) {
      return are_alternatives(parameters()[assignment.parameter], parameter);
    });
    if (other == end) continue;
    diagnostics.push_back(
        {assignments[i].pointer, described_already(choice_of(parameter), other->pointer)});
    return;
  }
}

/// Unsets whatever a new assignment describes in another way.
void unset_alternatives(const Assignment& assignment, InEffect& in_effect) {
  const Parameter& parameter = parameters()[assignment.parameter];
  if (choice_of(parameter) == Choice::none) return;
  for (std::size_t i = 0; i < in_effect.size(); ++i) {
    if (are_alternatives(parameters()[i], parameter)) in_effect[i] = nullptr;
  }
}

/// Where `message` about a group speaks of a part of it: a number, smaller the more likely the part
/// is meant. First comes a message that begins with the part, then one that begins with what the
/// part belongs to ("table.passing must ..." means the file of a table, too), then by where the
/// first word of the part's name is: "angle" for "angle_deg".
std::size_t mention_of(const std::string& part, const std::string& message) {
  if (message.starts_with(part + " ")) return 0;
  const std::size_t dot = part.rfind('.');
  if (dot != std::string::npos && message.starts_with(part.substr(0, dot + 1))) return 1;
  const std::string name = part.substr(dot + 1);  // all of it, if there is no dot
  const std::size_t mention = message.find(name.substr(0, name.find('_')));
  return mention == std::string::npos ? mention : mention + 2;
}

}  // namespace

void read_assignments(const std::string& path, const Json& value, const std::string& pointer,
                      Assignments& assignments, Diagnostics& diagnostics) {
  const auto index = find_parameter(path);
  if (index && !(value.is_object() && is_group(path))) {
    read_parameter(*index, value, pointer, assignments, diagnostics);
  } else if (const auto preset = preset_of(path); preset && value.is_string()) {
    read_parameter(*preset, value, pointer, assignments, diagnostics);
  } else if (value.is_object()) {
    if (value.empty()) read_empty_group(path, pointer, assignments, diagnostics);
    read_group(path, value, pointer, assignments, diagnostics);
  } else {
    diagnostics.push_back({pointer, wanted_group(path) + describe(value)});
  }
}

bool is_known_path(const std::string& path, const std::string& pointer, Diagnostics& diagnostics) {
  if (find_parameter(path) || (is_group(path) && !path.empty())) return true;
  diagnostics.push_back({pointer, unknown_path("", path, pointer), Anchor::key});
  return false;
}

std::string described_already(Choice choice, const std::string& pointer) {
  if (choice == Choice::container) {
    return "the container is already described at " + pointer + "; keep one of box, tube";
  }
  if (choice == Choice::accuracy) {
    return "the accuracy is already described at " + pointer +
           "; keep one: a preset, or what is asked for, solid_fraction and coordination";
  }
  return "the sizes are already described at " + pointer +
         "; keep one: two classes, or one distribution, " + size_formula_names(", ", ", or ") +
         " by lists or file";
}

void refuse_double_assignments(const Assignments& assignments, Diagnostics& diagnostics) {
  refuse_second_shape(assignments, diagnostics);
  refuse_alternatives(assignments, diagnostics);
  InEffect seen(parameters().size(), nullptr);
  const Assignment* fill = nullptr;
  for (const Assignment& assignment : assignments) {
    if (assignment.is_usual) continue;
    const Assignment*& first = seen[assignment.parameter];
    const std::string& path = parameters()[assignment.parameter].path;
    if (first != nullptr) {
      diagnostics.push_back({assignment.pointer, path + " is already set at " + first->pointer});
    } else if (is_fill(assignment.parameter) && fill != nullptr) {
      diagnostics.push_back({assignment.pointer,
                             "the box is already filled by " + parameters()[fill->parameter].path +
                                 "; keep one of solid_height, grains, file, files"});
    }
    if (first == nullptr) first = &assignment;
    if (fill == nullptr && is_fill(assignment.parameter)) fill = &assignment;
  }
}

Assignments read_layer(const Json& object, const std::string& pointer, Diagnostics& diagnostics) {
  Assignments assignments;
  if (!object.is_object()) {
    diagnostics.push_back({pointer, "must be an object of parameters, is " + describe(object)});
    return assignments;
  }
  read_assignments("", object, pointer, assignments, diagnostics);
  refuse_double_assignments(assignments, diagnostics);
  return assignments;
}

void overlay(const std::vector<const Assignments*>& layer, InEffect& in_effect) {
  bool fills = false, is_in_files = false;
  std::string_view shape;
  for (const Assignments* part : layer) {
    for (const Assignment& assignment : *part) {
      fills = fills || is_fill(assignment.parameter);
      is_in_files = is_in_files || is_fill_in_files(assignment.parameter);
      unset_alternatives(assignment, in_effect);
      shape = more_exact(shape, shape_named_by(assignment));
    }
  }
  const std::size_t unit = parameter_with(Role::fill_diameter);  // of any file
  const Assignment* const diameter = is_in_files ? in_effect[unit] : nullptr;
  if (fills) unset(Choice::fill, in_effect), in_effect[unit] = diameter;
  if (exclude_each_other(shape, shape_of(in_effect))) unset(Choice::shape, in_effect);
  for (const Assignments* part : layer) {
    for (const Assignment& assignment : *part) {
      const Assignment*& holds = in_effect[assignment.parameter];
      if (holds == nullptr || !assignment.is_usual) holds = &assignment;
    }
  }
}

ResolvedSpec resolve(const InEffect& in_effect) {
  ResolvedSpec resolved;
  for (std::size_t i = 0; i < in_effect.size(); ++i) {
    if (in_effect[i] != nullptr) parameters()[i].set(resolved, in_effect[i]->value);
  }
  return resolved;
}

const Assignment* assignment_of(const SpecError& error, const InEffect& in_effect) {
  if (const auto parameter = find_parameter(error.path)) {
    const bool is_of_preset = error.path.starts_with("accuracy.") && !in_effect[*parameter];
    return in_effect[is_of_preset ? parameter_with(Role::preset) : *parameter];
  }
  const Assignment* found = nullptr;
  std::size_t first = std::string::npos;
  for (const Assignment* assignment : in_effect) {
    if (assignment == nullptr) continue;
    const std::string& path = parameters()[assignment->parameter].path;
    if (!path.starts_with(error.path + ".")) continue;
    const std::size_t mention = mention_of(path.substr(error.path.size() + 1), error.message);
    if (found != nullptr && mention >= first) continue;
    found = assignment;
    first = mention;
  }
  return found;
}

}  // namespace grainsweep
