#include "runner/sweep/bed_kind.hpp"

#include <array>
#include <cmath>
#include <variant>

namespace grainsweep {
namespace {

constexpr std::array<BedKind, bed_kinds> kinds = {
    BedKind::spheres,          BedKind::narrow_spheres, BedKind::two_sizes,
    BedKind::narrow_two_sizes, BedKind::many_sizes,     BedKind::pinacoids,
    BedKind::narrow_pinacoids};

/// Whether its walls stand at least so far from each other as in narrow containers of other grains
/// than spheres of one size that were measured.
bool is_wide_enough(const Box& box, double gap, double duct, double tube) {
  return nearest_walls(box) >= (box.is_tube ? tube : is_walled_around(box) ? duct : gap);
}

/// Of the beds of uniform sizes that were measured, the largest grain over the smallest, and the
/// widest lognormal sizes.
constexpr double widest = 3.0, widest_sigma = 0.5;

bool is_within_widest(double smallest, double largest) {
  constexpr double rounding = 1e-9;
  return largest <= widest * smallest * (1.0 + rounding);
}

/// Whether the diameters of a curve differ no more than those that were measured.
struct IsMeasured {
  bool operator()(const LognormalSizes& sizes) const { return sizes.sigma <= widest_sigma; }
  bool operator()(const UniformSizes& sizes) const {
    return is_within_widest(sizes.from, sizes.to);
  }
  bool operator()(const WeibullSizes& /*sizes*/) const { return false; }
  bool operator()(const SizeTable& table) const {
    return !table.diameters.empty() &&
           is_within_widest(table.diameters.front(), table.diameters.back());
  }
};

std::optional<BedKind> kind_of_spheres(const SizesSpec& sizes, const Box& box) {
  if (sizes.distribution) {
    const bool is_measured = std::visit(IsMeasured{}, sizes.distribution->formula);
    return is_measured && !is_narrow(box) ? std::optional(BedKind::many_sizes) : std::nullopt;
  }
  if (sizes.small_share == 0.0) return is_narrow(box) ? BedKind::narrow_spheres : BedKind::spheres;
  constexpr double least_ratio = 0.5;  // of two classes that were measured
  if (sizes.small_share == 1.0 || sizes.size_ratio < least_ratio) return std::nullopt;
  const bool is_half = sizes.size_ratio == least_ratio;
  if (is_narrow(box)) {
    const bool is_measured = is_half && is_wide_enough(box, 2.0, 2.0, 3.0);
    return is_measured ? std::optional(BedKind::narrow_two_sizes) : std::nullopt;
  }
  return is_half && !box.is_tube ? BedKind::two_sizes : BedKind::many_sizes;
}

bool is_usual(const PinacoidSize& size) {
  const PinacoidSize usual;
  constexpr double rounding = 1e-12;  // of degrees as radians
  return size.length == usual.length && size.width == usual.width && size.height == usual.height &&
         std::abs(size.angle - usual.angle) < rounding;
}

}  // namespace

bool is_narrow(const Box& box) {
  constexpr double narrow_gap = 4.0, narrow_duct = 5.0;  // d
  return nearest_walls(box) < (is_walled_around(box) ? narrow_duct : narrow_gap);
}

std::optional<BedKind> bed_kind(const PackingSpec& spec) {
  const SizesSpec& sizes = spec.sizes;
  if (std::holds_alternative<PlacedGrains>(spec.fill)) return std::nullopt;
  if (!sizes.distribution && sizes.spread > SizesSpec{}.spread) return std::nullopt;
  if (std::holds_alternative<SphereShape>(spec.shape)) return kind_of_spheres(sizes, spec.box);
  const auto* pinacoid = std::get_if<PinacoidSize>(&spec.shape);
  const bool is_measured = pinacoid != nullptr && is_usual(*pinacoid) && !sizes.distribution &&
                           sizes.small_share == 0.0 && !spec.box.is_tube &&
                           is_wide_enough(spec.box, 2.0, 2.5, 0.0);
  if (!is_measured) return std::nullopt;
  return is_narrow(spec.box) ? BedKind::narrow_pinacoids : BedKind::pinacoids;
}

const char* name_of(BedKind kind) {
  switch (kind) {
    case BedKind::spheres:
      return "spheres of one size";
    case BedKind::narrow_spheres:
      return "spheres of one size in narrow gaps, ducts or tubes";
    case BedKind::two_sizes:
      return "spheres of two sizes, 1 to 2";
    case BedKind::narrow_two_sizes:
      return "spheres of two sizes, 1 to 2, in narrow gaps, ducts or tubes";
    case BedKind::many_sizes:
      return "spheres of several sizes";
    case BedKind::pinacoids:
      return "pinacoids 1 by 1 by 1";
    case BedKind::narrow_pinacoids:
      return "pinacoids 1 by 1 by 1 in narrow gaps or ducts";
  }
  return "";
}

std::optional<BedKind> bed_kind_called(std::string_view name) {
  for (const BedKind kind : kinds) {
    if (name_of(kind) == name) return kind;
  }
  return std::nullopt;
}

}  // namespace grainsweep
