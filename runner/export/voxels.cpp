#include "runner/export/voxels.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include <Eigen/Geometry>

#include "engine/shape/hull.hpp"
#include "runner/exit_codes.hpp"
#include "runner/machine.hpp"
#include "runner/tables/csv.hpp"

namespace grainsweep {
namespace {

/// The numbers of the voxels along an axis whose middles lie within `reach` of `centre`; along a
/// periodic axis they may lie beyond the grid.
struct VoxelRange {
  std::int64_t first = 0, last = -1;
};
VoxelRange voxels_within(double centre, double reach, double size) {
  return {static_cast<std::int64_t>(std::ceil((centre - reach) / size - 0.5)),
          static_cast<std::int64_t>(std::floor((centre + reach) / size - 0.5))};
}

/// The place of voxel k on the grid, whose axis is periodic or ends there; -1 beyond it.
std::int64_t wrapped(std::int64_t k, std::size_t count, bool periodic) {
  const auto all = static_cast<std::int64_t>(count);
  if (k >= 0 && k < all) return k;
  return periodic ? ((k % all) + all) % all : -1;
}

/// Half-spaces normal . x <= offset about the centre that make up a grain of size 1 in its frame.
std::vector<Face> faces_of(const Mesh& mesh) {
  std::vector<Face> faces;
  for (const auto& corners : mesh.faces) {
    const auto at = [&](std::size_t k) {
      const auto& [x, y, z] = mesh.vertices[static_cast<std::size_t>(corners[k])];
      return Vector(x, y, z);
    };
    Vector normal = Vector::Zero();
    for (std::size_t k = 2; k < corners.size(); ++k) {
      normal += (at(k - 1) - at(0)).cross(at(k) - at(0));
    }
    normal.normalize();
    faces.push_back({normal, normal.dot(at(0))});
  }
  return faces;
}

/// Tells whether points about a grain's centre lie in it, and how far the grain reaches from it.
struct Inside {
  double reach = 0.0;
  std::vector<Face> faces;  ///< turned and scaled; empty for a sphere

