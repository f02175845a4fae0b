#include "runner/sweep/parameters.hpp"

#include <algorithm>
#include <limits>
#include <type_traits>
#include <utility>

#include "engine/dynamics/presets.hpp"

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

/// `members` leads from the draft to the parameter: &Draft::spec, &PackingSpec::box, &BoxSpec::x.
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
  return {path,
          meaning,
          kind_of<T>(),
          std::numeric_limits<int>::max(),
          std::move(choices),
          set_member<members...>,
          get_member<members...>};
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

Rows box_rows() {
  const Names boundaries = {"periodic", "walls"};  // in the order of Boundary
  return {
      box<&BoxSpec::length>("box.length", "extent of the box along x, d"),
      box<&BoxSpec::width>("box.width", "extent of the box along y, d: the gap between walls"),
      box<&BoxSpec::x>("box.x", "what bounds the box along x", boundaries),
      box<&BoxSpec::y>("box.y", "what bounds the box along y", boundaries),
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

constexpr std::int64_t any_whole = std::numeric_limits<std::int64_t>::max();

Rows fill_rows() {
  return {
      {"fill.solid_height",
       "solid volume per floor area, d; as many grains as fill it up",
       ValueKind::number,
       0,
       {},
       set_solid_height,
       get_solid_height},
      {"fill.grains", "number of grains", ValueKind::whole, any_whole, {}, set_grains, get_grains},
      {"fill.file",
       "CSV file of x,y,z,r: where the grains start; relative to the sweep file",
       ValueKind::text,
       0,
       {},
       set_file,
       get_file},
      {"fill.diameter",
       "the length in fill.file that is d",
       ValueKind::number,
       0,
       {},
       set_member<&Draft::fill_diameter>,
       get_diameter},
  };
}

Rows size_rows() {
  return {
      sizes<&SizesSpec::spread>("sizes.spread",
                                "standard deviation of the diameter over its mean, each class"),
      sizes<&SizesSpec::small_share>("sizes.small_share",
                                     "share of the small class in the solid volume, 0 to 1"),
      sizes<&SizesSpec::size_ratio>("sizes.size_ratio", "mean diameter of the small class, d"),
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

Rows accuracy_rows() {
  using A = Accuracy;
  return {
      {"accuracy.preset", "named accuracy; parts written beside it override its own",
       ValueKind::choice, 0, preset_names(), set_preset, no_identity},
      accuracy<&A::protocol>("accuracy.protocol",
                             "how grains come down: damped in long steps, or plain dynamics",
                             {"heavy_ball", "dynamic"}),  // in the order of Protocol
      accuracy<&A::solver>("accuracy.solver", "iterations that solve a step",
                           {"pgs", "symmetric_pgs", "nncg", "apgd"}),  // in the order of Solver
      accuracy<&A::precision>("accuracy.precision", "number type of the solver", {"f32", "f64"}),
      accuracy<&A::step>("accuracy.step", "time step, sqrt(d/g)"),
      accuracy<&A::momentum>("accuracy.momentum",
                             "share of the last displacement carried on, 0 to 1"),
      accuracy<&A::fall_iterations>("accuracy.fall_iterations",
                                    "solver iterations per step while the bed compacts"),
      accuracy<&A::creep_steps>("accuracy.creep_steps",
                                "double steps after the fall, while the bed creeps to rest"),
      accuracy<&A::rest_iterations>("accuracy.rest_iterations",
                                    "most solver iterations per step at the end of the creep"),
      accuracy<&A::residual_tolerance>("accuracy.residual_tolerance",
                                       "worst force imbalance at rest, m g"),
      accuracy<&A::kinetic_tolerance>("accuracy.kinetic_tolerance",
                                      "kinetic energy per grain at rest, m g d"),
      accuracy<&A::contact_tolerance>("accuracy.contact_tolerance",
                                      "|contacts / isostatic count - 1| at rest"),
      accuracy<&A::overlap_tolerance>("accuracy.overlap_tolerance",
                                      "mean overlap of touching pairs at rest, d"),
      accuracy<&A::max_steps>("accuracy.max_steps",
                              "steps after which a bed counts as not settled"),
      accuracy<&A::force_balance>("accuracy.force_balance",
                                  "certify the final contacts by a direct solve of force balance",
                                  {"skip", "solve"}),  // in the order of BalanceCheck
  };
}

Rows measure_rows() {
  using M = MeasureSpec;
  return {
      measure<&M::exclude_floor>("measure.exclude_floor", "zone above the floor left out, d"),
      measure<&M::exclude_surface>("measure.exclude_surface", "zone below the surface left out, d"),
      measure<&M::gap_tolerances>("measure.gap_tolerances",
                                  "grains touch below these gaps, d; the first is the headline"),
      measure<&M::bin_width>("measure.bin_width", "width of the bins of profiles, d"),
  };
}

Rows all_rows() {
  Rows all = {row<&Draft::shape>("shape", "what the grains are", {"sphere"})};
  for (Rows rows : {box_rows(), fill_rows(), size_rows(), accuracy_rows(), measure_rows()}) {
    for (Parameter& parameter : rows) all.push_back(std::move(parameter));
  }
  all.push_back({"seed",
                 "master seed of the random numbers; in blocks only",
                 ValueKind::natural,
                 0,
                 {},
                 set_member<&Draft::seed>,
                 no_identity});
  return all;
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

bool is_group(std::string_view path) {
  if (path.empty()) return true;
  return std::any_of(parameters().begin(), parameters().end(), [&](const Parameter& parameter) {
    return parameter.path.size() > path.size() && parameter.path.starts_with(path) &&
           parameter.path[path.size()] == '.';
  });
}

std::vector<std::string> known_keys(std::string_view path) {
  const std::string prefix = path.empty() ? "" : std::string(path) + ".";
  std::vector<std::string> groups, leaves;
  for (const Parameter& parameter : parameters()) {
    if (!parameter.path.starts_with(prefix)) continue;
    const std::string rest = parameter.path.substr(prefix.size());
    const std::size_t dot = rest.find('.');
    if (dot != std::string::npos) leaves.push_back(rest);
    const std::string head = rest.substr(0, dot);
    if (groups.empty() || groups.back() != head) groups.push_back(head);
  }
  groups.insert(groups.end(), leaves.begin(), leaves.end());
  return groups;
}

bool is_fill(std::size_t parameter) {
  const std::string& path = parameters()[parameter].path;
  return path == "fill.solid_height" || path == "fill.grains" || path == "fill.file";
}

}  // namespace grainsweep
