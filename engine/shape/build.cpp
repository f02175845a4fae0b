#include "engine/shape/build.hpp"

#include <algorithm>
#include <map>
#include <utility>

#include <Eigen/Geometry>

#include "engine/units.hpp"

namespace grainsweep {

namespace {

// Directions closer than this are one: far above the rounding of a cross product, and far below
// what could change the depth of an overlap.
constexpr double same_direction = 1e-14;

const Vector& at(const std::vector<Vector>& vertices, std::int32_t k) {
  return vertices[static_cast<std::size_t>(k)];
}

void add_face(const std::vector<std::int32_t>& loop, ConvexShape& shape) {
  Face face;
  face.normal = area_vector(shape.vertices, loop).normalized();
  face.offset = reach_along(shape, face.normal);
  face.first = static_cast<std::int32_t>(shape.loops.size());
  face.corners = static_cast<std::int32_t>(loop.size());
  shape.faces.push_back(face);
  shape.loops.insert(shape.loops.end(), loop.begin(), loop.end());
  for (std::size_t k = 0; k < loop.size(); ++k) {
    const Vector& from = at(shape.vertices, loop[k]);
    const Vector& to = at(shape.vertices, loop[(k + 1) % loop.size()]);
    const Vector outward = (to - from).cross(face.normal).normalized();
    shape.sides.push_back({outward, outward.dot(from)});
  }
}

/// Number of a direction among the distinct ones; a new one is added.
std::int32_t direction_number(const Vector& direction, std::vector<Vector>& distinct) {
  const auto same = [&](const Vector& other) {
    return other.cross(direction).norm() < same_direction;
  };
  const auto found = std::find_if(distinct.begin(), distinct.end(), same);
  const auto number = static_cast<std::int32_t>(found - distinct.begin());
  if (found == distinct.end()) {
    distinct.push_back(direction);
  }
  return number;
}

/// Every edge is met once in each direction; it is listed where it is met first.
void add_edges(const Loops& loops, ConvexShape& shape) {
  std::map<std::pair<std::int32_t, std::int32_t>, std::size_t> met;
  for (std::size_t f = 0; f < loops.size(); ++f) {
    for (std::size_t k = 0; k < loops[f].size(); ++k) {
      const std::int32_t from = loops[f][k], to = loops[f][(k + 1) % loops[f].size()];
      const auto back = met.find({to, from});
      if (back != met.end()) {
        shape.edges[back->second].right = static_cast<std::int32_t>(f);
        continue;
      }
      met[{from, to}] = shape.edges.size();
      const Vector along = (at(shape.vertices, to) - at(shape.vertices, from)).normalized();
      shape.edges.push_back({from, to, static_cast<std::int32_t>(f), -1,
                             direction_number(along, shape.edge_directions), along});
    }
  }
}

void add_vertex_faces(const Loops& loops, ConvexShape& shape) {
  for (std::size_t v = 0; v < shape.vertices.size(); ++v) {
    shape.vertex_faces_begin.push_back(static_cast<std::int32_t>(shape.vertex_faces.size()));
    for (std::size_t f = 0; f < loops.size(); ++f) {
      if (std::count(loops[f].begin(), loops[f].end(), static_cast<std::int32_t>(v)) > 0) {
        shape.vertex_faces.push_back(static_cast<std::int32_t>(f));
      }
    }
  }
  shape.vertex_faces_begin.push_back(static_cast<std::int32_t>(shape.vertex_faces.size()));
}

void add_flat_with(ConvexShape& shape) {
  for (const Face& face : shape.faces) {
    shape.flat_with_begin.push_back(static_cast<std::int32_t>(shape.flat_with.size()));
    for (std::size_t f = 0; f < shape.faces.size(); ++f) {
      const Face& other = shape.faces[f];
      const bool is_nearly = (other.normal - face.normal).norm() < nearly_flat;
      if (&other != &face && is_nearly) shape.flat_with.push_back(static_cast<std::int32_t>(f));
    }
  }
  shape.flat_with_begin.push_back(static_cast<std::int32_t>(shape.flat_with.size()));
}

void add_radii(ConvexShape& shape) {
  for (const Vector& vertex : shape.vertices) {
    shape.circumradius = std::max(shape.circumradius, vertex.norm());
  }
  shape.inradius = shape.circumradius;
  for (const Face& face : shape.faces) {
    shape.inradius = std::min(shape.inradius, face.offset);
  }
}

void add_columns(ConvexShape& shape) {
  for (const Vector& vertex : shape.vertices) shape.corner_columns.add(vertex);
  for (const Face& face : shape.faces) {
    shape.normal_columns.add(face.normal);
    shape.offset_columns.push_back(face.offset);
  }
  shape.offset_columns.resize(shape.normal_columns.padded(), infinity);
}

}  // namespace

Vector area_vector(const std::vector<Vector>& vertices, const std::vector<std::int32_t>& loop) {
  Vector sum = Vector::Zero();
  const Vector& origin = at(vertices, loop.front());
  for (std::size_t k = 1; k + 1 < loop.size(); ++k) {
    sum += (at(vertices, loop[k]) - origin).cross(at(vertices, loop[k + 1]) - origin);
  }
  return sum / 2.0;
}

double surface_area(const ConvexShape& shape) {
  if (shape.is_ball) return 4.0 * pi * shape.inradius * shape.inradius;
  double area = 0.0;
  for (const Face& face : shape.faces) {
    const std::span<const std::int32_t> corners = corners_of(shape, face);
    area += area_vector(shape.vertices, {corners.begin(), corners.end()}).norm();
  }
  return area;
}

/// Tetrahedra from the origin to the triangles of each face. With corners p, q, r and S = p + q + r
/// one of them has 6 V = p . (q x r), 24 V mean(x) = 6 V S, 120 times the integral of x x^T =
/// 6 V (p p^T + q q^T + r r^T + S S^T).
MassMoments mass_moments(const std::vector<Vector>& vertices, const Loops& loops) {
  double volume = 0.0;
  Vector first = Vector::Zero();
  Matrix second = Matrix::Zero();
  for (const auto& loop : loops) {
    for (std::size_t k = 1; k + 1 < loop.size(); ++k) {
      const Vector &p = at(vertices, loop[0]), &q = at(vertices, loop[k]),
                   &r = at(vertices, loop[k + 1]);
      const double six_volumes = p.dot(q.cross(r));
      const Vector sum = p + q + r;
      volume += six_volumes / 6.0;
      first += six_volumes / 24.0 * sum;
      second += six_volumes / 120.0 *
                (p * p.transpose() + q * q.transpose() + r * r.transpose() + sum * sum.transpose());
    }
  }
  return {volume, first / volume, second / volume};
}

Matrix inertia_of(const Matrix& second) { return second.trace() * Matrix::Identity() - second; }

ConvexShape build_shape(std::vector<Vector> vertices, const Loops& loops) {
  const MassMoments moments = mass_moments(vertices, loops);
  ConvexShape shape;
  shape.vertices = std::move(vertices);
  for (const auto& loop : loops) {
    add_face(loop, shape);
  }
  add_edges(loops, shape);
  add_vertex_faces(loops, shape);
  add_flat_with(shape);
  shape.volume = moments.volume;
  shape.inertia = inertia_of(moments.second).diagonal();
  add_radii(shape);
  add_columns(shape);
  return shape;
}

}  // namespace grainsweep
