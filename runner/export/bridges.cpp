#include "runner/export/bridges.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

#include <Eigen/Geometry>

#include "engine/clusters.hpp"
#include "engine/shape/build.hpp"
#include "runner/export/open_surfaces.hpp"

namespace grainsweep {
namespace {

/// By how many periods an image is shifted along x and y.
struct Shift {
  int x = 0, y = 0;

  Shift operator+(const Shift& other) const { return {x + other.x, y + other.y}; }
};

/// A grain, or an image of it.
struct Copy {
  std::size_t grain = 0;
  Shift shift;
};

Vector way_of(const Box& box, const Shift& shift) {
  return {shift.x * box.period_x(), shift.y * box.period_y(), 0.0};
}

int periods_in(double way, double period) {
  return period == 0.0 ? 0 : static_cast<int>(std::lround(way / period));
}

/// The shift of grain b from its place in the box to the image at the neck.
Shift shift_of(const StoredBed& bed, const Neck& neck) {
  const Vector way = neck.between - (centre_in_box(bed, neck.b) - centre_in_box(bed, neck.a));
  return {periods_in(way.x(), bed.box.period_x()), periods_in(way.y(), bed.box.period_y())};
}

/// Whether any part of a convex body may lie within the periodic sides of the box.
bool reaches_into(const Box& box, const std::vector<Vector>& points, const Vector& way) {
  for (const auto& [axis, period] : {std::pair(0, box.period_x()), std::pair(1, box.period_y())}) {
    if (period == 0.0) continue;
    double low = period, high = 0.0;
    for (const Vector& point : points) {
      low = std::min(low, point[axis] + way[axis]);
      high = std::max(high, point[axis] + way[axis]);
    }
    if (low >= period || high <= 0.0) return false;
  }
  return true;
}

std::vector<Shift> shifts_of(const Box& box) {
  std::vector<Shift> shifts = {{0, 0}};
  for (const int x : {-1, 0, 1}) {
    for (const int y : {-1, 0, 1}) {
      const bool is_new = (x != 0 || y != 0) && (x == 0 || box.period_x() > 0.0) &&
                          (y == 0 || box.period_y() > 0.0);
      if (is_new) shifts.push_back({x, y});
    }
  }
  return shifts;
}

/// Numbers of the copies by grain and shift, in the order in which they are met.
class Copies {
 public:
  void add(std::size_t grain, const Shift& shift) {
    const auto [known, is_new] = numbers_.try_emplace({grain, shift.x, shift.y}, copies_.size());
    if (is_new) copies_.push_back({grain, shift});
  }
  /// Number of a copy, or that of all copies if it is none of them.
  std::size_t number(std::size_t grain, const Shift& shift) const {
    const auto found = numbers_.find({grain, shift.x, shift.y});
    return found == numbers_.end() ? copies_.size() : found->second;
  }
  const std::vector<Copy>& all() const { return copies_; }

