// Whole-record loads and stores, and mask bits, for SSE2. One of three files with the same names.
#pragma once

#include <xsimd/xsimd.hpp>

#include "kernels/arch/places.hpp"

namespace {

using Arch = xsimd::sse2;

/// Four numbers per lane, one batch per component.
template <class Real>
struct Components {
  xsimd::batch<Real, Arch> x, y, z, w;
};

inline Components<float> load_records(const Record<float>* base, const std::uint32_t* offset) {
  __m128 r0 = _mm_load_ps(&at(base, offset[0]).x);
  __m128 r1 = _mm_load_ps(&at(base, offset[1]).x);
  __m128 r2 = _mm_load_ps(&at(base, offset[2]).x);
  __m128 r3 = _mm_load_ps(&at(base, offset[3]).x);
  _MM_TRANSPOSE4_PS(r0, r1, r2, r3);
  return {r0, r1, r2, r3};
}

inline void store_records(Record<float>* base, const std::uint32_t* offset,
                          const Components<float>& c) {
  __m128 r0 = c.x, r1 = c.y, r2 = c.z, r3 = c.w;
  _MM_TRANSPOSE4_PS(r0, r1, r2, r3);
  _mm_store_ps(&at(base, offset[0]).x, r0);
  _mm_store_ps(&at(base, offset[1]).x, r1);
  _mm_store_ps(&at(base, offset[2]).x, r2);
  _mm_store_ps(&at(base, offset[3]).x, r3);
}

inline void push_records(Record<float>* base, const std::uint32_t* a, const std::uint32_t* b,
                         const Components<float>& c) {
  __m128 r0 = c.x, r1 = c.y, r2 = c.z, r3 = c.w;
  _MM_TRANSPOSE4_PS(r0, r1, r2, r3);
  push_pair(at(base, a[0]), at(base, b[0]), r0);
  push_pair(at(base, a[1]), at(base, b[1]), r1);
  push_pair(at(base, a[2]), at(base, b[2]), r2);
  push_pair(at(base, a[3]), at(base, b[3]), r3);
}

template <std::size_t stride = sizeof(Record<double>)>
inline Components<double> load_records(const Record<double>* base, const std::uint32_t* offset) {
  const double* r0 = &at<stride>(base, offset[0]).x;
  const double* r1 = &at<stride>(base, offset[1]).x;
  const __m128d xy0 = _mm_load_pd(r0), zw0 = _mm_load_pd(r0 + 2);
  const __m128d xy1 = _mm_load_pd(r1), zw1 = _mm_load_pd(r1 + 2);
  return {_mm_unpacklo_pd(xy0, xy1), _mm_unpackhi_pd(xy0, xy1), _mm_unpacklo_pd(zw0, zw1),
          _mm_unpackhi_pd(zw0, zw1)};
}

inline void store_records(Record<double>* base, const std::uint32_t* offset,
                          const Components<double>& c) {
  double* r0 = &at(base, offset[0]).x;
  double* r1 = &at(base, offset[1]).x;
  _mm_store_pd(r0, _mm_unpacklo_pd(c.x, c.y));
  _mm_store_pd(r0 + 2, _mm_unpacklo_pd(c.z, c.w));
  _mm_store_pd(r1, _mm_unpackhi_pd(c.x, c.y));
  _mm_store_pd(r1 + 2, _mm_unpackhi_pd(c.z, c.w));
}

inline void push_pair(Record<double>& a, Record<double>& b, __m128d xy, __m128d zw) {
  _mm_store_pd(&a.x, _mm_sub_pd(_mm_load_pd(&a.x), xy));
  _mm_store_pd(&a.z, _mm_sub_pd(_mm_load_pd(&a.z), zw));
  _mm_store_pd(&b.x, _mm_add_pd(_mm_load_pd(&b.x), xy));
  _mm_store_pd(&b.z, _mm_add_pd(_mm_load_pd(&b.z), zw));
}

inline void push_records(Record<double>* base, const std::uint32_t* a, const std::uint32_t* b,
                         const Components<double>& c) {
  push_pair(at(base, a[0]), at(base, b[0]), _mm_unpacklo_pd(c.x, c.y), _mm_unpacklo_pd(c.z, c.w));
  push_pair(at(base, a[1]), at(base, b[1]), _mm_unpackhi_pd(c.x, c.y), _mm_unpackhi_pd(c.z, c.w));
}

inline void add_to(Record<float>& to, __m128 record) {
  _mm_store_ps(&to.x, _mm_add_ps(_mm_load_ps(&to.x), record));
}

/// Adds each record of `c` to its place; lanes may share one.
inline void add_records(Record<float>* base, const std::uint32_t* offset,
                        const Components<float>& c) {
  __m128 r0 = c.x, r1 = c.y, r2 = c.z, r3 = c.w;
  _MM_TRANSPOSE4_PS(r0, r1, r2, r3);
  add_to(at(base, offset[0]), r0);
  add_to(at(base, offset[1]), r1);
  add_to(at(base, offset[2]), r2);
  add_to(at(base, offset[3]), r3);
}

inline void add_to(Record<double>& to, __m128d xy, __m128d zw) {
  _mm_store_pd(&to.x, _mm_add_pd(_mm_load_pd(&to.x), xy));
  _mm_store_pd(&to.z, _mm_add_pd(_mm_load_pd(&to.z), zw));
}

inline void add_records(Record<double>* base, const std::uint32_t* offset,
                        const Components<double>& c) {
  add_to(at(base, offset[0]), _mm_unpacklo_pd(c.x, c.y), _mm_unpacklo_pd(c.z, c.w));
  add_to(at(base, offset[1]), _mm_unpackhi_pd(c.x, c.y), _mm_unpackhi_pd(c.z, c.w));
}

/// Records that apply_to_records handles.
template <class Real>
inline constexpr std::size_t records_at_once = 1;

/// u = free + inverse mass x accumulated impulse of so many records; the impulses are gone then.
inline void apply_to_records(const Record<float>* free, Record<float>* accumulated,
                             Record<float>* u) {
  const __m128 from = _mm_load_ps(&free->x);
  const __m128 inverse_mass = _mm_shuffle_ps(from, from, 0xFF);
  _mm_store_ps(&u->x, _mm_add_ps(from, _mm_mul_ps(inverse_mass, _mm_load_ps(&accumulated->x))));
  _mm_store_ps(&accumulated->x, _mm_setzero_ps());
}

inline void apply_to_records(const Record<double>* free, Record<double>* accumulated,
                             Record<double>* u) {
  const __m128d inverse_mass = _mm_set1_pd(free->w), zero = _mm_setzero_pd();
  const __m128d xy = _mm_mul_pd(inverse_mass, _mm_load_pd(&accumulated->x));
  const __m128d zw = _mm_mul_pd(inverse_mass, _mm_load_pd(&accumulated->z));
  _mm_store_pd(&u->x, _mm_add_pd(_mm_load_pd(&free->x), xy));
  _mm_store_pd(&u->z, _mm_add_pd(_mm_load_pd(&free->z), zw));
  _mm_store_pd(&accumulated->x, zero);
  _mm_store_pd(&accumulated->z, zero);
}

/// Bit k is lane k of the mask.
inline std::uint32_t bits_of(const xsimd::batch_bool<float, Arch>& mask) {
  return static_cast<std::uint32_t>(_mm_movemask_ps(mask));
}
inline std::uint32_t bits_of(const xsimd::batch_bool<double, Arch>& mask) {
  return static_cast<std::uint32_t>(_mm_movemask_pd(mask));
}

/// Writes the pairs of grain i with those of the others whose bit is set, in their order, the
/// smaller number first.
inline void put_pairs(std::int32_t i, const std::int32_t* others, std::uint32_t lanes,
                      GrainPair* to) {
  for (; lanes != 0; lanes &= lanes - 1) {
    const std::int32_t j = others[__builtin_ctz(lanes)];
    *to++ = i < j ? GrainPair{i, j} : GrainPair{j, i};
  }
}

}  // namespace
