// Whole-record loads and stores, and mask bits, for AVX-512 (f, cd, dq, bw, vl).
// One of three files with the same names.
#pragma once

#include <xsimd/xsimd.hpp>

#include "kernels/arch/places.hpp"

namespace {

using Arch = xsimd::avx512bw;

/// Four numbers per lane, one batch per component.
template <class Real>
struct Components {
  xsimd::batch<Real, Arch> x, y, z, w;
};

/// Records k, k + 4, k + 8, k + 12, one in each quarter: lanes stay in order through the
/// transposition.
inline __m512 load_four(const Record<float>* base, const std::uint32_t* offset, int k) {
  __m512 r = _mm512_castps128_ps512(_mm_load_ps(&at(base, offset[k]).x));
  r = _mm512_insertf32x4(r, _mm_load_ps(&at(base, offset[k + 4]).x), 1);
  r = _mm512_insertf32x4(r, _mm_load_ps(&at(base, offset[k + 8]).x), 2);
  return _mm512_insertf32x4(r, _mm_load_ps(&at(base, offset[k + 12]).x), 3);
}

/// Transposes the 4 x 4 numbers in each quarter.
inline void transpose(__m512& r0, __m512& r1, __m512& r2, __m512& r3) {
  const __m512 xy01 = _mm512_unpacklo_ps(r0, r1), zw01 = _mm512_unpackhi_ps(r0, r1);
  const __m512 xy23 = _mm512_unpacklo_ps(r2, r3), zw23 = _mm512_unpackhi_ps(r2, r3);
  r0 = _mm512_shuffle_ps(xy01, xy23, 0x44);
  r1 = _mm512_shuffle_ps(xy01, xy23, 0xEE);
  r2 = _mm512_shuffle_ps(zw01, zw23, 0x44);
  r3 = _mm512_shuffle_ps(zw01, zw23, 0xEE);
}

inline Components<float> load_records(const Record<float>* base, const std::uint32_t* offset) {
  __m512 r0 = load_four(base, offset, 0), r1 = load_four(base, offset, 1);
  __m512 r2 = load_four(base, offset, 2), r3 = load_four(base, offset, 3);
  transpose(r0, r1, r2, r3);
  return {r0, r1, r2, r3};
}

inline void store_four(Record<float>* base, const std::uint32_t* offset, int k, __m512 records) {
  _mm_store_ps(&at(base, offset[k]).x, _mm512_castps512_ps128(records));
  _mm_store_ps(&at(base, offset[k + 4]).x, _mm512_extractf32x4_ps(records, 1));
  _mm_store_ps(&at(base, offset[k + 8]).x, _mm512_extractf32x4_ps(records, 2));
  _mm_store_ps(&at(base, offset[k + 12]).x, _mm512_extractf32x4_ps(records, 3));
}

inline void store_records(Record<float>* base, const std::uint32_t* offset,
                          const Components<float>& c) {
  __m512 r0 = c.x, r1 = c.y, r2 = c.z, r3 = c.w;
  transpose(r0, r1, r2, r3);
  store_four(base, offset, 0, r0);
  store_four(base, offset, 1, r1);
  store_four(base, offset, 2, r2);
  store_four(base, offset, 3, r3);
}

/// Calls put(lane, record) for the records of quarter `quarter` of four transposed batches. Always
/// inlined: a call in a sweep costs more than what it does.
template <int quarter, class Put>
[[gnu::always_inline]] inline void put_quarter(const Put& put, __m512 r0, __m512 r1, __m512 r2,
                                               __m512 r3) {
  put(4 * quarter, _mm512_extractf32x4_ps(r0, quarter));
  put(4 * quarter + 1, _mm512_extractf32x4_ps(r1, quarter));
  put(4 * quarter + 2, _mm512_extractf32x4_ps(r2, quarter));
  put(4 * quarter + 3, _mm512_extractf32x4_ps(r3, quarter));
}

inline void push_records(Record<float>* base, const std::uint32_t* a, const std::uint32_t* b,
                         const Components<float>& c) {
  const auto put = [&](int k, __m128 push) { push_pair(at(base, a[k]), at(base, b[k]), push); };
  __m512 r0 = c.x, r1 = c.y, r2 = c.z, r3 = c.w;
  transpose(r0, r1, r2, r3);
  put_quarter<0>(put, r0, r1, r2, r3);
  put_quarter<1>(put, r0, r1, r2, r3);
  put_quarter<2>(put, r0, r1, r2, r3);
  put_quarter<3>(put, r0, r1, r2, r3);
}

/// Records i and j, one in each half.
template <std::size_t stride>
inline __m512d load_two(const Record<double>* base, std::uint32_t i, std::uint32_t j) {
  return _mm512_insertf64x4(_mm512_castpd256_pd512(_mm256_load_pd(&at<stride>(base, i).x)),
                            _mm256_load_pd(&at<stride>(base, j).x), 1);
}

/// Eight records as (0 | 2), (1 | 3), (4 | 6), (5 | 7): after the pairwise unpacking one shuffle of
/// 128-bit chunks puts the lanes in order.
template <std::size_t stride = sizeof(Record<double>)>
inline Components<double> load_records(const Record<double>* base, const std::uint32_t* offset) {
  const __m512d r02 = load_two<stride>(base, offset[0], offset[2]),
                r13 = load_two<stride>(base, offset[1], offset[3]);
  const __m512d r46 = load_two<stride>(base, offset[4], offset[6]),
                r57 = load_two<stride>(base, offset[5], offset[7]);
  const __m512d xz0 = _mm512_unpacklo_pd(r02, r13), yw0 = _mm512_unpackhi_pd(r02, r13);
  const __m512d xz4 = _mm512_unpacklo_pd(r46, r57), yw4 = _mm512_unpackhi_pd(r46, r57);
  return {_mm512_shuffle_f64x2(xz0, xz4, 0x88), _mm512_shuffle_f64x2(yw0, yw4, 0x88),
          _mm512_shuffle_f64x2(xz0, xz4, 0xDD), _mm512_shuffle_f64x2(yw0, yw4, 0xDD)};
}

/// The eight records of `c`, in order.
struct EightRecords {
  __m256d record[8];
};

inline EightRecords records_of(const Components<double>& c) {
  const __m512d xy_even = _mm512_unpacklo_pd(c.x, c.y), xy_odd = _mm512_unpackhi_pd(c.x, c.y);
  const __m512d zw_even = _mm512_unpacklo_pd(c.z, c.w), zw_odd = _mm512_unpackhi_pd(c.z, c.w);
  const auto join = [](__m128d low, __m128d high) {
    return _mm256_insertf128_pd(_mm256_castpd128_pd256(low), high, 1);
  };
  return {{join(_mm512_extractf64x2_pd(xy_even, 0), _mm512_extractf64x2_pd(zw_even, 0)),
           join(_mm512_extractf64x2_pd(xy_odd, 0), _mm512_extractf64x2_pd(zw_odd, 0)),
           join(_mm512_extractf64x2_pd(xy_even, 1), _mm512_extractf64x2_pd(zw_even, 1)),
           join(_mm512_extractf64x2_pd(xy_odd, 1), _mm512_extractf64x2_pd(zw_odd, 1)),
           join(_mm512_extractf64x2_pd(xy_even, 2), _mm512_extractf64x2_pd(zw_even, 2)),
           join(_mm512_extractf64x2_pd(xy_odd, 2), _mm512_extractf64x2_pd(zw_odd, 2)),
           join(_mm512_extractf64x2_pd(xy_even, 3), _mm512_extractf64x2_pd(zw_even, 3)),
           join(_mm512_extractf64x2_pd(xy_odd, 3), _mm512_extractf64x2_pd(zw_odd, 3))}};
}

inline void store_records(Record<double>* base, const std::uint32_t* offset,
                          const Components<double>& c) {
  const EightRecords r = records_of(c);
  for (int k = 0; k < 8; ++k) {
    _mm256_store_pd(&at(base, offset[k]).x, r.record[k]);
  }
}

inline void push_records(Record<double>* base, const std::uint32_t* a, const std::uint32_t* b,
                         const Components<double>& c) {
  const EightRecords r = records_of(c);
  for (int k = 0; k < 8; ++k) {
    double* from = &at(base, a[k]).x;
    double* to = &at(base, b[k]).x;
    _mm256_store_pd(from, _mm256_sub_pd(_mm256_load_pd(from), r.record[k]));
    _mm256_store_pd(to, _mm256_add_pd(_mm256_load_pd(to), r.record[k]));
  }
}

/// Both records of grains k and k + 4, one grain in each half.
inline __m512 load_two_grains(const Record<float>* base, const std::uint32_t* offset, int k) {
  const __m512 grain = _mm512_castps256_ps512(_mm256_loadu_ps(&at(base, offset[k]).x));
  return _mm512_insertf32x8(grain, _mm256_loadu_ps(&at(base, offset[k + 4]).x), 1);
}

/// A grain's two records by one load. Transposed, a batch of eight grains has their first records
/// in its even quarters and their second records in its odd ones.
inline TwoRecords<Components<float>> load_both(const Record<float>* base,
                                               const std::uint32_t* offset) {
  __m512 r0 = load_two_grains(base, offset, 0), r1 = load_two_grains(base, offset, 1);
  __m512 r2 = load_two_grains(base, offset, 2), r3 = load_two_grains(base, offset, 3);
  __m512 s0 = load_two_grains(base, offset, 8), s1 = load_two_grains(base, offset, 9);
  __m512 s2 = load_two_grains(base, offset, 10), s3 = load_two_grains(base, offset, 11);
  transpose(r0, r1, r2, r3);
  transpose(s0, s1, s2, s3);
  return {{_mm512_shuffle_f32x4(r0, s0, 0x88), _mm512_shuffle_f32x4(r1, s1, 0x88),
           _mm512_shuffle_f32x4(r2, s2, 0x88), _mm512_shuffle_f32x4(r3, s3, 0x88)},
          {_mm512_shuffle_f32x4(r0, s0, 0xDD), _mm512_shuffle_f32x4(r1, s1, 0xDD),
           _mm512_shuffle_f32x4(r2, s2, 0xDD), _mm512_shuffle_f32x4(r3, s3, 0xDD)}};
}

/// Adds a grain's two records.
inline void add_to_two_records(Record<float>& to, __m256 records) {
  _mm256_storeu_ps(&to.x, _mm256_add_ps(_mm256_loadu_ps(&to.x), records));
}

/// Adds the records of lanes 0 .. 7, or of 8 .. 15: each component's quarters of first and second
/// records in turn.
inline void add_eight(Record<float>* base, const std::uint32_t* offset, __m512 r0, __m512 r1,
                      __m512 r2, __m512 r3) {
  transpose(r0, r1, r2, r3);
  add_to_two_records(at(base, offset[0]), _mm512_castps512_ps256(r0));
  add_to_two_records(at(base, offset[1]), _mm512_castps512_ps256(r1));
  add_to_two_records(at(base, offset[2]), _mm512_castps512_ps256(r2));
  add_to_two_records(at(base, offset[3]), _mm512_castps512_ps256(r3));
  add_to_two_records(at(base, offset[4]), _mm512_extractf32x8_ps(r0, 1));
  add_to_two_records(at(base, offset[5]), _mm512_extractf32x8_ps(r1, 1));
  add_to_two_records(at(base, offset[6]), _mm512_extractf32x8_ps(r2, 1));
  add_to_two_records(at(base, offset[7]), _mm512_extractf32x8_ps(r3, 1));
}

/// Adds both records of each grain by one store; lanes may share a grain.
inline void add_both(Record<float>* base, const std::uint32_t* offset,
                     const TwoRecords<Components<float>>& g) {
  const __m512i low = _mm512_setr_epi32(0, 1, 2, 3, 16, 17, 18, 19, 4, 5, 6, 7, 20, 21, 22, 23);
  const __m512i high = _mm512_add_epi32(low, _mm512_set1_epi32(8));
  const auto in_turn = [](const __m512i& which, __m512 first, __m512 second) {
    return _mm512_permutex2var_ps(first, which, second);
  };
  add_eight(base, offset, in_turn(low, g.first.x, g.second.x), in_turn(low, g.first.y, g.second.y),
            in_turn(low, g.first.z, g.second.z), in_turn(low, g.first.w, g.second.w));
  add_eight(base, offset + 8, in_turn(high, g.first.x, g.second.x),
            in_turn(high, g.first.y, g.second.y), in_turn(high, g.first.z, g.second.z),
            in_turn(high, g.first.w, g.second.w));
}

inline void add_to(Record<double>& to, __m256d record) {
  _mm256_store_pd(&to.x, _mm256_add_pd(_mm256_load_pd(&to.x), record));
}

/// Adds each record of `c` to its place; lanes may share one.
inline void add_records(Record<double>* base, const std::uint32_t* offset,
                        const Components<double>& c) {
  const EightRecords r = records_of(c);
  for (int k = 0; k < 8; ++k) {
    add_to(at(base, offset[k]), r.record[k]);
  }
}

/// Records that apply_to_records handles.
template <class Real>
inline constexpr std::size_t records_at_once = sizeof(__m512) / sizeof(Record<Real>);

/// u = free + inverse mass x accumulated impulse of so many records; the impulses are gone then.
inline void apply_to_records(const Record<float>* free, Record<float>* accumulated,
                             Record<float>* u) {
  const __m512 from = _mm512_loadu_ps(&free->x), push = _mm512_loadu_ps(&accumulated->x);
  const __m512 inverse_mass = _mm512_permute_ps(from, 0xFF);
  _mm512_storeu_ps(&u->x, _mm512_add_ps(from, _mm512_mul_ps(inverse_mass, push)));
  _mm512_storeu_ps(&accumulated->x, _mm512_setzero_ps());
}

inline void apply_to_records(const Record<double>* free, Record<double>* accumulated,
                             Record<double>* u) {
  const __m512d from = _mm512_loadu_pd(&free->x), push = _mm512_loadu_pd(&accumulated->x);
  const __m512d inverse_mass = _mm512_permutex_pd(from, 0xFF);
  _mm512_storeu_pd(&u->x, _mm512_add_pd(from, _mm512_mul_pd(inverse_mass, push)));
  _mm512_storeu_pd(&accumulated->x, _mm512_setzero_pd());
}

/// Bit k is lane k of the mask.
inline std::uint32_t bits_of(const xsimd::batch_bool<float, Arch>& mask) {
  return static_cast<std::uint32_t>(static_cast<__mmask16>(mask));
}
inline std::uint32_t bits_of(const xsimd::batch_bool<double, Arch>& mask) {
  return static_cast<std::uint32_t>(static_cast<__mmask8>(mask));
}

/// Writes the pairs of grain i with those of the others whose bit is set, in their order, the
/// smaller number first. What lies behind them, up to a batch of pairs, is overwritten.
inline void put_pairs(std::int32_t i, const std::int32_t* others, std::uint32_t lanes,
                      GrainPair* to) {
  const __m512i all = _mm512_loadu_si512(others), one = _mm512_set1_epi32(i);
  const __m512i j = _mm512_maskz_compress_epi32(static_cast<__mmask16>(lanes), all);
  const __m512i a = _mm512_min_epi32(one, j), b = _mm512_max_epi32(one, j);
  const __m512i low = _mm512_setr_epi32(0, 16, 1, 17, 2, 18, 3, 19, 4, 20, 5, 21, 6, 22, 7, 23);
  const __m512i high = _mm512_add_epi32(low, _mm512_set1_epi32(8));
  _mm512_storeu_si512(to, _mm512_permutex2var_epi32(a, low, b));
  _mm512_storeu_si512(to + 8, _mm512_permutex2var_epi32(a, high, b));
}

}  // namespace
