#include "engine/shape/hull.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <set>
#include <stdexcept>
#include <utility>

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <libqhull_r/qhull_ra.h>

#include "engine/shape/build.hpp"
#include "engine/text.hpp"
#include "engine/units.hpp"

namespace grainsweep {

namespace {

// Shares of the largest distance between points. Thinner is flat: the hull would have no inside
// that f64 resolves well. Deeper inside is a dent; less is a point on a face or an edge.
constexpr double flat_share = 1e-9;
constexpr double dent = 1e-6;
// How far corners of flat faces may lie off their planes by rounding.
constexpr double in_plane = 1e-13;
// Places this many extents from the origin lose digits that products of them need.
constexpr double far_off = 1e3;
// Products of inertia below this share of the trace are rounding: the frame is principal already.
constexpr double principal = 1e-13;

/// By number: the places are in d here, perhaps not where they were written.
std::string named(const std::vector<Vector>& points, std::size_t k) {
  return joined("vertex ", k + 1, " of ", points.size());
}

std::string problem_with_numbers(const std::vector<Vector>& points) {
  for (std::size_t k = 0; k < points.size(); ++k) {
    if (!points[k].allFinite()) {
      return named(points, k) + " must have finite coordinates";
    }
  }
  return "";
}

std::string problem_with_twins(const std::vector<Vector>& points) {
  for (std::size_t k = 0; k < points.size(); ++k) {
    for (std::size_t j = 0; j < k; ++j) {
      if (points[j] == points[k]) {
        return joined(named(points, k), " is there twice, also as vertex ", j + 1,
                      "; remove one of them");
      }
    }
  }
  return "";
}

/// The point for which `measure` is largest.
template <class Measure>
const Vector& farthest(const std::vector<Vector>& points, Measure measure) {
  return *std::max_element(points.begin(), points.end(), [&](const Vector& p, const Vector& q) {
    return measure(p) < measure(q);
  });
}

/// Largest distances of points from the first one, from a line through that, and from a plane
/// through both: 0 where the points span no more.
struct Extents {
  double length, width, height;
};

Extents extents_of(const std::vector<Vector>& points) {
  const Vector& o = points.front();
  const auto from_point = [&](const Vector& p) { return (p - o).norm(); };
  const Vector along = farthest(points, from_point) - o;
  const double length = along.norm();
  const Vector u = length > 0.0 ? Vector(along / length) : Vector(Vector::UnitX());
  const auto from_line = [&](const Vector& p) { return (p - o).cross(u).norm(); };
  const Vector across = u.cross(farthest(points, from_line) - o);
  const double width = across.norm();
  const Vector n = width > 0.0 ? Vector(across / width) : Vector(Vector::Zero());
  const auto from_plane = [&](const Vector& p) { return std::abs((p - o).dot(n)); };
  return {length, width, from_plane(farthest(points, from_plane))};
}

std::string problem_with_extents(const Extents& extents) {
  const char* where = extents.width <= flat_share * extents.length    ? "a line"
                      : extents.height <= flat_share * extents.length ? "a plane"
                                                                      : nullptr;
  if (where == nullptr) return "";
  return joined("the vertices lie on ", where, ", so that the hull has no volume");
}

std::string problem_with_points(const std::vector<Vector>& points) {
  if (points.size() < 4) {
    return joined("a hull needs at least 4 vertices, has ", points.size());
  }
  std::string problem = problem_with_numbers(points);
  if (problem.empty()) problem = problem_with_twins(points);
  return problem.empty() ? problem_with_extents(extents_of(points)) : problem;
}

/// Corners of a facet, counter-clockwise about its outward normal.
std::vector<std::int32_t> ordered_corners(qhT* qhull, const facetT& facet,
                                          const std::vector<Vector>& points) {
  std::vector<std::int32_t> corners;
  for (int k = 0; k < qh_setsize(qhull, facet.vertices); ++k) {
    const auto* vertex = static_cast<const vertexT*>(facet.vertices->e[k].p);
    corners.push_back(qh_pointid(qhull, vertex->point));
  }
  Vector centre = Vector::Zero();
  for (const std::int32_t k : corners) {
    centre += points[static_cast<std::size_t>(k)] / static_cast<double>(corners.size());
  }
  const Vector normal(facet.normal);
  const Vector u = (points[static_cast<std::size_t>(corners[0])] - centre).normalized();
  const Vector v = normal.cross(u);
  const auto angle = [&](std::int32_t k) {
    const Vector from_centre = points[static_cast<std::size_t>(k)] - centre;
    return std::atan2(from_centre.dot(v), from_centre.dot(u));
  };
  std::sort(corners.begin(), corners.end(),
            [&](std::int32_t j, std::int32_t k) { return angle(j) < angle(k); });
  return corners;
}

/// Vertices of fewer than three faces lie within an edge or a face and are not corners.
void drop_straight_corners(std::size_t points, Loops& loops) {
  std::vector<int> faces_at(points, 0);
  for (const auto& loop : loops) {
    for (const std::int32_t k : loop) ++faces_at[static_cast<std::size_t>(k)];
  }
  for (auto& loop : loops) {
    std::erase_if(loop, [&](std::int32_t k) { return faces_at[static_cast<std::size_t>(k)] < 3; });
  }
}

/// Qhull's state, freed at the end. Qhull is C: it reports into a stream, here one in memory.
struct QhullRun {
  qhT state = {};
  char* said = nullptr;
  std::size_t length = 0;
  std::FILE* messages = open_memstream(&said, &length);

