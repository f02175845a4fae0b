#include <limits>
#include <type_traits>
#include <utility>

#include "engine/dynamics/presets.hpp"
#include "runner/sweep/parameter_row.hpp"
#include "runner/sweep/parameters.hpp"

namespace grainsweep {
namespace {

using Rows = std::vector<Parameter>;

// Parts of a box: a tube has none.
template <auto member>
std::optional<Value> get_of_box(const ResolvedSpec& resolved) {
  if (resolved.spec.box.is_tube) return std::nullopt;
  return get_member<&ResolvedSpec::spec, &PackingSpec::box, member>(resolved);
}
template <auto member>
Parameter of_box(const char* path, const WrittenValues& limits, const char* meaning) {
  using T = std::remove_cvref_t<decltype(std::declval<Box&>().*member)>;
  return own(path, limits, meaning, kind_of<T>(), Role::box,
             set_member<&ResolvedSpec::spec, &PackingSpec::box, member>, get_of_box<member>);
}

void set_tube(ResolvedSpec& resolved, const Value& value) {
  resolved.spec.box = tube_of(std::get<double>(value));
}
std::optional<Value> get_tube(const ResolvedSpec& resolved) {
  const Box& box = resolved.spec.box;
  return box.is_tube ? present(box.length) : std::nullopt;
}

Rows container_rows() {
  const Names boundaries = {// in the order of Boundary
                            {"periodic", "what leaves on one side comes in on the other"},
                            {"walls", "two flat walls without friction"}};
  return {
      in("d",
         of_box<&Box::length>("box.length", Interval{1, 10000}, "extent of the box along x, d")),
      in("d", of_box<&Box::width>("box.width", Interval{1, 10000},
                                  "extent of the box along y, d: the gap between walls")),
      of_box<&Box::x>("box.x", boundaries, "what bounds the box along x"),
      of_box<&Box::y>("box.y", boundaries, "what bounds the box along y"),
      in("d", own("tube.diameter", Interval{1, 10000},
                  "inner diameter D of an upright round tube in the box's place, d",
                  ValueKind::number, Role::tube, set_tube, get_tube)),
  };
}

void set_solid_height(ResolvedSpec& resolved, const Value& value) {
  resolved.spec.fill = SolidHeight{std::get<double>(value)};
}
void set_grains(ResolvedSpec& resolved, const Value& value) {
  resolved.spec.fill = GrainCount{std::get<std::int64_t>(value)};
}
void set_file(ResolvedSpec& resolved, const Value& value) {
  resolved.spec.fill = PlacedGrains{};
  resolved.fill_file = std::get<std::string>(value);
}
std::optional<Value> get_solid_height(const ResolvedSpec& resolved) {
  const auto* fill = std::get_if<SolidHeight>(&resolved.spec.fill);
  return fill ? present(fill->height) : std::nullopt;
}
std::optional<Value> get_grains(const ResolvedSpec& resolved) {
  const auto* fill = std::get_if<GrainCount>(&resolved.spec.fill);
  return fill ? present(fill->count) : std::nullopt;
}
std::optional<Value> get_file(const ResolvedSpec& resolved) {
  return resolved.fill_file.empty() ? std::nullopt : present(resolved.fill_content);
}
void set_files(ResolvedSpec& resolved, const Value& value) {
  resolved.spec.fill = PlacedGrains{};
  resolved.fill_files = std::get<std::vector<std::string>>(value);
}
std::optional<Value> get_files(const ResolvedSpec& resolved) {
  return resolved.fill_files.empty() ? std::nullopt : present(resolved.fill_content);
}
std::optional<Value> get_diameter(const ResolvedSpec& resolved) {
  const bool is_placed = !resolved.fill_file.empty() || !resolved.fill_files.empty();
  return is_placed ? present(resolved.fill_diameter) : std::nullopt;
}

Rows fill_rows() {
  Parameter grains = own("fill.grains", Interval{1, 10000000}, "number of grains", ValueKind::whole,
                         Role::fill, set_grains, get_grains);
  grains.largest = std::numeric_limits<std::int64_t>::max();
  return {
      in("d", own("fill.solid_height", Interval{0, 1000, true},
                  "solid volume per floor area, d; as many grains as fill it up", ValueKind::number,
                  Role::fill, set_solid_height, get_solid_height)),
      std::move(grains),
      own("fill.file", WrittenValues{},
          "CSV file of x,y,z,r, and qx,qy,qz,qw of non-spherical grains, and of a mixture "
          "component: where they start; relative to the sweep file",
          ValueKind::text, Role::fill_file, set_file, get_file),
      own("fill.files", WrittenValues{}, "a list of such files: a start for each replicate",
          ValueKind::texts, Role::fill_files, set_files, get_files),
      own("fill.diameter", positive, "the length in those files that is d", ValueKind::number,
          Role::fill_diameter, set_member<&ResolvedSpec::fill_diameter>, get_diameter),
  };
}

Names preset_names() {
  Names names;
  for (const Preset& known : presets()) names.emplace_back(known.name, known.promise);
  return names;
}

void set_preset(ResolvedSpec& resolved, const Value& value) {
  resolved.preset = static_cast<int>(std::get<std::int64_t>(value));
  resolved.spec.accuracy = presets()[static_cast<std::size_t>(resolved.preset)].accuracy;
}

Parameter solver_row() {
  Parameter solver = row<&PackingSpec::accuracy, &Accuracy::solver>(
      "accuracy.solver",
      Names{{"pgs", "projected Gauss-Seidel sweeps"},
            {"apgs", "the same with Nesterov's momentum"}},
      "iterations that solve a step");
  solver.former_choices = {"symmetric_pgs", "nncg", "apgd"};
  return solver;
}

/// Names are in the order of the engine's own.
Rows accuracy_rows() {
  using S = PackingSpec;
  using A = Accuracy;
  return {
      own("accuracy.preset", preset_names(),
          "named accuracy; parts written beside it, or in base, override its own",
          ValueKind::choice, Role::preset, set_preset, no_identity),
      own("accuracy.solid_fraction", Interval{0, 1, true},
          "in place of a preset: the cheapest one is taken that moves no mean solid fraction by "
          "more than this, by its measured bound",
          ValueKind::number, Role::asked_accuracy,
          set_member<&ResolvedSpec::asked_accuracy, &ErrorWish::solid_fraction>, no_identity),
      own("accuracy.coordination", Interval{0, 1, true},
          "the same of the mean coordination number; both may be asked for", ValueKind::number,
          Role::asked_accuracy, set_member<&ResolvedSpec::asked_accuracy, &ErrorWish::coordination>,
          no_identity),
      row<&S::accuracy, &A::protocol>(
          "accuracy.protocol",
          Names{{"heavy_ball", "damped, in long steps"},
                {"dynamic", "plain contact dynamics, undamped, in a quarter of the steps' length"}},
          "how grains come down: damped in long steps, or plain dynamics"),
      solver_row(),
      row<&S::accuracy, &A::precision>(
          "accuracy.precision",
          Names{{"f32", "single precision; places are always f64"},
                {"f64", "double precision, for masses above 1e5 to 1"}},
          "number type of the solver"),
      row<&S::accuracy, &A::rest>(
          "accuracy.rest",
          Names{{"in_steps", "steps pass every test of rest"},
                {"exact", "then on to where all forces balance; spheres only"}},
          "what counts as settled: rest in steps, or, of spheres, exact rest after it"),
      in("sqrt(d/g)",
         row<&S::accuracy, &A::step>("accuracy.step", Interval{1e-4, 2}, "time step, sqrt(d/g)")),
      row<&S::accuracy, &A::momentum>("accuracy.momentum", Interval{0, 1, false, true},
                                      "share of the last displacement carried on, 0 to 1"),
      row<&S::accuracy, &A::fall_iterations>("accuracy.fall_iterations", Interval{1, 1000000},
                                             "most solver iterations per step of fall, "
                                             "creep and ease; doubled, up to 20,000, while "
                                             "they leave too large a residual"),
      in("d",
         row<&S::accuracy, &A::path_tolerance>(
             "accuracy.path_tolerance", Interval{1e-9},
             "how far contacts may stray, d, root mean square: in a full step of the fall of "
             "polyhedra so far, of spheres twice, in all steps of a creep 160 times, of "
             "polyhedra 80 to 100 times (up to 160 where creep_steps is below 200); less, by the "
             "square of their distance, between walls "
             "nearer than 5 d, in ducts and tubes of less than 7 d and in shorter periods than 5 "
             "d")),
      row<&S::accuracy, &A::creep_steps>("accuracy.creep_steps", Interval{0, 1000000},
                                         "steps after the fall, while the bed creeps to rest, "
                                         "where step is 0.2, in proportion where it is shorter; "
                                         "spheres take 1.35 times as many, polyhedra 1.25 times "
                                         "as many and 60; before they are tested for rest, spheres "
                                         "take a 24th as many without momentum"),
      row<&S::accuracy, &A::rest_iterations>("accuracy.rest_iterations", Interval{1, 1000000},
                                             "most solver iterations per step at rest, or "
                                             "1.5 for each mean diameter of height if that "
                                             "is more; spheres take up to twice as many; "
                                             "doubled while they leave too large a "
                                             "residual, once in f32, to 16 times as many "
                                             "in f64")};
}

/// What a bed at rest keeps.
Rows rest_rows() {
  using S = PackingSpec;
  using A = Accuracy;
  return {
      in("m g",
         row<&S::accuracy, &A::residual_tolerance>("accuracy.residual_tolerance", positive,
                                                   "worst residual of the last step at rest, m g")),
      in("m g d",
         row<&S::accuracy, &A::kinetic_tolerance>("accuracy.kinetic_tolerance", positive,
                                                  "kinetic energy per grain at rest, m g d")),
      row<&S::accuracy, &A::contact_tolerance>(
          "accuracy.contact_tolerance", positive,
          "share of the isostatic contacts that may be missing at rest"),
      in("d",
         row<&S::accuracy, &A::overlap_tolerance>(
             "accuracy.overlap_tolerance", positive,
             "mean overlap of touching pairs at rest, d; no pair more than a hundred times it")),
      in("own weights", row<&S::accuracy, &A::imbalance_tolerance>(
                            "accuracy.imbalance_tolerance", positive,
                            "mean static imbalance at rest, in own weights; "
                            "no grain more than 15 times it. A bed slides "
                            "on until its motion tells of no more")),
      in("d", row<&S::accuracy, &A::imbalance_gap>(
                  "accuracy.imbalance_gap", Interval{0, 0.01, true},
                  "contacts with a smaller gap carry the bed statically, d")),
      row<&S::accuracy, &A::max_steps>("accuracy.max_steps", Interval{1, 2147483647},
                                       "steps after which a bed counts as not settled"),
  };
}

Rows measure_rows() {
  using S = PackingSpec;
  using M = MeasureSpec;
  return {
      in("d", row<&S::measure, &M::exclude_floor>("measure.exclude_floor", Interval{0, 1000},
                                                  "zone above the floor left out, d")),
      in("d", row<&S::measure, &M::exclude_surface>("measure.exclude_surface", Interval{0, 1000},
                                                    "zone below the surface left out, d")),
      in("d", row<&S::measure, &M::gap_tolerances>(
                  "measure.gap_tolerances", Interval{0, 0.1, true, true},
                  "grains touch below these gaps, d, 1 to 8 of them; the first is the headline")),
      in("d", row<&S::measure, &M::bin_width>(
                  "measure.bin_width", Interval{0.01, 10000},
                  "width of the bins of profiles, d; at most box.width or half of tube.diameter")),
  };
}

Rows all_rows() {
  Rows all;
  for (Rows rows : {shape_parameters(), container_rows(), fill_rows(), size_parameters(),
                    accuracy_rows(), rest_rows(), measure_rows()}) {
    for (Parameter& parameter : rows) all.push_back(std::move(parameter));
  }
  all.push_back(own("seed", WrittenValues{}, "master seed of the random numbers; in blocks only",
                    ValueKind::natural, Role::seed, set_member<&ResolvedSpec::seed>, no_identity));
  return all;
}

}  // namespace

const std::vector<Parameter>& parameters() {
  static const Rows table = all_rows();
  return table;
}

}  // namespace grainsweep
