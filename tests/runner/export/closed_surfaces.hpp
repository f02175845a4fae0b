// What tests ask of surfaces.
#pragma once

#include <algorithm>
#include <array>
#include <map>
#include <set>
#include <utility>
#include <vector>

#include <Eigen/Geometry>

#include "runner/export/surfaces.hpp"

namespace grainsweep {

/// How often faces run through each of their edges in each direction.
inline std::map<std::pair<std::int32_t, std::int32_t>, int> directed_edges(const Surface& surface) {
  std::map<std::pair<std::int32_t, std::int32_t>, int> edges;
  for (const auto& face : surface.faces) {
    for (std::size_t k = 0; k < face.size(); ++k) {
      ++edges[{face[k], face[(k + 1) % face.size()]}];
    }
  }
  return edges;
}

/// Whether each edge of each face is that of one other face, run through the other way.
inline bool is_closed(const Surface& surface) {
  const auto edges = directed_edges(surface);
  return !edges.empty() && std::all_of(edges.begin(), edges.end(), [&](const auto& edge) {
    const auto back = edges.find({edge.first.second, edge.first.first});
    return edge.second == 1 && back != edges.end();
  });
}

/// Volume within, d^3.
inline double volume_of(const Surface& surface) {
  double six = 0.0;
  for (const auto& face : surface.faces) {
    for (std::size_t k = 2; k < face.size(); ++k) {
      six += corner(surface, face[0])
                 .dot(corner(surface, face[k - 1]).cross(corner(surface, face[k])));
    }
  }
  return six / 6.0;
}

/// Corners less edges plus faces.
inline int euler_characteristic(const Surface& surface) {
  return static_cast<int>(surface.vertices.size()) -
         static_cast<int>(directed_edges(surface).size() / 2) +
         static_cast<int>(surface.faces.size());
}

using Triangle3 = std::array<Eigen::Vector3d, 3>;

inline std::vector<Triangle3> triangles_in(const std::vector<GrainSurface>& surfaces) {
  std::vector<Triangle3> triangles;
  for (const GrainSurface& body : surfaces) {
    for (const auto& face : body.surface.faces) {
      for (std::size_t k = 2; k < face.size(); ++k) {
        triangles.push_back({corner(body.surface, face[0]), corner(body.surface, face[k - 1]),
                             corner(body.surface, face[k])});
      }
    }
  }
  return triangles;
}

/// Whether a side of the first triangle goes through the second one; sides with an end at a corner
/// of that do not count.
inline bool pierces(const Triangle3& one, const Triangle3& other) {
  const Eigen::Vector3d normal = (other[1] - other[0]).cross(other[2] - other[0]);
  for (std::size_t k = 0; k < 3; ++k) {
    const Eigen::Vector3d &from = one[k], &to = one[(k + 1) % 3];
    const auto is_end = [&](const Eigen::Vector3d& at) { return at == from || at == to; };
    if (std::any_of(other.begin(), other.end(), is_end)) continue;
    const double here = normal.dot(from - other[0]), there = normal.dot(to - other[0]);
    if (here * there > 0.0 || here == there) continue;
    const Eigen::Vector3d at = from + here / (here - there) * (to - from);
    bool is_inside = true;
    for (std::size_t j = 0; j < 3; ++j) {
      const Eigen::Vector3d side = other[(j + 1) % 3] - other[j];
      is_inside = is_inside && side.cross(at - other[j]).dot(normal) >= 0.0;
    }
    if (is_inside) return true;
  }
  return false;
}

/// Pairs of triangles that go through each other, every one against every other that its extent
/// along x meets.
inline int crossings(const std::vector<GrainSurface>& surfaces) {
  struct Bounded {
    Triangle3 triangle;
    Eigen::AlignedBox3d box;
  };
  std::vector<Bounded> all;
  for (const Triangle3& triangle : triangles_in(surfaces)) {
    Eigen::AlignedBox3d box;
    for (const Eigen::Vector3d& at : triangle) box.extend(at);
    all.push_back({triangle, box});
  }
  std::sort(all.begin(), all.end(), [](const Bounded& one, const Bounded& other) {
    return one.box.min().x() < other.box.min().x();
  });
  int count = 0;
  for (auto one = all.begin(); one != all.end(); ++one) {
    for (auto other = one + 1; other != all.end(); ++other) {
      if (other->box.min().x() > one->box.max().x()) break;
      if (!one->box.intersects(other->box)) continue;
      count += pierces(one->triangle, other->triangle) || pierces(other->triangle, one->triangle);
    }
  }
  return count;
}

}  // namespace grainsweep