  QhullRun() { qh_zero(&state, messages); }
  QhullRun(const QhullRun&) = delete;
  QhullRun& operator=(const QhullRun&) = delete;
  QhullRun(QhullRun&&) = delete;
  QhullRun& operator=(QhullRun&&) = delete;
  ~QhullRun() {
    int left = 0, total = 0;
    qh_freeqhull(&state, qh_ALL);
    qh_memfreeshort(&state, &left, &total);
    std::fclose(messages);
    std::free(said);  // NOLINT(cppcoreguidelines-no-malloc): open_memstream allocated it
  }
  std::string first_line() {
    std::fflush(messages);
    const std::string text(said, length);
    return text.substr(0, text.find('\n'));
  }
};

/// The faces of the hull as loops of points, those that lie within `merged`, d, of one plane as
/// one; what Qhull says if it finds none.
Loops hull_loops(const std::vector<Vector>& points, double merged, std::string& error) {
  std::vector<double> coordinates;
  coordinates.reserve(3 * points.size());
  for (const Vector& p : points) {
    coordinates.insert(coordinates.end(), p.data(), p.data() + 3);
  }
  QhullRun run;
  std::string options = merged > 0.0 ? joined("qhull C", merged) : "qhull";
  const int failure =
      qh_new_qhull(&run.state, 3, static_cast<int>(points.size()), coordinates.data(), False,
                   options.data(), nullptr, run.messages);
  if (failure != 0) {
    error = "Qhull finds no hull: " + run.first_line();
    return {};
  }
  Loops loops;
  for (const facetT* facet = run.state.facet_list; facet->next != nullptr; facet = facet->next) {
    loops.push_back(ordered_corners(&run.state, *facet, points));
  }
  drop_straight_corners(points.size(), loops);
  return loops;
}

/// Whether every edge is met once in each direction.
bool is_closed(const Loops& loops) {
  std::set<std::pair<std::int32_t, std::int32_t>> steps;
  std::size_t count = 0;
  for (const auto& loop : loops) {
    for (std::size_t k = 0; k < loop.size(); ++k, ++count) {
      steps.insert({loop[k], loop[(k + 1) % loop.size()]});
    }
  }
  return steps.size() == count && std::all_of(steps.begin(), steps.end(), [&](const auto& step) {
           return steps.contains({step.second, step.first});
         });
}

/// A plane: normal . x = offset.
struct Plane {
  Vector normal = Vector::Zero();
  double offset = 0.0;
};

/// The planes that fit the faces best.
std::vector<Plane> planes_of(const std::vector<Vector>& corners, const Loops& loops) {
  std::vector<Plane> planes(loops.size());
  for (std::size_t f = 0; f < loops.size(); ++f) {
    const Vector normal = area_vector(corners, loops[f]).normalized();
    double sum = 0.0;
    for (const std::int32_t k : loops[f]) sum += normal.dot(corners[static_cast<std::size_t>(k)]);
    planes[f] = {normal, sum / static_cast<double>(loops[f].size())};
  }
  return planes;
}

/// Depth of a point below the nearest face of the hull.
double depth_of(const Vector& point, const std::vector<Plane>& faces) {
  double depth = infinity;
  for (const Plane& face : faces) depth = std::min(depth, face.offset - face.normal.dot(point));
  return depth;
}

/// Depth of a dent that a hull of such an extent hides, if faces within `merged` of a plane are
/// one.
double allowed_dent(double extent, double merged) { return std::max(dent * extent, 2.0 * merged); }

std::string problem_with_dents(const std::vector<Vector>& points, const Loops& loops,
                               double merged) {
  const double allowed = allowed_dent(extents_of(points).length, merged);
  const std::vector<Plane> faces = planes_of(points, loops);
  for (std::size_t k = 0; k < points.size(); ++k) {
    const double depth = depth_of(points[k], faces);
    if (depth > allowed) {
      return joined(
          named(points, k), " lies inside the hull of the others, ",
          100.0 * depth / extents_of(points).length,
          " % of the shape's extent deep: the shape is not convex; remove the vertex if its "
          "hull is meant");
    }
  }
  return "";
}

/// By how much corners lie off the planes of their faces, d.
double unevenness_of(const std::vector<Plane>& planes, const std::vector<Vector>& corners,
                     const Loops& loops) {
  double most = 0.0;
  for (std::size_t f = 0; f < loops.size(); ++f) {
    for (const std::int32_t k : loops[f]) {
      const double height = planes[f].normal.dot(corners[static_cast<std::size_t>(k)]);
      most = std::max(most, std::abs(height - planes[f].offset));
    }
  }
  return most;
}

/// How deep the middle of an edge of `face` lies, or the mean of its corners if it is flat: of a
/// face of a convex shape that is a point of it, or of its plane within another one; a face that is
/// bent along a diagonal may be on the hull, and the mean of its corners in it.
double depth_of(const std::vector<std::int32_t>& face, const std::vector<Vector>& points,
                const std::vector<Plane>& planes, double allowed) {
  const auto point = [&](std::size_t k) -> const Vector& {
    return points[static_cast<std::size_t>(face[k % face.size()])];
  };
  double deepest = 0.0;
  Vector sum = Vector::Zero();
  for (std::size_t k = 0; k < face.size(); ++k) {
    deepest = std::max(deepest, depth_of(Vector((point(k) + point(k + 1)) / 2.0), planes));
    sum += point(k);
  }
  if (unevenness_of(planes_of(points, {face}), points, {face}) > allowed) return deepest;
  return std::max(deepest, depth_of(Vector(sum / static_cast<double>(face.size())), planes));
}

/// Keeps the points that are corners, in their order, and numbers the loops anew.
std::vector<Vector> keep_corners(const std::vector<Vector>& points, Loops& loops) {
  std::vector<std::int32_t> number(points.size(), -1);
  for (const auto& loop : loops) {
    for (const std::int32_t k : loop) number[static_cast<std::size_t>(k)] = 0;
  }
  std::vector<Vector> corners;
  for (std::size_t k = 0; k < points.size(); ++k) {
    if (number[k] == 0) {
      number[k] = static_cast<std::int32_t>(corners.size());
      corners.push_back(points[k]);
    }
  }
  for (auto& loop : loops) {
    for (std::int32_t& k : loop) k = number[static_cast<std::size_t>(k)];
  }
  return corners;
}

/// Faces of more than three corners at each corner.
std::vector<std::vector<std::size_t>> polygons_at(std::size_t corners, const Loops& loops) {
  std::vector<std::vector<std::size_t>> faces(corners);
  for (std::size_t f = 0; f < loops.size(); ++f) {
    if (loops[f].size() == 3) continue;
    for (const std::int32_t k : loops[f]) faces[static_cast<std::size_t>(k)].push_back(f);
  }
  return faces;
}

/// Moves corners as little as brings them onto the planes of their faces, again and again, since
/// that moves the planes, too. Faces that are flat but for rounding stay as they are.
void flatten(const Loops& loops, std::vector<Vector>& corners) {
  constexpr int most_rounds = 1000;
  const double rounding = in_plane * extents_of(corners).length;
  const auto faces = polygons_at(corners.size(), loops);
  for (int round = 0; round < most_rounds; ++round) {
    const std::vector<Plane> planes = planes_of(corners, loops);
    if (unevenness_of(planes, corners, loops) <= rounding) return;
    for (std::size_t k = 0; k < corners.size(); ++k) {
      const auto count = static_cast<Eigen::Index>(faces[k].size());
      if (count == 0) continue;
      Eigen::MatrixX3d normals(count, 3);
      Eigen::VectorXd missing(count);
      for (Eigen::Index f = 0; f < count; ++f) {
        const Plane& plane = planes[faces[k][static_cast<std::size_t>(f)]];
        normals.row(f) = plane.normal.transpose();
        missing[f] = plane.offset - plane.normal.dot(corners[k]);
      }
      corners[k] += normals.completeOrthogonalDecomposition().solve(missing);
    }
  }
}

/// Whether no corner lies above a face by more than rounding.
bool is_convex(const std::vector<Vector>& corners, const Loops& loops) {
  const double rounding = 10.0 * in_plane * extents_of(corners).length;
  const std::vector<Plane> planes = planes_of(corners, loops);
  return std::all_of(planes.begin(), planes.end(), [&](const Plane& plane) {
    return std::all_of(corners.begin(), corners.end(), [&](const Vector& corner) {
      return plane.normal.dot(corner) <= plane.offset + rounding;
    });
  });
}

/// Axes of the shape's frame in the given one: right-handed, moments ascending.
Matrix principal_axes(const Matrix& inertia) {
  const double off = std::abs(inertia(0, 1)) + std::abs(inertia(0, 2)) + std::abs(inertia(1, 2));
  if (off <= principal * inertia.trace()) {
    return Matrix::Identity();
  }
  Matrix axes = Eigen::SelfAdjointEigenSolver<Matrix>(inertia).eigenvectors();
  axes.col(2) = axes.col(0).cross(axes.col(1));
  return axes;
}

/// Moves the corners to the centroid, turns them to the principal axes.
InputFrame centre(std::vector<Vector>& corners, const Loops& loops) {
  InputFrame given;
  given.centroid = mass_moments(corners, loops).centroid;
  for (Vector& corner : corners) corner -= given.centroid;
  const Vector rest = mass_moments(corners, loops).centroid;  // what rounding left
  for (Vector& corner : corners) corner -= rest;
  given.centroid += rest;
  given.rotation = principal_axes(inertia_of(mass_moments(corners, loops).second));
  if (!given.rotation.isIdentity(0.0)) {
    for (Vector& corner : corners) corner = given.rotation.transpose() * corner;
  }
  return given;
}

Hull refused(std::string error) { return {std::nullopt, std::move(error)}; }

/// The corners and faces of a hull, or what forbids it.
struct Surface {
  std::vector<Vector> corners;
  Loops loops;
  std::string error;
};

Surface surface_of(const std::vector<Vector>& points, double flat) {
  const char* const undecided =
      "some vertices lie so nearly on one plane that rounding decides which are corners; move or "
      "remove them";
  const double merged = flat * extents_of(points).height;
  Surface surface;
  surface.loops = hull_loops(points, merged, surface.error);
  if (!surface.error.empty()) return surface;
  surface.error =
      is_closed(surface.loops) ? problem_with_dents(points, surface.loops, merged) : undecided;
  if (!surface.error.empty()) return surface;
  surface.corners = keep_corners(points, surface.loops);
  if (flat > 0.0) flatten(surface.loops, surface.corners);
  if (flat > 0.0 && !is_convex(surface.corners, surface.loops)) surface.error = undecided;
  return surface;
}

/// Faces in which only some triangles are nearly flat stay as bent as they are.
Hull whole_hull(const std::vector<Vector>& points, double flat) {
  Surface surface = surface_of(points, flat);
  if (!surface.error.empty() && flat > 0.0) surface = surface_of(points, 0.0);
  if (!surface.error.empty()) return refused(surface.error);
  const InputFrame given = centre(surface.corners, surface.loops);
  Hull hull{build_shape(std::move(surface.corners), surface.loops), ""};
  hull.shape->given = given;
  return hull;
}

}  // namespace

Hull convex_hull(const std::vector<Vector>& points, double flat) {
  const std::string problem = problem_with_points(points);
  if (!problem.empty()) {
    return refused(problem);
  }
  const double extent = extents_of(points).length;
  const bool is_far = points.front().cwiseAbs().maxCoeff() > far_off * extent;
  if (!is_far) return whole_hull(points, flat);
  std::vector<Vector> near = points;
  for (Vector& point : near) point -= points.front();
  Hull hull = whole_hull(near, flat);
  if (hull.shape) hull.shape->given.centroid += points.front();
  return hull;
}

std::optional<Dent> deepest_dent(const std::vector<Vector>& points, const Loops& faces) {
  if (!problem_with_points(points).empty()) return std::nullopt;
  std::vector<Vector> near = points;  // places far from the origin lose digits
  for (Vector& point : near) point -= points.front();
  const Extents extents = extents_of(near);
  const double merged = flat_as_written * extents.height;
  std::string error;
  const std::vector<Plane> planes = planes_of(near, hull_loops(near, merged, error));
  Dent deepest{0, allowed_dent(extents.length, merged), extents.length};
  const double allowed = deepest.depth;
  for (std::size_t f = 0; f < faces.size() && !planes.empty(); ++f) {
    const double depth = depth_of(faces[f], near, planes, allowed);
    if (depth > deepest.depth) deepest.face = f, deepest.depth = depth;
  }
  return deepest.depth > allowed ? std::optional(deepest) : std::nullopt;
}

Loops hull_faces(const std::vector<Vector>& points) {
  std::string error;
  Loops loops = hull_loops(points, 0.0, error);
  if (loops.empty()) throw std::invalid_argument(error);
  return loops;
}

}  // namespace grainsweep
