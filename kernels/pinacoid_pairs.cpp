// Narrow phase of pinacoids: the separating-axis test of 16 pairs at a time.
//
// For each axis n the separation is |n . c| - s_a h_a(n) - s_b h_b(R^T n), with c the difference of
// centres and R the turn of b, both in the frame of a, and h_a, h_b the half widths of the shapes.
// Edge axes are cross products e_i x R e_j, taken in both frames from constants, and not
// normalised: with s the separation times |n|, they are compared by s |s| / |n|^2 without a
// division.
#include "kernels/lanes.hpp"
#include "kernels/tables.hpp"

namespace {

using grainsweep::PinacoidBlock;
using grainsweep::PinacoidHalves;

using Lanes = Batch<float>;
using Vec = Vectors<float>;

inline Vec operator+(const Vec& u, const Vec& v) { return {u.x + v.x, u.y + v.y, u.z + v.z}; }
inline Vec operator-(const Vec& u, const Vec& v) { return {u.x - v.x, u.y - v.y, u.z - v.z}; }
inline Vec operator*(float k, const Vec& v) {
  const Lanes all(k);
  return {all * v.x, all * v.y, all * v.z};
}

/// The shape, its unit normals (0, +-roof_y, roof_z) and (+-end_x, 0, end_z), and its unit hips
/// (+-hip_x, +-hip_y, +-hip_z).
struct Pinacoid {
  float a, b, c, e;
  float roof_y, roof_z, end_x, end_z, hip_x, hip_y, hip_z;
};

inline Pinacoid pinacoid_of(const PinacoidHalves& h) {
  const double s = h.a - h.c;
  const double roof = __builtin_sqrt(h.e * h.e + h.b * h.b);
  const double end = __builtin_sqrt(h.e * h.e + s * s);
  const double hip = __builtin_sqrt(s * s + h.b * h.b + h.e * h.e);
  const auto rounded = [](double value) { return static_cast<float>(value); };
  return {rounded(h.a),        rounded(h.b),        rounded(h.c),       rounded(h.e),
          rounded(h.e / roof), rounded(h.b / roof), rounded(h.e / end), rounded(s / end),
          rounded(s / hip),    rounded(h.b / hip),  rounded(h.e / hip)};
}

/// Half width along n of any length.
inline Lanes half_width(const Pinacoid& p, const Vec& n) {
  const Lanes x = xsimd::abs(n.x), y = xsimd::abs(n.y), z = xsimd::abs(n.z);
  return xsimd::max(Lanes(p.a) * x + Lanes(p.b) * y, Lanes(p.c) * x + Lanes(p.e) * z);
}

/// A batch of pairs: b in the frame of a.
struct Pairs {
  Vec centre;
  Lanes scale_a, scale_b;
  Vec column[3];  ///< axes of b in the frame of a
  Vec row[3];     ///< axes of a in the frame of b
};

// ---- reading: f64 records, differences of centres in f64, all else in f32 ----

/// Grains of a block, component by component, as f32.
struct Grains {
  float dx[block_width], dy[block_width], dz[block_width];
  float scale_a[block_width], scale_b[block_width];
  float qa[4][block_width], qb[4][block_width];  ///< x, y, z, w
};

inline void round_quaternions(const Components<double>& q, float (&to)[4][block_width],
                              std::size_t lane) {
  store_rounded(q.x, to[0] + lane);
  store_rounded(q.y, to[1] + lane);
  store_rounded(q.z, to[2] + lane);
  store_rounded(q.w, to[3] + lane);
}

inline void read_grains(const PinacoidBlock& block, const Record<double>* centres,
                        const Record<double>* orientations, double period_x, double period_y,
                        Grains& grains) {
  constexpr std::size_t stride = sizeof(Record<double>);
  const double inverse_x = inverse_of(period_x), inverse_y = inverse_of(period_y);
  for (std::size_t lane = 0; lane < block_width; lane += batch_width<double>) {
    const std::uint32_t *i = block.offset_a + lane, *j = block.offset_b + lane;
    const Components<double> a = load_records<stride>(centres, i),
                             b = load_records<stride>(centres, j);
    store_rounded(nearest_image(b.x - a.x, period_x, inverse_x), grains.dx + lane);
    store_rounded(nearest_image(b.y - a.y, period_y, inverse_y), grains.dy + lane);
    store_rounded(b.z - a.z, grains.dz + lane);
    store_rounded(a.w, grains.scale_a + lane);
    store_rounded(b.w, grains.scale_b + lane);
    round_quaternions(load_records<stride>(orientations, i), grains.qa, lane);
    round_quaternions(load_records<stride>(orientations, j), grains.qb, lane);
  }
}

struct Quaternion {
  Lanes x, y, z, w;
};

inline Quaternion quaternion(const float (&q)[4][block_width], std::size_t lane) {
  return {load(q[0] + lane), load(q[1] + lane), load(q[2] + lane), load(q[3] + lane)};
}

/// conj(p) q.
inline Quaternion back_and_forth(const Quaternion& p, const Quaternion& q) {
  return {
      p.w * q.x - p.x * q.w - p.y * q.z + p.z * q.y, p.w * q.y + p.x * q.z - p.y * q.w - p.z * q.x,
      p.w * q.z - p.x * q.y + p.y * q.x - p.z * q.w, p.w * q.w + p.x * q.x + p.y * q.y + p.z * q.z};
}

/// Columns of the rotation matrix of q.
inline void columns_of(const Quaternion& q, Vec (&column)[3]) {
  const Lanes one(1.0F), x2 = q.x + q.x, y2 = q.y + q.y, z2 = q.z + q.z;
  const Lanes xx = q.x * x2, yy = q.y * y2, zz = q.z * z2;
  const Lanes xy = q.x * y2, xz = q.x * z2, yz = q.y * z2;
  const Lanes wx = q.w * x2, wy = q.w * y2, wz = q.w * z2;
  column[0] = {one - (yy + zz), xy + wz, xz - wy};
  column[1] = {xy - wz, one - (xx + zz), yz + wx};
  column[2] = {xz + wy, yz - wx, one - (xx + yy)};
}

inline Pairs pairs_of(const Grains& grains, std::size_t lane) {
  const Quaternion qa = quaternion(grains.qa, lane);
  Vec axis_a[3];
  columns_of(qa, axis_a);
  const Vec d{load(grains.dx + lane), load(grains.dy + lane), load(grains.dz + lane)};
  Pairs pairs{};
  pairs.centre = {dot(axis_a[0], d), dot(axis_a[1], d), dot(axis_a[2], d)};
  pairs.scale_a = load(grains.scale_a + lane);
  pairs.scale_b = load(grains.scale_b + lane);
  columns_of(back_and_forth(qa, quaternion(grains.qb, lane)), pairs.column);
  const Vec(&c)[3] = pairs.column;
  pairs.row[0] = {c[0].x, c[1].x, c[2].x};
  pairs.row[1] = {c[0].y, c[1].y, c[2].y};
  pairs.row[2] = {c[0].z, c[1].z, c[2].z};
  return pairs;
}

// ---- face axes ----

/// The best axis so far; numbers are small integers kept as f32.
struct BestFace {
  Lanes separation, axis;

