#include "runner/export/surfaces.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "engine/units.hpp"
#include "runner/export/bridges.hpp"
#include "runner/export/caps.hpp"

namespace grainsweep {
namespace {

using Sides = std::pair<std::int32_t, std::int32_t>;  // the ends of an edge

std::int32_t next_corner(const std::vector<Vector>& vertices) {
  return static_cast<std::int32_t>(vertices.size());
}

Surface icosahedron() {
  const double golden = (1.0 + std::sqrt(5.0)) / 2.0;
  Surface surface;
  for (const double one : {-1.0, 1.0}) {
    for (const double two : {-golden, golden}) {
      for (const Vector& v : {Vector(0, one, two), Vector(one, two, 0), Vector(two, 0, one)}) {
        surface.vertices.push_back(v.normalized());
      }
    }
  }
  // Three corners an edge apart are a face; each is found once, and turned outwards.
  const double longest = 1.2;  // an edge is 1.05, the next distance 1.7
  const auto near = [&](std::int32_t a, std::int32_t b) {
    return (corner(surface, a) - corner(surface, b)).norm() < longest;
  };
  for (std::int32_t a = 0; a < 12; ++a) {
    for (std::int32_t b = a + 1; b < 12; ++b) {
      for (std::int32_t c = b + 1; c < 12; ++c) {
        if (!near(a, b) || !near(b, c) || !near(c, a)) continue;
        const Vector &p = corner(surface, a), &q = corner(surface, b), &r = corner(surface, c);
        const bool outward = (q - p).cross(r - p).dot(p) > 0.0;
        surface.faces.push_back(outward ? std::vector{a, b, c} : std::vector{a, c, b});
      }
    }
  }
  return surface;
}

/// Each triangle in four, the new corners on the unit sphere.
Surface divided(const Surface& coarse) {
  Surface fine{coarse.vertices, {}};
  std::map<Sides, std::int32_t> middles;
  const auto middle = [&](std::int32_t a, std::int32_t b) {
    const auto [known, is_new] = middles.try_emplace(std::minmax(a, b), next_corner(fine.vertices));
    if (is_new) {
      fine.vertices.push_back((corner(coarse, a) + corner(coarse, b)).normalized());
    }
    return known->second;
  };
  for (const auto& face : coarse.faces) {
    const std::int32_t a = face[0], b = face[1], c = face[2];
    const std::int32_t ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
    fine.faces.insert(fine.faces.end(), {{a, ab, ca}, {b, bc, ab}, {c, ca, bc}, {ab, bc, ca}});
  }
  return fine;
}

/// A closed loop of the edges, each of which begins where another ends.
std::vector<std::int32_t> loop_of(const std::map<std::int32_t, std::int32_t>& next) {
  std::vector<std::int32_t> loop;
  for (std::int32_t at = next.begin()->first; loop.size() < next.size(); at = next.at(at)) {
    loop.push_back(at);
  }
  return loop;
}

void scale(Surface& surface, double by) {
  for (Vector& vertex : surface.vertices) vertex *= by;
}

void shift(Surface& surface, const Vector& by) {
  for (Vector& vertex : surface.vertices) vertex += by;
}

/// Lowest and highest corner along an axis.
std::pair<double, double> extent_along(const Surface& surface, int axis) {
  const auto [low, high] =
      std::minmax_element(surface.vertices.begin(), surface.vertices.end(),
                          [&](const Vector& a, const Vector& b) { return a[axis] < b[axis]; });
  return {(*low)[axis], (*high)[axis]};
}

/// By how many periods of an axis images of the surface lie in the box, 0 first.
std::vector<double> image_shifts(const Surface& surface, int axis, double period) {
  if (period == 0.0) return {0.0};
  std::vector<double> shifts = {0.0};
  const auto [low, high] = extent_along(surface, axis);
  if (low < 0.0) shifts.push_back(period);
  if (high > period) shifts.push_back(-period);
  return shifts;
}

void append_with_images(const StoredBed& bed, std::size_t grain, const Surface& surface,
                        std::vector<GrainSurface>& surfaces) {
  for (const double x : image_shifts(surface, 0, bed.box.period_x())) {
    for (const double y : image_shifts(surface, 1, bed.box.period_y())) {
      surfaces.push_back({grain, 1, surface});
      shift(surfaces.back().surface, {x, y, 0.0});
    }
  }
}

/// Of the prism around a tube.
constexpr int corners_of_tube = 128;

/// A prism over a polygon, counter-clockwise seen from above, from the floor up: its sides, that
/// from corner k to the next one first for k = 0, its bottom, its top.
Surface prism(const std::vector<Eigen::Vector2d>& polygon, double height) {
  Surface surface;
  const auto corners = static_cast<std::int32_t>(polygon.size());
  std::vector<std::int32_t> bottom, top;
  for (const double z : {0.0, height}) {
    for (const auto& p : polygon) surface.vertices.emplace_back(p.x(), p.y(), z);
  }
  for (std::int32_t k = 0; k < corners; ++k) {
    const std::int32_t next = (k + 1) % corners;
    surface.faces.push_back({k, next, corners + next, corners + k});
    bottom.insert(bottom.begin(), k);
    top.push_back(corners + k);
  }
  surface.faces.push_back(bottom);
  surface.faces.push_back(top);
  return surface;
}

}  // namespace

Surface unit_ball(int divisions) {
  Surface ball = icosahedron();
  for (int k = 0; k < divisions; ++k) ball = divided(ball);
  return ball;
}

Mesh drawn_mesh(const Mesh& mesh, int divisions) {
  if (!mesh.is_ball()) return mesh;
  constexpr double radius = 0.5;  // of a sphere of size 1, d
  const Surface ball = unit_ball(divisions);
  Mesh drawn{{}, ball.faces};
  for (const Vector& v : ball.vertices) {
    drawn.vertices.push_back({radius * v.x(), radius * v.y(), radius * v.z()});
  }
  return drawn;
}

Surface compact(const Surface& surface) {
  Surface small;
  std::map<std::int32_t, std::int32_t> number;
  for (const auto& face : surface.faces) {
    std::vector<std::int32_t>& corners = small.faces.emplace_back();
    for (const std::int32_t k : face) {
      const auto [known, is_new] = number.try_emplace(k, next_corner(small.vertices));
      if (is_new) small.vertices.push_back(corner(surface, k));
      corners.push_back(known->second);
    }
  }
  return small;
}

Surface cut_off(const Surface& surface, const Vector& normal, double offset) {
  std::vector<double> beyond;
  for (const Vector& vertex : surface.vertices) beyond.push_back(normal.dot(vertex) - offset);
  if (*std::max_element(beyond.begin(), beyond.end()) <= 0.0) return surface;
  Surface left{surface.vertices, {}};
  std::map<Sides, std::int32_t> cuts;
  std::map<std::int32_t, std::int32_t> next;  // of the corners of the new face
  for (const auto& face : surface.faces) {
    std::vector<std::int32_t> corners;
    std::int32_t enters = -1, leaves = -1;
    for (std::size_t k = 0; k < face.size(); ++k) {
      const std::int32_t from = face[k], to = face[(k + 1) % face.size()];
      const double here = beyond[static_cast<std::size_t>(from)];
      const double there = beyond[static_cast<std::size_t>(to)];
      if (here <= 0.0) corners.push_back(from);
      if ((here <= 0.0) == (there <= 0.0)) continue;
      const auto [known, is_new] =
          cuts.try_emplace(std::minmax(from, to), next_corner(left.vertices));
      if (is_new) {
        left.vertices.emplace_back(corner(surface, from) +
                                   here / (here - there) *
                                       (corner(surface, to) - corner(surface, from)));
      }
      corners.push_back(known->second);
      (here <= 0.0 ? leaves : enters) = known->second;
    }
    if (corners.size() >= 3) left.faces.push_back(corners);
    if (leaves >= 0) next[enters] = leaves;
  }
  if (left.faces.empty()) return {};
  left.faces.push_back(loop_of(next));
  return compact(left);
}

std::vector<Surface> whole_surfaces(const ExportedBed& exported) {
  const StoredBed& bed = exported.bed;
  // 320 triangles; the flat ends of caps, and necks, take smaller ones.
  using Kind = ContactTreatment::Kind;
  const Kind kind = exported.settings.treatment.kind;
  const Surface ball = unit_ball(kind == Kind::cap || kind == Kind::bridge ? 3 : 2);
  std::vector<Surface> surfaces;
  for (std::size_t k = 0; k < bed.grains.size(); ++k) {
    if (is_sphere(bed, k)) {
      surfaces.push_back(ball);
      scale(surfaces.back(), bed.grains[k].radius);
    } else {
      surfaces.push_back({vertices_about_centre(bed, k), bed.turned->mesh(k).faces});
    }
  }
  return surfaces;
}

std::vector<GrainSurface> grain_surfaces(const ExportedBed& exported) {
  const StoredBed& bed = exported.bed;
  const ContactTreatment& treatment = exported.settings.treatment;
  if (treatment.kind == ContactTreatment::Kind::bridge) return bridged_surfaces(exported);
  std::vector<Surface> surfaces = whole_surfaces(exported);
  if (treatment.kind == ContactTreatment::Kind::shrink) {
    for (Surface& surface : surfaces) scale(surface, treatment.share);
  }
  if (treatment.kind == ContactTreatment::Kind::cap) cut_caps(exported, surfaces);
  std::vector<GrainSurface> placed;
  for (std::size_t k = 0; k < surfaces.size(); ++k) {
    shift(surfaces[k], centre_in_box(bed, k));
    if (exported.settings.periodic_images) {
      append_with_images(bed, k, surfaces[k], placed);
    } else {
      placed.push_back({k, 1, surfaces[k]});
    }
  }
  return placed;
}

Surface container_surface(const Box& box, double height) {
  if (!box.is_tube) {
    return prism({{0, 0}, {box.length, 0}, {box.length, box.width}, {0, box.width}}, height);
  }
  const double radius = box.length / 2.0, reach = radius / std::cos(pi / corners_of_tube);
  std::vector<Eigen::Vector2d> polygon;
  for (int k = 0; k < corners_of_tube; ++k) {
    const double angle = 2.0 * pi * k / corners_of_tube;
    polygon.emplace_back(radius + reach * std::cos(angle), radius + reach * std::sin(angle));
  }
  return prism(polygon, height);
}

std::vector<std::string> container_parts(const Box& box) {
  const auto side = [](Boundary boundary, const char* periodic) {
    return std::string(boundary == Boundary::walls ? "container_walls" : periodic);
  };
  std::vector<std::string> parts(static_cast<std::size_t>(corners_of_tube), "container_walls");
  if (!box.is_tube) {
    const std::string x = side(box.x, "container_periodic_x");
    const std::string y = side(box.y, "container_periodic_y");
    parts = {y, x, y, x};
  }
  parts.insert(parts.end(), {"container_floor", "container_top"});
  return parts;
}

}  // namespace grainsweep
