// Whole-record loads and stores, and mask bits, for AVX2. One of three files with the same names.
#pragma once

#include <xsimd/xsimd.hpp>

#include "kernels/arch/places.hpp"

namespace {

using Arch = xsimd::avx2;

/// Four numbers per lane, one batch per component.
template <class Real>
struct Components {
  xsimd::batch<Real, Arch> x, y, z, w;
};

/// Records k and k + 4, one in each half: lanes stay in order through the transposition.
inline __m256 load_two(const Record<float>* base, const std::uint32_t* offset, int k) {
  return _mm256_insertf128_ps(_mm256_castps128_ps256(_mm_load_ps(&at(base, offset[k]).x)),
                              _mm_load_ps(&at(base, offset[k + 4]).x), 1);
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

inline Components<float> load_records(const Record<float>* base, const std::uint32_t* offset) {
  __m256 r0 = load_two(base, offset, 0), r1 = load_two(base, offset, 1);
  __m256 r2 = load_two(base, offset, 2), r3 = load_two(base, offset, 3);
  transpose(r0, r1, r2, r3);
  return {r0, r1, r2, r3};
}

inline void store_two(Record<float>* base, const std::uint32_t* offset, int k, __m256 records) {
  _mm_store_ps(&at(base, offset[k]).x, _mm256_castps256_ps128(records));
  _mm_store_ps(&at(base, offset[k + 4]).x, _mm256_extractf128_ps(records, 1));
}

inline void store_records(Record<float>* base, const std::uint32_t* offset,
                          const Components<float>& c) {
  __m256 r0 = c.x, r1 = c.y, r2 = c.z, r3 = c.w;
  transpose(r0, r1, r2, r3);
  store_two(base, offset, 0, r0);
  store_two(base, offset, 1, r1);
  store_two(base, offset, 2, r2);
  store_two(base, offset, 3, r3);
}

inline void push_records(Record<float>* base, const std::uint32_t* a, const std::uint32_t* b,
                         const Components<float>& c) {
  __m256 r0 = c.x, r1 = c.y, r2 = c.z, r3 = c.w;
  transpose(r0, r1, r2, r3);
  push_pair(at(base, a[0]), at(base, b[0]), _mm256_castps256_ps128(r0));
  push_pair(at(base, a[1]), at(base, b[1]), _mm256_castps256_ps128(r1));
  push_pair(at(base, a[2]), at(base, b[2]), _mm256_castps256_ps128(r2));
  push_pair(at(base, a[3]), at(base, b[3]), _mm256_castps256_ps128(r3));
  push_pair(at(base, a[4]), at(base, b[4]), _mm256_extractf128_ps(r0, 1));
  push_pair(at(base, a[5]), at(base, b[5]), _mm256_extractf128_ps(r1, 1));
  push_pair(at(base, a[6]), at(base, b[6]), _mm256_extractf128_ps(r2, 1));
  push_pair(at(base, a[7]), at(base, b[7]), _mm256_extractf128_ps(r3, 1));
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

template <std::size_t stride = sizeof(Record<double>)>
inline Components<double> load_records(const Record<double>* base, const std::uint32_t* offset) {
  __m256d r0 = _mm256_load_pd(&at<stride>(base, offset[0]).x),
          r1 = _mm256_load_pd(&at<stride>(base, offset[1]).x);
  __m256d r2 = _mm256_load_pd(&at<stride>(base, offset[2]).x),
          r3 = _mm256_load_pd(&at<stride>(base, offset[3]).x);
  transpose(r0, r1, r2, r3);
  return {r0, r1, r2, r3};
}

inline void store_records(Record<double>* base, const std::uint32_t* offset,
                          const Components<double>& c) {
  __m256d r0 = c.x, r1 = c.y, r2 = c.z, r3 = c.w;
  transpose(r0, r1, r2, r3);
  _mm256_store_pd(&at(base, offset[0]).x, r0);
  _mm256_store_pd(&at(base, offset[1]).x, r1);
  _mm256_store_pd(&at(base, offset[2]).x, r2);
  _mm256_store_pd(&at(base, offset[3]).x, r3);
}

inline void push_pair(Record<double>& a, Record<double>& b, __m256d push) {
  _mm256_store_pd(&a.x, _mm256_sub_pd(_mm256_load_pd(&a.x), push));
  _mm256_store_pd(&b.x, _mm256_add_pd(_mm256_load_pd(&b.x), push));
}

inline void push_records(Record<double>* base, const std::uint32_t* a, const std::uint32_t* b,
                         const Components<double>& c) {
  __m256d r0 = c.x, r1 = c.y, r2 = c.z, r3 = c.w;
  transpose(r0, r1, r2, r3);
  push_pair(at(base, a[0]), at(base, b[0]), r0);
  push_pair(at(base, a[1]), at(base, b[1]), r1);
  push_pair(at(base, a[2]), at(base, b[2]), r2);
  push_pair(at(base, a[3]), at(base, b[3]), r3);
}

inline __m256 load_two_records(const Record<float>* base, std::uint32_t offset) {
  return _mm256_loadu_ps(&at(base, offset).x);
}

/// Both records of each grain by one load.
inline TwoRecords<Components<float>> load_both(const Record<float>* base,
                                               const std::uint32_t* offset) {
  __m256 r0 = load_two_records(base, offset[0]), r1 = load_two_records(base, offset[1]);
  __m256 r2 = load_two_records(base, offset[2]), r3 = load_two_records(base, offset[3]);
  __m256 r4 = load_two_records(base, offset[4]), r5 = load_two_records(base, offset[5]);
  __m256 r6 = load_two_records(base, offset[6]), r7 = load_two_records(base, offset[7]);
  transpose(r0, r1, r2, r3);
  transpose(r4, r5, r6, r7);
  return {{_mm256_permute2f128_ps(r0, r4, 0x20), _mm256_permute2f128_ps(r1, r5, 0x20),
           _mm256_permute2f128_ps(r2, r6, 0x20), _mm256_permute2f128_ps(r3, r7, 0x20)},
          {_mm256_permute2f128_ps(r0, r4, 0x31), _mm256_permute2f128_ps(r1, r5, 0x31),
           _mm256_permute2f128_ps(r2, r6, 0x31), _mm256_permute2f128_ps(r3, r7, 0x31)}};
}

/// Adds a grain's two records.
inline void add_to_two_records(Record<float>& to, __m256 records) {
  _mm256_storeu_ps(&to.x, _mm256_add_ps(_mm256_loadu_ps(&to.x), records));
}

/// Adds both records of each grain by one store; lanes may share a grain.
inline void add_both(Record<float>* base, const std::uint32_t* offset,
                     const TwoRecords<Components<float>>& g) {
  __m256 r0 = g.first.x, r1 = g.first.y, r2 = g.first.z, r3 = g.first.w;
  __m256 s0 = g.second.x, s1 = g.second.y, s2 = g.second.z, s3 = g.second.w;
  transpose(r0, r1, r2, r3);
  transpose(s0, s1, s2, s3);
  add_to_two_records(at(base, offset[0]), _mm256_permute2f128_ps(r0, s0, 0x20));
  add_to_two_records(at(base, offset[1]), _mm256_permute2f128_ps(r1, s1, 0x20));
  add_to_two_records(at(base, offset[2]), _mm256_permute2f128_ps(r2, s2, 0x20));
  add_to_two_records(at(base, offset[3]), _mm256_permute2f128_ps(r3, s3, 0x20));
  add_to_two_records(at(base, offset[4]), _mm256_permute2f128_ps(r0, s0, 0x31));
  add_to_two_records(at(base, offset[5]), _mm256_permute2f128_ps(r1, s1, 0x31));
  add_to_two_records(at(base, offset[6]), _mm256_permute2f128_ps(r2, s2, 0x31));
  add_to_two_records(at(base, offset[7]), _mm256_permute2f128_ps(r3, s3, 0x31));
}

inline void add_to(Record<double>& to, __m256d record) {
  _mm256_store_pd(&to.x, _mm256_add_pd(_mm256_load_pd(&to.x), record));
}

/// Adds each record of `c` to its place; lanes may share one.
inline void add_records(Record<double>* base, const std::uint32_t* offset,
                        const Components<double>& c) {
  __m256d r0 = c.x, r1 = c.y, r2 = c.z, r3 = c.w;
  transpose(r0, r1, r2, r3);
  add_to(at(base, offset[0]), r0);
  add_to(at(base, offset[1]), r1);
  add_to(at(base, offset[2]), r2);
  add_to(at(base, offset[3]), r3);
}

/// Records that apply_to_records handles.
template <class Real>
inline constexpr std::size_t records_at_once = sizeof(__m256) / sizeof(Record<Real>);

/// u = free + inverse mass x accumulated impulse of so many records; the impulses are gone then.
inline void apply_to_records(const Record<float>* free, Record<float>* accumulated,
                             Record<float>* u) {
  const __m256 from = _mm256_loadu_ps(&free->x), push = _mm256_loadu_ps(&accumulated->x);
  const __m256 inverse_mass = _mm256_permute_ps(from, 0xFF);
  _mm256_storeu_ps(&u->x, _mm256_add_ps(from, _mm256_mul_ps(inverse_mass, push)));
  _mm256_storeu_ps(&accumulated->x, _mm256_setzero_ps());
}

inline void apply_to_records(const Record<double>* free, Record<double>* accumulated,
                             Record<double>* u) {
  const __m256d from = _mm256_load_pd(&free->x), inverse_mass = _mm256_set1_pd(free->w);
  const __m256d pushed = _mm256_mul_pd(inverse_mass, _mm256_load_pd(&accumulated->x));
  _mm256_store_pd(&u->x, _mm256_add_pd(from, pushed));
  _mm256_store_pd(&accumulated->x, _mm256_setzero_pd());
}

/// Bit k is lane k of the mask.
inline std::uint32_t bits_of(const xsimd::batch_bool<float, Arch>& mask) {
  return static_cast<std::uint32_t>(_mm256_movemask_ps(mask));
}
inline std::uint32_t bits_of(const xsimd::batch_bool<double, Arch>& mask) {
  return static_cast<std::uint32_t>(_mm256_movemask_pd(mask));
}

/// For each mask of eight lanes, the lanes that are set, in order.
struct SetLanes {
  std::uint8_t of_mask[256][8] = {};

  constexpr SetLanes() {
    for (unsigned mask = 0; mask < 256; ++mask) {
      unsigned count = 0;
      for (unsigned lane = 0; lane < 8; ++lane) {
        if ((mask >> lane & 1U) != 0) of_mask[mask][count++] = static_cast<std::uint8_t>(lane);
      }
    }
  }
};
inline constexpr SetLanes set_lanes;

/// Writes the pairs of grain i with those of the others whose bit is set, in their order, the
/// smaller number first. What lies behind them, up to a batch of pairs, is overwritten.
inline void put_pairs(std::int32_t i, const std::int32_t* others, std::uint32_t lanes,
                      GrainPair* to) {
  const auto* const chosen = reinterpret_cast<const __m128i*>(set_lanes.of_mask[lanes]);
  const __m256i all = _mm256_loadu_si256(reinterpret_cast<const __m256i*>(others));
  const __m256i j = _mm256_permutevar8x32_epi32(all, _mm256_cvtepu8_epi32(_mm_loadl_epi64(chosen)));
  const __m256i one = _mm256_set1_epi32(i);
  const __m256i a = _mm256_min_epi32(one, j), b = _mm256_max_epi32(one, j);
  const __m256i even = _mm256_unpacklo_epi32(a, b), odd = _mm256_unpackhi_epi32(a, b);
  auto* const out = reinterpret_cast<__m256i*>(to);
  _mm256_storeu_si256(out, _mm256_permute2x128_si256(even, odd, 0x20));
  _mm256_storeu_si256(out + 1, _mm256_permute2x128_si256(even, odd, 0x31));
}

}  // namespace
