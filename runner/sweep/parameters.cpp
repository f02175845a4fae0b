#include "runner/sweep/parameters.hpp"

#include <algorithm>
#include <map>

#include "runner/sweep/parameter_row.hpp"
#include "runner/sweep/size_formulas.hpp"

namespace grainsweep {
namespace {

void add_new(const std::string& word, std::vector<std::string>& words) {
  if (std::find(words.begin(), words.end(), word) == words.end()) words.push_back(word);
}

/// The formula of a distribution that such a parameter is a part of; of a part of any the first.
std::optional<SizeFormula> usual_formula(const Parameter& parameter) {
  const SizeFormulaKind* kind = size_formula_kind_of(parameter.path);
  if (kind == nullptr && parameter.role == Role::distribution) kind = &size_formula_kinds().front();
  return kind == nullptr ? std::nullopt : kind->usual;
}

/// Why cutting a curve that has ends of its own removes nothing; "" if it does.
std::string cut_reason(bool is_smallest, const std::optional<SizeDistribution>& distribution) {
  const bool has_ends =
      distribution && size_formula_kinds()[distribution->formula.index()].has_ends;
  if (!has_ends || !fault_of(*distribution).empty()) return "";
  const std::vector<double> whole =
      curve_of({distribution->formula, distribution->by, {}, {}}).diameters;
  if (is_smallest && distribution->smallest < whole.front()) return "no grain is smaller";
  if (!is_smallest && distribution->largest > whole.back()) return "no grain is larger";
  return "";
}

}  // namespace

std::optional<std::size_t> find_parameter(std::string_view path) {
  for (std::size_t i = 0; i < parameters().size(); ++i) {
    if (parameters()[i].path == path) return i;
  }
  return std::nullopt;
}

bool is_interval(const std::string& path) {
  const auto index = find_parameter(path);
  return index && (parameters()[*index].kind == ValueKind::number ||
                   parameters()[*index].kind == ValueKind::whole);
}

std::size_t parameter_with(Role role) {
  const auto has_role = [&](const Parameter& parameter) { return parameter.role == role; };
  const auto found = std::find_if(parameters().begin(), parameters().end(), has_role);
  return static_cast<std::size_t>(found - parameters().begin());
}

Choice choice_of(const Parameter& parameter) {
  const Role role = parameter.role;
  if (role < Role::preset) return Choice::none;
  if (role < Role::shape) return Choice::accuracy;
  if (role < Role::box) return Choice::shape;
  if (role < Role::fill) return Choice::container;
  return role < Role::size_class ? Choice::fill : Choice::sizes;
}

bool are_alternatives(const Parameter& a, const Parameter& b) {
  const Choice choice = choice_of(a);
  if (choice != choice_of(b)) return false;
  const SizeFormulaKind *of_a = size_formula_kind_of(a.path), *of_b = size_formula_kind_of(b.path);
  if (of_a != nullptr && of_b != nullptr && of_a != of_b) return true;
  if (a.role == b.role) return false;
  if (choice == Choice::container || choice == Choice::accuracy) return true;
  const bool is_part = a.role == Role::distribution || b.role == Role::distribution;
  const bool is_class = a.role == Role::size_class || b.role == Role::size_class;
  return choice == Choice::sizes && (is_class || !is_part);
}

std::optional<std::size_t> preset_of(std::string_view path) {
  const std::size_t preset = parameter_with(Role::preset);
  const std::string& full = parameters()[preset].path;
  return full.substr(0, full.rfind('.')) == path ? std::optional(preset) : std::nullopt;
}

std::optional<Value> default_of(const Parameter& parameter) {
  ResolvedSpec resolved;
  if (parameter.role == Role::shape_part) resolved.spec.shape = shape_with_part(parameter.path);
  if (parameter.role == Role::mixture_by) resolved.spec.shape = Mixture{};
  if (parameter.role == Role::tube) return std::nullopt;
  if (auto formula = usual_formula(parameter)) {
    resolved.spec.sizes.distribution = SizeDistribution{*formula};
  }
  return parameter.get(resolved);
}

bool is_group(std::string_view path) {
  if (path.empty()) return true;
  return std::any_of(parameters().begin(), parameters().end(), [&](const Parameter& parameter) {
    return parameter.path.size() > path.size() && parameter.path.starts_with(path) &&
           parameter.path[path.size()] == '.';
  });
}

std::string meaning_of_group(std::string_view path) {
  static const std::map<std::string_view, std::string> meanings = {
      {"shape", "what the grains are: one shape, by its name or its parts"},
      {"shape.pinacoid", "a rectangle with a hip roof above it and one below"},
      {"shape.cube", "a cube"},
      {"shape.cuboid", "a brick"},
      {"shape.tetrahedron", "a regular tetrahedron"},
      {"shape.octahedron", "a regular octahedron"},
      {"shape.dodecahedron", "a regular dodecahedron, of twelve pentagons"},
      {"shape.icosahedron", "a regular icosahedron, of twenty triangles"},
      {"shape.prism", "an upright prism over a regular polygon"},
      {"shape.cylinder", "a cylinder, packed as a prism of as many sides as its chord error takes"},
      {"shape.hull", "a convex polyhedron, by its vertices"},
      {"box", "the box that the grains fall into: a flat floor, open at the top"},
      {"tube", "an upright round tube in the box's place: a flat floor, open at the top"},
      {"fill", "how many grains, in one of three ways: solid_height, grains or file"},
      {"sizes", "sizes of the grains: one class or two, each Gaussian, or a distribution"},
      {"sizes.distribution", "a curve that the diameters of the grains are drawn from"},
      {"accuracy",
       "how exactly a bed is settled: a preset's name, or parts that override it, or asked for"},
      {"measure", "what is measured, and where"}};
  if (const SizeFormulaKind* kind = size_formula_kind_of(path)) return std::string(kind->meaning);
  return meanings.at(path);
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

std::string idle_reason(const Parameter& parameter, const PackingSpec& spec) {
  const std::string& path = parameter.path;
  if (path == "sizes.size_ratio" && spec.sizes.small_share == 0.0) {
    return "sizes.small_share is 0";
  }
  const bool is_drawn_from = path == "sizes.spread" || path.starts_with("sizes.distribution.");
  if (is_drawn_from && std::holds_alternative<PlacedGrains>(spec.fill)) {
    return "the sizes stand in fill.file";
  }
  if (path == "sizes.distribution.smallest" || path == "sizes.distribution.largest") {
    return cut_reason(path.ends_with("smallest"), spec.sizes.distribution);
  }
  if (path == "shape.mixture_by" && std::holds_alternative<PlacedGrains>(spec.fill)) {
    return "the component of each grain stands in fill.file";
  }
  return "";
}

bool is_fill(std::size_t parameter) {
  return parameters()[parameter].role == Role::fill || is_fill_in_files(parameter);
}

bool is_fill_in_files(std::size_t parameter) {
  const Role role = parameters()[parameter].role;
  return role == Role::fill_file || role == Role::fill_files;
}

}  // namespace grainsweep
