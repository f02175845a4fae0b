#include "engine/shape/hull.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <memory>
#include <set>
#include <stdexcept>
#include <utility>

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <libqhull_r/qhull_ra.h>

#include "engine/shape/build.hpp"
#include "engine/text.hpp"

namespace grainsweep {

namespace {

// Shares of the largest distance between points. Thinner is flat: the hull would have no inside
// that f64 resolves well. Deeper inside is a dent; less is a point on a face or an edge.
constexpr double flat_share = 1e-9;
constexpr double dent = 1e-6;
// Products of inertia below this share of the trace are rounding: the frame is principal already.
constexpr double principal = 1e-13;

std::string named(const std::vector<Vector>& points, std::size_t k) {
  const Vector& p = points[k];
  return joined("vertex ", k + 1, " (", p.x(), ", ", p.y(), ", ", p.z(), ")");
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

/// Vertices of fewer than three faces lie within an edge or a face and are no corners.
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

/// The faces of the hull as loops of points; what Qhull says if it finds none.
Loops hull_loops(const std::vector<Vector>& points, std::string& error) {
  std::vector<double> coordinates;
  coordinates.reserve(3 * points.size());
  for (const Vector& p : points) {
    coordinates.insert(coordinates.end(), p.data(), p.data() + 3);
  }
  QhullRun run;
  char options[] = "qhull";
  const int failure = qh_new_qhull(&run.state, 3, static_cast<int>(points.size()),
                                   coordinates.data(), False, options, nullptr, run.messages);
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

/// Depth of a point below the nearest face of the hull.
double depth_of(const Vector& point, const std::vector<Vector>& points, const Loops& loops) {
  double depth = std::numeric_limits<double>::infinity();
  for (const auto& loop : loops) {
    const auto corner = [&](std::size_t k) { return points[static_cast<std::size_t>(loop[k])]; };
    const Vector normal =
        (corner(1) - corner(0)).cross(corner(loop.size() - 1) - corner(0)).normalized();
    depth = std::min(depth, normal.dot(corner(0) - point));
  }
  return depth;
}

std::string problem_with_dents(const std::vector<Vector>& points, const Loops& loops) {
  const double allowed = dent * extents_of(points).length;
  for (std::size_t k = 0; k < points.size(); ++k) {
    const double depth = depth_of(points[k], points, loops);
    if (depth > allowed) {
      return joined(named(points, k), " lies ", depth,
                    " inside the hull of the others: the shape is not convex; remove the vertex if "
                    "its hull is meant");
    }
  }
  return "";
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

Hull whole_hull(const std::vector<Vector>& points) {
  std::string error;
  Loops loops = hull_loops(points, error);
  if (!error.empty()) {
    return refused(error);
  }
  if (!is_closed(loops)) {
    return refused(
        "some vertices lie so nearly on one plane that rounding decides which are corners; move or "
        "remove them");
  }
  const std::string problem = problem_with_dents(points, loops);
  if (!problem.empty()) {
    return refused(problem);
  }
  std::vector<Vector> corners = keep_corners(points, loops);
  const InputFrame given = centre(corners, loops);
  Hull hull{build_shape(std::move(corners), loops), ""};
  hull.shape->given = given;
  return hull;
}

}  // namespace

Hull convex_hull(const std::vector<Vector>& points) {
  const std::string problem = problem_with_points(points);
  if (!problem.empty()) {
    return refused(problem);
  }
  return whole_hull(points);
}

Loops hull_faces(const std::vector<Vector>& points) {
  std::string error;
  Loops loops = hull_loops(points, error);
  if (loops.empty()) throw std::invalid_argument(error);
  return loops;
}

}  // namespace grainsweep
