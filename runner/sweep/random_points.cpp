#include "runner/sweep/random_points.hpp"

#include <algorithm>
#include <cmath>

#include <Random123/philox.h>

#include "engine/portable.hpp"
#include "runner/sweep/identity.hpp"
#include "runner/sweep/values.hpp"

namespace grainsweep {
namespace {

constexpr std::uint64_t sweep_purpose = 0x7377656570647277;  // apart from the engine's numbers

double number_between(const RandomPath& random, double u) {
  double value = random.low + u * (random.high - random.low);
  if (random.distribution == Distribution::log_uniform) {
    value = random.low * portable::exp(u * portable::log(random.high / random.low));
  }
  return std::clamp(nine_digits(value), random.low, random.high);
}

/// Every whole number of a uniform range is equally likely, also the bounds.
std::int64_t whole_between(const RandomPath& random, double u) {
  if (random.distribution == Distribution::log_uniform) {
    return static_cast<std::int64_t>(std::round(number_between(random, u)));
  }
  const double value = std::floor(random.low + u * (random.high - random.low + 1.0));
  return static_cast<std::int64_t>(std::min(value, random.high));
}

}  // namespace

double uniform_draw(const DrawKey& key, const std::string& path) {
  const r123::Philox4x64::ctr_type counter = {{key.block, key.point, fnv1a(path), 0}};
  const r123::Philox4x64::key_type philox_key = {{key.seed, sweep_purpose}};
  const std::uint64_t word = r123::Philox4x64()(counter, philox_key)[0];
  return static_cast<double>(word >> 11U) * 0x1p-53;
}

Assignments draw(const RandomPath& random, const DrawKey& key) {
  const double u = uniform_draw(key, random.path);
  if (random.distribution == Distribution::choice) {
    return random.choices[static_cast<std::size_t>(u * static_cast<double>(random.choices.size()))];
  }
  if (parameters()[random.parameter].kind == ValueKind::whole) {
    return {{random.parameter, whole_between(random, u), random.pointer}};
  }
  return {{random.parameter, number_between(random, u), random.pointer}};
}

}  // namespace grainsweep
