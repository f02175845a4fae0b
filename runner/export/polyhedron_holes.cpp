#include <algorithm>
#include <array>
#include <map>
#include <utility>

#include <Eigen/Geometry>

#include "engine/shape/build.hpp"
#include "runner/export/open_surfaces.hpp"

namespace grainsweep {
namespace {

constexpr std::int32_t outside_all = -1;

using Ends = std::pair<std::int32_t, std::int32_t>;

/// Where the side of a column crosses an edge.
struct Crossing {
  double along = 0.0;  ///< share of the way from the lower end of the edge to the other
  std::int32_t vertex = 0;
  std::int32_t column = 0;
};

/// A line on a face: the edge of a column, counter-clockwise.
struct Segment {
  std::int32_t from = 0, to = 0, column = 0;
};

/// A convex polyhedron on which columns are traced.
struct Trace {
  OpenSurface open;
  std::vector<Vector> normals;  ///< unit, of the faces
  std::map<Ends, std::vector<Crossing>> crossings;
  std::map<Ends, std::array<std::size_t, 2>> faces_at;  ///< of edges
  std::vector<std::vector<Segment>> segments;           ///< of faces
  std::vector<std::int32_t> column_over;                ///< of vertices, or outside_all
};

/// A column in the frame in which it is vertical, seen from outside the polyhedron.
struct Upright {
  Vector outward, x, y;
  std::vector<Eigen::Vector2d> corners;  ///< counter-clockwise

