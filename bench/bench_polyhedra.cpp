// Narrow phase of polyhedra: items are pairs, at random turns, a third of them overlapping; those
// of `touching` all touch.
#include <algorithm>
#include <random>

#include <benchmark/benchmark.h>

#include "engine/narrow/manifold.hpp"
#include "engine/shape/hull.hpp"
#include "engine/shape/pinacoid.hpp"
#include "tests/support/shapes.hpp"

namespace grainsweep::bench {
namespace {

constexpr std::size_t pairs = 1024;

class Random {
 public:
  double uniform(double low, double high) {
    return low + (high - low) * static_cast<double>(generator_() >> 11) * 0x1p-53;
  }
  /// Not uniform over rotations; good enough to meet every feature.
  Quaternion turn() {
    return Quaternion(uniform(-1, 1), uniform(-1, 1), uniform(-1, 1), uniform(-1, 1)).normalized();
  }
  Vector direction() { return turn() * Vector::UnitX(); }

 private:
  std::mt19937_64 generator_{1};
};

ConvexShape rock() {
  Random random;
  std::vector<Vector> corners(20);
  for (Vector& corner : corners) corner = 0.5 * random.direction();
  return *convex_hull(corners).shape;
}

/// Columns of grains, 2 k and 2 k + 1 a pair close to touching.
struct Bed {
  std::vector<Record<double>> centres, orientations;
  std::vector<PairPose> poses;
};

Bed close_pairs(const ConvexShape& shape) {
  Random random;
  Bed bed;
  const double usual = shape.circumradius + shape.inradius;
  for (std::size_t k = 0; k < pairs; ++k) {
    Pose a, b;
    a.orientation = random.turn();
    b.orientation = random.turn();
    b.centre = usual * random.uniform(0.8, 1.05) * random.direction();
    for (const Pose& pose : {a, b}) {
      const Quaternion& q = pose.orientation;
      bed.centres.push_back({pose.centre.x(), pose.centre.y(), pose.centre.z(), 1});
      bed.orientations.push_back({q.x(), q.y(), q.z(), q.w()});
    }
    bed.poses.push_back(seen_from_a(a, b, b.centre - a.centre));
  }
  return bed;
}

/// Brings the grains of every pair together along their centres' line, until they overlap by up to
/// .02 d along it.
std::vector<PairPose> touching_poses(const ConvexShape& shape) {
  Random random;
  std::vector<PairPose> poses = close_pairs(shape).poses;
  for (PairPose& pose : poses) {
    const Vector n = pose.centre.normalized();
    pose.centre = 2.0 * shape.circumradius * n;
    for (int k = 0; k < 40; ++k) {
      pose.centre -=
          closest_points({shape, shape, pose}, kernels_for(best_isa()).hull).distance * n;
    }
    pose.centre -= random.uniform(0.0, 0.02) * n;
  }
  return poses;
}

void count_pairs(benchmark::State& run) {
  run.SetItemsProcessed(run.iterations() * static_cast<std::int64_t>(pairs));
  run.counters["per_pair"] =
      benchmark::Counter(static_cast<double>(pairs), benchmark::Counter::kIsIterationInvariantRate |
                                                         benchmark::Counter::kInvert);
}

void batch_axes(benchmark::State& run) {
  const ConvexShape shape = pinacoid({});
  const Bed bed = close_pairs(shape);
  std::vector<PinacoidBlock> blocks(pairs / block_width);
  for (std::size_t k = 0; k < pairs; ++k) {
    const auto a = static_cast<std::int32_t>(2 * k);
    blocks[k / block_width].set_grains(k % block_width, a, a + 1);
  }
  const Kernels& kernels = kernels_for(static_cast<Isa>(run.range(0)));
  for (auto _ : run) {
    kernels.pinacoid_axes(*shape.pinacoid, *shape.pinacoid, blocks.data(), blocks.size(),
                          bed.centres.data(), bed.orientations.data(), 20, 20);
    benchmark::ClobberMemory();
  }
  run.SetLabel(name_of(kernels.isa));
  count_pairs(run);
}

/// Calls what(pair, k) for every pair of a shape.
template <class What>
void over_pairs(benchmark::State& run, const ConvexShape& shape, const std::vector<PairPose>& poses,
                What what) {
  for (auto _ : run) {
    for (std::size_t k = 0; k < pairs; ++k) {
      what(ShapePair{shape, shape, poses[k]}, k);
    }
  }
  count_pairs(run);
}
template <class What>
void over_pairs(benchmark::State& run, const ConvexShape& shape, What what) {
  over_pairs(run, shape, close_pairs(shape).poses, what);
}

void axes(benchmark::State& run, const ConvexShape& shape) {
  over_pairs(run, shape, [](const ShapePair& pair, std::size_t) {
    benchmark::DoNotOptimize(separating_axes(pair, kernels_for(best_isa()).hull));
  });
}

void gjk(benchmark::State& run, const ConvexShape& shape) {
  over_pairs(run, shape, [](const ShapePair& pair, std::size_t) {
    benchmark::DoNotOptimize(closest_points(pair, kernels_for(best_isa()).hull));
  });
}

void cached_axis(benchmark::State& run, const ConvexShape& shape) {
  over_pairs(run, shape, [](const ShapePair& pair, std::size_t) {
    benchmark::DoNotOptimize(separation_along(pair, pair.pose.turn.col(0)));
  });
}

/// Axes known, a margin of .05 d beyond the separation: what clipping and crossing of edges cost.
void clip(benchmark::State& run, const ConvexShape& shape) {
  const Bed bed = close_pairs(shape);
  std::vector<ContactAxes> known;
  for (const PairPose& pose : bed.poses) {
    known.push_back(separating_axes({shape, shape, pose}, kernels_for(best_isa()).hull));
  }
  ClipColumns columns;
  std::vector<ContactPoint> points;
  over_pairs(run, shape, [&](const ShapePair& pair, std::size_t k) {
    points.clear();
    const double margin = std::max(0.0, known[k].separation()) + 0.05;
    benchmark::DoNotOptimize(touch(pair, {margin, 1e-3}, known[k], columns, points));
  });
}

/// The whole chain, with the axis that pairs remember, with a margin of .05 d.
void touch_poses(benchmark::State& run, const ConvexShape& shape,
                 const std::vector<PairPose>& poses) {
  TouchColumns columns;
  std::vector<ContactPoint> points;
  std::vector<PairMemory> memories(pairs);
  over_pairs(run, shape, poses, [&](const ShapePair& pair, std::size_t k) {
    points.clear();
    memories[k].candidates = {};
    benchmark::DoNotOptimize(touch(pair, {0.05, 1e-3}, memories[k], columns, points));
  });
}

void whole_touch(benchmark::State& run, const ConvexShape& shape) {
  touch_poses(run, shape, close_pairs(shape).poses);
}

void touching(benchmark::State& run, const ConvexShape& shape) {
  touch_poses(run, shape, touching_poses(shape));
}

void on_isas(benchmark::internal::Benchmark* benchmark) {
  for (const Isa isa : {Isa::sse2, Isa::avx2, Isa::avx512}) {
    if (is_supported(isa)) benchmark->Arg(static_cast<int>(isa));
  }
}

BENCHMARK(batch_axes)->Apply(on_isas);
BENCHMARK_CAPTURE(axes, pinacoid, pinacoid({}));
BENCHMARK_CAPTURE(axes, hull_of_20, rock());
BENCHMARK_CAPTURE(gjk, pinacoid, pinacoid({}));
BENCHMARK_CAPTURE(gjk, hull_of_20, rock());
BENCHMARK_CAPTURE(cached_axis, pinacoid, pinacoid({}));
BENCHMARK_CAPTURE(clip, pinacoid, pinacoid({}));
BENCHMARK_CAPTURE(clip, hull_of_20, rock());
BENCHMARK_CAPTURE(whole_touch, pinacoid, pinacoid({}));
BENCHMARK_CAPTURE(whole_touch, hull_of_20, rock());
BENCHMARK_CAPTURE(touching, pinacoid, pinacoid({}));
BENCHMARK_CAPTURE(touching, hull_of_20, rock());
BENCHMARK_CAPTURE(touching, cube, testing::cube());
BENCHMARK_CAPTURE(touching, icosahedron, testing::icosahedron());
BENCHMARK_CAPTURE(touching, dodecahedron, testing::dodecahedron());
BENCHMARK_CAPTURE(touching, prism_16, testing::prism(16, 1.0));
BENCHMARK_CAPTURE(touching, prism_32, testing::prism(32, 1.0));

}  // namespace
}  // namespace grainsweep::bench
