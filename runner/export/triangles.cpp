#include "runner/export/triangles.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <stdexcept>
#include <utility>

#include <Eigen/Geometry>

namespace grainsweep {
namespace {

using Place = Eigen::Vector2d;

/// Twice the area of a triangle, positive if it turns counter-clockwise.
double turn_of(const Place& a, const Place& b, const Place& c) {
  return (b.x() - a.x()) * (c.y() - a.y()) - (b.y() - a.y()) * (c.x() - a.x());
}

/// A corner of a region in its plane.
struct FlatCorner {
  std::int32_t number = 0;
  Place place;
};
using FlatLoop = std::vector<FlatCorner>;

double doubled_area(const FlatLoop& loop) {
  double area = 0.0;
  for (std::size_t k = 2; k < loop.size(); ++k) {
    area += turn_of(loop[0].place, loop[k - 1].place, loop[k].place);
  }
  return area;
}

FlatLoop flattened(const std::vector<Eigen::Vector3d>& corners, const Eigen::Vector3d& normal,
                   const Loop& loop) {
  const Eigen::Vector3d x = normal.unitOrthogonal(), y = normal.normalized().cross(x);
  FlatLoop flat;
  for (const std::int32_t k : loop) {
    const Eigen::Vector3d& corner = corners[static_cast<std::size_t>(k)];
    flat.push_back({k, {x.dot(corner), y.dot(corner)}});
  }
  return flat;
}

bool is_around(const FlatLoop& loop, const Place& place) {
  bool inside = false;
  for (std::size_t k = 0, before = loop.size() - 1; k < loop.size(); before = k++) {
    const Place &p = loop[before].place, &q = loop[k].place;
    if ((p.y() > place.y()) == (q.y() > place.y())) continue;
    inside ^= (turn_of(p, q, place) > 0.0) == (q.y() > p.y());
  }
  return inside;
}

/// Whether the line from p to q meets that from a to b anywhere but at a common end.
bool lines_meet(const FlatCorner& p, const FlatCorner& q, const FlatCorner& a,
                const FlatCorner& b) {
  for (const FlatCorner* end : {&a, &b}) {
    if (end->number == p.number || end->number == q.number) return false;
  }
  return (turn_of(p.place, q.place, a.place) > 0.0) != (turn_of(p.place, q.place, b.place) > 0.0) &&
         (turn_of(a.place, b.place, p.place) > 0.0) != (turn_of(a.place, b.place, q.place) > 0.0);
}

bool is_free(const FlatCorner& p, const FlatCorner& q, const std::vector<FlatLoop>& loops) {
  return std::all_of(loops.begin(), loops.end(), [&](const FlatLoop& loop) {
    for (std::size_t k = 0, before = loop.size() - 1; k < loop.size(); before = k++) {
      if (lines_meet(p, q, loop[before], loop[k])) return false;
    }
    return true;
  });
}

/// Whether a place lies within the angle at corner k of a loop: a corner where a slit ends is in
/// the loop twice, each time with the region in another direction.
bool is_ahead(const FlatLoop& loop, std::size_t k, const Place& place) {
  const Place& before = loop[(k + loop.size() - 1) % loop.size()].place;
  const Place &at = loop[k].place, &after = loop[(k + 1) % loop.size()].place;
  const bool left_of_first = turn_of(before, at, place) > 0.0;
  const bool left_of_second = turn_of(at, after, place) > 0.0;
  return turn_of(before, at, after) > 0.0 ? left_of_first && left_of_second
                                          : left_of_first || left_of_second;
}

/// Where a hole is cut open towards the region's edge.
struct Slit {
  std::size_t outer = 0, hole = 0;
  double length = std::numeric_limits<double>::infinity();
};

/// Of infinite length if other holes hide this one from the whole edge.
Slit shortest_slit(const FlatLoop& outer, const FlatLoop& hole,
                   const std::vector<FlatLoop>& loops) {
  Slit best;
  for (std::size_t j = 0; j < outer.size(); ++j) {
    for (std::size_t k = 0; k < hole.size(); ++k) {
      const double length = (outer[j].place - hole[k].place).norm();
      if (length >= best.length || !is_ahead(outer, j, hole[k].place)) continue;
      if (is_free(outer[j], hole[k], loops)) best = {j, k, length};
    }
  }
  return best;
}

/// Holes joined to the edge around them, one after the other, by slits of no width.
FlatLoop opened(FlatLoop outer, std::vector<FlatLoop> holes) {
  while (!holes.empty()) {
    std::vector<FlatLoop> all = holes;
    all.push_back(outer);
    std::size_t nearest = 0;
    Slit best;
    for (std::size_t k = 0; k < holes.size(); ++k) {
      const Slit slit = shortest_slit(outer, holes[k], all);
      if (slit.length >= best.length) continue;
      best = slit;
      nearest = k;
    }
    if (best.length == std::numeric_limits<double>::infinity()) {
      throw std::logic_error("no hole of a flat region can be reached from its edge");
    }
    FlatLoop& hole = holes[nearest];
    std::rotate(hole.begin(), hole.begin() + static_cast<std::ptrdiff_t>(best.hole), hole.end());
    hole.push_back(hole.front());
    hole.push_back(outer[best.outer]);
    outer.insert(outer.begin() + static_cast<std::ptrdiff_t>(best.outer) + 1, hole.begin(),
                 hole.end());
    holes.erase(holes.begin() + static_cast<std::ptrdiff_t>(nearest));
  }
  return outer;
}

/// Twice the area over the square of the longest side: 0.87 at best, 0 of a line.
double quality_of(const Place& a, const Place& b, const Place& c) {
  const double longest =
      std::max({(b - a).squaredNorm(), (c - b).squaredNorm(), (a - c).squaredNorm()});
  return turn_of(a, b, c) / longest;
}

/// How good a triangle corner k and the two beside it are; 0 if it cannot be cut off.
double ear_quality(const FlatLoop& loop, std::size_t k) {
  constexpr double flat = 1e-9;
  const FlatCorner& a = loop[(k + loop.size() - 1) % loop.size()];
  const FlatCorner& b = loop[k];
  const FlatCorner& c = loop[(k + 1) % loop.size()];
  const double quality = quality_of(a.place, b.place, c.place);
  if (quality <= flat) return 0.0;
  const double margin = -flat * (c.place - a.place).squaredNorm();
  const bool is_clear = std::none_of(loop.begin(), loop.end(), [&](const FlatCorner& other) {
    return other.number != a.number && other.number != b.number && other.number != c.number &&
           turn_of(a.place, b.place, other.place) >= margin &&
           turn_of(b.place, c.place, other.place) >= margin &&
           turn_of(c.place, a.place, other.place) >= margin;
  });
  return is_clear ? quality : 0.0;
}

/// Cuts off the best ear of those left until only a triangle is left: all turn counter-clockwise,
/// and therefore fill the loop without overlap.
std::vector<Loop> ears_of(FlatLoop loop) {
  std::vector<Loop> triangles;
  while (loop.size() >= 3) {
    std::size_t best = 0;
    double quality = 0.0;
    for (std::size_t k = 0; k < loop.size(); ++k) {
      const double of_ear = ear_quality(loop, k);
      if (of_ear <= quality) continue;
      quality = of_ear;
      best = k;
    }
    if (quality == 0.0) throw std::logic_error("a flat region has an edge that crosses itself");
    const std::size_t count = loop.size();
    triangles.push_back({loop[(best + count - 1) % count].number, loop[best].number,
                         loop[(best + 1) % count].number});
    if (count == 3) break;
    loop.erase(loop.begin() + static_cast<std::ptrdiff_t>(best));
  }
  return triangles;
}

/// Triangles of a region with the edges that two of them share.
struct Net {
  std::map<std::int32_t, Place> places;
  std::vector<Loop> triangles;
  std::map<std::pair<std::int32_t, std::int32_t>, std::size_t> left_of;  ///< directed edges