  bool operator()(const Vector& x) const {
    if (faces.empty()) return x.squaredNorm() <= reach * reach;
    return std::all_of(faces.begin(), faces.end(),
                       [&](const Face& face) { return face.normal.dot(x) <= face.offset; });
  }
};

Inside inside_of(const StoredBed& bed, const std::vector<std::vector<Face>>& faces,
                 std::size_t grain) {
  const SettledGrain& at = bed.grains[grain];
  if (is_sphere(bed, grain)) return {at.radius, {}};
  Inside inside;
  for (const Vector& vertex : vertices_about_centre(bed, grain)) {
    inside.reach = std::max(inside.reach, vertex.norm());
  }
  const auto& [x, y, z, w] = bed.turned->orientations[grain];
  const Eigen::Quaterniond turn(w, x, y, z);
  for (Face face : faces[bed.turned->component(grain)]) {
    face.normal = turn * face.normal;
    face.offset *= 2.0 * at.radius;
    inside.faces.push_back(face);
  }
  return inside;
}

/// Writes the class or component of a grain into its voxels.
void fill(const StoredBed& bed, const VoxelGrid& grid, std::size_t grain, const Inside& inside,
          char value, std::string& voxels) {
  const SettledGrain& at = bed.grains[grain];
  const Vector centre(at.x, at.y, at.z);
  const std::array periodic = {bed.box.x == Boundary::periodic, bed.box.y == Boundary::periodic,
                               false};
  std::array<VoxelRange, 3> range;
  for (int axis = 0; axis < 3; ++axis) {
    const auto k = static_cast<std::size_t>(axis);
    range[k] = voxels_within(centre[axis], inside.reach, grid.size[k]);
  }
  const auto middle = [&](std::size_t axis, std::int64_t k) {
    return (static_cast<double>(k) + 0.5) * grid.size[axis] - centre[static_cast<int>(axis)];
  };
  for (std::int64_t k = range[2].first; k <= range[2].last; ++k) {
    const std::int64_t z = wrapped(k, grid.count[2], false);
    for (std::int64_t j = range[1].first; j <= range[1].last && z >= 0; ++j) {
      const std::int64_t y = wrapped(j, grid.count[1], periodic[1]);
      for (std::int64_t i = range[0].first; i <= range[0].last && y >= 0; ++i) {
        const std::int64_t x = wrapped(i, grid.count[0], periodic[0]);
        if (x < 0 || !inside({middle(0, i), middle(1, j), middle(2, k)})) continue;
        const auto row = static_cast<std::size_t>(z) * grid.count[1] + static_cast<std::size_t>(y);
        voxels[row * grid.count[0] + static_cast<std::size_t>(x)] = value;
      }
    }
  }
}

constexpr char outside_tube = '\xff';

/// Marks what lies outside a tube, which is no void.
void mark_outside(const Box& box, const VoxelGrid& grid, std::string& voxels) {
  const auto& [nx, ny, nz] = grid.count;
  const double radius = box.width / 2.0;
  for (std::size_t j = 0; j < ny; ++j) {
    for (std::size_t i = 0; i < nx; ++i) {
      const double x = (static_cast<double>(i) + 0.5) * grid.size[0] - radius;
      const double y = (static_cast<double>(j) + 0.5) * grid.size[1] - radius;
      if (std::hypot(x, y) <= radius) continue;
      for (std::size_t k = 0; k < nz; ++k) voxels[(k * ny + j) * nx + i] = outside_tube;
    }
  }
}

/// Throws BadInput if there is no memory for so many voxels.
void expect_room(const ExportedBed& exported, const VoxelGrid& grid) {
  double voxels = 1.0;
  for (const std::size_t count : grid.count) voxels *= static_cast<double>(count);
  if (voxels <= memory_for_packings() / 2.0) return;
  throw BadInput("--voxels " + cell(exported.settings.voxels) + ": packing " + exported.bed.job +
                 " takes " + cell(std::round(voxels / 1e6)) +
                 " million voxels, a byte each, more than there is memory for; take fewer a d");
}

}  // namespace

VoxelGrid voxel_grid(const StoredBed& bed, double per_d) {
  VoxelGrid grid;
  const std::array extent = {bed.box.length, bed.box.width, height_of(bed)};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double voxels = extent[axis] * per_d;
    const double whole = axis < 2 ? std::round(voxels) : std::ceil(voxels);
    grid.count[axis] = static_cast<std::size_t>(std::max(1.0, whole));
    grid.size[axis] = axis < 2 ? extent[axis] / static_cast<double>(grid.count[axis]) : 1.0 / per_d;
  }
  return grid;
}

std::string voxels_nrrd(const ExportedBed& exported) {
  const StoredBed& bed = exported.bed;
  const VoxelGrid grid = voxel_grid(bed, exported.settings.voxels);
  const auto& [nx, ny, nz] = grid.count;
  const auto& [dx, dy, dz] = grid.size;
  expect_room(exported, grid);
  std::string voxels(nx * ny * nz, '\0');
  if (bed.box.is_tube) mark_outside(bed.box, grid, voxels);
  const bool is_mixture = has_components(bed);
  std::vector<std::vector<Face>> faces;  // of each mesh
  if (bed.turned) {
    for (const Mesh& mesh : bed.turned->meshes) faces.push_back(faces_of(mesh));
  }
  for (std::size_t k = 0; k < bed.grains.size(); ++k) {
    const auto value =
        static_cast<char>(is_mixture ? bed.turned->component(k) + 1
                                     : static_cast<std::size_t>(size_class(exported, k)));
    fill(bed, grid, k, inside_of(bed, faces, k), value, voxels);
  }
  const Units& lengths = exported.settings.lengths;
  return "NRRD0004\n# lengths in " + lengths.unit + "; 0 void, " +
         std::string(is_mixture ? "else the component" : "1 large grains, 2 small ones") +
         (bed.box.is_tube ? "; 255 outside the tube" : "") +
         "\ntype: uint8\ndimension: 3\nsizes: " + cell(nx) + " " + cell(ny) + " " + cell(nz) +
         "\nspacings: " + cell(lengths.d * dx) + " " + cell(lengths.d * dy) + " " +
         cell(lengths.d * dz) + "\naxis mins: 0 0 0\ncenters: cell cell cell\nencoding: raw\n\n" +
         voxels;
}

}  // namespace grainsweep