  Eigen::Vector2d flat(const Vector& v) const { return {x.dot(v), y.dot(v)}; }
};

Upright upright_of(const NeckEnd& column) {
  const Neck& neck = *column.neck;
  const Vector outward = column.outward();
  Upright upright{outward, neck.across, outward.cross(neck.across), {}};
  const Vector centre = column.is_of_b ? neck.between : Vector(Vector::Zero());
  for (int k = 0; k < neck_sides; ++k) {
    const int in_order = column.is_of_b ? (neck_sides - k) % neck_sides : k;
    upright.corners.push_back(upright.flat(neck_corner(neck, in_order, 0.0) - centre));
  }
  return upright;
}

double cross(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  return a.x() * b.y() - a.y() * b.x();
}

bool is_within(const Upright& column, const Eigen::Vector2d& p) {
  for (std::size_t k = 0; k < column.corners.size(); ++k) {
    const Eigen::Vector2d& from = column.corners[k];
    if (cross(column.corners[(k + 1) % column.corners.size()] - from, p - from) <= 0.0) {
      return false;
    }
  }
  return true;
}

/// The face that a line along the column meets, and at which height.
std::pair<std::size_t, double> face_under(const Trace& trace, const Upright& column,
                                          const Eigen::Vector2d& p) {
  constexpr double steep = 1e-9;
  const Vector foot = p.x() * column.x + p.y() * column.y;
  std::pair<std::size_t, double> lowest = {0, 1e300};
  for (std::size_t f = 0; f < trace.normals.size(); ++f) {
    const Vector& normal = trace.normals[f];
    const double slope = normal.dot(column.outward);
    if (slope < steep) continue;
    const Vector& on_face = corner(trace.open.surface, trace.open.surface.faces[f][0]);
    const double height = normal.dot(on_face - foot) / slope;
    if (height < lowest.second) lowest = {f, height};
  }
  return lowest;
}

std::int32_t added(Trace& trace, const Vector& vertex) {
  trace.open.surface.vertices.push_back(vertex);
  return static_cast<std::int32_t>(trace.open.surface.vertices.size()) - 1;
}

bool is_in_front(const Trace& trace, const std::array<std::size_t, 2>& faces,
                 const Vector& outward) {
  return trace.normals[faces[0]].dot(outward) > 0.0 || trace.normals[faces[1]].dot(outward) > 0.0;
}

/// The corners of the rim from corner k of the column up to the next one.
Loop traced_side(Trace& trace, const Upright& column, std::size_t k, std::int32_t number) {
  const Eigen::Vector2d& from = column.corners[k];
  const Eigen::Vector2d way = column.corners[(k + 1) % column.corners.size()] - from;
  const Vector foot = from.x() * column.x + from.y() * column.y;
  const double height = face_under(trace, column, from).second;
  std::vector<std::pair<double, std::int32_t>> found = {
      {0.0, added(trace, foot + height * column.outward)}};
  for (const auto& [ends, faces] : trace.faces_at) {
    if (!is_in_front(trace, faces, column.outward)) continue;
    const Vector start = corner(trace.open.surface, ends.first);
    const Vector edge = corner(trace.open.surface, ends.second) - start;
    const Eigen::Vector2d flat_edge = column.flat(edge), to_start = column.flat(start) - from;
    const double area = cross(way, flat_edge);
    if (area == 0.0) continue;
    const double of_side = cross(to_start, flat_edge) / area, along = cross(to_start, way) / area;
    if (of_side <= 0.0 || of_side >= 1.0 || along <= 0.0 || along >= 1.0) continue;
    found.emplace_back(of_side, added(trace, start + along * edge));
    trace.crossings[ends].push_back({along, found.back().second, number});
  }
  std::sort(found.begin(), found.end());
  Loop side;
  for (const auto& place : found) side.push_back(place.second);
  return side;
}

/// Marks the rim of a column on the faces.
void trace_column(Trace& trace, const Upright& column, std::int32_t number, Hole& hole) {
  const std::size_t vertices = trace.column_over.size();
  for (std::size_t k = 0; k < column.corners.size(); ++k) {
    hole.sides.push_back(traced_side(trace, column, k, number));
  }
  Loop rim;
  for (const Loop& side : hole.sides) rim.insert(rim.end(), side.begin(), side.end());
  for (std::size_t k = 0; k < rim.size(); ++k) {
    const std::int32_t from = rim[k], to = rim[(k + 1) % rim.size()];
    const Vector middle = (corner(trace.open.surface, from) + corner(trace.open.surface, to)) / 2.0;
    const std::size_t face = face_under(trace, column, column.flat(middle)).first;
    trace.segments[face].push_back({from, to, number});
  }
  for (const auto& [ends, faces] : trace.faces_at) {
    if (!is_in_front(trace, faces, column.outward)) continue;
    for (const std::int32_t k : {ends.first, ends.second}) {
      if (static_cast<std::size_t>(k) >= vertices) continue;
      const bool is_over = is_within(column, column.flat(corner(trace.open.surface, k)));
      if (is_over) trace.column_over[static_cast<std::size_t>(k)] = number;
    }
  }
}

/// Crossings of an edge in the order from one end to the other.
std::vector<Crossing> crossings_from(const Trace& trace, std::int32_t from, std::int32_t to) {
  const auto found = trace.crossings.find(std::minmax(from, to));
  if (found == trace.crossings.end()) return {};
  std::vector<Crossing> crossings = found->second;
  std::sort(crossings.begin(), crossings.end(), [&](const Crossing& p, const Crossing& q) {
    return from < to ? p.along < q.along : p.along > q.along;
  });
  return crossings;
}

using Steps = std::map<std::int32_t, std::int32_t>;  // from corner to corner

/// The boundaries of what is left of a face, and of what lies under each column.
std::map<std::int32_t, Steps> regions_of(const Trace& trace, std::size_t face) {
  std::map<std::int32_t, Steps> regions;
  const Loop& loop = trace.open.surface.faces[face];
  for (std::size_t k = 0; k < loop.size(); ++k) {
    const std::int32_t to = loop[(k + 1) % loop.size()];
    std::int32_t from = loop[k];
    std::int32_t region = trace.column_over[static_cast<std::size_t>(from)];
    for (const Crossing& crossing : crossings_from(trace, from, to)) {
      regions[region][from] = crossing.vertex;
      from = crossing.vertex;
      region = region == crossing.column ? outside_all : crossing.column;
    }
    regions[region][from] = to;
  }
  for (const Segment& segment : trace.segments[face]) {
    regions[segment.column][segment.from] = segment.to;
    regions[outside_all][segment.to] = segment.from;
  }
  return regions;
}

bool is_untouched(const std::map<std::int32_t, Steps>& regions, const Loop& face) {
  return regions.begin()->first == outside_all && regions.begin()->second.size() == face.size() &&
         regions.size() == 1;
}

std::vector<Loop> loops_of(Steps steps) {
  std::vector<Loop> loops;
  while (!steps.empty()) {
    Loop& loop = loops.emplace_back();
    for (auto at = steps.begin(); at != steps.end(); at = steps.find(loop.back())) {
      loop.push_back(at->second);
      steps.erase(at);
    }
  }
  return loops;
}

/// Sides in the order of the neck, which the polyhedron at its other end sees from the back.
std::vector<Loop> turned_round(const std::vector<Loop>& sides) {
  std::vector<Loop> turned;
  for (std::size_t k = 0; k < sides.size(); ++k) {
    const Loop& next = sides[sides.size() - k - 1];
    Loop& side = turned.emplace_back();
    side.push_back(sides[(sides.size() - k) % sides.size()].front());
    side.insert(side.end(), next.rbegin(), next.rend() - 1);
  }
  return turned;
}

Trace untraced(const Surface& convex) {
  Trace trace{{convex, {}}, {}, {}, {}, {}, {}};
  for (std::size_t f = 0; f < convex.faces.size(); ++f) {
    const Loop& loop = convex.faces[f];
    trace.normals.push_back(area_vector(convex.vertices, loop).normalized());
    for (std::size_t k = 0; k < loop.size(); ++k) {
      const std::int32_t from = loop[k], to = loop[(k + 1) % loop.size()];
      trace.faces_at[std::minmax(from, to)].at(from < to ? 0 : 1) = f;
    }
  }
  trace.segments.resize(convex.faces.size());
  trace.column_over.assign(convex.vertices.size(), outside_all);
  return trace;
}

}  // namespace

OpenSurface with_holes(const Surface& convex, const std::vector<NeckEnd>& columns) {
  if (columns.empty()) return {convex, {}};
  Trace trace = untraced(convex);
  std::vector<Hole> holes(columns.size());
  for (std::size_t k = 0; k < columns.size(); ++k) {
    holes[k].neck = columns[k].number;
    trace_column(trace, upright_of(columns[k]), static_cast<std::int32_t>(k), holes[k]);
  }
  OpenSurface open{{trace.open.surface.vertices, {}}, {}};
  for (std::size_t f = 0; f < convex.faces.size(); ++f) {
    const auto regions = regions_of(trace, f);
    if (is_untouched(regions, convex.faces[f])) {
      open.surface.faces.push_back(convex.faces[f]);
      continue;
    }
    for (const auto& [region, steps] : regions) {
      auto& faces =
          region == outside_all ? open.surface.faces : holes[static_cast<std::size_t>(region)].lid;
      for (const Loop& triangle :
           triangles_of(open.surface.vertices, trace.normals[f], loops_of(steps))) {
        faces.push_back(triangle);
      }
    }
  }
  for (std::size_t k = 0; k < columns.size(); ++k) {
    if (columns[k].is_of_b) holes[k].sides = turned_round(holes[k].sides);
  }
  open.holes = std::move(holes);
  return open;
}

}  // namespace grainsweep