  void take(const Lanes& other, int number) {
    axis = xsimd::select(other > separation, Lanes(static_cast<float>(number)), axis);
    separation = xsimd::max(separation, other);
  }
};

/// The four face normals, given the images of the axes they are seen by.
struct Normals {
  Vec n[4];
};

inline Normals normals(const Pinacoid& p, const Vec (&axis)[3]) {
  const Vec roof_y = p.roof_y * axis[1], roof_z = p.roof_z * axis[2];
  const Vec end_x = p.end_x * axis[0], end_z = p.end_z * axis[2];
  return {{roof_z + roof_y, roof_z - roof_y, end_z + end_x, end_z - end_x}};
}

/// A shape and the scales of its grains.
struct Scaled {
  const Pinacoid& shape;
  const Lanes& scale;
};

/// Tests the normals of one grain: `along` is n . c, `seen` the normals in the frame of the other.
inline void test_faces(const Scaled& own, const Scaled& other, const Lanes (&along)[4],
                       const Normals& seen, int first, BestFace& best) {
  const Pinacoid& p = own.shape;
  const Lanes roof = own.scale * Lanes(p.roof_y * p.b), end = own.scale * Lanes(p.end_x * p.a);
  for (int k = 0; k < 4; ++k) {
    const Lanes width = (k < 2 ? roof : end) + other.scale * half_width(other.shape, seen.n[k]);
    best.take(xsimd::abs(along[k]) - width, first + k);
  }
}

inline BestFace best_face(const Scaled& a, const Scaled& b, const Pairs& pairs) {
  const Pinacoid& p = a.shape;
  const Vec& c = pairs.centre;
  const Lanes ry = Lanes(p.roof_y) * c.y, rz = Lanes(p.roof_z) * c.z;
  const Lanes ex = Lanes(p.end_x) * c.x, ez = Lanes(p.end_z) * c.z;
  const Lanes along_a[4] = {rz + ry, rz - ry, ez + ex, ez - ex};
  BestFace best{Lanes(-1e30F), Lanes(0.0F)};
  test_faces(a, b, along_a, normals(p, pairs.row), 0, best);
  const Normals of_b = normals(b.shape, pairs.column);
  const Lanes along_b[4] = {dot(of_b.n[0], c), dot(of_b.n[1], c), dot(of_b.n[2], c),
                            dot(of_b.n[3], c)};
  test_faces(b, a, along_b, of_b, 4, best);
  return best;
}

// ---- edge axes: directions 0 along x, 1 .. 4 the hips, 5 along y ----

/// A direction of one grain and its products with the components of a hip of the other.
struct Direction {
  Vec v;
  Lanes xy, xz;  ///< hip_x times y, z
  Lanes yx, yz;  ///< hip_y times x, z
  Lanes zx, zy;  ///< hip_z times x, y
};

inline Direction direction(const Pinacoid& other, const Vec& v) {
  const Lanes x(other.hip_x), y(other.hip_y), z(other.hip_z);
  return {v, x * v.y, x * v.z, y * v.x, y * v.z, z * v.x, z * v.y};
}

/// The six directions of one grain as the other sees them.
inline void directions(const Pinacoid& p, const Pinacoid& other, const Vec (&axis)[3],
                       Direction (&seen)[6]) {
  const Vec x = p.hip_x * axis[0], y = p.hip_y * axis[1], z = p.hip_z * axis[2];
  seen[0] = direction(other, axis[0]);
  seen[1] = direction(other, x - y + z);
  seen[2] = direction(other, x + y - z);
  seen[3] = direction(other, y + z - x);
  seen[4] = direction(other, x + y + z);  // its sign does not matter
  seen[5] = direction(other, axis[1]);
}

/// Cross product of an own direction and one of the other grain.
template <int own>
inline Vec cross(const Direction& t) {
  const Lanes zero(0.0F);
  if constexpr (own == 0) return {zero, zero - t.v.z, t.v.y};
  if constexpr (own == 5) return {t.v.z, zero, zero - t.v.x};
  if constexpr (own == 1) return {zero - t.yz - t.zy, t.zx - t.xz, t.xy + t.yx};
  if constexpr (own == 2) return {t.yz + t.zy, zero - t.zx - t.xz, t.xy - t.yx};
  if constexpr (own == 3) return {t.yz - t.zy, t.zx + t.xz, zero - t.xy - t.yx};
  if constexpr (own == 4) return {t.yz - t.zy, t.zx - t.xz, t.xy - t.yx};
}

/// Best edge axis so far: separation |separation| / length2 decides.
struct BestEdges {
  Lanes signed_square, length2, axis;
  Lanes least_length2;  ///< of all axes

