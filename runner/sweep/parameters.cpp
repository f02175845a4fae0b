#include "runner/sweep/parameters.hpp"

#include <algorithm>
#include <limits>
#include <type_traits>
#include <utility>

#include "engine/dynamics/presets.hpp"
#include "engine/units.hpp"
#include "runner/sweep/identity.hpp"

namespace grainsweep {
namespace {

using Rows = std::vector<Parameter>;

template <class T>
constexpr ValueKind kind_of() {
  if constexpr (std::is_enum_v<T>) return ValueKind::choice;
  if constexpr (std::is_same_v<T, double>) return ValueKind::number;
  if constexpr (std::is_same_v<T, std::uint64_t>) return ValueKind::natural;
  if constexpr (std::is_same_v<T, int>) return ValueKind::whole;
  return ValueKind::numbers;
}

/// Built in place: g++ 12 warns, wrongly, about a value moved into the optional under sanitizers.
template <class T>
std::optional<Value> present(const T& value) {
  return std::optional<Value>(std::in_place, std::in_place_type<T>, value);
}

/// `members` leads from the draft to the parameter: &Draft::spec, &PackingSpec::box, &Box::x.
template <auto... members>
void set_member(Draft& draft, const Value& value) {
  auto& target = (draft.*....*members);
  using T = std::remove_reference_t<decltype(target)>;
  if constexpr (std::is_enum_v<T> || std::is_same_v<T, int>) {
    target = static_cast<T>(std::get<std::int64_t>(value));
  } else {
    target = std::get<T>(value);
  }
}

template <auto... members>
std::optional<Value> get_member(const Draft& draft) {
  const auto& source = (draft.*....*members);
  using T = std::remove_cvref_t<decltype(source)>;
  if constexpr (std::is_enum_v<T> || std::is_same_v<T, int>) {
    return present<std::int64_t>(static_cast<std::int64_t>(source));
  } else {
    return present<T>(source);
  }
}

std::optional<Value> no_identity(const Draft&) { return std::nullopt; }

using Names = std::vector<std::string>;

/// The row of a member that is read and written as it is.
template <auto... members>
Parameter row(const char* path, const char* meaning, Names choices = {}) {
  using T = std::remove_cvref_t<decltype((std::declval<Draft&>().*....*members))>;
  return {.path = path,
          .meaning = meaning,
          .kind = kind_of<T>(),
          .largest = std::numeric_limits<int>::max(),
          .choices = std::move(choices),
          .set = set_member<members...>,
          .get = get_member<members...>};
}

/// `parameter` with the range it must lie in.
Parameter within(const char* range, Parameter parameter) {
  parameter.range = range;
  return parameter;
}

template <auto member>
Parameter box(const char* path, const char* meaning, Names choices = {}) {
  return row<&Draft::spec, &PackingSpec::box, member>(path, meaning, std::move(choices));
}
template <auto member>
Parameter sizes(const char* path, const char* meaning) {
  return row<&Draft::spec, &PackingSpec::sizes, member>(path, meaning);
}
template <auto member>
Parameter accuracy(const char* path, const char* meaning, Names choices = {}) {
  return row<&Draft::spec, &PackingSpec::accuracy, member>(path, meaning, std::move(choices));
}
template <auto member>
Parameter measure(const char* path, const char* meaning) {
  return row<&Draft::spec, &PackingSpec::measure, member>(path, meaning);
}

void set_shape(Draft& draft, const Value& value) {
  draft.spec.shape = std::get<std::int64_t>(value) == 0 ? ShapeSpec(SphereShape{}) : PinacoidSize{};
}
/// Other shapes are known by their parts.
std::optional<Value> get_shape(const Draft& draft) {
  if (!std::holds_alternative<SphereShape>(draft.spec.shape)) return std::nullopt;
  return present(std::int64_t{0});
}

PinacoidSize& pinacoid_of(Draft& draft) {
  auto* pinacoid = std::get_if<PinacoidSize>(&draft.spec.shape);
  return pinacoid != nullptr ? *pinacoid : draft.spec.shape.emplace<PinacoidSize>();
}
template <auto member>
void set_side(Draft& draft, const Value& value) {
  pinacoid_of(draft).*member = std::get<double>(value);
}
template <auto member>
std::optional<Value> get_side(const Draft& draft) {
  const auto* pinacoid = std::get_if<PinacoidSize>(&draft.spec.shape);
  return pinacoid != nullptr ? present(pinacoid->*member) : std::nullopt;
}
void set_angle(Draft& draft, const Value& value) {
  draft.pinacoid_angle = std::get<double>(value);
  pinacoid_of(draft).angle = draft.pinacoid_angle * (pi / 180.0);
}
std::optional<Value> get_angle(const Draft& draft) {
  const bool is_pinacoid = std::holds_alternative<PinacoidSize>(draft.spec.shape);
  return is_pinacoid ? present(draft.pinacoid_angle) : std::nullopt;
}

void set_vertices(Draft& draft, const Value& value) {
  draft.spec.shape = HullVertices{std::get<Points>(value)};
}
std::optional<Value> get_vertices(const Draft& draft) {
  const auto* hull = std::get_if<HullVertices>(&draft.spec.shape);
  return hull != nullptr ? present(hash_of(*hull)) : std::nullopt;
}
void set_hull_file(Draft& draft, const Value& value) {
  draft.spec.shape = HullVertices{};
  draft.hull_file = std::get<std::string>(value);
}

/// A part of a pinacoid.
Parameter pinacoid_part(const char* path, const char* meaning, void (*set)(Draft&, const Value&),
                        std::optional<Value> (*get)(const Draft&)) {
  return {.path = path,
          .meaning = meaning,
          .kind = ValueKind::number,
          .set = set,
          .get = get,
          .role = Role::pinacoid};
}
template <auto member>
Parameter side(const char* path, const char* meaning) {
  return pinacoid_part(path, meaning, set_side<member>, get_side<member>);
}

/// The shape's name comes before the parts that name a shape too.
Rows shape_rows() {
  return {
      {.path = "shape",
       .meaning = "what the grains are; a name alone stands for the shape with its defaults",
       .kind = ValueKind::choice,
       .choices = {"sphere", "pinacoid"},
       .set = set_shape,
       .get = get_shape,
       .role = Role::shape},
      within("> 0",
             side<&PinacoidSize::length>("shape.pinacoid.length", "length of the middle plane, d")),
      within("> 0",
             side<&PinacoidSize::width>("shape.pinacoid.width", "width of the middle plane, d")),
      within("> 0",
             side<&PinacoidSize::height>("shape.pinacoid.height", "distance of its two ridges, d")),
      within("(0, 89]",
             pinacoid_part("shape.pinacoid.angle_deg",
                           "angle between ends and middle plane, degrees", set_angle, get_angle)),
      {.path = "shape.hull.vertices",
       .meaning = "vertices [x, y, z] of a convex grain",
       .kind = ValueKind::points,
       .set = set_vertices,
       .get = get_vertices,
       .role = Role::hull_vertices},
      {.path = "shape.hull.file",
       .meaning = "OBJ file of the vertices instead; relative to the sweep file",
       .kind = ValueKind::text,
       .set = set_hull_file,
       .get = no_identity,
       .role = Role::hull_file},
      {.path = "shape.hull.size",
       .meaning = "the length in the vertices that is d; 1 if left out",
       .kind = ValueKind::number,
       .set = set_member<&Draft::hull_size>,
       .get = no_identity,
       .role = Role::hull_size,
       .range = "> 0"},
  };
}

Rows box_rows() {
  const Names boundaries = {"periodic", "walls"};  // in the order of Boundary
  return {
      within("[2, 10000]", box<&Box::length>("box.length", "extent of the box along x, d")),
      within("[1, 10000]",
             box<&Box::width>("box.width", "extent of the box along y, d: the gap between walls")),
      box<&Box::x>("box.x", "what bounds the box along x", boundaries),
      box<&Box::y>("box.y", "what bounds the box along y", boundaries),
  };
}

void set_solid_height(Draft& draft, const Value& value) {
  draft.spec.fill = SolidHeight{std::get<double>(value)};
}
void set_grains(Draft& draft, const Value& value) {
  draft.spec.fill = GrainCount{std::get<std::int64_t>(value)};
}
void set_file(Draft& draft, const Value& value) {
  draft.spec.fill = PlacedGrains{};
  draft.fill_file = std::get<std::string>(value);
}
std::optional<Value> get_solid_height(const Draft& draft) {
  const auto* fill = std::get_if<SolidHeight>(&draft.spec.fill);
  return fill ? present(fill->height) : std::nullopt;
}
std::optional<Value> get_grains(const Draft& draft) {
  const auto* fill = std::get_if<GrainCount>(&draft.spec.fill);
  return fill ? present(fill->count) : std::nullopt;
}
std::optional<Value> get_file(const Draft& draft) {
  return draft.fill_file.empty() ? std::nullopt : present(draft.fill_content);
}
std::optional<Value> get_diameter(const Draft& draft) {
  return draft.fill_file.empty() ? std::nullopt : present(draft.fill_diameter);
}

Rows fill_rows() {
  return {
      {.path = "fill.solid_height",
       .meaning = "solid volume per floor area, d; as many grains as fill it up",
       .kind = ValueKind::number,
       .set = set_solid_height,
       .get = get_solid_height,
       .role = Role::fill,
       .range = "(0, 1000]"},
      {.path = "fill.grains",
       .meaning = "number of grains",
       .kind = ValueKind::whole,
       .largest = std::numeric_limits<std::int64_t>::max(),
       .set = set_grains,
       .get = get_grains,
       .role = Role::fill,
       .range = "[1, 10000000]"},
      {.path = "fill.file",
       .meaning = "CSV file of x,y,z,r, and qx,qy,qz,qw of grains that are no spheres: where they "
                  "start; relative to the sweep file",
       .kind = ValueKind::text,
       .set = set_file,
       .get = get_file,
       .role = Role::fill_file},
      {.path = "fill.diameter",
       .meaning = "the length in fill.file that is d",
       .kind = ValueKind::number,
       .set = set_member<&Draft::fill_diameter>,
       .get = get_diameter,
       .role = Role::fill_diameter,
       .range = "> 0"},
  };
}

Rows size_rows() {
  return {
      within("[0, 0.2]",
             sizes<&SizesSpec::spread>(
                 "sizes.spread", "standard deviation of the diameter over its mean, each class")),
      within("[0, 1]",
             sizes<&SizesSpec::small_share>(
                 "sizes.small_share", "share of the small class in the solid volume, 0 to 1")),
      within("(0.02, 1]", sizes<&SizesSpec::size_ratio>("sizes.size_ratio",
                                                        "mean diameter of the small class, d")),
  };
}

Names preset_names() {
  Names names;
  for (const Preset& known : presets()) names.emplace_back(known.name);
  return names;
}

void set_preset(Draft& draft, const Value& value) {
  draft.preset = static_cast<int>(std::get<std::int64_t>(value));
  draft.spec.accuracy = presets()[static_cast<std::size_t>(draft.preset)].accuracy;
}

Parameter solver_row() {
  Parameter solver = accuracy<&Accuracy::solver>("accuracy.solver", "iterations that solve a step",
                                                 {"pgs", "apgs"});  // in the order of Solver
  solver.former_choices = {"symmetric_pgs", "nncg", "apgd"};
  return solver;
}

Rows accuracy_rows() {
  using A = Accuracy;
  return {
      {.path = "accuracy.preset",
       .meaning = "named accuracy; parts written beside it override its own",
       .kind = ValueKind::choice,
       .choices = preset_names(),
       .set = set_preset,
       .get = no_identity,
       .role = Role::preset},
      accuracy<&A::protocol>("accuracy.protocol",
                             "how grains come down: damped in long steps, or plain dynamics",
                             {"heavy_ball", "dynamic"}),  // in the order of Protocol
      solver_row(),
      accuracy<&A::precision>("accuracy.precision", "number type of the solver", {"f32", "f64"}),
      within("(0, 2]", accuracy<&A::step>("accuracy.step", "time step, sqrt(d/g)")),
      within("[0, 1)", accuracy<&A::momentum>("accuracy.momentum",
                                              "share of the last displacement carried on, 0 to 1")),
      within("[1, 1000000]",
             accuracy<&A::fall_iterations>("accuracy.fall_iterations",
                                           "solver iterations per step while the bed compacts")),
      within("[0, 1000000]", accuracy<&A::creep_steps>(
                                 "accuracy.creep_steps",
                                 "double steps after the fall, while the bed creeps to rest")),
      within("[1, 1000000]", accuracy<&A::rest_iterations>(
                                 "accuracy.rest_iterations",
                                 "most solver iterations per step at the end of the creep")),
      within("> 0", accuracy<&A::residual_tolerance>("accuracy.residual_tolerance",
                                                     "worst force imbalance at rest, m g")),
      within("> 0", accuracy<&A::kinetic_tolerance>("accuracy.kinetic_tolerance",
                                                    "kinetic energy per grain at rest, m g d")),
      within("> 0", accuracy<&A::contact_tolerance>("accuracy.contact_tolerance",
                                                    "|contacts / isostatic count - 1| at rest")),
      within(
          "> 0",
          accuracy<&A::overlap_tolerance>(
              "accuracy.overlap_tolerance",
              "mean overlap of touching pairs at rest, d; no pair more than a hundred times it")),
      within("[1, 2147483647]",
             accuracy<&A::max_steps>("accuracy.max_steps",
                                     "steps after which a bed counts as not settled")),
      accuracy<&A::force_balance>("accuracy.force_balance",
                                  "certify the final contacts by a direct solve of force balance",
                                  {"skip", "solve"}),  // in the order of BalanceCheck
  };
}

Rows measure_rows() {
  using M = MeasureSpec;
  return {
      within("[0, 1000]", measure<&M::exclude_floor>("measure.exclude_floor",
                                                     "zone above the floor left out, d")),
      within("[0, 1000]", measure<&M::exclude_surface>("measure.exclude_surface",
                                                       "zone below the surface left out, d")),
      within("(0, 0.1)", measure<&M::gap_tolerances>(
                             "measure.gap_tolerances",
                             "grains touch below these gaps, d; the first is the headline")),
      within("[0.01, 10000]",
             measure<&M::bin_width>("measure.bin_width", "width of the bins of profiles, d")),
  };
}

Rows all_rows() {
  Rows all;
  for (Rows rows :
       {shape_rows(), box_rows(), fill_rows(), size_rows(), accuracy_rows(), measure_rows()}) {
    for (Parameter& parameter : rows) all.push_back(std::move(parameter));
  }
  all.push_back({.path = "seed",
                 .meaning = "master seed of the random numbers; in blocks only",
                 .kind = ValueKind::natural,
                 .set = set_member<&Draft::seed>,
                 .get = no_identity,
                 .role = Role::seed,
                 .range = "[0, 18446744073709551615]"});
  return all;
}

void add_new(const std::string& word, Names& words) {
  if (std::find(words.begin(), words.end(), word) == words.end()) words.push_back(word);
}

}  // namespace

const std::vector<Parameter>& parameters() {
  static const Rows table = all_rows();
  return table;
}

std::optional<std::size_t> find_parameter(std::string_view path) {
  for (std::size_t i = 0; i < parameters().size(); ++i) {
    if (parameters()[i].path == path) return i;
  }
  return std::nullopt;
}

std::size_t parameter_with(Role role) {
  const auto has_role = [&](const Parameter& parameter) { return parameter.role == role; };
  const auto found = std::find_if(parameters().begin(), parameters().end(), has_role);
  return static_cast<std::size_t>(found - parameters().begin());
}

Choice choice_of(const Parameter& parameter) {
  switch (parameter.role) {
    case Role::shape:
    case Role::pinacoid:
    case Role::hull_vertices:
    case Role::hull_file:
    case Role::hull_size:
      return Choice::shape;
    case Role::fill:
    case Role::fill_file:
    case Role::fill_diameter:
      return Choice::fill;
    default:
      return Choice::none;
  }
}

std::optional<std::size_t> preset_of(std::string_view path) {
  const std::size_t preset = parameter_with(Role::preset);
  const std::string& full = parameters()[preset].path;
  return full.substr(0, full.rfind('.')) == path ? std::optional(preset) : std::nullopt;
}

std::optional<Value> default_of(const Parameter& parameter) {
  Draft draft;
  if (parameter.role == Role::pinacoid) draft.spec.shape = PinacoidSize{};
  return parameter.get(draft);
}

bool is_group(std::string_view path) {
  if (path.empty()) return true;
  return std::any_of(parameters().begin(), parameters().end(), [&](const Parameter& parameter) {
    return parameter.path.size() > path.size() && parameter.path.starts_with(path) &&
           parameter.path[path.size()] == '.';
  });
}

std::vector<std::string> known_keys(std::string_view path) {
  const std::string prefix = path.empty() ? "" : std::string(path) + ".";
  std::vector<std::string> heads, dotted;
  for (const Parameter& parameter : parameters()) {
    if (!parameter.path.starts_with(prefix)) continue;
    const std::string rest = parameter.path.substr(prefix.size());
    std::size_t dot = rest.find('.');
    add_new(rest.substr(0, dot), heads);
    while (dot != std::string::npos) {
      dot = rest.find('.', dot + 1);
      add_new(rest.substr(0, dot), dotted);
    }
  }
  heads.insert(heads.end(), dotted.begin(), dotted.end());
  return heads;
}

bool is_fill(std::size_t parameter) {
  const Role role = parameters()[parameter].role;
  return role == Role::fill || role == Role::fill_file;
}

}  // namespace grainsweep
