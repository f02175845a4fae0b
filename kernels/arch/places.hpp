// Records by the byte offsets that rows name them with: no multiplication on the way.
#pragma once

#include <cstddef>
#include <cstdint>
#include <xmmintrin.h>

#include "kernels/kernels.hpp"

namespace {

using grainsweep::GrainPair;
using grainsweep::Record;

/// Bytes to go for an offset that counts records of `stride` bytes.
template <class Real, std::size_t stride>
inline std::size_t bytes(std::uint32_t offset) {
  return offset * (sizeof(Record<Real>) / stride);
}

template <std::size_t stride, class Real>
inline const Record<Real>& at(const Record<Real>* base, std::uint32_t offset) {
  return *reinterpret_cast<const Record<Real>*>(reinterpret_cast<const std::byte*>(base) +
                                                bytes<Real, stride>(offset));
}

template <class Real>
inline const Record<Real>& at(const Record<Real>* base, std::uint32_t offset) {
  return at<sizeof(Record<Real>)>(base, offset);
}

template <class Real>
inline Record<Real>& at(Record<Real>* base, std::uint32_t offset) {
  return *reinterpret_cast<Record<Real>*>(reinterpret_cast<std::byte*>(base) + offset);
}

/// Takes `push` from record a and gives it to record b.
inline void push_pair(Record<float>& a, Record<float>& b, __m128 push) {
  _mm_store_ps(&a.x, _mm_sub_ps(_mm_load_ps(&a.x), push));
  _mm_store_ps(&b.x, _mm_add_ps(_mm_load_ps(&b.x), push));
}

/// Components of two records that follow each other in memory, as those of a polyhedron.
template <class Components>
struct TwoRecords {
  Components first, second;
};

}  // namespace