  void take(const Lanes& separation, const Lanes& length_2, int number) {
    const Lanes square = separation * xsimd::abs(separation);
    const auto better = (square * length2 > signed_square * length_2) &
                        (length_2 > Lanes(grainsweep::parallel_edges_sine2));
    signed_square = xsimd::select(better, square, signed_square);
    length2 = xsimd::select(better, length_2, length2);
    axis = xsimd::select(better, Lanes(static_cast<float>(number)), axis);
    least_length2 = xsimd::min(least_length2, length_2);
  }
};

template <int i, int j>
inline void test_edges(const Scaled& a, const Scaled& b, const Pairs& pairs, const Direction& of_b,
                       const Direction& of_a, BestEdges& best) {
  const Vec n = cross<i>(of_b), m = cross<j>(of_a);
  const Lanes width = a.scale * half_width(a.shape, n) + b.scale * half_width(b.shape, m);
  best.take(xsimd::abs(dot(n, pairs.centre)) - width, dot(n, n), 8 + 6 * i + j);
}

/// All edges of a against direction j of b.
template <int j>
inline void test_all_edges(const Scaled& a, const Scaled& b, const Pairs& pairs,
                           const Direction& of_b, const Direction (&of_a)[6], BestEdges& best) {
  test_edges<0, j>(a, b, pairs, of_b, of_a[0], best);
  test_edges<1, j>(a, b, pairs, of_b, of_a[1], best);
  test_edges<2, j>(a, b, pairs, of_b, of_a[2], best);
  test_edges<3, j>(a, b, pairs, of_b, of_a[3], best);
  test_edges<4, j>(a, b, pairs, of_b, of_a[4], best);
  test_edges<5, j>(a, b, pairs, of_b, of_a[5], best);
}

inline BestEdges best_edges(const Scaled& a, const Scaled& b, const Pairs& pairs) {
  Direction of_a[6], of_b[6];
  directions(a.shape, b.shape, pairs.row, of_a);
  directions(b.shape, a.shape, pairs.column, of_b);
  BestEdges best{Lanes(-1e30F), Lanes(1.0F), Lanes(8.0F), Lanes(1.0F)};
  test_all_edges<0>(a, b, pairs, of_b[0], of_a, best);
  test_all_edges<1>(a, b, pairs, of_b[1], of_a, best);
  test_all_edges<2>(a, b, pairs, of_b[2], of_a, best);
  test_all_edges<3>(a, b, pairs, of_b[3], of_a, best);
  test_all_edges<4>(a, b, pairs, of_b[4], of_a, best);
  test_all_edges<5>(a, b, pairs, of_b[5], of_a, best);
  return best;
}

inline void store_numbers(const Lanes& numbers, std::int32_t* to) {
  float lane[batch_width<float>];
  numbers.store_unaligned(lane);
  for (std::size_t k = 0; k < batch_width<float>; ++k) {
    to[k] = static_cast<std::int32_t>(lane[k]);
  }
}

inline void test_pairs(const Pinacoid& shape_a, const Pinacoid& shape_b, const Grains& grains,
                       std::size_t lane, PinacoidBlock& block) {
  const Pairs pairs = pairs_of(grains, lane);
  const Scaled a{shape_a, pairs.scale_a}, b{shape_b, pairs.scale_b};
  const BestFace face = best_face(a, b, pairs);
  const BestEdges edges = best_edges(a, b, pairs);
  const Lanes zero(0.0F), size = xsimd::sqrt(xsimd::abs(edges.signed_square) / edges.length2);
  face.separation.store_unaligned(block.face_separation + lane);
  xsimd::select(edges.signed_square < zero, zero - size, size)
      .store_unaligned(block.edge_separation + lane);
  store_numbers(face.axis, block.face_axis + lane);
  store_numbers(edges.axis, block.edge_axis + lane);
  const auto parallel = edges.least_length2 <= Lanes(grainsweep::parallel_edges_sine2);
  store_numbers(xsimd::select(parallel, Lanes(1.0F), zero), block.edges_parallel + lane);
}

}  // namespace

namespace grainsweep::GRAINSWEEP_ISA_NAME {

void pinacoid_axes(const PinacoidHalves& shape_a, const PinacoidHalves& shape_b,
                   PinacoidBlock* pairs, std::size_t blocks, const Record<double>* centres,
                   const Record<double>* orientations, double period_x, double period_y) {
  const Pinacoid a = pinacoid_of(shape_a), b = pinacoid_of(shape_b);
  Grains grains{};
  for (std::size_t block = 0; block < blocks; ++block) {
    read_grains(pairs[block], centres, orientations, period_x, period_y, grains);
    for (std::size_t lane = 0; lane < block_width; lane += batch_width<float>) {
      test_pairs(a, b, grains, lane, pairs[block]);
    }
  }
}

}  // namespace grainsweep::GRAINSWEEP_ISA_NAME
