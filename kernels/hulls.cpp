// Corners and faces of convex hulls in narrow phase, f64.
//
// Every number is made by itself, by the same operations whatever the width of a batch is.
#include "kernels/lanes.hpp"
#include "kernels/tables.hpp"

namespace {

using grainsweep::EdgeColumns;
using grainsweep::HullEdge;
using grainsweep::PlaneColumns;
using grainsweep::PointColumns;

using Lanes = Batch<double>;
using Vec = Vectors<double>;

constexpr std::size_t width = batch_width<double>;

inline Vec all(const double* v) { return {Lanes(v[0]), Lanes(v[1]), Lanes(v[2])}; }
inline Vec load(const PointColumns& points, std::size_t k) {
  return {load(points.x + k), load(points.y + k), load(points.z + k)};
}

std::size_t largest(const double* numbers, std::size_t count) {
  Lanes batch = load(numbers);
  for (std::size_t k = width; k < count; k += width) batch = xsimd::max(batch, load(numbers + k));
  double lane[width];
  batch.store_unaligned(lane);
  double most = lane[0];
  for (std::size_t l = 1; l < width; ++l) most = lane[l] > most ? lane[l] : most;
  std::size_t k = 0;
  std::uint32_t places = bits_of(load(numbers) == Lanes(most));
  while (places == 0) places = bits_of(load(numbers + (k += width)) == Lanes(most));
  return k + static_cast<std::size_t>(__builtin_ctz(places));
}

std::size_t farthest(const PointColumns& points, const double* n, double* reach) {
  const Vec normal = all(n);
  for (std::size_t k = 0; k < points.count; k += width) {
    dot(load(points, k), normal).store_unaligned(reach + k);
  }
  return largest(reach, points.count);
}

void heights(const PlaneColumns& planes, double scale, const double* x, double* heights,
             double* least) {
  const Vec point = all(x);
  const Lanes scales(scale);
  for (std::size_t k = 0; k < planes.normal.count; k += width) {
    const Lanes height = dot(load(planes.normal, k), point) - scales * ::load(planes.offset + k);
    height.store_unaligned(heights + k);
    xsimd::min(height, ::load(least + k)).store_unaligned(least + k);
  }
}

void below(const double* heights, std::size_t stride, std::size_t rows, double limit,
           std::uint64_t* below) {
  for (std::size_t f = 0; f < stride; ++f) below[f] = 0;
  for (std::size_t k = 0; k < rows && k < 64; ++k) {
    const double* row = heights + k * stride;
    const std::uint64_t bit = std::uint64_t{1} << k;
    for (std::size_t f = 0; f < stride; ++f) below[f] |= row[f] <= limit ? bit : 0;
  }
}

/// The cross product of two unit vectors, of length 1: only the part of v at right angles to u is
/// crossed, so that it is true however small their angle is. Zero if they are parallel.
Vec across(const Vec& u, const Vec& v, const Lanes& parallel) {
  const Lanes along = dot(u, v);
  const Vec w = {v.x - along * u.x, v.y - along * u.y, v.z - along * u.z};
  const Vec n = {u.y * w.z - u.z * w.y, u.z * w.x - u.x * w.z, u.x * w.y - u.y * w.x};
  const Lanes length = xsimd::sqrt(dot(n, n)), none(0.0);
  const auto is_crossed = length > parallel;
  return {xsimd::select(is_crossed, n.x / length, none),
          xsimd::select(is_crossed, n.y / length, none),
          xsimd::select(is_crossed, n.z / length, none)};
}

void crossings(const EdgeColumns& edges, const HullEdge& other, double in_doubt, double parallel,
               double* parted, std::uint8_t* crossings) {
  const Vec from = all(other.from), along = all(other.along), left = all(other.left),
            right = all(other.right);
  const Lanes positive(-in_doubt), negative(in_doubt), least_sine(parallel);
  for (std::size_t k = 0; k < edges.along.count; k += width) {
    const Vec own = load(edges.along, k);
    const Lanes to_left = dot(along, load(edges.left, k));
    const Lanes to_right = dot(along, load(edges.right, k));
    const Lanes from_left = dot(own, left), from_right = dot(own, right);
    const auto with = (to_left >= positive) & (to_right <= negative) & (from_left >= positive) &
                      (from_right <= negative);
    const auto against = (to_left <= negative) & (to_right >= positive) & (from_left <= negative) &
                         (from_right >= positive);
    const std::uint32_t is_with = bits_of(with), is_against = bits_of(against);
    for (std::size_t l = 0; l < width; ++l) {
      crossings[k + l] =
          static_cast<std::uint8_t>((is_with >> l & 1) * grainsweep::along_product |
                                    (is_against >> l & 1) * grainsweep::against_product);
    }
    if ((is_with | is_against) == 0) continue;
    const Vec begin = load(edges.from, k);
    dot(across(own, along, least_sine), {from.x - begin.x, from.y - begin.y, from.z - begin.z})
        .store_unaligned(parted + k);
  }
}

}  // namespace

namespace grainsweep::GRAINSWEEP_ISA_NAME {

extern constinit const HullKernels hull_kernels = {::farthest, ::largest, ::heights, ::below,
                                                   ::crossings};

}  // namespace grainsweep::GRAINSWEEP_ISA_NAME
