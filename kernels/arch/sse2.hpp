// Whole-record loads and stores, and mask bits, for SSE2. One of three files with the same names.
#pragma once

#include <xsimd/xsimd.hpp>

#include "kernels/kernels.hpp"

namespace {

using Arch = xsimd::sse2;

/// Four numbers per lane, one batch per component.
template <class Real>
struct Components {
  xsimd::batch<Real, Arch> x, y, z, w;
};

inline Components<float> load_records(const grainsweep::Record<float>* base,
                                      const std::int32_t* index) {
  __m128 r0 = _mm_load_ps(&base[index[0]].x);
  __m128 r1 = _mm_load_ps(&base[index[1]].x);
  __m128 r2 = _mm_load_ps(&base[index[2]].x);
  __m128 r3 = _mm_load_ps(&base[index[3]].x);
  _MM_TRANSPOSE4_PS(r0, r1, r2, r3);
  return {r0, r1, r2, r3};
}

inline void store_records(grainsweep::Record<float>* base, const std::int32_t* index,
                          const Components<float>& c) {
  __m128 r0 = c.x, r1 = c.y, r2 = c.z, r3 = c.w;
  _MM_TRANSPOSE4_PS(r0, r1, r2, r3);
  _mm_store_ps(&base[index[0]].x, r0);
  _mm_store_ps(&base[index[1]].x, r1);
  _mm_store_ps(&base[index[2]].x, r2);
  _mm_store_ps(&base[index[3]].x, r3);
}

inline void add_record(grainsweep::Record<float>& record, __m128 increment) {
  _mm_store_ps(&record.x, _mm_add_ps(_mm_load_ps(&record.x), increment));
}

inline void add_to_records(grainsweep::Record<float>* base, const std::int32_t* index,
                           const Components<float>& c) {
  __m128 r0 = c.x, r1 = c.y, r2 = c.z, r3 = c.w;
  _MM_TRANSPOSE4_PS(r0, r1, r2, r3);
  add_record(base[index[0]], r0);
  add_record(base[index[1]], r1);
  add_record(base[index[2]], r2);
  add_record(base[index[3]], r3);
}

inline Components<double> load_records(const grainsweep::Record<double>* base,
                                       const std::int32_t* index) {
  const double* r0 = &base[index[0]].x;
  const double* r1 = &base[index[1]].x;
  const __m128d xy0 = _mm_load_pd(r0), zw0 = _mm_load_pd(r0 + 2);
  const __m128d xy1 = _mm_load_pd(r1), zw1 = _mm_load_pd(r1 + 2);
  return {_mm_unpacklo_pd(xy0, xy1), _mm_unpackhi_pd(xy0, xy1), _mm_unpacklo_pd(zw0, zw1),
          _mm_unpackhi_pd(zw0, zw1)};
}

inline void store_records(grainsweep::Record<double>* base, const std::int32_t* index,
                          const Components<double>& c) {
  double* r0 = &base[index[0]].x;
  double* r1 = &base[index[1]].x;
  _mm_store_pd(r0, _mm_unpacklo_pd(c.x, c.y));
  _mm_store_pd(r0 + 2, _mm_unpacklo_pd(c.z, c.w));
  _mm_store_pd(r1, _mm_unpackhi_pd(c.x, c.y));
  _mm_store_pd(r1 + 2, _mm_unpackhi_pd(c.z, c.w));
}

inline void add_record(grainsweep::Record<double>& record, __m128d xy, __m128d zw) {
  double* r = &record.x;
  _mm_store_pd(r, _mm_add_pd(_mm_load_pd(r), xy));
  _mm_store_pd(r + 2, _mm_add_pd(_mm_load_pd(r + 2), zw));
}

inline void add_to_records(grainsweep::Record<double>* base, const std::int32_t* index,
                           const Components<double>& c) {
  add_record(base[index[0]], _mm_unpacklo_pd(c.x, c.y), _mm_unpacklo_pd(c.z, c.w));
  add_record(base[index[1]], _mm_unpackhi_pd(c.x, c.y), _mm_unpackhi_pd(c.z, c.w));
}

/// Bit k is lane k of the mask.
inline std::uint32_t bits_of(const xsimd::batch_bool<float, Arch>& mask) {
  return static_cast<std::uint32_t>(_mm_movemask_ps(mask));
}

}  // namespace
