#include "runner/sweep/schema_edges.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>

#include "engine/dynamics/presets.hpp"
#include "engine/scene/spec.hpp"
#include "engine/shape/shape_spec.hpp"
#include "engine/units.hpp"
#include "runner/sweep/schema_words.hpp"

namespace grainsweep {
namespace {

/// No grain of the usual sizes and shapes is half as wide: layers interlock between walls.
constexpr double wide = 3.0;  // d

/// What rounding to whole grains may change in the solid height of a box that is `wide`, d.
constexpr double rounding = 0.1;

Json named(const char* name) { return {{"const", name}}; }
Json at_least(double value) { return number_with({{"minimum", value}}); }
Json at_most(double value) { return number_with({{"maximum", value}}); }

/// The value nearest to `right` that is refused, among those between `refused` and it: a packing is
/// usual in all but what `set` makes of the value. Nothing where `refused` or `right` is not as its
/// name says.
template <class Set>
std::optional<double> last_refused(double refused, double right, Set set) {
  const auto is_refused = [&](double value) {
    PackingSpec spec;
    set(spec, value);
    return !check(spec).empty();
  };
  if (!is_refused(refused) || is_refused(right)) return std::nullopt;
  while (std::abs(right - refused) > 1e-3 * std::abs(refused)) {
    const double middle = (refused + right) / 2.0;
    (is_refused(middle) ? refused : right) = middle;
  }
  return refused;
}

/// What is refused. `anywhere`: may be said in any place and changes nothing as long as it fits.
/// `steps`: one of them is said in the base, or holds by default and is not denied by the base.
/// Nothing else about the groups is said.
struct EdgeRule {
  std::string groups;
  std::vector<Mention> anywhere;
  std::vector<Json> steps;
  std::vector<Mention> in_base;  ///< what steps are about
};

constexpr const char* all_groups = "shape|sizes|box|tube|fill";
constexpr const char* all_and_measure = "shape|sizes|box|tube|fill|measure";

Json said(const std::string& path, const Json& value) {
  return with("base", in_any_way(path, value));
}

/// That it is said, or, where the usual value is such a one, that no other is said.
Json said_or_usual(const std::string& path, const Json& value, bool is_usual) {
  return is_usual ? no(said(path, no(value))) : said(path, value);
}

Json forbidden(const EdgeRule& edge) {
  return not_all({says_only(edge.groups, edge.anywhere, edge.in_base), {{"anyOf", edge.steps}}});
}

/// Periods that hold no two spheres of the usual sizes.
EdgeRule short_periods() {
  const auto most = last_refused(1.0, 15.0, [](auto& spec, double d) { spec.box.length = d; });
  return {all_groups,
          {{"box.x", named("periodic")},
           {"box.width"},
           {"box.y"},
           {"shape", named("sphere")},
           {"fill.solid_height"},
           {"fill.grains"}},
          {said("box.length", at_most(*most))},
          {{"box.length"}}};
}

/// Zones that leave nothing of a bed of spheres, or none of a lower one.
Json too_low(double floor, double surface) {
  const auto height = last_refused(1e-3, 1000.0, [&](auto& spec, double d) {
    spec.fill = SolidHeight{d};
    spec.measure.exclude_floor = floor;
    spec.measure.exclude_surface = surface;
  });
  const double most = *height - rounding;
  const MeasureSpec usual;
  return {{"allOf",
           {said_or_usual("fill.solid_height", at_most(most), SolidHeight{}.height <= most),
            said_or_usual("measure.exclude_floor", at_least(floor), floor <= usual.exclude_floor),
            said_or_usual("measure.exclude_surface", at_least(surface),
                          surface <= usual.exclude_surface)}}};
}

EdgeRule low_beds() {
  const MeasureSpec usual;
  std::vector<Json> steps = {too_low(usual.exclude_floor, usual.exclude_surface)};
  for (const double zone : round_numbers(4.0, 500.0)) {
    steps.push_back(too_low(zone, usual.exclude_surface));
    steps.push_back(too_low(usual.exclude_floor, zone));
  }
  return {all_and_measure,
          {{"measure.gap_tolerances"},
           {"measure.bin_width"},
           {"box.length", at_least(wide)},
           {"box.width", at_least(wide)},
           {"box.x"},
           {"box.y"},
           {"shape", named("sphere")}},
          steps,
          {{"fill.solid_height"}, {"measure.exclude_floor"}, {"measure.exclude_surface"}}};
}

/// So few spheres in the usual box that nothing is left between the usual zones.
EdgeRule few_grains() {
  const auto most = last_refused(1.0, 1e5, [](auto& spec, double count) {
    spec.fill = GrainCount{static_cast<std::int64_t>(count)};
  });
  return {all_and_measure,
          {{"shape", named("sphere")}},
          {said("fill.grains", at_most(std::floor(*most)))},
          {{"fill.grains"}}};
}

/// More spheres than can be numbered.
EdgeRule huge_beds() {
  std::vector<Json> steps;
  for (const double height : round_numbers(1.0, 1000.0)) {
    const auto side = last_refused(1e4, 20.0, [&](auto& spec, double d) {
      spec.box.length = spec.box.width = d;
      spec.fill = SolidHeight{height};
      spec.measure = {.exclude_floor = 0.0, .exclude_surface = 0.0};
    });
    if (!side) continue;
    steps.push_back(
        {{"allOf",
          {said_or_usual("fill.solid_height", at_least(height), SolidHeight{}.height >= height),
           said("box.length", at_least(*side)), said("box.width", at_least(*side))}}});
  }
  return {all_groups,
          {{"box.x"}, {"box.y"}, {"shape", named("sphere")}},
          steps,
          {{"fill.solid_height"}, {"box.length"}, {"box.width"}}};
}

/// Ends of a pinacoid of the usual length and height that cross.
EdgeRule flat_ends() {
  const PinacoidSize usual;
  const double least = std::atan(usual.height / usual.length) * 180.0 / pi;
  return {"shape",
          {{"shape", named("pinacoid")}, {"shape.pinacoid.width"}},
          {said("shape.pinacoid.angle_deg", number_with({{"exclusiveMaximum", least}}))},
          {{"shape.pinacoid.angle_deg"}}};
}

/// Periods that hold no two pinacoids, which are no shorter than their middle plane.
EdgeRule long_pinacoids() {
  std::vector<Json> steps;
  for (const double length : round_numbers(2.0, 200.0)) {
    const auto most = last_refused(2.0, 1e4, [&](auto& spec, double d) {
      spec.shape = PinacoidSize{.length = length};
      spec.box.length = d;
      spec.box.width = 1e4;
      spec.fill = GrainCount{1'000'000};
      spec.measure = {.exclude_floor = 0.0, .exclude_surface = 0.0};
    });
    if (!most) continue;
    steps.push_back({{"allOf",
                      {said("shape.pinacoid.length", at_least(length)),
                       said_or_usual("box.length", at_most(*most), Box{}.length <= *most)}}});
  }
  return {all_groups,
          {{"shape", named("pinacoid")},
           {"shape.pinacoid.width", at_least(PinacoidSize{}.width)},
           {"shape.pinacoid.height"},
           {"box.x", named("periodic")},
           {"box.width"},
           {"box.y"},
           {"fill.solid_height"},
           {"fill.grains"}},
          steps,
          {{"shape.pinacoid.length"}, {"box.length"}}};
}

/// Hulls so small that even the least box takes more of them than can be numbered: the lengths in
/// their vertices are not d.
EdgeRule tiny_hulls() {
  constexpr double solid_height = 1.0;  // d
  const auto half = last_refused(1e-6, 0.1, [&](auto& spec, double d) {
    HullVertices cube;
    for (const double x : {-d, d}) {
      for (const double y : {-d, d}) {
        for (const double z : {-d, d}) cube.points.push_back({x, y, z});
      }
    }
    spec.shape = cube;
    spec.box = {.length = 2.0, .width = 1.0, .x = Boundary::walls, .y = Boundary::walls};
    spec.fill = SolidHeight{solid_height};
    spec.measure = {.exclude_floor = 0.0, .exclude_surface = 0.0};
  });
  const Json within = number_with({{"minimum", -*half}, {"maximum", *half}});
  return {all_groups,
          {{"box.length"},
           {"box.width"},
           {"box.x"},
           {"box.y"},
           {"fill.solid_height", at_least(solid_height)}},
          {said("shape.hull.vertices", list_like(list_like(within)))},
          {{"shape.hull.vertices"}}};
}

/// Tubes too narrow for the usual pinacoids.
EdgeRule narrow_tubes() {
  const auto most = last_refused(2.0, 10.0, [](auto& spec, double d) {
    spec.shape = PinacoidSize{};
    spec.box = tube_of(d);
  });
  return {"shape|box|tube",
          {},
          {{{"allOf", {said("shape", named("pinacoid")), said("tube.diameter", at_most(*most))}}}},
          {{"shape"}, {"tube.diameter"}}};
}

/// The longest of the steps that are too short for grains of the usual bed to come down in time.
double too_short_step(const ShapeSpec& shape) {
  return *last_refused(1e-4, 0.2, [&](auto& spec, double step) {
    spec.shape = shape;
    spec.fill = SolidHeight{SolidHeight{}.height - rounding};
    spec.accuracy.step = step;
  });
}

/// Such steps, or shorter ones, for that bed or a higher one.
EdgeRule short_steps() {
  const auto with_shape = [](const ShapeSpec& shape, const Json& name) -> Json {
    return {{"allOf",
             {said_or_usual("shape", name, name == named("sphere")),
              said("accuracy.step", at_most(too_short_step(shape)))}}};
  };
  return {
      "shape|sizes|box|tube|fill|accuracy",
      {{"fill.solid_height", at_least(SolidHeight{}.height)},
       {"box.length", at_least(wide)},
       {"box.width", at_least(wide)},
       {"box.x"},
       {"box.y"}},
      {with_shape(SphereShape{}, named("sphere")), with_shape(PinacoidSize{}, named("pinacoid"))},
      {{"shape"}, {"accuracy.step"}}};
}

/// Accuracies that no preset keeps for spheres of one size, or for the usual pinacoids.
EdgeRule unkept_accuracies() {
  std::vector<Json> steps;
  const auto add = [&](BedKind kind, const char* path, double ProtocolBias::*bound) {
    double least = 1.0;
    for (const Preset& known : presets()) {
      if (const auto of = bias_bound(known.name, kind)) least = std::min(least, (*of).*bound);
    }
    const bool is_sphere = kind == BedKind::spheres;
    steps.push_back({{"allOf",
                      {said_or_usual("shape", named(is_sphere ? "sphere" : "pinacoid"), is_sphere),
                       said(path, number_with({{"exclusiveMaximum", least}}))}}});
  };
  for (const BedKind kind : {BedKind::spheres, BedKind::pinacoids}) {
    add(kind, "accuracy.solid_fraction", &ProtocolBias::solid_fraction);
    add(kind, "accuracy.coordination", &ProtocolBias::coordination);
  }
  return {"shape|sizes|tube|accuracy",
          {},
          steps,
          {{"shape"}, {"accuracy.solid_fraction"}, {"accuracy.coordination"}}};
}

/// Accuracies requested for shapes for which no bound was measured, or for tubes of other grains
/// than spheres.
EdgeRule unmeasured_accuracies() {
  const Json asks = {{"anyOf",
                      {said("accuracy.solid_fraction", Json::object()),
                       said("accuracy.coordination", Json::object())}}};
  const Json usual = {{"anyOf", {named("sphere"), named("pinacoid")}}};
  const Json unmeasured = {{"anyOf",
                            {{{"allOf",
                               {said("tube.diameter", Json::object()),
                                said("shape", {{"type", "string"}, {"not", named("sphere")}})}}},
                             said("shape", {{"type", "string"}, {"not", usual}})}}};
  return {"shape|sizes|box|tube|accuracy",
          {},
          {{{"allOf", {asks, unmeasured}}}},
          {{"shape"}, {"tube.diameter"}, {"accuracy.solid_fraction"}, {"accuracy.coordination"}}};
}

/// Neighbours counted by another gap than that at which bounds of their number were measured.
EdgeRule unmeasured_gaps() {
  const Json other = {{"not", {{"const", measured_gap}}}};
  const Json gaps = {{"type", "array"}, {"minItems", 1}, {"items", Json::array({other})}};
  return {
      all_and_measure,
      {},
      {{{"allOf",
         {said("accuracy.coordination", Json::object()), said("measure.gap_tolerances", gaps)}}}},
      {{"measure.gap_tolerances"}, {"accuracy.coordination"}}};
}

}  // namespace

Json edge_rules() {
  Json rules = Json::array();
  for (const auto& made :
       {short_periods, low_beds, few_grains, huge_beds, flat_ends, long_pinacoids, tiny_hulls,
        narrow_tubes, short_steps, unkept_accuracies, unmeasured_accuracies, unmeasured_gaps}) {
    rules.push_back(forbidden(made()));
  }
  return rules;
}

}  // namespace grainsweep
