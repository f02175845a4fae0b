#include "engine/dynamics/rest.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <type_traits>
#include <utility>

#include "engine/clusters.hpp"
#include "engine/text.hpp"

namespace grainsweep {

namespace {

/// Independent directions, at most three.
class Directions {
 public:
  std::size_t count() const { return count_; }
  /// Adds a unit vector unless it depends on those before.
  void add(const UnitVector& n) {
    constexpr double dependent = 1e-6;
    Vector rest(n.x, n.y, n.z);
    for (std::size_t k = 0; k < count_; ++k) rest -= rest.dot(basis_[k]) * basis_[k];
    if (count_ < basis_.size() && rest.norm() > dependent) basis_[count_++] = rest.normalized();
  }
  /// Unit vectors at right angles to these and to each other: three less their number.
  std::vector<Vector> across() const {
    Directions all = *this;
    for (const UnitVector& axis : {UnitVector{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}) all.add(axis);
    return {all.basis_.begin() + static_cast<std::ptrdiff_t>(count_), all.basis_.end()};
  }

 private:
  std::array<Vector, 3> basis_{};
  std::size_t count_ = 0;
};

/// What holds one cluster.
struct Hold {
  std::vector<std::int32_t> grains;  ///< grains that push each other
  Directions walls;                  ///< directions in which walls push it
  bool stands = false;               ///< a wall pushes it up
  bool is_grain = true;              ///< it is a single grain
};

/// The wall's normal where a grain touches it. A round wall is the last one, and has a name for
/// each vertex.
UnitVector normal_at(const SphereBed& bed, const ForceContact& contact) {
  const Record<double>& p = bed.position[static_cast<std::size_t>(contact.a)];
  return bed.walls[static_cast<std::size_t>(contact.b - bed.wall_name(0))].normal(p.x, p.y, p.z);
}
UnitVector normal_at(const PolyhedronBed& bed, const ForceContact& contact) {
  const auto grain = static_cast<std::size_t>(contact.a);
  const auto name = static_cast<std::size_t>(contact.b - bed.wall_name(0));
  const Wall& wall = bed.walls[std::min(name, bed.walls.size() - 1)];
  const Pose pose = bed.pose(grain);
  Vector place = pose.centre;
  if (wall.is_round() && bed.turns(grain)) {
    place = pose.place(bed.shape(grain).vertices[name - (bed.walls.size() - 1)]);
  }
  return wall.normal(place.x(), place.y(), place.z());
}

/// Whether a cluster turns about the axis of a tube, which keeps all gaps, in a way that its slides
/// and spins do not amount to, to first order: for grains one above the other they do.
bool turns_in_tube(const SphereBed& bed, const Hold& hold) {
  constexpr double rounding = 1e-9;  // of places, d
  if (!bed.box.is_tube) return false;
  const auto place = [&](std::int32_t grain) {
    return bed.position[static_cast<std::size_t>(grain)];
  };
  const Record<double> first = place(hold.grains.front());
  return std::any_of(hold.grains.begin(), hold.grains.end(), [&](std::int32_t grain) {
    return std::hypot(place(grain).x - first.x, place(grain).y - first.y) > rounding;
  });
}
bool turns_in_tube(const PolyhedronBed& bed, const Hold& hold) {
  return bed.box.is_tube && !(hold.is_grain && hold.walls.count() == 1);
}

/// The grain of a contact that its normal, if it turns, holds.
template <class Kind>
std::size_t turning_grain(const Bed<Kind>& bed, const ForceContact& contact) {
  const bool is_b = bed.is_grain(contact.b) && !bed.turns(static_cast<std::size_t>(contact.a));
  return static_cast<std::size_t>(is_b ? contact.b : contact.a);
}

/// WallForce::wall of a contact with a wall.
template <class Kind>
std::int32_t wall_of(const Bed<Kind>& bed, const ForceContact& contact) {
  const std::int32_t wall = contact.b - bed.wall_name(0);
  const bool is_vertex =
      bed.box.is_tube && wall >= tube_wall && bed.turns(static_cast<std::size_t>(contact.a));
  return is_vertex ? wall_of_vertex(wall - tube_wall) : wall;
}

/// Most directions in which turning normals can hold a grain: a polyhedron's three turns.
constexpr std::int64_t most_by_turning = 3;

/// Whether a grain of this radius fills a container from one wall to the other.
bool fills(Boundary boundary, double extent, double radius) {
  return boundary == Boundary::walls && extent / 2.0 - radius < closed_gap;
}
/// Whether a sphere fills the space between the walls along x, or y.
struct Filled {
  bool along_x = false, along_y = false;
  std::int64_t count() const { return (along_x ? 1 : 0) + (along_y ? 1 : 0); }
};
Filled filled_by(const SphereBed& bed, std::size_t grain) {
  const double radius = bed.position[grain].w;
  return {fills(bed.box.x, bed.box.length, radius), fills(bed.box.y, bed.box.width, radius)};
}
Filled filled_by(const PolyhedronBed& /*bed*/, std::size_t /*grain*/) { return {}; }

/// Degrees of freedom of spheres that fill a box or a tube: walls hold them in a plane or on the
/// axis, without a force.
template <class Kind>
std::int64_t held_in_place(const Bed<Kind>& bed) {
  std::int64_t held = 0;
  for (std::size_t i = 0; i < bed.grains(); ++i) held += filled_by(bed, i).count();
  return held;
}

/// What holds the clusters of grains that push each other; at the root of each.
template <class Kind>
std::vector<Hold> holds_of(const Bed<Kind>& bed, const std::vector<ForceContact>& contacts) {
  Clusters clusters(bed.grains());
  for (const ForceContact& c : contacts) {
    if (!bed.is_grain(c.b)) continue;
    clusters.join(static_cast<std::size_t>(c.a), static_cast<std::size_t>(c.b));
  }
  std::vector<Hold> holds(bed.grains());
  for (std::size_t i = 0; i < bed.grains(); ++i) {
    Hold& hold = holds[clusters.root(i)];
    hold.grains.push_back(static_cast<std::int32_t>(i));
    const Filled filled = bed.box.is_tube ? Filled() : filled_by(bed, i);
    if (filled.along_x) hold.walls.add({1, 0, 0});
    if (filled.along_y) hold.walls.add({0, 1, 0});
  }
  for (const ForceContact& c : contacts) {
    Hold& hold = holds[clusters.root(static_cast<std::size_t>(c.a))];
    if (bed.is_grain(c.b)) {
      hold.is_grain = false;
    } else {
      const UnitVector normal = normal_at(bed, c);
      hold.walls.add(normal);
      hold.stands = hold.stands || normal.z > 0.0;
    }
  }
  return holds;
}

bool is_held_by(const PolyhedronBed& /*bed*/, const ForceContact& /*contact*/) { return false; }

struct RestTest {
  bool is_passed = false;
  std::string failure;      ///< what is wrong if it is not passed
  std::string remedy;       ///< how a bed passes: which members of the accuracy to make larger
  std::string advice = {};  ///< what to do if no accuracy does