  void set(std::size_t k, const Loop& triangle) {
    triangles[k] = triangle;
    for (std::size_t j = 0; j < 3; ++j) left_of[{triangle[j], triangle[(j + 1) % 3]}] = k;
  }
};

Net net_of(const FlatLoop& corners, const std::vector<Loop>& triangles) {
  Net net;
  for (const FlatCorner& corner : corners) net.places[corner.number] = corner.place;
  net.triangles.resize(triangles.size());
  for (std::size_t k = 0; k < triangles.size(); ++k) net.set(k, triangles[k]);
  return net;
}

std::int32_t opposite(const Loop& triangle, std::int32_t a, std::int32_t b) {
  return *std::find_if(triangle.begin(), triangle.end(),
                       [&](std::int32_t k) { return k != a && k != b; });
}

double angle_at(const Place& corner, const Place& a, const Place& b) {
  return std::atan2(turn_of(corner, a, b), (a - corner).dot(b - corner));
}

/// Turns the edge from a to b, with triangles on both sides, to join the corners opposite to it, if
/// those are then more even: the angles at them add up to more than two right ones.
bool flip(Net& net, std::int32_t a, std::int32_t b) {
  constexpr double flat = 1e-9, two_right = 3.1415927;  // with a margin, so that it ends
  const auto left = net.left_of.find({a, b}), right = net.left_of.find({b, a});
  if (left == net.left_of.end() || right == net.left_of.end()) return false;
  const std::size_t of_left = left->second, of_right = right->second;
  const std::int32_t c = opposite(net.triangles[of_left], a, b);
  const std::int32_t d = opposite(net.triangles[of_right], a, b);
  const Place &p = net.places[a], &q = net.places[b], &r = net.places[c], &s = net.places[d];
  if (angle_at(r, p, q) + angle_at(s, q, p) <= two_right) return false;
  if (quality_of(r, p, s) <= flat || quality_of(s, q, r) <= flat) return false;
  net.left_of.erase(left);
  net.left_of.erase(right);
  net.set(of_left, {c, a, d});
  net.set(of_right, {d, b, c});
  return true;
}

/// The same region in triangles as even as its corners allow (Delaunay's, within its edges).
std::vector<Loop> evened(const FlatLoop& corners, const std::vector<Loop>& triangles) {
  constexpr int most_rounds = 100;
  Net net = net_of(corners, triangles);
  bool is_even = false;
  for (int round = 0; round < most_rounds && !is_even; ++round) {
    is_even = true;
    for (std::size_t k = 0; k < net.triangles.size(); ++k) {
      for (std::size_t j = 0; j < 3; ++j) {
        const Loop& triangle = net.triangles[k];
        if (flip(net, triangle[j], triangle[(j + 1) % 3])) is_even = false;
      }
    }
  }
  return net.triangles;
}

}  // namespace

std::vector<Loop> triangles_of(const std::vector<Eigen::Vector3d>& corners,
                               const Eigen::Vector3d& normal, const std::vector<Loop>& loops) {
  std::vector<FlatLoop> outer, holes;
  for (const Loop& loop : loops) {
    FlatLoop flat = flattened(corners, normal, loop);
    (doubled_area(flat) > 0.0 ? outer : holes).push_back(std::move(flat));
  }
  std::vector<Loop> triangles;
  for (const FlatLoop& edge : outer) {
    std::vector<FlatLoop> within;
    for (const FlatLoop& hole : holes) {
      if (is_around(edge, hole.front().place)) within.push_back(hole);
    }
    const FlatLoop loop = opened(edge, within);
    for (Loop& triangle : evened(loop, ears_of(loop))) triangles.push_back(std::move(triangle));
  }
  return triangles;
}

}  // namespace grainsweep
