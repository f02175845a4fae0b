#include "engine/scene/bed.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <utility>

#include "engine/units.hpp"

namespace grainsweep {

namespace {

/// Far enough that no grain ever meets the void, near enough that squares stay finite.
constexpr double void_distance = 1e9;

/// Appends the entries that are not grains: the walls, then two voids for each subdomain.
void append_padding(Grains& bed) {
  bed.position.insert(bed.position.end(), bed.subdomains, {0.0, 0.0, -void_distance, 0.0});
  bed.motion.insert(bed.motion.end(), bed.subdomains, {0.0, 0.0, 0.0, 0.0});
  for (std::size_t subdomain = 0; subdomain < bed.subdomains; ++subdomain) {
    bed.position.insert(bed.position.end(), {{0.0, 0.0, -2.0 * void_distance, 0.0},
                                             {0.0, 0.0, -3.0 * void_distance, 0.0}});
    bed.motion.insert(bed.motion.end(), {{0.0, 0.0, 0.0, 1.0}, {0.0, 0.0, 0.0, 1.0}});
  }
}

/// The container of so many grains, still without the grains.
template <class Kind>
Bed<Kind> empty_bed(const Box& box, std::size_t grains, double solid_volume) {
  Bed<Kind> bed;
  bed.box = box;
  bed.walls = walls_of(box);
  bed.subdomains = max_subdomains<Kind>(grains);
  bed.subdomain_axis = subdomain_axis(box, solid_volume);
  bed.position.reserve(grains + 3 * bed.subdomains);
  bed.motion.reserve(grains + 3 * bed.subdomains);
  return bed;
}

bool is_finite(const Record<double>& r) {
  return std::isfinite(r.x) && std::isfinite(r.y) && std::isfinite(r.z) && std::isfinite(r.w);
}
bool are_finite(const std::vector<Record<double>>& records) {
  return std::all_of(records.begin(), records.end(),
                     [](const Record<double>& r) { return is_finite(r); });
}

std::uint64_t mixed_value(std::uint64_t hash, double value) {
  std::uint64_t bits = 0;
  std::memcpy(&bits, &value, sizeof bits);
  hash = (hash ^ bits) * 0x9E3779B97F4A7C15ULL;  // odd constant of Knuth's multiplicative hashing
  return hash ^ (hash >> 29);
}
std::uint64_t mixed(std::uint64_t hash, const Record<double>& r) {
  return mixed_value(mixed_value(mixed_value(mixed_value(hash, r.x), r.y), r.z), r.w);
}

/// sin(x) / x and cos(x) of x = sqrt(squared) by their series: the same bits with any mathematical
/// library. Exact to rounding for x <= 1; beyond, the quaternion is still a turn about its axis.
struct SineCosine {
  double sine_over, cosine;
};
SineCosine series(double squared) {
  constexpr int terms = 10;
  SineCosine sum{1.0, 1.0};
  for (int k = terms; k > 0; --k) {
    sum.sine_over = 1.0 - squared * sum.sine_over / (2.0 * k * (2.0 * k + 1.0));
    sum.cosine = 1.0 - squared * sum.cosine / (2.0 * k * (2.0 * k - 1.0));
  }
  return sum;
}

/// The rotation by an angle vector, radians.
Quaternion rotation_by(const Vector& angles) {
  const SineCosine half = series(angles.squaredNorm() / 4.0);
  const Vector axis = half.sine_over / 2.0 * angles;
  return Quaternion(half.cosine, axis.x(), axis.y(), axis.z()).normalized();
}

Record<double> record_of(const Quaternion& q) { return {q.x(), q.y(), q.z(), q.w()}; }

}  // namespace

double usual_height(const Box& box, double solid_volume) {
  constexpr double solid_fraction = 0.6;  // about that of all settled beds
  return solid_volume / (solid_fraction * box.floor_area());
}

int subdomain_axis(const Box& box, double solid_volume) {
  constexpr double flat = 1.5;  // so many times as long as high: subdomains along x or y
  const double height = usual_height(box, solid_volume);
  const int longer = box.length >= box.width ? 0 : 1;
  return std::max(box.length, box.width) > flat * height ? longer : 2;
}

std::int64_t degrees_of_freedom(const SphereBed& bed) {
  return Sphere::degrees_of_freedom * static_cast<std::int64_t>(bed.grains());
}
std::int64_t degrees_of_freedom(const PolyhedronBed& bed) {
  std::int64_t sum = 0;
  for (std::size_t i = 0; i < bed.grains(); ++i) {
    sum += bed.turns(i) ? Polyhedron::degrees_of_freedom : Sphere::degrees_of_freedom;
  }
  return sum;
}

SphereBed make_bed(const Box& box, const std::vector<PlacedSphere>& spheres) {
  double volume = 0.0;
  for (const PlacedSphere& s : spheres) volume += sphere_volume(s.radius);
  SphereBed bed = empty_bed<Sphere>(box, spheres.size(), volume);
  for (const PlacedSphere& s : spheres) {
    bed.position.push_back({s.x, s.y, s.z, s.radius});
    bed.motion.push_back({0.0, 0.0, 0.0, 1.0 / sphere_mass(s.radius)});
  }
  append_padding(bed);
  return bed;
}

PolyhedronBed make_bed(const Box& box, std::vector<ConvexShape> shapes,
                       std::vector<std::uint8_t> components, const std::vector<Pose>& poses) {
  const auto shape_of = [&](std::size_t i) -> const ConvexShape& {
    return shapes[components.empty() ? 0 : components[i]];
  };
  double volume = 0.0;
  for (std::size_t i = 0; i < poses.size(); ++i) volume += shape_of(i).volume_at(poses[i].scale);
  PolyhedronBed bed = empty_bed<Polyhedron>(box, poses.size(), volume);
  for (std::size_t i = 0; i < poses.size(); ++i) {
    const Pose& p = poses[i];
    const ConvexShape& shape = shape_of(i);
    const double unit_mass = shape.volume / shapes.front().volume;
    bed.position.push_back({p.centre.x(), p.centre.y(), p.centre.z(), 0.5 * p.scale});
    bed.orientation.push_back(record_of(p.orientation));
    bed.motion.push_back({0.0, 0.0, 0.0, 1.0 / (p.scale * p.scale * p.scale * unit_mass)});
  }
  bed.shapes = std::move(shapes);
  bed.components = std::move(components);
  bed.spin.assign(poses.size(), Vector::Zero());
  for (std::size_t i = 0; i < poses.size(); ++i) {
    bed.root_inertia.emplace_back(principal_moments(bed, i).cwiseSqrt());
  }
  append_padding(bed);
  return bed;
}

Vector principal_moments(const PolyhedronBed& bed, std::size_t grain) {
  const double scale = bed.scale(grain);
  const double inverse_inertia = bed.lightness_of(grain) * bed.motion[grain].w;
  return scale * scale / inverse_inertia * bed.shape(grain).inertia;
}

bool is_finite(const SphereBed& bed) { return are_finite(bed.position) && are_finite(bed.motion); }
bool is_finite(const PolyhedronBed& bed) {
  return are_finite(bed.position) && are_finite(bed.motion) && are_finite(bed.orientation) &&
         std::all_of(bed.spin.begin(), bed.spin.end(),
                     [](const Vector& spin) { return spin.allFinite(); });
}

void wrap(Grains& bed, const ParallelFor& loop) {
  parallel_chunks(loop, bed.grains(), bed.subdomains, [&](std::size_t, IndexRange grains) {
    for (std::size_t i = grains.first; i < grains.last; ++i) wrap(bed.box, bed.position[i]);
  });
}

Vector nearest_difference(const Box& box, const Record<double>& p, const Record<double>& q) {
  return {nearest_image(q.x - p.x, box.period_x()), nearest_image(q.y - p.y, box.period_y()),
          q.z - p.z};
}

Vector nearest_difference(const Grains& bed, std::size_t a, std::size_t b) {
  return nearest_difference(bed.box, bed.position[a], bed.position[b]);
}

PairPose pair_pose(const PolyhedronBed& bed, std::size_t a, std::size_t b) {
  return seen_from_a(bed.pose(a), bed.pose(b), nearest_difference(bed, a, b));
}

void move_grain(PolyhedronBed& bed, std::size_t grain, const Vector& displacement,
                const Vector& angles) {
  Record<double>&centre = bed.position[grain], &motion = bed.motion[grain];
  centre = {centre.x + displacement.x(), centre.y + displacement.y(), centre.z + displacement.z(),
            centre.w};
  motion = {displacement.x(), displacement.y(), displacement.z(), motion.w};
  const Quaternion step = rotation_by(angles);
  bed.orientation[grain] = record_of((bed.pose(grain).orientation * step).normalized());
  const Vector& inertia = bed.shape(grain).inertia;
  const Vector momentum = step.conjugate() * inertia.cwiseProduct(angles);
  bed.spin[grain] = momentum.cwiseQuotient(inertia);
}

std::uint64_t state_hash(const SphereBed& bed) {
  std::uint64_t hash = bed.grains();
  for (std::size_t i = 0; i < bed.grains(); ++i) hash = mixed(hash, bed.position[i]);
  return hash;
}
std::uint64_t state_hash(const PolyhedronBed& bed) {
  std::uint64_t hash = bed.grains();
  for (std::size_t i = 0; i < bed.grains(); ++i) {
    const Record<double>& p = bed.position[i];
    hash = mixed(mixed(hash, {p.x, p.y, p.z, bed.scale(i)}), bed.orientation[i]);
  }
  return hash;
}

}  // namespace grainsweep
