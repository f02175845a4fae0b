#include <cmath>

#include "engine/dynamics/presets.hpp"
#include "engine/scene/start.hpp"
#include "tests/extremes/accuracy_names.hpp"
#include "tests/extremes/catalogue.hpp"
#include "tests/extremes/judge.hpp"
#include "tests/extremes/packed.hpp"
#include "tests/support/scenes.hpp"

namespace grainsweep::extremes {

namespace {

Finding settle_any(const Box& box, const Spheres& spheres, const Accuracy& accuracy) {
  PackingSpec spec = small_spec(1, accuracy);
  spec.box = {box.length, box.width, box.x, box.y};
  spec.fill = PlacedGrains{spheres};
  return pack(spec);
}

/// A cubic lattice of `side`^3 spheres of diameter 1, `spacing` apart.
Spheres cubic(int side, double spacing) {
  Spheres spheres;
  for (int k = 0; k < side * side * side; ++k) {
    const int x = k % side, y = k / side % side, z = k / side / side;
    spheres.push_back({0.6 + x * spacing, 0.6 + y * spacing, 0.5 + z * spacing, 0.5});
  }
  return spheres;
}

/// A random bed of 60 grains moved by x and z.
Spheres cluster(double x, double z) {
  const SphereBed bed = *start<Sphere>(small_spec(60, {}));
  Spheres spheres;
  for (std::size_t i = 0; i < bed.grains(); ++i) {
    const Record<double>& p = bed.position[i];
    spheres.push_back({x + p.x, p.y, z + p.z, p.w});
  }
  return spheres;
}

Spheres on_one_spot(int grains) {
  return Spheres(static_cast<std::size_t>(grains), {2, 2, 0.5, 0.5});
}

Scene placed(const std::string& name, const std::string& extreme, const NamedAccuracy& at,
             const Box& box, const Spheres& spheres, Outcome expected) {
  return {"starts", name,     extreme,
          at.name,  expected, [=] { return settle_any(box, spheres, at.accuracy); }};
}

/// Settles a bed, and what came out again.
Finding settle_twice(const Accuracy& accuracy) {
  SettledBed first = settle_scene(*start<Sphere>(small_spec(120, accuracy)), accuracy);
  if (!first.report.failure.empty()) return finding_of(first, {});
  SphereBed again = first.bed;
  for (std::size_t i = 0; i < again.grains(); ++i) again.motion[i] = {0, 0, 0, again.motion[i].w};
  const SettledBed second = settle_scene(again, accuracy);
  double moved = 0.0;
  for (std::size_t i = 0; i < again.grains(); ++i) {
    const Record<double>&p = first.bed.position[i], &q = second.bed.position[i];
    moved += std::hypot(p.x - q.x, p.y - q.y, p.z - q.z) / static_cast<double>(again.grains());
  }
  const double steps = static_cast<double>(second.report.steps) * last_step(accuracy);
  return finding_of(second,
                    {{"mean motion of a grain, d", moved,
                      steps * std::sqrt(2.0 * accuracy.kinetic_tolerance / 0.9),
                      "what the kinetic energy at rest lets grains creep in as many steps"}});
}

/// A lone grain stays where it stands and carries itself.
Finding settle_alone(const Box& box, const PlacedSphere& sphere, double x, double y,
                     const Accuracy& accuracy) {
  const SettledBed settled = settle_scene(make_bed(box, {sphere}), accuracy);
  const Record<double>& p = settled.bed.position[0];
  const double gap = gap_bound(accuracy, 1.0 / settled.bed.motion[0].w);
  return finding_of(
      settled,
      {{"its place, d", std::hypot(p.x - x, p.y - y, p.z - sphere.radius), gap, "a row's residual"},
       {"its weight on the floor", std::abs(settled.on_floor() - settled.weight()),
        accuracy.residual_tolerance, "a row's residual"}});
}

Scene alone(const std::string& name, const std::string& extreme, const NamedAccuracy& at,
            const Box& box, const PlacedSphere& sphere) {
  return {
      "starts",       name,
      extreme,        at.name,
      Outcome::right, [=] { return settle_alone(box, sphere, sphere.x, sphere.y, at.accuracy); }};
}

NamedAccuracy patient(const char* name) {
  NamedAccuracy at = at_preset(name);
  at.accuracy.max_steps = 20'000;
  at.name += ", 20,000 steps";
  return at;
}

void add_overlaps(std::vector<Scene>& scenes) {
  const Box box{4, 4, testing::periodic, testing::walls};
  for (const char* name : {"fast", "balanced", "accurate"}) {
    const NamedAccuracy at = at_preset(name);
    scenes.push_back(placed("lattice in itself", "all neighbours overlap by 50 %", at, box,
                            cubic(5, 0.5), Outcome::not_settled));
    for (const int grains : {2, 3, 10, 60}) {
      scenes.push_back(placed(std::to_string(grains) + " grains on one spot", "coincident centres",
                              at, box, on_one_spot(grains), Outcome::refused));
    }
  }
}

void add_balanced_starts(std::vector<Scene>& scenes) {
  for (const NamedAccuracy& at : {at_preset("balanced"), at_preset("accurate"), tight()}) {
    const Box cube{4, 4, testing::periodic, testing::periodic};
    Spheres lattice;
    for (const PlacedSphere& s : cubic(4, 1.0)) lattice.push_back({s.x - 0.1, s.y - 0.1, s.z, 0.5});
    scenes.push_back(placed("simple cubic lattice", "balanced without being stable", at, cube,
                            lattice, Outcome::not_settled));
    Spheres pole;
    for (int k = 0; k < 10; ++k) pole.push_back({2, 2, 0.5 + k, 0.5});
    scenes.push_back(placed("pole of ten", "stands by symmetry alone", at,
                            {4, 4, testing::periodic, testing::walls}, pole, Outcome::refused));
    scenes.push_back({"starts", "a bed at rest", "nothing moves", at.name, Outcome::right,
                      [at] { return settle_twice(at.accuracy); }});
  }
}

void add_starts_in_places(std::vector<Scene>& scenes) {
  const Box room{4, 4, testing::walls, testing::walls},
      pipe{10000, 4, testing::periodic, testing::walls};
  for (const char* name : {"fast", "balanced", "accurate"}) {
    const NamedAccuracy at = at_preset(name);
    scenes.push_back(alone("a grain in a corner", "touches two walls and the floor", at, room,
                           {0.5, 0.5, 0.5, 0.5}));
    scenes.push_back(alone("a grain at the far end", "x = 9999 d", at, pipe, {9999, 2, 3, 0.5}));
    scenes.push_back(placed("a bed at the far end", "x = 9994 to 9998 d", at, pipe,
                            cluster(9994, 0), Outcome::refused));
  }
  scenes.push_back(alone("a grain from far above", "falls 1000 d", patient("balanced"), room,
                         {2, 2, 1000.5, 0.5}));
  scenes.push_back(alone("a grain from as far as it goes", "falls 9999 d",
                         [] {
                           NamedAccuracy at = patient("balanced");
                           at.accuracy.max_steps = 100'000;
                           at.name = "balanced, 100,000 steps";
                           return at;
                         }(),
                         room, {2, 2, 9999.5, 0.5}));
  scenes.push_back(placed("a bed from far above", "falls 1000 d", at_preset("balanced"),
                          {4, 4, testing::periodic, testing::walls}, cluster(0, 1000),
                          Outcome::not_settled));
  scenes.push_back(placed("a bed from far above, with time", "falls 1000 d", patient("balanced"),
                          {4, 4, testing::periodic, testing::walls}, cluster(0, 1000),
                          Outcome::right));
}

}  // namespace

std::vector<Scene> starts() {
  std::vector<Scene> scenes;
  add_overlaps(scenes);
  add_balanced_starts(scenes);
  add_starts_in_places(scenes);
  return scenes;
}

}  // namespace grainsweep::extremes
