#include "runner/sweep/mixture_components.hpp"

#include <algorithm>
#include <utility>
#include <vector>

#include "engine/interval.hpp"
#include "runner/sweep/assignments.hpp"
#include "runner/sweep/identity.hpp"
#include "runner/sweep/suggest.hpp"
#include "runner/sweep/values.hpp"

namespace grainsweep {
namespace {

constexpr const char* share_key = "share";
constexpr Interval shares{0.0, 1.0};

/// Shapes that may be a component, and what stands beside them.
std::vector<std::string> component_keys() {
  std::vector<std::string> keys = {share_key};
  for (const std::string_view name : shape_names) {
    if (name != "mixture") keys.emplace_back(name);
  }
  return keys;
}

/// What is wrong with a key of a component; "" if nothing is.
std::string key_error(const std::string& key) {
  if (key.starts_with("mixture")) return "a component must not be a mixture itself";
  const std::vector<std::string> keys = component_keys();
  const bool is_known = std::find(keys.begin(), keys.end(), key) != keys.end();
  return is_known ? "" : unknown_key(key, keys);
}

/// Reads one component into `components`; notes what is wrong with it.
class ComponentReader {
 public:
  ComponentReader(std::string pointer, Diagnostics& diagnostics)
      : pointer_(std::move(pointer)), diagnostics_(diagnostics) {}

  void read(const Json& value, Components& components) {
    if (!value.is_object()) {
      return note("", "must be an object with a share and a shape, is " + describe(value));
    }
    Json shape = value;
    shape.erase(share_key);
    if (!has_right_keys(shape) || !has_share(value)) return;
    if (shape.contains("sphere")) shape = "sphere";  // which has no parts
    Assignments assignments;
    const std::size_t before = diagnostics_.size();
    read_assignments("shape", shape, pointer_, assignments, diagnostics_);
    refuse_double_assignments(assignments, diagnostics_);
    if (diagnostics_.size() > before || !has_vertices(assignments)) return;
    components.push_back(component_of(value.at(share_key).get<double>() + 0.0, assignments));
  }

 private:
  void note(const std::string& key, const std::string& message, Anchor anchor = Anchor::value) {
    diagnostics_.push_back(
        {key.empty() ? pointer_ : child_pointer(pointer_, key), message, anchor});
  }

  bool has_right_keys(const Json& shape) {
    bool is_right = true;
    for (const auto& [key, part] : shape.items()) {
      std::string error = key_error(key);
      const bool is_known = error.empty();
      if (is_known && !part.is_object()) {
        error = "must be an object of the shape's parts, {} for its defaults, is " + describe(part);
      } else if (is_known && key == "sphere" && !part.empty()) {
        error = "a sphere has no parts: write {}; its diameter is d times its size";
      }
      if (error.empty()) continue;
      note(key, error, is_known ? Anchor::value : Anchor::key);
      is_right = false;
    }
    if (shape.empty()) note("", "names no shape; must have " + short_list(component_keys()));
    if (is_right && shape.size() > 1) {
      note("", "names several shapes; give each of them a component and a share of its own");
    }
    return is_right && shape.size() == 1;
  }

  bool has_share(const Json& value) {
    const auto share = value.find(share_key);
    if (share == value.end()) {
      note("", "has no share; write \"share\": 0.5, with shares that add up to 1");
      return false;
    }
    if (share->is_number() && shares.holds(share->get<double>())) return true;
    note(share_key,
         "must be a number in " + shares.text() + ", is " + describe(*share) + of_percent(*share));
    return false;
  }

  /// Whether the component, if it is a hull, has vertices and a positive size; notes what is
  /// missing.
  bool has_vertices(const Assignments& assignments) {
    const auto has_role = [](Role role) {
      return [role](const Assignment& one) { return parameters()[one.parameter].role == role; };
    };
    const auto size =
        std::find_if(assignments.begin(), assignments.end(), has_role(Role::hull_size));
    if (size == assignments.end()) return true;
    if (assignments.size() == 1) {
      note("hull", "a hull needs its vertices: write \"vertices\" or \"file\"");
      return false;
    }
    if (std::get<double>(size->value) > 0.0) return true;
    diagnostics_.push_back({size->pointer, "must be positive"});
    return false;
  }

  static WrittenComponent component_of(double share, const Assignments& assignments) {
    InEffect in_effect(parameters().size(), nullptr);
    for (const Assignment& assignment : assignments) in_effect[assignment.parameter] = &assignment;
    const ResolvedSpec resolved = resolve(in_effect);
    return {share,
            resolved.spec.shape,
            resolved.pinacoid_angle,
            canonical_component(share, resolved),
            resolved.hull_file,
            resolved.hull_size};
  }

  std::string pointer_;
  Diagnostics& diagnostics_;
};

}  // namespace

std::optional<Components> read_components(const Json& value, const std::string& pointer,
                                          Diagnostics& diagnostics) {
  const std::size_t before = diagnostics.size();
  Components components;
  if (!value.is_array() || value.empty()) {
    diagnostics.push_back({pointer, std::string("must be a list of components, "
                                                R"([{"share": 0.7, "cube": {}}, ...], is )") +
                                        (value.is_array() ? "empty" : describe(value))});
    return std::nullopt;
  }
  for (std::size_t i = 0; i < value.size(); ++i) {
    ComponentReader(pointer + "/" + std::to_string(i), diagnostics).read(value[i], components);
  }
  return diagnostics.size() == before ? std::optional(std::move(components)) : std::nullopt;
}

void place_hull(std::vector<std::array<double, 3>> points, WrittenComponent& component) {
  ResolvedSpec resolved;
  resolved.spec.shape = HullVertices{std::move(points)};
  component.shape = resolved.spec.shape;
  component.text = canonical_component(component.share, resolved);
}

}  // namespace grainsweep
