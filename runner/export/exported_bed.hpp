// A stored bed with what else exported files say about it.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <Eigen/Core>

#include "runner/store/states.hpp"
#include "runner/sweep/units.hpp"

namespace grainsweep {

/// What is done to grains in surfaces, so that they do not touch the container, and touch each
/// other either not at all or over a whole neck.
struct ContactTreatment {
  enum class Kind {
    none,
    shrink,  ///< grains are scaled about their centres by `share`
    cap,     ///< where grains nearly touch, caps are cut off, of `share` of the radius
    bridge,  ///< where grains nearly touch, necks of `share` of the smaller radius join them
  };
  Kind kind = Kind::none;
  double share = 1.0;
};

/// The least share of caps and bridges. A tube gets about one side for each share of a radius, and
/// of 134 grains in one some surfaces did not close with shares of 1e-4 and less.
inline constexpr double least_cut = 0.001;

/// "shrink:0.99", "cap:0.2" or "bridge:0.2"; nothing if it is no such thing, or the share not in
/// (0, 1), of caps and bridges in [least_cut, 1).
std::optional<ContactTreatment> contact_treatment(std::string_view text);

struct ExportSettings {
  ContactTreatment treatment;      ///< for surfaces
  bool periodic_images = false;    ///< for surfaces: of grains that cross a periodic side
  double voxels = 20.0;            ///< per d
  Units lengths = {1.0, "d", {}};  ///< of files of grains, surfaces and voxels
};

struct ExportedBed {
  StoredBed bed;
  /// Grains of a smaller radius are small, d; 0 where none are, infinite where all are.
  double small_limit = 0.0;
  double gap_tolerance = 1e-4;  ///< grains with a smaller gap touch, d: the widest of the packing
  ExportSettings settings = {};
};

/// The bed with its lengths, of box, places and radii, in those of the settings.
ExportedBed scaled(ExportedBed exported);

/// What files call a grain: its number from 1.
inline std::size_t id_of(std::size_t grain) { return grain + 1; }

/// 1 for a large grain, 2 for a small one.
int size_class(const ExportedBed& exported, std::size_t grain);

/// Whether its grains belong to several components of a mixture.
bool has_components(const StoredBed& bed);

/// The component of a grain of a mixture, from 1, after a separator; else "".
std::string component_text(const StoredBed& bed, std::size_t grain, char separator);

/// "large" or "small".
const char* class_name(const ExportedBed& exported, std::size_t grain);

/// Whether a grain is a sphere; others of its bed may not be.
bool is_sphere(const StoredBed& bed, std::size_t grain);

/// The vertices of a grain that is no sphere, as they lie in the box, from its centre, d.
std::vector<Eigen::Vector3d> vertices_about_centre(const StoredBed& bed, std::size_t grain);

/// The same in the frame of the box, d.
std::vector<Eigen::Vector3d> vertices_in_box(const StoredBed& bed, std::size_t grain);

/// The centre of a grain, box frame, d.
Eigen::Vector3d centre_in_box(const StoredBed& bed, std::size_t grain);

/// From the centre of grain a to that of b, or of its image nearest to a, box frame, d.
Eigen::Vector3d between_centres(const StoredBed& bed, std::size_t a, std::size_t b);

/// z of the highest point of a grain, d; 0 without grains.
double height_of(const StoredBed& bed);

}  // namespace grainsweep
