// The batch kernel of pinacoid pairs as a plain loop over lanes, with the same operations in the
// same order: its bits have to be equal.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "kernels/kernels.hpp"
#include "tests/support/row_twins.hpp"

namespace grainsweep::testing {

struct Vec3f {
  float x, y, z;
};
inline Vec3f operator+(Vec3f u, Vec3f v) { return {u.x + v.x, u.y + v.y, u.z + v.z}; }
inline Vec3f operator-(Vec3f u, Vec3f v) { return {u.x - v.x, u.y - v.y, u.z - v.z}; }
inline Vec3f operator*(float k, Vec3f v) { return {k * v.x, k * v.y, k * v.z}; }
inline float dot(Vec3f u, Vec3f v) { return u.x * v.x + u.y * v.y + u.z * v.z; }

struct PinacoidTwin {
  float a, b, c, e, roof_y, roof_z, end_x, end_z;
  Vec3f hip;

  explicit PinacoidTwin(const PinacoidHalves& h) {
    const double s = h.a - h.c, roof = std::sqrt(h.e * h.e + h.b * h.b);
    const double end = std::sqrt(h.e * h.e + s * s);
    const double whole = std::sqrt(s * s + h.b * h.b + h.e * h.e);
    const auto f32 = [](double value) { return static_cast<float>(value); };
    a = f32(h.a), b = f32(h.b), c = f32(h.c), e = f32(h.e);
    roof_y = f32(h.e / roof), roof_z = f32(h.b / roof);
    end_x = f32(h.e / end), end_z = f32(s / end);
    hip = {f32(s / whole), f32(h.b / whole), f32(h.e / whole)};
  }
  float width(Vec3f n) const {
    const float x = std::abs(n.x), y = std::abs(n.y), z = std::abs(n.z);
    return std::max(a * x + b * y, c * x + e * z);
  }
};

struct Axes3f {
  Vec3f axis[3];
};

inline Axes3f columns_twin(const float (&q)[4]) {
  const float x = q[0], y = q[1], z = q[2], w = q[3], x2 = x + x, y2 = y + y, z2 = z + z;
  return {{{1 - (y * y2 + z * z2), x * y2 + w * z2, x * z2 - w * y2},
           {x * y2 - w * z2, 1 - (x * x2 + z * z2), y * z2 + w * x2},
           {x * z2 + w * y2, y * z2 - w * x2, 1 - (x * x2 + y * y2)}}};
}

struct PairTwin {
  Vec3f centre;
  float scale_a, scale_b;
  Axes3f columns, rows;
};

inline PairTwin pair_twin(const Record<double>& a, const Record<double>& b,
                          const Record<double>& ra, const Record<double>& rb, double period_x,
                          double period_y) {
  const auto f32 = [](double value) { return static_cast<float>(value); };
  const float p[4] = {f32(ra.x), f32(ra.y), f32(ra.z), f32(ra.w)};
  const float q[4] = {f32(rb.x), f32(rb.y), f32(rb.z), f32(rb.w)};
  const float between[4] = {p[3] * q[0] - p[0] * q[3] - p[1] * q[2] + p[2] * q[1],
                            p[3] * q[1] + p[0] * q[2] - p[1] * q[3] - p[2] * q[0],
                            p[3] * q[2] - p[0] * q[1] + p[1] * q[0] - p[2] * q[3],
                            p[3] * q[3] + p[0] * q[0] + p[1] * q[1] + p[2] * q[2]};
  const Vec3f d{f32(nearest_image_twin(b.x - a.x, period_x)),
                f32(nearest_image_twin(b.y - a.y, period_y)), f32(b.z - a.z)};
  const Axes3f own = columns_twin(p), c = columns_twin(between);
  return {{dot(own.axis[0], d), dot(own.axis[1], d), dot(own.axis[2], d)},
          f32(a.w),
          f32(b.w),
          c,
          {{{c.axis[0].x, c.axis[1].x, c.axis[2].x},
            {c.axis[0].y, c.axis[1].y, c.axis[2].y},
            {c.axis[0].z, c.axis[1].z, c.axis[2].z}}}};
}

inline void face_twin(const PinacoidTwin& own_a, const PinacoidTwin& own_b, const PairTwin& pair,
                      PinacoidBlock& block, std::size_t lane) {
  const auto normals = [](const PinacoidTwin& p, const Axes3f& s, Vec3f(&n)[4]) {
    const Vec3f y = p.roof_y * s.axis[1], z = p.roof_z * s.axis[2];
    const Vec3f ex = p.end_x * s.axis[0], ez = p.end_z * s.axis[2];
    n[0] = z + y, n[1] = z - y, n[2] = ez + ex, n[3] = ez - ex;
  };
  const Vec3f c = pair.centre;
  Vec3f seen_by_b[4], of_b[4];
  normals(own_a, pair.rows, seen_by_b);
  normals(own_b, pair.columns, of_b);
  const float ry = own_a.roof_y * c.y, rz = own_a.roof_z * c.z;
  const float ex = own_a.end_x * c.x, ez = own_a.end_z * c.z;
  const float along_a[4] = {rz + ry, rz - ry, ez + ex, ez - ex};
  block.face_separation[lane] = -1e30F;
  for (int k = 0; k < 8; ++k) {
    const bool a = k < 4;
    const PinacoidTwin &p = a ? own_a : own_b, &seer = a ? own_b : own_a;
    const float own = a ? pair.scale_a : pair.scale_b, other = a ? pair.scale_b : pair.scale_a;
    const float reach = own * (k % 4 < 2 ? p.roof_y * p.b : p.end_x * p.a);
    const Vec3f n = a ? seen_by_b[k] : of_b[k - 4];
    const float along = std::abs(a ? along_a[k] : dot(n, c));
    const float separation = along - (reach + other * seer.width(n));
    if (separation > block.face_separation[lane]) {
      block.face_separation[lane] = separation;
      block.face_axis[lane] = k;
    }
  }
}

/// Directions 0 along x, 1 .. 4 the hips, 5 along y, of the grain whose axes are given.
inline void directions_twin(const PinacoidTwin& p, const Axes3f& s, Vec3f (&seen)[6]) {
  const Vec3f x = p.hip.x * s.axis[0], y = p.hip.y * s.axis[1], z = p.hip.z * s.axis[2];
  seen[0] = s.axis[0], seen[1] = x - y + z, seen[2] = x + y - z;
  seen[3] = y + z - x, seen[4] = x + y + z, seen[5] = s.axis[1];
}

/// Cross product of an own direction and another. Products come first, then signs: a product with a
/// sign inside has the same bits.
inline Vec3f cross_twin(const PinacoidTwin& p, int own, Vec3f v) {
  if (own == 0) return {0, 0 - v.z, v.y};
  if (own == 5) return {v.z, 0, 0 - v.x};
  const float sx = own == 3 ? -1.0F : 1.0F, sy = own == 1 ? -1.0F : 1.0F;
  const float sz = own == 2 ? -1.0F : 1.0F;
  const Vec3f h{sx * p.hip.x, sy * p.hip.y, sz * p.hip.z};
  return {h.y * v.z - h.z * v.y, h.z * v.x - h.x * v.z, h.x * v.y - h.y * v.x};
}

inline void edges_twin(const PinacoidTwin& a, const PinacoidTwin& b, const PairTwin& pair,
                       PinacoidBlock& block, std::size_t lane) {
  Vec3f of_a[6], of_b[6];
  directions_twin(a, pair.rows, of_a);
  directions_twin(b, pair.columns, of_b);
  float square = -1e30F, length2 = 1, least = 1;
  block.edge_axis[lane] = 8;
  for (int j = 0; j < 6; ++j) {
    for (int i = 0; i < 6; ++i) {
      const Vec3f n = cross_twin(a, i, of_b[j]), m = cross_twin(b, j, of_a[i]);
      const float width = pair.scale_a * a.width(n) + pair.scale_b * b.width(m);
      const float separation = std::abs(dot(n, pair.centre)) - width, l = dot(n, n);
      const float its_square = separation * std::abs(separation);
      if (its_square * length2 > square * l && l > parallel_edges_sine2) {
        square = its_square, length2 = l;
        block.edge_axis[lane] = 8 + 6 * i + j;
      }
      least = std::min(least, l);
    }
  }
  const float size = std::sqrt(std::abs(square) / length2);
  block.edge_separation[lane] = square < 0 ? 0 - size : size;
  block.edges_parallel[lane] = least <= parallel_edges_sine2 ? 1 : 0;
}

inline void pinacoid_axes_twin(const PinacoidHalves& shape_a, const PinacoidHalves& shape_b,
                               PinacoidBlock* pairs, std::size_t blocks,
                               const Record<double>* centres, const Record<double>* orientations,
                               double period_x, double period_y) {
  const PinacoidTwin of_a(shape_a), of_b(shape_b);
  for (std::size_t row = 0; row < blocks * block_width; ++row) {
    PinacoidBlock& block = pairs[row / block_width];
    const std::size_t lane = row % block_width;
    const auto a = static_cast<std::size_t>(block.a(lane));
    const auto b = static_cast<std::size_t>(block.b(lane));
    const PairTwin pair =
        pair_twin(centres[a], centres[b], orientations[a], orientations[b], period_x, period_y);
    face_twin(of_a, of_b, pair, block, lane);
    edges_twin(of_a, of_b, pair, block, lane);
  }
}

}  // namespace grainsweep::testing
