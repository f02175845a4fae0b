#include "runner/store/fields.hpp"

#include <algorithm>
#include <iterator>
#include <limits>
#include <optional>
#include <type_traits>
#include <utility>

namespace grainsweep {
namespace {

constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

template <class Part>
struct IsOptional : std::false_type {};
template <class Part>
struct IsOptional<std::optional<Part>> : std::true_type {};

/// Follows members and places in arrays from `part` on; null at an optional part without a value,
/// which is created if the part may be changed.
template <auto key, auto... further, class Part>
auto walk(Part& part) {
  if constexpr (IsOptional<std::remove_const_t<Part>>::value) {
    if constexpr (!std::is_const_v<Part>) {
      if (!part) part.emplace();
    }
    return part ? walk<key, further...>(*part) : nullptr;
  } else if constexpr (std::is_integral_v<decltype(key)>) {
    if constexpr (sizeof...(further) == 0)
      return &part[key];
    else
      return walk<further...>(part[key]);
  } else {
    if constexpr (sizeof...(further) == 0)
      return &(part.*key);
    else
      return walk<further...>(part.*key);
  }
}

/// Nothing at an optional number that the outcome does not have, as in one of an earlier version.
template <auto... path>
FieldValue value_at(const Outcome& outcome) {
  const auto* const value = walk<path...>(outcome);
  if (value == nullptr) return FieldValue();
  if constexpr (IsOptional<std::remove_cvref_t<decltype(*value)>>::value) {
    return *value ? FieldValue(**value) : FieldValue();
  } else {
    return FieldValue(*value);
  }
}

template <auto... path>
FieldPlace place_at(Outcome& outcome) {
  auto* const value = walk<path...>(outcome);
  if constexpr (IsOptional<std::remove_cvref_t<decltype(*value)>>::value) {
    return &value->emplace();
  } else {
    return value;
  }
}

/// A value that is stored at `path` of an outcome.
template <auto... path>
Field stored(std::string_view name, std::string_view unit, std::string_view meaning,
             FieldUse use = {}) {
  return {name, unit, meaning, use, value_at<path...>, place_at<path...>};
}

template <auto... path>
Field in_result(std::string_view name, std::string_view unit, std::string_view meaning,
                FieldUse use = {}) {
  return stored<&Outcome::result, path...>(name, unit, meaning, use);
}

template <double Coordination::*kind>
FieldValue headline(const Outcome& outcome) {
  const auto& coordination = outcome.result.coordination;
  return coordination.empty() ? not_a_number : coordination.front().*kind;
}

FieldValue contact_ratio(const Outcome& outcome) {
  const RestReport& rest = outcome.result.rest;
  if (rest.isostatic_contacts == 0) return not_a_number;
  return static_cast<double>(rest.contacts) / static_cast<double>(rest.isostatic_contacts);
}

using Result = PackingResult;
using Rest = RestReport;
using Shape = ShapeOrder;

constexpr FieldUse not_in_tables{.packings = false, .measured = false};
constexpr FieldUse summary_only{.summary = true, .packings = false, .measured = false};
constexpr FieldUse even_if_failed{.measured = false};
constexpr FieldUse counted_even_if_failed{.groups = true, .measured = false};
constexpr FieldUse with_mean{.groups = true};
constexpr FieldUse derived{.journal = false, .groups = true};

/// Parts of a result.
namespace of {
constexpr auto rest = &Result::rest;
constexpr auto order = &Result::order;
constexpr auto shape = &Result::shape_order;
}  // namespace of

std::vector<Field> outcome_fields() {
  return {
      stored<&Outcome::job>("job", "", "id of the packing", summary_only),
      stored<&Outcome::version>("version", "", "of the program that made it", summary_only),
      stored<&Outcome::bed>(
          "bed", "", "hash of its parameters without what is measured, if its grains are stored",
          summary_only),
      stored<&Outcome::exception>("exception", "", "it ended in an exception", summary_only),
      in_result<&Result::status>("status", "", "settled, not_settled or failed", summary_only),
      stored<&Outcome::finished_at>("finished_at", "s", "time since 1970 when it was finished",
                                    summary_only),
      stored<&Outcome::stored_at>("stored_at", "", "byte of the file of beds where its bed begins",
                                  summary_only),
      stored<&Outcome::stored_bytes>("stored_bytes", "", "size of its bed", summary_only),
      in_result<&Result::coordination>(
          "coordinations", "", "gap tolerance, coordination and coordination_with_walls of each",
          not_in_tables),
      in_result<&Result::grains>("grains", "", "number of grains", counted_even_if_failed),
  };
}

std::vector<Field> main_fields() {
  return {
      in_result<&Result::solid_fraction>(
          "solid_fraction", "", "exact solid volume in the slab over the slab's volume", with_mean),
      {"coordination", "",
       "touching grains per grain with its centre in the slab, at gap_tolerance; walls and floor "
       "not counted",
       derived, headline<&Coordination::between_grains>},
      {"coordination_with_walls", "", "the same, walls and floor counted as neighbours", derived,
       headline<&Coordination::with_walls>},
      in_result<of::rest, &Rest::contacts>(
          "contacts", "",
          "force-bearing contacts closed to 1e-4 d, walls and floor included; of polyhedra a "
          "contact along a line counts 2, one over an area 3, as grains lie at the end (a few lie "
          "otherwise than in the last step, whose kinds contacts_simple and an export tell)"),
      in_result<of::rest, &Rest::isostatic_contacts>(
          "isostatic_contacts", "", "degrees of freedom less those that nothing holds"),
      {"contact_ratio", "", "contacts over isostatic_contacts, 1 at perfect rest", derived,
       contact_ratio},
      in_result<of::rest, &Rest::overlap_mean>(
          "overlap_mean", "d", "mean overlap of the force-bearing contacts", with_mean),
      in_result<of::rest, &Rest::overlap_max>("overlap_max", "d", "deepest overlap"),
      in_result<of::rest, &Rest::imbalance, &Imbalance::mean>(
          "static_imbalance_mean", "",
          "net force on a grain in its own weight under forces on all contacts closed to "
          "accuracy.imbalance_gap, none of which pulls, that are the best ones to some 0.005, in "
          "narrow tubes 0.03; of polyhedra or net torque over its circumradius",
          with_mean),
      in_result<of::rest, &Rest::imbalance, &Imbalance::max>(
          "static_imbalance_max", "", "the largest of them; the best forces may leave 0.05 less"),
      in_result<of::rest, &Rest::step_residual>(
          "step_residual", "m g",
          "how well the last step was solved: worst residual of a contact, in weights of its "
          "lighter "
          "grain where that is lighter; not a balance of forces"),
      in_result<of::rest, &Rest::kinetic_energy>("kinetic_energy", "m g d",
                                                 "mean per grain in the last step"),
      in_result<&Result::steps>("steps", "", "steps taken", even_if_failed),
      in_result<&Result::iterations>("iterations", "", "iterations of the solver, all steps",
                                     even_if_failed),
      stored<&Outcome::cpu_seconds>(
          "cpu_seconds", "s", "CPU time of all threads; the one column that differs between runs",
          FieldUse{.summary = true, .measured = false}),
  };
}

std::vector<Field> further_fields() {
  return {
      in_result<&Result::surface_height>(
          "surface_height", "d",
          "z of the bed's free surface: median, over columns of the "
          "floor about d wide (as wide as the grains, if these are "
          "larger), of the highest point of the grains whose centres "
          "stand above each; of an even number of columns the higher "
          "of the two in the middle",
          with_mean),
      in_result<&Result::slab_bottom>("slab_bottom", "d", "z where the measured slab begins"),
      in_result<&Result::slab_top>("slab_top", "d", "z where it ends"),
      in_result<of::rest, &Rest::independent_contacts>(
          "independent_contacts", "",
          "contacts that do not depend on others: all of them, unless they exceed "
          "isostatic_contacts by more than accuracy.contact_tolerance; then they are counted, or "
          "empty if more than 30,000"),
      in_result<of::rest, &Rest::largest_motion>(
          "largest_motion", "d", "largest displacement of a grain in the last step"),
      in_result<&Result::spurious_path>("spurious_path", "d",
                                        "how far contacts strayed while the bed settled, for want "
                                        "of better solves: taps that pack "
                                        "it denser",
                                        with_mean),
      in_result<&Result::small_share>("slab_small_share", "",
                                      "share of the slab's solid volume in small grains; where "
                                      "they sink, other than small_share",
                                      with_mean),
      in_result<&Result::small_share_of_bed>("bed_small_share", "",
                                             "the same of the whole bed; other than small_share "
                                             "where sizes of both classes overlap",
                                             with_mean),
      in_result<&Result::mean_diameter>("mean_diameter", "d", "of all grains"),
      in_result<&Result::mean_diameter_by_volume>("mean_diameter_by_volume", "d",
                                                  "the same, each grain weighted by its volume"),
      in_result<&Result::sauter_diameter>(
          "sauter_diameter", "d",
          "6 times the volume of all grains over their surface; a volume of the bed holds 6 times "
          "solid_fraction over it of their surface",
          with_mean),
  };
}

std::vector<Field> order_fields() {
  return {
      in_result<of::order, &Order::q6_global>(
          "q6_global", "",
          "bond order of the bonds of all grains in the slab together, one between two of them "
          "twice; 0 if they point anywhere",
          with_mean),
      in_result<of::order, &Order::q6_local>(
          "q6_local", "", "bond order of a grain's own bonds, mean over grains", with_mean),
      in_result<of::order, &Order::three_contact_share>(
          "three_contact_share", "", "grains that touch exactly three others, walls included",
          with_mean),
      in_result<of::order, &Order::segregation>(
          "segregation", "",
          "mean height of small less that of large grains in the slab, in its heights", with_mean),
      in_result<of::order, &Order::force_mean>(
          "force_mean", "m g",
          "of the force-bearing contacts between grains midway between whose centres the slab is",
          with_mean),
      in_result<of::order, &Order::force_square>(
          "force_square", "",
          "mean square of a contact force over the mean of its layer, 1 d thick, counted from the "
          "slab's bottom by the middle of both centres",
          with_mean),
  };
}

std::vector<Field> last_fields() {
  return {
      in_result<&Result::state_hash>("state_hash", "", "of the final positions and radii",
                                     FieldUse{.summary = true}),
      in_result<&Result::reason>("reason", "", "why the packing did not settle or failed",
                                 even_if_failed),
  };
}

std::vector<Field> shape_fields() {
  return {
      in_result<of::shape, &Shape::contact_share, 0>(
          "contacts_simple", "",
          "share of the force-bearing contacts of the slab, as of force_mean, that are at a point; "
          "like the following only of polyhedra",
          with_mean),
      in_result<of::shape, &Shape::contact_share, 1>("contacts_double", "", "of those along a line",
                                                     with_mean),
      in_result<of::shape, &Shape::contact_share, 2>("contacts_triple", "", "of those over an area",
                                                     with_mean),
      in_result<of::shape, &Shape::force_share, 0>(
          "force_simple", "", "share of the sum of those contacts' forces that simple ones carry",
          with_mean),
      in_result<of::shape, &Shape::force_share, 1>("force_double", "", "that double ones carry",
                                                   with_mean),
      in_result<of::shape, &Shape::force_share, 2>("force_triple", "", "that triple ones carry",
                                                   with_mean),
      in_result<of::shape, &Shape::nematic, 0>(
          "nematic_x", "", "nematic order of the axis x of the frame in which the shape is written",
          with_mean),
      in_result<of::shape, &Shape::nematic, 1>("nematic_y", "", "the same of y", with_mean),
      in_result<of::shape, &Shape::nematic, 2>("nematic_z", "", "the same of z", with_mean),
  };
}

std::vector<Field> all_fields() {
  std::vector<Field> all;
  for (const auto& some : {outcome_fields(), main_fields(), further_fields(), order_fields(),
                           last_fields(), shape_fields()}) {
    all.insert(all.end(), some.begin(), some.end());
  }
  return all;
}

}  // namespace

const std::vector<Field>& fields() {
  static const std::vector<Field> all = all_fields();
  return all;
}

const Field& field_named(std::string_view name) {
  return *std::find_if(fields().begin(), fields().end(),
                       [&](const Field& field) { return field.name == name; });
}

double number_of(const Field& field, const Outcome& outcome) {
  const FieldValue value = field.value(outcome);
  if (const auto* number = std::get_if<double>(&value)) return *number;
  if (const auto* count = std::get_if<std::int64_t>(&value)) return static_cast<double>(*count);
  return not_a_number;
}

}  // namespace grainsweep