 private:
  std::vector<Copy> copies_;
  std::map<std::tuple<std::size_t, int, int>, std::size_t> numbers_;
};

Copies copies_of(const ExportedBed& exported, const OpenSurfaces& open) {
  const StoredBed& bed = exported.bed;
  Copies copies;
  for (std::size_t k = 0; k < bed.grains.size(); ++k) copies.add(k, {});
  if (!exported.settings.periodic_images) return copies;
  for (const Shift& shift : shifts_of(bed.box)) {
    const Vector way = way_of(bed.box, shift);
    for (std::size_t k = 0; k < bed.grains.size(); ++k) {
      const Vector of_grain = way + centre_in_box(bed, k);
      if (reaches_into(bed.box, open.grains[k].surface.vertices, of_grain)) copies.add(k, shift);
    }
    for (const Neck& neck : open.necks) {
      if (neck.is_wall ||
          !reaches_into(bed.box, neck_corners(neck, centre_in_box(bed, neck.a)), way))
        continue;
      copies.add(neck.a, shift);
      copies.add(neck.b, shift + shift_of(bed, neck));
    }
  }
  return copies;
}

/// A neck between two copies.
struct Bridge {
  std::size_t neck = 0, a = 0, b = 0;
};

std::vector<Bridge> bridges_of(const StoredBed& bed, const OpenSurfaces& open,
                               const Copies& copies) {
  std::vector<Bridge> bridges;
  for (std::size_t k = 0; k < open.necks.size(); ++k) {
    const Neck& neck = open.necks[k];
    if (neck.is_wall) continue;
    for (std::size_t copy = 0; copy < copies.all().size(); ++copy) {
      if (copies.all()[copy].grain != neck.a) continue;
      const std::size_t other =
          copies.number(neck.b, copies.all()[copy].shift + shift_of(bed, neck));
      if (other < copies.all().size()) bridges.push_back({k, copy, other});
    }
  }
  return bridges;
}

/// For each copy the first one that bridges join it to.
std::vector<std::size_t> first_joined(std::size_t copies, const std::vector<Bridge>& bridges) {
  Clusters clusters(copies);
  for (const Bridge& bridge : bridges) {
    const auto [first, last] = std::minmax({clusters.root(bridge.a), clusters.root(bridge.b)});
    clusters.join(last, first);
  }
  std::vector<std::size_t> first(copies);
  for (std::size_t k = 0; k < copies; ++k) first[k] = clusters.root(k);
  return first;
}

Loop moved(Loop loop, std::int32_t by) {
  for (std::int32_t& k : loop) k += by;
  return loop;
}

const Hole& hole_at(const OpenSurface& open, std::size_t neck) {
  return *std::find_if(open.holes.begin(), open.holes.end(),
                       [&](const Hole& hole) { return hole.neck == neck; });
}

/// One body, as it grows, and where in its vertices those of each copy begin.
struct Body {
  GrainSurface joined;
  std::map<std::size_t, std::int32_t> first_vertex;
};

void append_copy(const OpenSurface& open, const Vector& centre, std::size_t copy, Body& body) {
  Surface& surface = body.joined.surface;
  const auto first = static_cast<std::int32_t>(surface.vertices.size());
  body.first_vertex[copy] = first;
  for (const Vector& vertex : open.surface.vertices) surface.vertices.emplace_back(vertex + centre);
  for (const Loop& face : open.surface.faces) surface.faces.push_back(moved(face, first));
}

/// The sides of a neck, each flat, from the rim on a to that on b.
void append_sides(const Hole& a, std::int32_t first_a, const Hole& b, std::int32_t first_b,
                  Surface& surface) {
  for (std::size_t k = 0; k < neck_sides; ++k) {
    const std::size_t next = (k + 1) % neck_sides;
    Loop loop = moved(a.sides[k], first_a);
    loop.push_back(a.sides[next].front() + first_a);
    loop.push_back(b.sides[next].front() + first_b);
    const Loop back = moved(b.sides[k], first_b);
    loop.insert(loop.end(), back.rbegin(), back.rend());
    if (loop.size() == 4) {
      surface.faces.push_back(loop);
      continue;
    }
    for (const Loop& triangle :
         triangles_of(surface.vertices, area_vector(surface.vertices, loop), {loop})) {
      surface.faces.push_back(triangle);
    }
  }
}

/// Closes the holes of a copy at which no bridge begins or ends.
void append_lids(const OpenSurface& open, std::int32_t first,
                 const std::vector<std::size_t>& joined, Surface& surface) {
  for (const Hole& hole : open.holes) {
    if (std::find(joined.begin(), joined.end(), hole.neck) != joined.end()) continue;
    for (const Loop& face : hole.lid) surface.faces.push_back(moved(face, first));
  }
}

}  // namespace

std::vector<GrainSurface> bridged_surfaces(const ExportedBed& exported) {
  const StoredBed& bed = exported.bed;
  const OpenSurfaces open = bed.turned ? open_polyhedra(exported) : open_spheres(exported);
  const Copies copies = copies_of(exported, open);
  const std::vector<Bridge> bridges = bridges_of(bed, open, copies);
  const std::vector<std::size_t> first = first_joined(copies.all().size(), bridges);
  std::map<std::size_t, Body> bodies;  // by their first copy
  for (std::size_t k = 0; k < copies.all().size(); ++k) {
    const Copy& copy = copies.all()[k];
    Body& body = bodies[first[k]];
    if (body.joined.grains++ == 0) body.joined.grain = copy.grain;
    append_copy(open.grains[copy.grain],
                centre_in_box(bed, copy.grain) + way_of(bed.box, copy.shift), k, body);
  }
  std::vector<std::vector<std::size_t>> joined(copies.all().size());  // necks of each copy
  for (const Bridge& bridge : bridges) {
    joined[bridge.a].push_back(bridge.neck);
    joined[bridge.b].push_back(bridge.neck);
    Body& body = bodies[first[bridge.a]];
    const Neck& neck = open.necks[bridge.neck];
    append_sides(hole_at(open.grains[neck.a], bridge.neck), body.first_vertex[bridge.a],
                 hole_at(open.grains[neck.b], bridge.neck), body.first_vertex[bridge.b],
                 body.joined.surface);
  }
  std::vector<GrainSurface> surfaces;
  for (std::size_t k = 0; k < copies.all().size(); ++k) {
    Body& body = bodies[first[k]];
    append_lids(open.grains[copies.all()[k].grain], body.first_vertex[k], joined[k],
                body.joined.surface);
  }
  for (auto& [copy, body] : bodies) {
    body.joined.surface = compact(body.joined.surface);
    surfaces.push_back(std::move(body.joined));
  }
  return surfaces;
}

}  // namespace grainsweep
