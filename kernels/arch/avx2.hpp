// Whole-record loads and stores, and mask bits, for AVX2. One of three files with the same names.
#pragma once

#include <xsimd/xsimd.hpp>

#include "kernels/kernels.hpp"

namespace {

using Arch = xsimd::avx2;

/// Four numbers per lane, one batch per component.
template <class Real>
struct Components {
  xsimd::batch<Real, Arch> x, y, z, w;
};

/// Records k and k + 4, one in each half: lanes stay in order through the transposition.
inline __m256 load_two(const grainsweep::Record<float>* base, const std::int32_t* index, int k) {
  return _mm256_insertf128_ps(_mm256_castps128_ps256(_mm_load_ps(&base[index[k]].x)),
                              _mm_load_ps(&base[index[k + 4]].x), 1);
}

/// Transposes the 4 x 4 numbers in each half.
inline void transpose(__m256& r0, __m256& r1, __m256& r2, __m256& r3) {
  const __m256 xy01 = _mm256_unpacklo_ps(r0, r1), zw01 = _mm256_unpackhi_ps(r0, r1);
  const __m256 xy23 = _mm256_unpacklo_ps(r2, r3), zw23 = _mm256_unpackhi_ps(r2, r3);
  r0 = _mm256_shuffle_ps(xy01, xy23, 0x44);
  r1 = _mm256_shuffle_ps(xy01, xy23, 0xEE);
  r2 = _mm256_shuffle_ps(zw01, zw23, 0x44);
  r3 = _mm256_shuffle_ps(zw01, zw23, 0xEE);
}

inline Components<float> load_records(const grainsweep::Record<float>* base,
                                      const std::int32_t* index) {
  __m256 r0 = load_two(base, index, 0), r1 = load_two(base, index, 1);
  __m256 r2 = load_two(base, index, 2), r3 = load_two(base, index, 3);
  transpose(r0, r1, r2, r3);
  return {r0, r1, r2, r3};
}

inline void store_two(grainsweep::Record<float>* base, const std::int32_t* index, int k,
                      __m256 records) {
  _mm_store_ps(&base[index[k]].x, _mm256_castps256_ps128(records));
  _mm_store_ps(&base[index[k + 4]].x, _mm256_extractf128_ps(records, 1));
}

inline void store_records(grainsweep::Record<float>* base, const std::int32_t* index,
                          const Components<float>& c) {
  __m256 r0 = c.x, r1 = c.y, r2 = c.z, r3 = c.w;
  transpose(r0, r1, r2, r3);
  store_two(base, index, 0, r0);
  store_two(base, index, 1, r1);
  store_two(base, index, 2, r2);
  store_two(base, index, 3, r3);
}

inline void add_record(grainsweep::Record<float>& record, __m128 increment) {
  _mm_store_ps(&record.x, _mm_add_ps(_mm_load_ps(&record.x), increment));
}

inline void add_to_records(grainsweep::Record<float>* base, const std::int32_t* index,
                           const Components<float>& c) {
  __m256 r0 = c.x, r1 = c.y, r2 = c.z, r3 = c.w;
  transpose(r0, r1, r2, r3);
  add_record(base[index[0]], _mm256_castps256_ps128(r0));
  add_record(base[index[1]], _mm256_castps256_ps128(r1));
  add_record(base[index[2]], _mm256_castps256_ps128(r2));
  add_record(base[index[3]], _mm256_castps256_ps128(r3));
  add_record(base[index[4]], _mm256_extractf128_ps(r0, 1));
  add_record(base[index[5]], _mm256_extractf128_ps(r1, 1));
  add_record(base[index[6]], _mm256_extractf128_ps(r2, 1));
  add_record(base[index[7]], _mm256_extractf128_ps(r3, 1));
}

/// Transposes 4 x 4 numbers.
inline void transpose(__m256d& r0, __m256d& r1, __m256d& r2, __m256d& r3) {
  const __m256d xz01 = _mm256_unpacklo_pd(r0, r1), yw01 = _mm256_unpackhi_pd(r0, r1);
  const __m256d xz23 = _mm256_unpacklo_pd(r2, r3), yw23 = _mm256_unpackhi_pd(r2, r3);
  r0 = _mm256_permute2f128_pd(xz01, xz23, 0x20);
  r1 = _mm256_permute2f128_pd(yw01, yw23, 0x20);
  r2 = _mm256_permute2f128_pd(xz01, xz23, 0x31);
  r3 = _mm256_permute2f128_pd(yw01, yw23, 0x31);
}

inline Components<double> load_records(const grainsweep::Record<double>* base,
                                       const std::int32_t* index) {
  __m256d r0 = _mm256_load_pd(&base[index[0]].x), r1 = _mm256_load_pd(&base[index[1]].x);
  __m256d r2 = _mm256_load_pd(&base[index[2]].x), r3 = _mm256_load_pd(&base[index[3]].x);
  transpose(r0, r1, r2, r3);
  return {r0, r1, r2, r3};
}

inline void store_records(grainsweep::Record<double>* base, const std::int32_t* index,
                          const Components<double>& c) {
  __m256d r0 = c.x, r1 = c.y, r2 = c.z, r3 = c.w;
  transpose(r0, r1, r2, r3);
  _mm256_store_pd(&base[index[0]].x, r0);
  _mm256_store_pd(&base[index[1]].x, r1);
  _mm256_store_pd(&base[index[2]].x, r2);
  _mm256_store_pd(&base[index[3]].x, r3);
}

inline void add_record(grainsweep::Record<double>& record, __m256d increment) {
  _mm256_store_pd(&record.x, _mm256_add_pd(_mm256_load_pd(&record.x), increment));
}

inline void add_to_records(grainsweep::Record<double>* base, const std::int32_t* index,
                           const Components<double>& c) {
  __m256d r0 = c.x, r1 = c.y, r2 = c.z, r3 = c.w;
  transpose(r0, r1, r2, r3);
  add_record(base[index[0]], r0);
  add_record(base[index[1]], r1);
  add_record(base[index[2]], r2);
  add_record(base[index[3]], r3);
}

/// Bit k is lane k of the mask.
inline std::uint32_t bits_of(const xsimd::batch_bool<float, Arch>& mask) {
  return static_cast<std::uint32_t>(_mm256_movemask_ps(mask));
}

}  // namespace
