#include "runner/store/curves.hpp"

#include <cstdint>

#include "runner/store/bytes.hpp"

namespace grainsweep {
namespace {

constexpr std::size_t head_size = 8 + 8;
constexpr std::size_t bin_size = 2 * sizeof(double) + 4 * sizeof(std::uint64_t);

void put_tally(std::string& bytes, std::int64_t count) {
  put(bytes, static_cast<std::uint64_t>(count));
}

std::int64_t take_tally(std::string_view& bytes) {
  return static_cast<std::int64_t>(take<std::uint64_t>(bytes));
}

/// The number of items that follow, of `item_size` bytes each.
std::uint64_t take_length(std::string_view& bytes, std::size_t item_size) {
  const auto length = take<std::uint64_t>(bytes);
  need(bytes, length, item_size);
  return length;
}

void put_profile(std::string& bytes, const Profile& profile) {
  put(bytes, profile.bin_width);
  put(bytes, static_cast<std::uint64_t>(profile.bins.size()));
  for (const ProfileBin& bin : profile.bins) {
    put(bytes, bin.large);
    put(bytes, bin.small);
    for (const std::int64_t count :
         {bin.large_grains, bin.small_grains, bin.neighbours, bin.walls}) {
      put_tally(bytes, count);
    }
  }
}

Profile take_profile(std::string_view& bytes) {
  need(bytes, 1, head_size);
  Profile profile{take_double(bytes), {}};
  profile.bins.resize(take_length(bytes, bin_size));
  for (ProfileBin& bin : profile.bins) {
    bin.large = take_double(bytes);
    bin.small = take_double(bytes);
    for (std::int64_t* count :
         {&bin.large_grains, &bin.small_grains, &bin.neighbours, &bin.walls}) {
      *count = take_tally(bytes);
    }
  }
  return profile;
}

void put_curve(std::string& bytes, const Curve& curve) {
  put(bytes, curve.bin_width);
  put(bytes, static_cast<std::uint64_t>(curve.values.size()));
  for (const double value : curve.values) put(bytes, value);
}

Curve take_curve(std::string_view& bytes) {
  need(bytes, 1, head_size);
  Curve curve{take_double(bytes), {}};
  curve.values.resize(take_length(bytes, sizeof(double)));
  for (double& value : curve.values) value = take_double(bytes);
  return curve;
}

}  // namespace

Curves curves_of(const PackingResult& result) {
  return {result.profile_y, result.profile_z, result.order.pair_correlation,
          result.order.force_density};
}

void set_curves(Curves&& curves, PackingResult& result) {
  result.profile_y = std::move(curves.profile_y);
  result.profile_z = std::move(curves.profile_z);
  result.order.pair_correlation = std::move(curves.pair_correlation);
  result.order.force_density = std::move(curves.force_density);
}

void put_curves(std::string& bytes, const Curves& curves) {
  put_profile(bytes, curves.profile_y);
  put_profile(bytes, curves.profile_z);
  put_curve(bytes, curves.pair_correlation);
  put_curve(bytes, curves.force_density);
}

Curves take_curves(std::string_view& bytes) {
  Curves curves;
  curves.profile_y = take_profile(bytes);
  curves.profile_z = take_profile(bytes);
  curves.pair_correlation = take_curve(bytes);
  curves.force_density = take_curve(bytes);
  return curves;
}

}  // namespace grainsweep
