#include <algorithm>
#include <cmath>
#include <limits>

#include <catch2/catch.hpp>

#include "engine/dynamics/presets.hpp"
#include "engine/packing.hpp"
#include "engine/scene/bed.hpp"
#include "engine/shape/given_shape.hpp"
#include "engine/shape/mixture.hpp"
#include "engine/shape/named_shapes.hpp"
#include "tests/support/about.hpp"
#include "tests/support/instruction_sets.hpp"
#include "tests/support/keep_going.hpp"
#include "tests/support/part_loops.hpp"
#include "tests/support/placed.hpp"
#include "tests/support/shapes.hpp"
#include "tests/support/tries.hpp"

namespace grainsweep {
namespace {

using testing::kernels;

Packing pack(const PackingSpec& spec) {
  return make_packing(spec, kernels(), [](const Progress&) { return true; });
}

/// Seventy grains or so on a floor of 3 by 3, 4 d high.
PackingSpec small_spec(const ShapeSpec& shape = PinacoidSize{}) {
  PackingSpec spec;
  spec.shape = shape;
  spec.box = {4, 4, Boundary::periodic, Boundary::walls};
  spec.fill = SolidHeight{2.5};
  spec.accuracy = *preset("fast");
  spec.measure.exclude_floor = 1;
  spec.measure.exclude_surface = 1;
  spec.random_key = 3;
  return spec;
}

TEST_CASE("a packing of pinacoids is settled, measured and given back grain by grain") {
  const PackingSpec spec = small_spec();
  const Packing packing = pack(spec);
  const PackingResult& r = packing.result;
  INFO(r.reason);
  REQUIRE(r.status == PackingStatus::settled);
  CHECK(r.grains == grain_count(spec));
  CHECK(packing.grains.size() == static_cast<std::size_t>(r.grains));
  CHECK((r.solid_fraction > 0.5 && r.solid_fraction < 0.8));
  REQUIRE(r.shape_order);
  const auto& share = r.shape_order->contact_share;
  CHECK(share[0] + share[1] + share[2] == Approx(1));
  CHECK(r.shape_order->force_share[0] + r.shape_order->force_share[1] +
            r.shape_order->force_share[2] ==
        Approx(1));
  for (const double order : r.shape_order->nematic) CHECK((order >= 0 && order <= 1));
  REQUIRE(packing.turned);
  CHECK(packing.turned->meshes.front().vertices.size() == 8);
  CHECK(packing.turned->meshes.front().faces.size() == 8);
  REQUIRE(packing.turned->orientations.size() == packing.grains.size());
  for (const auto& [x, y, z, w] : packing.turned->orientations) {
    REQUIRE(x * x + y * y + z * z + w * w == Approx(1));
  }
}

TEST_CASE("the profiles of pinacoids hold the solid volume that is measured at once") {
  const PackingResult r = pack(small_spec()).result;
  REQUIRE(r.status == PackingStatus::settled);
  double mean = 0;
  for (const ProfileBin& bin : r.profile_y.bins) mean += bin.large;
  mean /= static_cast<double>(r.profile_y.bins.size());
  CHECK(mean == Approx(r.solid_fraction).epsilon(1e-12));
  double height = 0;  // of all solid volume, d
  for (const ProfileBin& bin : r.profile_z.bins) height += bin.large * r.profile_z.bin_width;
  const double drawn = static_cast<double>(r.grains) * extent_of(PinacoidSize{}).volume / 16;
  CHECK(height == Approx(drawn).epsilon(0.03));  // sizes scatter: a tenth over the root of 100
}

TEST_CASE("spheres have neither a mesh nor orientations nor an order of shapes") {
  const Packing packing = pack(small_spec(SphereShape{}));
  CHECK_FALSE(packing.turned);
  CHECK_FALSE(packing.result.shape_order);
}

TEST_CASE("a bed of hulls placed again as it was given back stays as it is") {
  // Not centred, not along its principal axes: given back in the frame in which it is written.
  PackingSpec spec = small_spec(testing::asked_for(
      {{1, 0, 0}, {2, 0.1, 0}, {1.9, 0.9, 0}, {1, 1, 0.1}, {1.5, 0.4, 0.8}, {1.3, 0.5, -0.5}}));
  const Packing first = pack(spec);
  INFO(first.result.reason);
  REQUIRE(first.result.status == PackingStatus::settled);
  spec.fill = testing::placed_as_in(first);
  spec.accuracy.max_steps = 1;  // a look at it, no more
  const Packing again = pack(spec);
  double farthest = 0;
  for (std::size_t i = 0; i < first.grains.size(); ++i) {
    farthest = std::max(farthest, std::abs(again.grains[i].z - first.grains[i].z));
    const auto &p = first.turned->orientations[i], &q = again.turned->orientations[i];
    const double same = p[0] * q[0] + p[1] * q[1] + p[2] * q[2] + p[3] * q[3];
    REQUIRE(std::abs(same) == about(1, 1e-3));
  }
  CHECK(farthest < 0.01);
  CHECK(again.result.rest.overlap_max < 0.01);
}

TEST_CASE("a bed of a mixture placed again as it was given back stays as it is") {
  // A hull that is not given about its centroid, flat bricks, and spheres.
  PackingSpec spec = small_spec(Mixture{
      {{0.4, HullVertices{{{1, 0, 0}, {2, 0.1, 0}, {1.9, 0.9, 0}, {1, 1, 0.1}, {1.5, 0.4, 0.8}}}},
       {0.3, CuboidSize{1, 1, 0.5}},
       {0.3, SphereShape{}}}});
  const Packing first = pack(spec);
  INFO(first.result.reason);
  REQUIRE(first.result.status == PackingStatus::settled);
  spec.fill = testing::placed_as_in(first);
  REQUIRE(check(spec).empty());
  spec.accuracy.max_steps = 1;  // a look at it, no more
  const Packing again = pack(spec);
  CHECK(again.turned->components == first.turned->components);
  CHECK(again.result.solid_fraction == Approx(first.result.solid_fraction).epsilon(1e-3));
  double farthest = 0;
  for (std::size_t i = 0; i < first.grains.size(); ++i) {
    farthest = std::max(farthest, std::abs(again.grains[i].z - first.grains[i].z));
  }
  CHECK(farthest < 0.01);
  CHECK(again.result.rest.overlap_max < 0.01);
}

TEST_CASE("a shape that starts at no finite place is a failure by name") {
  PackingSpec spec = small_spec();
  const double none = std::numeric_limits<double>::quiet_NaN();
  spec.fill = PlacedGrains{{{none, 2, 1, 0.5}}, {{0, 0, 0, 1}}};
  const PackingResult r = pack(spec).result;
  CHECK(r.status == PackingStatus::failed);
  CHECK(r.reason.find("not a finite number") != std::string::npos);
}

TEST_CASE("equal specifications of shapes give equal bits, another key another bed") {
  PackingSpec spec = small_spec();
  const std::uint64_t hash = pack(spec).result.state_hash;
  CHECK(pack(spec).result.state_hash == hash);
  spec.random_key = 4;
  CHECK(pack(spec).result.state_hash != hash);
}

TEST_CASE("pinacoids come to rest by plain contact dynamics, too") {
  PackingSpec spec = small_spec();
  const PackingResult damped = pack(spec).result;
  spec.accuracy.protocol = Protocol::dynamic;
  const PackingResult dynamic = pack(spec).result;
  INFO(dynamic.reason);
  CHECK(dynamic.status == PackingStatus::settled);
  CHECK(dynamic.state_hash != damped.state_hash);
  CHECK(10 * dynamic.rest.contacts > 9 * dynamic.rest.isostatic_contacts);
}

// The first steps of a bed of several subdomains: corners that overlap at the start part.
TEST_CASE("a large packing of pinacoids has the same bits however its parts are shared out",
          "[slow]") {
  PackingSpec spec = small_spec();
  spec.box = {8, 8, Boundary::periodic, Boundary::walls};
  spec.fill = GrainCount{static_cast<std::int64_t>(large_bed_grains<Polyhedron>) + 200};
  spec.accuracy.max_steps = 25;
  const PackingResult expected = pack(spec).result;
  for (const ParallelFor& loop :
       {ParallelFor(testing::last_part_first), ParallelFor(testing::two_threads)}) {
    const ExecutionContext context(kernels(), loop);
    const PackingResult result = make_packing(spec, context, testing::always).result;
    CHECK(result.state_hash == expected.state_hash);
    CHECK(result.rest.step_residual == expected.rest.step_residual);
    CHECK(result.rest.contacts == expected.rest.contacts);
    CHECK(result.rest.overlap_mean == expected.rest.overlap_mean);
  }
}

TEST_CASE("a large packing of pinacoids goes on from what it has saved to the same bits",
          "[slow]") {
  PackingSpec spec = small_spec();
  spec.box = {8, 8, Boundary::periodic, Boundary::walls};
  spec.fill = GrainCount{static_cast<std::int64_t>(large_bed_grains<Polyhedron>) + 200};
  spec.accuracy.max_steps = 20;
  std::string saved;
  const auto save_at_12 = [&](const Progress& progress) {
    if (progress.step == 12) saved = progress.save();
    return true;
  };
  const PackingResult whole = make_packing(spec, kernels(), save_at_12).result;
  REQUIRE_FALSE(saved.empty());
  const PackingResult rest = make_packing(spec, kernels(), testing::always, saved).result;
  CHECK(rest.steps == whole.steps);
  CHECK(rest.state_hash == whole.state_hash);
  CHECK(rest.rest.step_residual == whole.rest.step_residual);
}

TEST_CASE("a named solid packs as the hull of its corners does, bit for bit") {
  for (const int sides : {3, 6}) {
    const PrismSize prism{sides, 0.8, 1.1};
    HullVertices hull;
    for (const Vector& corner : corners_of(prism)) {
      hull.points.push_back({corner.x(), corner.y(), corner.z()});
    }
    const PackingResult named = pack(small_spec(prism)).result,
                        given = pack(small_spec(hull)).result;
    CHECK(named.state_hash == given.state_hash);
    CHECK(named.solid_fraction == given.solid_fraction);
    CHECK(named.rest.isostatic_contacts == given.rest.isostatic_contacts);
    CHECK(named.steps > 0);
  }
}

/// Isometric and flat pinacoids, by halves of the volume.
Mixture flat_and_isometric() { return {{{0.5, PinacoidSize{}}, {0.5, PinacoidSize{1, 1, 0.4}}}}; }

TEST_CASE("a mixture settles, and each grain is given back with the mesh of its component") {
  const PackingSpec spec = small_spec(flat_and_isometric());
  const Packing packing = pack(spec);
  INFO(packing.result.reason);
  REQUIRE(packing.result.status == PackingStatus::settled);
  CHECK(packing.result.grains == grain_count(spec));
  CHECK((packing.result.solid_fraction > 0.5 && packing.result.solid_fraction < 0.8));
  REQUIRE(packing.turned);
  REQUIRE(packing.turned->meshes.size() == 2);
  REQUIRE(packing.turned->components.size() == packing.grains.size());
  const std::vector<ConvexShape> shapes = shapes_of(spec.shape);
  for (std::size_t i = 0; i < packing.grains.size(); ++i) {
    double top = 0;
    for (const auto& vertex : packing.turned->mesh(i).vertices) top = std::max(top, vertex[2]);
    REQUIRE(top == Approx(packing.turned->component(i) == 0 ? 0.5 : 0.2));
  }
}

TEST_CASE("the components of a mixture add up to the whole bed") {
  const PackingResult r = pack(small_spec(flat_and_isometric())).result;
  REQUIRE(r.components.size() == 2);
  const auto &isometric = r.components[0], &flat = r.components[1];
  CHECK(isometric.grains + flat.grains == r.grains);
  CHECK(isometric.packed + flat.packed == Approx(1));
  CHECK(flat.packed == about(0.5, 0.02));  // sizes scatter: a tenth over the root of 100
  CHECK(isometric.slab_share + flat.slab_share == Approx(1));
  CHECK(isometric.solid_fraction + flat.solid_fraction == Approx(r.solid_fraction));
  double ends = 0, grains = 0;
  for (const ComponentMeasure& one : r.components) {
    CHECK(one.neighbours[0] + one.neighbours[1] == Approx(one.coordination));
    ends += one.coordination * static_cast<double>(one.slab_grains);
    grains += static_cast<double>(one.slab_grains);
  }
  CHECK(ends / grains == Approx(r.coordination.front().between_grains));
  REQUIRE(r.shape_order);
  const auto &own = isometric.contacts[0], &mixed = isometric.contacts[1],
             &flats = flat.contacts[1];
  CHECK(mixed == flat.contacts[0]);
  std::int64_t contacts = 0;
  for (std::size_t kind = 0; kind < 3; ++kind) contacts += own[kind] + mixed[kind] + flats[kind];
  for (std::size_t kind = 0; kind < 3; ++kind) {
    CHECK(static_cast<double>(own[kind] + mixed[kind] + flats[kind]) /
              static_cast<double>(contacts) ==
          r.shape_order->contact_share[kind]);
  }
  CHECK(pack(small_spec()).result.components.empty());
}

TEST_CASE("the slab's profile of a mixture holds the solid volume that is measured at once") {
  const PackingResult r = pack(small_spec(flat_and_isometric())).result;
  REQUIRE(r.status == PackingStatus::settled);
  double mean = 0;
  for (const ProfileBin& bin : r.profile_y.bins) mean += bin.large;
  mean /= static_cast<double>(r.profile_y.bins.size());
  CHECK(mean == Approx(r.solid_fraction).epsilon(1e-12));
}

TEST_CASE("components have the profiles that the bed has, which hold their solid volume") {
  PackingSpec spec = small_spec(flat_and_isometric());
  for (const Boundary x : {Boundary::periodic, Boundary::walls}) {
    spec.box.x = x;
    const PackingResult r = pack(spec).result;
    REQUIRE(r.components.size() == 2);
    for (const ComponentMeasure& one : r.components) {
      CHECK(one.profile_x.bins.size() == r.profile_x.bins.size());
      CHECK(one.profile_from_walls.bins.size() == r.profile_from_walls.bins.size());
      CHECK(one.profile_z.bins.size() == r.profile_z.bins.size());
      REQUIRE(one.profile_y.bins.size() == r.profile_y.bins.size());
      double mean = 0;
      for (const ComponentBin& bin : one.profile_y.bins) mean += bin.solid_fraction;
      mean /= static_cast<double>(r.profile_y.bins.size());
      CHECK(mean == Approx(one.solid_fraction).epsilon(1e-12));
    }
  }
}

TEST_CASE("the Sauter diameter is that of spheres with as much surface for their volume") {
  const auto sauter_diameter = [](const ShapeSpec& shape) {
    PackingSpec spec = small_spec(shape);
    spec.sizes.spread = 0.0;
    return pack(spec).result.sauter_diameter.value();
  };
  CHECK(sauter_diameter(CubeSize{}) == Approx(1.0).epsilon(1e-12));
  // A brick a by b by c: 6 a b c / (2 (a b + b c + c a)).
  CHECK(sauter_diameter(CuboidSize{1, 0.8, 0.5}) == Approx(2.4 / 3.4).epsilon(1e-12));
  // As many cubes as balls of size 1: volumes 1 and pi / 6, surfaces 6 and pi.
  const double halves = 6.0 * (1.0 + pi / 6.0) / (6.0 + pi);
  const Mixture both{{{0.5, CubeSize{}}, {0.5, SphereShape{}}}, ShareBy::number};
  CHECK(sauter_diameter(both) == Approx(halves).epsilon(0.02));  // one grain more or less
}

TEST_CASE("a mixture of equal components packs as their shape alone does, bit by bit") {
  const PinacoidSize pinacoid{1.2, 1, 0.8};
  const PrismSize prism{5, 0.8, 1.1};
  for (const ShapeSpec& shape : {ShapeSpec(pinacoid), ShapeSpec(prism)}) {
    const PackingResult alone = pack(small_spec(shape)).result;
    for (const Mixture& mixture :
         {Mixture{{{1.0, shape}}}, Mixture{{{0.3, shape}, {0.7, shape}}}}) {
      const PackingResult mixed = pack(small_spec(mixture)).result;
      CHECK(mixed.state_hash == alone.state_hash);
      CHECK(mixed.solid_fraction == alone.solid_fraction);
      CHECK(mixed.rest.step_residual == alone.rest.step_residual);
      CHECK(mixed.mean_diameter_by_volume == alone.mean_diameter_by_volume);
    }
  }
}

/// Spheres and isometric pinacoids, by halves of the volume.
Mixture spheres_and_pinacoids() { return {{{0.5, SphereShape{}}, {0.5, PinacoidSize{}}}}; }

TEST_CASE("spheres mix with polyhedra: 20 of 20 beds settle, and are measured as what they are") {
  double least_held = 1;
  for (std::uint64_t key = 1; key <= testing::tries(20U); ++key) {
    PackingSpec spec = small_spec(spheres_and_pinacoids());
    spec.accuracy = Accuracy{};
    spec.random_key = key;
    const Packing packing = pack(spec);
    const PackingResult& r = packing.result;
    INFO(key << ": " << r.reason);
    REQUIRE(r.status == PackingStatus::settled);
    const ComponentMeasure &spheres = r.components.at(0), &pinacoids = r.components.at(1);
    CHECK(spheres.grains + pinacoids.grains == r.grains);
    CHECK(spheres.packed == about(0.5, 0.02));  // sizes scatter by a tenth
    CHECK(spheres.solid_fraction + pinacoids.solid_fraction == Approx(r.solid_fraction));
    CHECK(std::isnan(spheres.nematic[0]));
    CHECK((pinacoids.nematic[2] >= 0 && pinacoids.nematic[2] <= 1));
    // 3 of a sphere, 6 of a pinacoid, less the motion along the walls; of the grains that are held.
    CHECK(r.rest.isostatic_contacts <= 3 * spheres.grains + 6 * pinacoids.grains - 1);
    const double held =
        static_cast<double>(r.rest.contacts) / static_cast<double>(r.rest.isostatic_contacts);
    least_held = std::min(least_held, held);
    REQUIRE(packing.turned);
    CHECK((packing.turned->meshes[0].is_ball() && !packing.turned->meshes[1].is_ball()));
  }
  // Spheres hold polyhedra by turning, too: they rest on fewer contacts than they have freedoms.
  CHECK(least_held < 0.98);
}

TEST_CASE("spheres of a mixture of spheres pack as densely as spheres do") {
  PackingSpec spec = small_spec(Mixture{{{0.5, SphereShape{}}, {0.5, SphereShape{}}}});
  spec.box = {5, 5, Boundary::periodic, Boundary::periodic};
  spec.fill = GrainCount{250};
  double mixed = 0, alone = 0;
  constexpr unsigned beds = testing::tries(8U);
  for (std::uint64_t key = 1; key <= beds; ++key) {
    spec.random_key = key;
    const PackingResult r = pack(spec).result;
    REQUIRE(r.status == PackingStatus::settled);
    CHECK(r.rest.isostatic_contacts <= 750);
    mixed += r.solid_fraction / beds;
    PackingSpec spheres = spec;
    spheres.shape = SphereShape{};
    alone += pack(spheres).result.solid_fraction / beds;
  }
  // Such beds scatter by .008: three standard errors of the difference of two means.
  CHECK(mixed == about(alone, 3 * 0.008 * std::sqrt(2.0 / beds)));
}

TEST_CASE("spheres among polyhedra have the same bits on any instruction set") {
  PackingSpec spec = small_spec(spheres_and_pinacoids());
  spec.accuracy.max_steps = 60;
  std::uint64_t hash = 0;
  for (const Isa isa : testing::testable_isas()) {
    const ExecutionContext context(kernels_for(isa));
    const PackingResult r = make_packing(spec, context, testing::always).result;
    CHECK((hash == 0 || r.state_hash == hash));
    hash = r.state_hash;
  }
}

TEST_CASE("a mixture goes on from what it has saved to the same bits") {
  PackingSpec spec = small_spec(GENERATE(flat_and_isometric(), spheres_and_pinacoids()));
  spec.accuracy.max_steps = 20;
  std::string saved;
  const auto save_at_12 = [&](const Progress& progress) {
    if (progress.step == 12) saved = progress.save();
    return true;
  };
  const PackingResult whole = make_packing(spec, kernels(), save_at_12).result;
  REQUIRE_FALSE(saved.empty());
  const PackingResult rest = make_packing(spec, kernels(), testing::always, saved).result;
  CHECK(rest.state_hash == whole.state_hash);
}

/// A block of cubes that touch each other and the walls.
PackingSpec block_of_cubes(int across, int up) {
  PackingSpec spec = small_spec(CubeSize{});
  const auto width = static_cast<double>(across);
  spec.box = {width, width, Boundary::walls, Boundary::walls};
  PlacedGrains cubes;
  for (int z = 0; z < up; ++z) {
    for (int y = 0; y < across; ++y) {
      for (int x = 0; x < across; ++x) {
        cubes.grains.push_back({x + 0.5, y + 0.5, z + 0.5, 0.5});
        cubes.orientations.push_back({0, 0, 0, 1});
      }
    }
  }
  spec.fill = cubes;
  return spec;
}

TEST_CASE("contacts that depend on others are told apart") {
  const RestReport few = pack(block_of_cubes(4, 6)).result.rest;
  INFO(few.contacts);
  CHECK(static_cast<double>(few.contacts) > 1.1 * static_cast<double>(few.isostatic_contacts));
  CHECK(few.independent_contacts <= static_cast<double>(few.isostatic_contacts));
  CHECK(few.independent_contacts > 0.5 * static_cast<double>(few.isostatic_contacts));
}

TEST_CASE("shapes that cannot be packed are refused with the reason") {
  const auto errors_of = [](const PackingSpec& spec) {
    std::string all;
    for (const SpecError& error : check(spec)) all += error.path + " " + error.message + "\n";
    return all;
  };
  CHECK(errors_of(small_spec()).empty());
  CHECK(errors_of(small_spec(PinacoidSize{1, 1, 1, 0.1})).find("shape.pinacoid") == 0);
  CHECK(errors_of(small_spec(HullVertices{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}})).find("shape.hull") ==
        0);
  CHECK(errors_of(small_spec(Mixture{{{1.0, CubeSize{-1}}}})).find("shape.mixture component 1") ==
        0);
  PackingSpec placed = small_spec(flat_and_isometric());
  placed.fill = PlacedGrains{{{2, 2, 1, 0.5}}, {{0, 0, 0, 1}}};
  CHECK(errors_of(placed).find("fill.file does not say which grain is of which component") == 0);
  std::get<PlacedGrains>(placed.fill).components = {2};
  CHECK(errors_of(placed).find("fill.file grain 1 is of no component") == 0);
  std::get<PlacedGrains>(placed.fill).components = {1};
  CHECK(errors_of(placed).empty());
  PackingSpec tight = small_spec();
  tight.box.width = 1.2;  // the circumscribed ball is 1.41 d across
  CHECK(errors_of(tight).find("box.width") == 0);
}

TEST_CASE("placed grains need an orientation each unless they are spheres, which have none") {
  const auto errors_of = [](const ShapeSpec& shape, const PlacedGrains& placed) {
    PackingSpec spec = small_spec(shape);
    spec.fill = placed;
    const auto errors = check(spec);
    return errors.empty() ? std::string() : errors.front().message;
  };
  const PlacedGrains bare{{{2, 2, 1, 0.5}}}, turned{{{2, 2, 1, 0.5}}, {{0, 0, 0, 1}}};
  CHECK(errors_of(SphereShape{}, bare).empty());
  CHECK(errors_of(PinacoidSize{}, turned).empty());
  CHECK(errors_of(SphereShape{}, turned).find("spheres have no orientation") == 0);
  CHECK(errors_of(PinacoidSize{}, bare).find("non-spherical grains need") == 0);
  const PlacedGrains stretched{{{2, 2, 1, 0.5}}, {{0, 0, 1, 1}}};
  CHECK(errors_of(PinacoidSize{}, stretched).find("unit quaternion") != std::string::npos);
}

}  // namespace
}  // namespace grainsweep