  RestTest advised(const std::string& text) const { return {is_passed, failure, remedy, text}; }
};

RestTest at_most(const char* what, const char* unit, double value, double tolerance,
                 const std::string& remedy, const std::string& why = "") {
  return {value <= tolerance,
          std::string(what) + " " + number_text(value) + " " + unit + " exceeds " +
              number_text(tolerance) + why,
          remedy};
}

/// What makes beds come to rest, first, with its value; then what only lets them pass.
std::string larger(const char* member, int value, const char* tolerance) {
  return joined("make accuracy.", member, " larger, which is ", value, ", or accuracy.", tolerance);
}

}  // namespace

bool is_held_by(const SphereBed& bed, const ForceContact& contact) {
  if (bed.box.is_tube || bed.is_grain(contact.b)) return false;
  const Filled filled = filled_by(bed, static_cast<std::size_t>(contact.a));
  const UnitVector normal = normal_at(bed, contact);
  return (filled.along_x && normal.x != 0.0) || (filled.along_y && normal.y != 0.0);
}

Vector free_part(const SphereBed& bed, std::size_t grain, const Vector& force) {
  if (bed.box.is_tube) return force;
  const Filled filled = filled_by(bed, grain);
  return {filled.along_x ? 0.0 : force.x(), filled.along_y ? 0.0 : force.y(), force.z()};
}

template <class Kind>
std::int64_t isostatic_count(const Bed<Kind>& bed, const std::vector<ForceContact>& contacts) {
  const std::int64_t in_place = bed.box.is_tube ? 0 : held_in_place(bed);
  return degrees_of_freedom(bed) - in_place - zero_modes(bed, contacts);
}

template <class Kind, class Real>
RestReport measure_rest(Bed<Kind>& bed, const ExecutionContext& context, double dt,
                        StepState<Kind, Real>& state) {
  RestReport rest;
  double overlap = 0.0;
  const std::vector<ForceContact> contacts = force_contacts(bed, dt, state.contacts);
  std::vector<std::int64_t> by_turning(bed.grains(), 0);
  auto contact = contacts.begin();
  for (const Closure& closure : closures(bed, context, dt, state.candidates, state.contacts)) {
    const ForceContact& of = *contact++;
    if (!std::isfinite(closure.gap)) continue;
    const double depth = std::max(0.0, -closure.gap);
    overlap += depth;
    rest.overlap_max = std::max(rest.overlap_max, depth);
    if (is_held_by(bed, of)) continue;
    rest.contacts += closure.constraints;
    by_turning[turning_grain(bed, of)] += closure.by_turning;
  }
  for (const std::int64_t held : by_turning)
    rest.held_by_turning += std::min(held, most_by_turning);
  if (bed.box.is_tube) rest.held_by_turning += held_in_place(bed);
  rest.independent_contacts = static_cast<double>(rest.contacts);
  rest.overlap_mean = overlap / std::max(static_cast<double>(contacts.size()), 1.0);
  rest.isostatic_contacts = isostatic_count(bed, contacts);
  rest.may_rest_on_fewer = std::is_same_v<Kind, Polyhedron>;
  return rest;
}

template <class Kind>
std::int64_t zero_modes(const Bed<Kind>& bed, const std::vector<ForceContact>& contacts) {
  std::int64_t modes = 0;
  for (const Hold& hold : holds_of(bed, contacts)) {
    if (!hold.stands) continue;
    modes += 3 - static_cast<std::int64_t>(hold.walls.count());
    const bool spins = hold.is_grain && bed.turns(static_cast<std::size_t>(hold.grains.front()));
    modes += spins && hold.walls.count() == 1 ? 1 : 0;
    modes += turns_in_tube(bed, hold) ? 1 : 0;
  }
  return modes;
}

std::vector<std::vector<std::int32_t>> clusters_that_turn(
    const SphereBed& bed, const std::vector<ForceContact>& contacts) {
  std::vector<std::vector<std::int32_t>> clusters;
  for (Hold& hold : holds_of(bed, contacts)) {
    if (hold.stands && turns_in_tube(bed, hold)) clusters.push_back(std::move(hold.grains));
  }
  return clusters;
}

std::vector<FreeMotion> free_motions(const SphereBed& bed,
                                     const std::vector<ForceContact>& contacts) {
  std::vector<FreeMotion> motions;
  for (Hold& hold : holds_of(bed, contacts)) {
    if (!hold.stands) continue;
    for (const Vector& direction : hold.walls.across()) {
      motions.push_back({hold.grains, direction});
    }
  }
  return motions;
}

WithLines<PairForce> pair_forces(const Grains& bed, const std::vector<ForceContact>& contacts,
                                 const std::vector<ForceLine>& lines) {
  WithLines<PairForce> of_pairs;
  for (std::size_t k = 0; k < contacts.size(); ++k) {
    const ForceContact& c = contacts[k];
    if (!bed.is_grain(c.b)) continue;
    const double height = (bed.position[static_cast<std::size_t>(c.a)].z +
                           bed.position[static_cast<std::size_t>(c.b)].z) /
                          2.0;
    of_pairs.first.push_back({c.a, c.b, c.force, height});
    if (!lines.empty()) of_pairs.second.push_back(lines[k]);
  }
  return of_pairs;
}

template <class Kind>
WithLines<WallForce> wall_forces(const Bed<Kind>& bed, const std::vector<ForceContact>& contacts,
                                 const std::vector<ForceLine>& lines) {
  std::map<std::pair<std::int32_t, std::int32_t>, std::pair<double, ForceLine>> sorted;
  for (std::size_t k = 0; k < contacts.size(); ++k) {
    const ForceContact& c = contacts[k];
    if (bed.is_grain(c.b)) continue;
    auto& [force, line] = sorted[{c.a, wall_of(bed, c)}];
    force += c.force;
    if (!lines.empty()) line = lines[k];
  }
  WithLines<WallForce> of_walls;
  of_walls.first.reserve(sorted.size());
  for (const auto& [where, what] : sorted) {
    of_walls.first.push_back({where.first, where.second, what.first});
    if (!lines.empty()) of_walls.second.push_back(what.second);
  }
  return of_walls;
}

std::vector<double> force_sums(const Grains& bed, const std::vector<ForceContact>& contacts) {
  std::vector<double> force(bed.grains(), 0.0);
  for (const ForceContact& c : contacts) {
    force[static_cast<std::size_t>(c.a)] += c.force;
    if (bed.is_grain(c.b)) force[static_cast<std::size_t>(c.b)] += c.force;
  }
  return force;
}

bool is_hyperstatic(const RestReport& rest, const Accuracy& accuracy) {
  return static_cast<double>(rest.contacts) >
         (1.0 + accuracy.contact_tolerance) * static_cast<double>(rest.isostatic_contacts);
}

std::string rest_failure(const RestReport& rest, const Accuracy& accuracy, bool may_go_on) {
  constexpr double most_by_symmetry =
      0.8;  // of the isostatic count; beds that creep soon have more
  const auto held = static_cast<double>(rest.contacts + rest.held_by_turning);
  const auto isostatic = static_cast<double>(rest.isostatic_contacts);
  const bool has_enough = held >= (1.0 - accuracy.contact_tolerance) * isostatic;
  const double imbalance_tolerance =
      (has_enough ? 1.0 : imbalance_share_of_few) * accuracy.imbalance_tolerance;
  const std::string why = has_enough
                              ? ""
                              : ", half of the tolerance since contacts / isostatic count is " +
                                    number_text(held / isostatic);
  constexpr double far = 10.0;  // from what more iterations would solve
  const std::string advice_where_stuck =
      rest.step_residual > far * accuracy.residual_tolerance
          ? joined(
                "give sizes a spread, as of 1e-2, if equal grains just fit between walls; else "
                "make accuracy.rest_iterations larger, which is ",
                accuracy.rest_iterations)
          : "";
  const auto more_iterations = [&](const char* tolerance) {
    return larger("rest_iterations", accuracy.rest_iterations, tolerance);
  };
  const RestTest tests[] = {
      at_most("residual of the last step", "m g", rest.step_residual, accuracy.residual_tolerance,
              more_iterations("residual_tolerance"))
          .advised(advice_where_stuck),
      at_most("kinetic energy", "m g d per grain", rest.kinetic_energy, accuracy.kinetic_tolerance,
              "make accuracy.kinetic_tolerance larger"),
      at_most("mean overlap", "d", rest.overlap_mean, accuracy.overlap_tolerance,
              more_iterations("overlap_tolerance")),
      at_most("deepest overlap", "d", rest.overlap_max,
              deepest_overlap * accuracy.overlap_tolerance, more_iterations("overlap_tolerance")),
      {has_enough || (rest.may_rest_on_fewer && rest.contacts > 0),
       "contacts / isostatic count " + number_text(held / isostatic) + " is below 1 by more than " +
           number_text(accuracy.contact_tolerance),
       larger("creep_steps", accuracy.creep_steps, "contact_tolerance"),
       held < most_by_symmetry * isostatic ? "its grains stand by symmetry, as columns do, or just "
                                             "fit: move the start a little or give sizes a spread"
                                           : ""},
      at_most("mean static imbalance", "own weights", rest.imbalance.mean, imbalance_tolerance,
              "make accuracy.imbalance_tolerance or accuracy.imbalance_gap larger", why),
      at_most("largest static imbalance", "own weights", rest.imbalance.max,
              largest_imbalance * imbalance_tolerance,
              "make accuracy.imbalance_tolerance or accuracy.imbalance_gap larger", why)};
  for (const RestTest& test : tests) {
    if (test.is_passed) continue;
    if (!may_go_on || accuracy.step > longest_settling_step) {
      return test.failure + ": " + remedy_of_steps(accuracy);
    }
    return test.failure + ": " + (test.advice.empty() ? test.remedy : test.advice);
  }
  return {};
}

std::string remedy_of_steps(const Accuracy& accuracy) {
  if (accuracy.step <= longest_settling_step) return "make accuracy.max_steps larger";
  return "make accuracy.step smaller, " + number_text(longest_settling_step) +
         " sqrt(d/g) at most, for gravity outruns the motion of longer ones";
}

std::string remedy_of_rounding(const RestReport& rest, const Accuracy& accuracy, double height) {
  RestReport balanced = rest;
  balanced.step_residual = 0.0;
  if (!rest_failure(balanced, accuracy).empty()) return "";  // it is on its way
  const bool is_rounding = accuracy.precision == Precision::f32 &&
                           rest.step_residual > accuracy.residual_tolerance &&
                           error_of_a_layer * height > accuracy.residual_tolerance / 2.0;
  return is_rounding ? "; or rather take accuracy.precision f64: in f32 the forces of a bed " +
                           number_text(height) + " d high are not known better"
                     : "";
}

template RestReport measure_rest(SphereBed&, const ExecutionContext&, double,
                                 StepState<Sphere, float>&);
template RestReport measure_rest(SphereBed&, const ExecutionContext&, double,
                                 StepState<Sphere, double>&);
template RestReport measure_rest(PolyhedronBed&, const ExecutionContext&, double,
                                 StepState<Polyhedron, float>&);
template RestReport measure_rest(PolyhedronBed&, const ExecutionContext&, double,
                                 StepState<Polyhedron, double>&);
template std::int64_t isostatic_count(const SphereBed&, const std::vector<ForceContact>&);
template std::int64_t isostatic_count(const PolyhedronBed&, const std::vector<ForceContact>&);
template std::int64_t zero_modes(const SphereBed&, const std::vector<ForceContact>&);
template std::int64_t zero_modes(const PolyhedronBed&, const std::vector<ForceContact>&);
template WithLines<WallForce> wall_forces(const SphereBed&, const std::vector<ForceContact>&,
                                          const std::vector<ForceLine>&);
template WithLines<WallForce> wall_forces(const PolyhedronBed&, const std::vector<ForceContact>&,
                                          const std::vector<ForceLine>&);

}  // namespace grainsweep
