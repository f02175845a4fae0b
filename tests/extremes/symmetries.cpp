#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <memory>

#include "engine/dynamics/presets.hpp"
#include "engine/dynamics/step.hpp"
#include "engine/narrow/manifold.hpp"
#include "engine/scene/start.hpp"
#include "tests/extremes/accuracy_names.hpp"
#include "tests/extremes/catalogue.hpp"
#include "tests/extremes/judge.hpp"
#include "tests/extremes/packed.hpp"
#include "tests/support/bits.hpp"
#include "tests/support/draw.hpp"

namespace grainsweep::extremes {

namespace {

using Change = void (*)(const Box&, Spheres&);

void shift(const Box& box, Spheres& spheres) {
  for (PlacedSphere& s : spheres) s.x = std::fmod(s.x + 1.25, box.length);
}
void mirror_x(const Box& box, Spheres& spheres) {
  for (PlacedSphere& s : spheres) s.x = box.length - s.x;
}
void mirror_y(const Box& box, Spheres& spheres) {
  for (PlacedSphere& s : spheres) s.y = box.width - s.y;
}
void rename_grains(const Box&, Spheres& spheres) { testing::Draw(5).shuffle(spheres); }

/// Mean and its standard error.
struct Mean {
  double value = 0.0, error = 0.0;
};
Mean mean_of(const std::vector<double>& values) {
  const auto n = static_cast<double>(values.size());
  Mean mean;
  for (const double v : values) mean.value += v / n;
  for (const double v : values) mean.error += (v - mean.value) * (v - mean.value);
  mean.error = std::sqrt(mean.error / (n * (n - 1.0)));
  return mean;
}

/// Places after some steps that are solved to `solved_to`.
constexpr double solved_to = 1e-10;  // m g
constexpr int steps_followed = 12;
Spheres after_fall(const Box& box, const Spheres& begin, double& worst_residual) {
  SphereBed bed = make_bed(box, begin);
  StepState<Sphere, double> state;
  StepSettings settings;
  settings.limits.iterations = 100'000;
  settings.limits.tolerance = solved_to;
  for (int k = 0; k < steps_followed; ++k) {
    const StepReport report = step(settings, kernels_for(best_isa()), bed, state);
    worst_residual = std::max(worst_residual, report.solve.residual);
  }
  return spheres_of(bed);
}

double largest_distance(const Box& box, const Spheres& one, const Spheres& other) {
  double largest = 0.0;
  for (std::size_t k = 0; k < one.size(); ++k) {
    const PlacedSphere &p = one[k], &q = other[k];
    largest = std::max(largest, std::hypot(nearest_image(p.x - q.x, box.period_x()),
                                           nearest_image(p.y - q.y, box.period_y()), p.z - q.z));
  }
  return largest;
}

/// A random bed falls as it is and changed. A step has one solution, whatever grains are called and
/// wherever x = 0 lies, so that the two differ by what solves leave undone.
Finding fall_alike(Change change) {
  const SphereBed bed = *start<Sphere>(small_spec(220, {}));
  Spheres changed = spheres_of(bed);
  change(bed.box, changed);
  double worst_residual = 0.0;
  changed = after_fall(bed.box, changed, worst_residual);
  Spheres plain = after_fall(bed.box, spheres_of(bed), worst_residual);
  change(bed.box, plain);
  Finding finding;
  if (worst_residual > solved_to) finding.unrest = "a step is solved to more than 1e-10 m g";
  finding.answers = {{"distance of any grain from its image, d",
                      largest_distance(bed.box, plain, changed), 1e-9,
                      "residuals of 4e-12 d in each of 12 steps, twentyfold through collisions"}};
  return finding;
}

/// Beds that are compared; many more in tests/run_full.sh.
std::uint64_t beds() {
  const char* tries = std::getenv("GRAINSWEEP_FAULTS");
  return tries != nullptr && std::string(tries) == "full" ? 160 : 40;
}

/// Largest of all 16 mean differences below, in standard errors, that chance exceeds once in a
/// million times that the bits of the beds change: Student's t of the 25 degrees of freedom that
/// the least number of settled beds leaves, at 1e-6 / 16, both sides.
constexpr double strayed = 7.6;

PackingSpec spec_of(std::uint64_t key, const Accuracy& accuracy) {
  PackingSpec spec = small_spec(220, accuracy);
  spec.measure.exclude_floor = spec.measure.exclude_surface = 2.0;
  spec.random_key = key;
  return spec;
}

PackingResult pack(const PackingSpec& spec) {
  return make_packing(spec, ExecutionContext(kernels_for(best_isa())),
                      [](const Progress&) { return true; })
      .result;
}

/// Many beds as they are, packed when they are first asked for.
class PlainBeds {
 public:
  explicit PlainBeds(const Accuracy& accuracy) : accuracy_(accuracy) {}

  PackingSpec spec(std::uint64_t key) const { return spec_of(key, accuracy_); }
  const PackingResult& packed(std::uint64_t key) {
    if (packed_.empty()) {
      for (std::uint64_t k = 1; k <= beds(); ++k) packed_.push_back(pack(spec(k)));
    }
    return packed_[static_cast<std::size_t>(key - 1)];
  }

