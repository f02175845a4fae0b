#include "engine/packing.hpp"

#include <algorithm>

#include "engine/dynamics/settle.hpp"
#include "engine/measure/bond_order.hpp"
#include "engine/measure/components.hpp"
#include "engine/measure/coordination.hpp"
#include "engine/measure/order.hpp"
#include "engine/measure/profile.hpp"
#include "engine/measure/shape_order.hpp"
#include "engine/measure/size_rows.hpp"
#include "engine/measure/solid_fraction.hpp"
#include "engine/measure/touching.hpp"
#include "engine/scene/sizes.hpp"
#include "engine/scene/start.hpp"
#include "engine/shape/build.hpp"
#include "engine/shape/given_shape.hpp"
#include "engine/units.hpp"

namespace grainsweep {

namespace {

Packing failed(std::string reason) {
  Packing packing;
  packing.result.reason = std::move(reason);
  return packing;
}

/// Why a bed is not called settled; empty if it is. A bed that was given must also have kept its
/// arrangement.
std::string why_not_settled(const Fill& fill, const SettleReport& settled) {
  const bool lost = settled.sank && std::holds_alternative<PlacedGrains>(fill);
  return settled.failure.empty() && lost
             ? "two grains of fill.file sank into each other by more than half on the way and may "
               "have passed through one another: make accuracy.path_tolerance smaller"
             : settled.failure;
}

template <class Kind>
PackingResult result_of(const Fill& fill, const Bed<Kind>& bed, const SettleReport& settled) {
  const std::string failure = why_not_settled(fill, settled);
  PackingResult result;
  result.status = settled.cancelled ? PackingStatus::cancelled
                  : failure.empty() ? PackingStatus::settled
                                    : PackingStatus::not_settled;
  result.reason = settled.cancelled ? "stopped on request" : failure;
  result.grains = static_cast<std::int64_t>(bed.grains());
  result.rest = settled.rest;
  result.spurious_path = settled.spurious_path;
  result.steps = settled.steps;
  result.iterations = settled.iterations;
  result.state_hash = state_hash(bed);
  return result;
}

double widest(const std::vector<double>& tolerances) {
  return *std::max_element(tolerances.begin(), tolerances.end());
}

/// The slab that is measured; a bed too low to hold one fails with the reason.
std::optional<Slab> slab_of(const MeasureSpec& spec, PackingResult& result) {
  const Slab slab{spec.exclude_floor, result.surface_height - spec.exclude_surface};
  result.slab_bottom = slab.bottom;
  result.slab_top = slab.top;
  if (slab.height() >= least_slab_height) return slab;
  result.status = PackingStatus::failed;
  result.reason =
      "the bed is too low to be measured: less than 1 d is left between the zones "
      "above the floor and below the surface; fill in more grains or make "
      "measure.exclude_floor and measure.exclude_surface smaller";
  return std::nullopt;
}

ProfileSettings bins_of(const PackingSpec& packing) {
  const MeasureSpec& spec = packing.measure;
  return {spec.bin_width, small_class_limit(packing.sizes), spec.gap_tolerances.front()};
}

/// `near` holds all pairs and walls with a gap below a tolerance or within that of a bond.
void measure_neighbours(const PackingSpec& packing, const Touching& near,
                        const std::vector<PairForce>& forces, const Slab& slab, const Grains& bed,
                        PackingResult& result) {
  const MeasureSpec& spec = packing.measure;
  for (const double tolerance : spec.gap_tolerances) {
    result.coordination.push_back(coordination(bed, near, slab, tolerance));
  }
  result.order = measure_order(bed, near, forces, slab, bins_of(packing), result);
}

/// A grain of size 1 of one component.
struct UnitGrain {
  double volume = 0.0;   ///< d^3
  double surface = 0.0;  ///< d^2
};
std::vector<UnitGrain> unit_grains(const SphereBed& /*bed*/) { return {{sphere_volume(0.5), pi}}; }
std::vector<UnitGrain> unit_grains(const PolyhedronBed& bed) {
  std::vector<UnitGrain> units;
  for (const ConvexShape& shape : bed.shapes) units.push_back({shape.volume, surface_area(shape)});
  return units;
}

/// What each grain would weigh in shares of this kind if its size were 1, over what one of the
/// first component, or a sphere, would.
template <class Kind>
std::vector<double> unit_weights(const Bed<Kind>& bed, SizeWeight by) {
  std::vector<double> weights(bed.grains(), 1.0);
  if (by == SizeWeight::number) return weights;
  const auto part = by == SizeWeight::area ? &UnitGrain::surface : &UnitGrain::volume;
  const std::vector<UnitGrain> units = unit_grains(bed);
  for (std::size_t i = 0; i < weights.size(); ++i) {
    weights[i] = units[bed.component(i)].*part / (units.front().*part);
  }
  return weights;
}

template <class Kind>
void measure_sizes(const Bed<Kind>& bed, PackingResult& result) {
  const std::vector<UnitGrain> units = unit_grains(bed);
  double volumes = 0.0, surfaces = 0.0, by_volume = 0.0, diameters = 0.0;
  for (std::size_t i = 0; i < bed.grains(); ++i) {
    const double diameter = 2.0 * bed.position[i].w;
    const UnitGrain& unit = units[bed.component(i)];
    const double volume = unit.volume * diameter * diameter * diameter;
    diameters += diameter;
    volumes += volume;
    surfaces += unit.surface * diameter * diameter;
    by_volume += volume * diameter;
  }
  result.mean_diameter = diameters / static_cast<double>(bed.grains());
  result.mean_diameter_by_volume = by_volume / volumes;
  result.sauter_diameter = 6.0 * volumes / surfaces;
}

std::vector<SettledGrain> grains_of(const Grains& bed, const Touching& near, double gap_tolerance,
                                    const std::vector<double>& force) {
  const auto neighbours = neighbour_counts(bed.grains(), near, gap_tolerance);
  std::vector<SettledGrain> grains(bed.grains());
  for (std::size_t i = 0; i < grains.size(); ++i) {
    const Record<double>& p = bed.position[i];
    grains[i] = {p.x, p.y, p.z, p.w, force[i], neighbours[i]};
  }
  return grains;
}

/// The mesh in the frame in which the shape was written, about its centroid.
Mesh mesh_of(const ConvexShape& shape) {
  Mesh mesh;
  if (shape.is_ball) return mesh;
  for (const Vector& vertex : shape.vertices) {
    const Vector v = shape.given.rotation * vertex;
    mesh.vertices.push_back({v.x(), v.y(), v.z()});
  }
  for (const Face& face : shape.faces) {
    const auto corners = corners_of(shape, face);
    mesh.faces.emplace_back(corners.begin(), corners.end());
  }
  return mesh;
}

std::vector<std::array<double, 4>> axes_of(const PolyhedronBed& bed) {
  std::vector<std::array<double, 4>> axes;
  for (std::size_t i = 0; i < bed.grains(); ++i) {
    const Record<double>& q = bed.orientation[i];
    axes.push_back({q.x, q.y, q.z, q.w});
  }
  return axes;
}

Turned orientations_of(const PolyhedronBed& bed) {
  Turned turned;
  for (const ConvexShape& shape : bed.shapes) turned.meshes.push_back(mesh_of(shape));
  turned.components = bed.components;
  for (std::size_t i = 0; i < bed.grains(); ++i) {
    const Quaternion q = bed.given_orientation(i);
    turned.orientations.push_back({q.x(), q.y(), q.z(), q.w()});
  }
  return turned;
}

/// All that is within a gap that counts as a contact or a bond.
Touching touching_or_bonded(const MeasureSpec& spec, const Kernels& kernels, SphereBed& bed) {
  const double tolerance = widest(spec.gap_tolerances);
  const auto tolerance_of = [=](double a, double b) { return std::max(tolerance, bond_gap(a, b)); };
  return find_touching(bed, tolerance_of, kernels);
}
Touching touching_or_bonded(const MeasureSpec& spec, const Kernels& kernels, PolyhedronBed& bed) {
  return find_touching(bed, std::max(widest(spec.gap_tolerances), longest_bond_gap), kernels);
}

/// Where a profile of a bed, and its components' parts of it, go.
struct ProfilePlace {
  ProfileAxis axis;
  Profile PackingResult::*whole;
  ComponentProfile ComponentMeasure::*part;
};
constexpr ProfilePlace profile_places[] = {
    {ProfileAxis::x, &PackingResult::profile_x, &ComponentMeasure::profile_x},
    {ProfileAxis::y, &PackingResult::profile_y, &ComponentMeasure::profile_y},
    {ProfileAxis::from_walls, &PackingResult::profile_from_walls,
     &ComponentMeasure::profile_from_walls},
    {ProfileAxis::z, &PackingResult::profile_z, &ComponentMeasure::profile_z}};

bool has_profile(const Box& box, ProfileAxis axis) {
  return axis == ProfileAxis::x            ? box.x == Boundary::walls && !box.is_tube
         : axis == ProfileAxis::y          ? !box.is_tube
         : axis == ProfileAxis::from_walls ? is_walled_around(box)
                                           : true;
}

/// Profiles of the components of a mixture.
void measure_profiles(const PolyhedronBed& bed, const Touching& near, const Slab& slab,
                      const ProfileSettings& settings, std::vector<ComponentMeasure>& components) {
  for (const ProfilePlace& place : profile_places) {
    if (!has_profile(bed.box, place.axis)) continue;
    auto profiles = component_profiles(place.axis, bed, near, slab, settings);
    for (std::size_t k = 0; k < profiles.size(); ++k) {
      components[k].*place.part = std::move(profiles[k]);
    }
  }
}
// What can be measured of one kind of grains only.
void measure_kind(const SphereBed&, const Touching&, const ProfileSettings&,
                  const std::optional<Slab>&, Packing&) {}
void measure_kind(const PolyhedronBed& bed, const Touching& near, const ProfileSettings& settings,
                  const std::optional<Slab>& slab, Packing& packing) {
  packing.turned = orientations_of(bed);
  packing.axes = axes_of(bed);
  if (!slab) return;
  packing.result.shape_order = measure_shape_order(bed, packing.forces, packing.lines, *slab);
  std::vector<ComponentMeasure>& components = packing.result.components;
  components =
      measure_components(bed, near, packing.forces, packing.lines, *slab, settings.gap_tolerance);
  if (!components.empty()) measure_profiles(bed, near, *slab, settings, components);
}

/// Measures what `spec` asks for of a packing whose forces are known. `force`: the sum of those on
/// each grain.
template <class Kind>
void measure(const PackingSpec& spec, const std::vector<double>& force, const Kernels& kernels,
             Bed<Kind>& bed, Packing& packing) {
  PackingResult& result = packing.result;
  measure_sizes(bed, result);
  const std::vector<double>& tolerances = spec.measure.gap_tolerances;
  const Touching near = touching_or_bonded(spec.measure, kernels, bed);
  packing.grains = grains_of(bed, near, tolerances.front(), force);
  result.surface_height = surface_height(bed);
  const std::optional<Slab> slab = slab_of(spec.measure, result);
  const bool are_drawn =
      spec.sizes.distribution && !std::holds_alternative<PlacedGrains>(spec.fill);
  if (slab && are_drawn) {
    const SizeCurve curve = curve_of(*spec.sizes.distribution);
    result.sizes = size_rows(bed, curve, *slab, unit_weights(bed, curve.by));
  }
  if (slab) {
    result.solid_fraction = solid_fraction(bed, *slab);
    measure_neighbours(spec, near, packing.forces, *slab, bed, result);
    const double limit = small_class_limit(spec.sizes);
    result.small_share = small_share(bed, *slab, limit);
    result.small_share_of_bed = small_share(bed, Slab{-infinity, infinity}, limit);
    for (const ProfilePlace& place : profile_places) {
      if (!has_profile(bed.box, place.axis)) continue;
      result.*place.whole = profile_along(place.axis, bed, near, *slab, bins_of(spec));
    }
  }
  measure_kind(bed, near, bins_of(spec), slab, packing);
}

/// From the start to the measured values.
template <class Kind>
Packing pack(const PackingSpec& spec, const ExecutionContext& context, const KeepGoing& keep_going,
             std::string_view saved) {
  std::optional<Bed<Kind>> bed = start<Kind>(spec);
  if (!bed) {
    return failed("a grain is larger than the gap between the walls; make the box wider");
  }
  if (!is_finite(*bed)) {
    return failed(
        "a grain's place, radius or inverse mass is not a finite number at the start: correct "
        "fill.file, whose radii are perhaps not in d");
  }
  SettleReport settled = settle(spec.accuracy, context, *bed, keep_going, saved);
  if (settled.precision_insufficient) return failed(settled.failure);
  if (!is_finite(*bed)) {
    const bool is_f32 = spec.accuracy.precision == Precision::f32;
    return failed("the bed blew up in step " + std::to_string(settled.steps) +
                  ": a grain's place is no longer a finite number; " +
                  (is_f32 ? "take accuracy.precision f64, or " : "") +
                  "leave out grains far smaller than d");
  }
  Packing packing;
  packing.result = result_of(spec.fill, *bed, settled);
  if (settled.cancelled) return packing;
  static_cast<BedForces&>(packing) = static_cast<BedForces&&>(settled);
  measure(spec, settled.force, context.kernels, *bed, packing);
  return packing;
}

/// Turns the grains as those of `made` are; false if these are not as many.
bool turn_as(const Packing& /*made*/, SphereBed& /*bed*/) { return true; }
bool turn_as(const Packing& made, PolyhedronBed& bed) {
  if (made.axes.size() != bed.grains()) return false;
  for (std::size_t i = 0; i < bed.grains(); ++i) {
    const auto& [x, y, z, w] = made.axes[i];
    bed.orientation[i] = {x, y, z, w};
  }
  return true;
}

/// Lays the grains where those of `made` lie; false if these are not the same.
bool lay_as(const Packing& made, Grains& bed) {
  if (made.grains.size() != bed.grains()) return false;
  for (std::size_t i = 0; i < bed.grains(); ++i) {
    const SettledGrain& grain = made.grains[i];
    if (bed.position[i].w != grain.radius) return false;
    bed.position[i] = {grain.x, grain.y, grain.z, grain.radius};
  }
  return true;
}

template <class Kind>
std::optional<Packing> measured_again(const PackingSpec& spec, const Kernels& kernels,
                                      const Packing& made) {
  std::optional<Bed<Kind>> bed = start<Kind>(spec);
  if (!bed || !lay_as(made, *bed) || !turn_as(made, *bed)) return std::nullopt;
  Packing packing;
  static_cast<SettledPart&>(packing.result) = static_cast<const SettledPart&>(made.result);
  static_cast<BedForces&>(packing) = static_cast<const BedForces&>(made);
  std::vector<double> force;
  force.reserve(made.grains.size());
  for (const SettledGrain& grain : made.grains) force.push_back(grain.force);
  measure(spec, force, kernels, *bed, packing);
  return packing;
}

}  // namespace

Packing make_packing(const PackingSpec& spec, const ExecutionContext& context,
                     const KeepGoing& keep_going, std::string_view saved) {
  return is_sphere(spec.shape) ? pack<Sphere>(spec, context, keep_going, saved)
                               : pack<Polyhedron>(spec, context, keep_going, saved);
}

std::optional<Packing> measure_again(const PackingSpec& spec, const Kernels& kernels,
                                     const Packing& made) {
  const bool is_at_its_end = made.result.status == PackingStatus::settled ||
                             made.result.status == PackingStatus::not_settled;
  if (!is_at_its_end) return std::nullopt;
  return is_sphere(spec.shape) ? measured_again<Sphere>(spec, kernels, made)
                               : measured_again<Polyhedron>(spec, kernels, made);
}

}  // namespace grainsweep
