// Seeded numbers for test scenes, the same on every machine.
#pragma once

#include <cmath>
#include <cstdint>
#include <random>
#include <utility>
#include <vector>

namespace grainsweep::testing {

class Draw {
 public:
  explicit Draw(std::uint64_t seed) : generator_(seed) {}

  /// In [0, 1), in steps of 2^-53.
  double unit() { return static_cast<double>(generator_() >> 11) * 0x1p-53; }
  double uniform(double low, double high) { return low + (high - low) * unit(); }
  /// In 0 .. n - 1.
  std::size_t below(std::size_t n) {
    return static_cast<std::size_t>(unit() * static_cast<double>(n));
  }
  bool chance(double probability) { return unit() < probability; }

  template <class T>
  void shuffle(std::vector<T>& items) {
    for (std::size_t i = items.size(); i > 1; --i) {
      std::swap(items[i - 1], items[below(i)]);
    }
  }

  struct Direction {
    double x, y, z;
  };
  /// Uniform on the unit sphere.
  Direction direction() {
    const double z = uniform(-1.0, 1.0), angle = uniform(0.0, 2.0 * 3.14159265358979323846);
    const double across = std::sqrt(1.0 - z * z);
    return {across * std::cos(angle), across * std::sin(angle), z};
  }

 private:
  std::mt19937_64 generator_;
};

}  // namespace grainsweep::testing