 private:
  Accuracy accuracy_;
  std::vector<PackingResult> packed_;
};

/// Solid fraction and coordination of many beds as they are and changed. A changed bed goes its own
/// way from the first rounding on, so that only statistics can be equal.
Finding compare(Change change, PlainBeds& plain) {
  std::vector<double> solid, neighbours;
  Finding finding;
  for (std::uint64_t key = 1; key <= beds(); ++key) {
    PackingSpec changed = plain.spec(key);
    Spheres spheres = spheres_of(*start<Sphere>(changed));
    change(changed.box, spheres);
    changed.fill = PlacedGrains{spheres};
    const PackingResult& a = plain.packed(key);
    const PackingResult b = pack(changed);
    if (!a.reason.empty() || !b.reason.empty()) continue;
    solid.push_back(a.solid_fraction - b.solid_fraction);
    neighbours.push_back(a.coordination[0].between_grains - b.coordination[0].between_grains);
  }
  if (solid.size() < beds() * 2 / 3) {
    finding.unrest = "fewer than two thirds of the beds settled";
    return finding;
  }
  const Mean phi = mean_of(solid), z = mean_of(neighbours);
  finding.answers = {{"solid fraction, mean difference", std::abs(phi.value), strayed * phi.error,
                      "7.6 standard errors"},
                     {"coordination number, mean difference", std::abs(z.value), strayed * z.error,
                      "7.6 standard errors"}};
  return finding;
}

/// One row of a pair of spheres: normal and gap in f64.
struct PairRow {
  double x, y, z, gap;
};
PairRow row_of(const Record<double>& a, const Record<double>& b) {
  RowBlock<double> block{};
  for (std::size_t lane = 0; lane < block_width; ++lane) block.set_grains(lane, 0, 1);
  const Record<double> positions[2] = {a, b};
  kernels_for(best_isa()).f64.rows.sphere_gaps(&block, 1, positions, 0.0, 0.0, 1.0);
  return {block.normal_x[0], block.normal_y[0], block.normal_z[0], block.gap[0]};
}

/// Number of random pairs whose row is not, to the last bit, the row of the changed pair.
template <class Changed>
Finding same_rows(Changed changed) {
  testing::Draw draw(3);
  double differ = 0.0;
  for (int k = 0; k < 20'000; ++k) {
    // Multiples of 2^-20, so that shifts and mirrors of them are exact.
    const auto place = [&] { return std::ldexp(std::floor(draw.uniform(0, 1 << 20)), -20); };
    const Record<double> a{place(), place(), place(), 0.5}, b{place(), place(), place(), 0.25};
    differ += changed(a, b) ? 0.0 : 1.0;
  }
  Finding finding;
  finding.answers = {
      {"pairs of 20,000 with other bits", differ, 0.0, "symmetries of f64 are exact"}};
  return finding;
}

bool survives_shift(const Record<double>& a, const Record<double>& b) {
  return testing::same_bits(row_of(a, b),
                            row_of({a.x + 64, a.y, a.z, a.w}, {b.x + 64, b.y, b.z, b.w}));
}
bool survives_mirror(const Record<double>& a, const Record<double>& b) {
  const PairRow plain = row_of(a, b);
  const PairRow seen = row_of({8 - a.x, a.y, a.z, a.w}, {8 - b.x, b.y, b.z, b.w});
  return plain.x == -seen.x && plain.y == seen.y && plain.z == seen.z && plain.gap == seen.gap;
}
bool survives_exchange(const Record<double>& a, const Record<double>& b) {
  const PairRow plain = row_of(a, b), seen = row_of(b, a);
  return plain.x == -seen.x && plain.y == -seen.y && plain.z == -seen.z && plain.gap == seen.gap;
}
bool survives_new_axes(const Record<double>& a, const Record<double>& b) {
  const PairRow plain = row_of(a, b), seen = row_of({a.y, a.x, a.z, a.w}, {b.y, b.x, b.z, b.w});
  return plain.x == seen.y && plain.y == seen.x && plain.z == seen.z && plain.gap == seen.gap;
}

}  // namespace

std::vector<Scene> symmetries() {
  std::vector<Scene> scenes;
  const auto kernel = [&](const char* extreme,
                          bool (*survives)(const Record<double>&, const Record<double>&)) {
    scenes.push_back({"symmetry", "a pair of spheres", extreme, "kernel, f64", Outcome::right,
                      [=] { return same_rows(survives); }});
  };
  kernel("shifted by 64 d", survives_shift);
  kernel("mirrored", survives_mirror);
  kernel("names exchanged", survives_exchange);
  kernel("x and y exchanged", survives_new_axes);
  const std::pair<const char*, Change> changes[] = {{"shifted along x", shift},
                                                    {"mirrored along x", mirror_x},
                                                    {"mirrored along y", mirror_y},
                                                    {"grains renamed", rename_grains}};
  for (const auto& [name, change] : changes) {
    scenes.push_back({"symmetry", "a bed of 220 falls", name, "f64, 1e-10 m g", Outcome::right,
                      [change = change] { return fall_alike(change); }});
  }
  for (const char* preset_name : {"fast", "balanced"}) {
    const NamedAccuracy at = at_preset(preset_name);
    const auto plain = std::make_shared<PlainBeds>(at.accuracy);
    for (const auto& [name, change] : changes) {
      scenes.push_back({"symmetry", "beds of 220", name, at.name, Outcome::right,
                        [=, changed = change] { return compare(changed, *plain); }});
    }
  }
  return scenes;
}

}  // namespace grainsweep::extremes
