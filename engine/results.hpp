// What the stages of a packing report: plain data, known to all of the engine and to whoever calls
// it.
//
// Lengths are in d, forces in m g, energies in m g d (engine/units.hpp). A number that a bed does
// not give is NaN.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace grainsweep {

enum class PackingStatus {
  settled,      ///< at rest within every tolerance of its accuracy
  not_settled,  ///< has not come to rest in all its steps, or was given up before; `reason` says
                ///< why
  cancelled,    ///< the observer asked to stop; nothing was measured
  failed,       ///< could not be made; `reason` says why (e.g. no room to place the grains)
};

/// Names of the statuses, as tables write them, in that order.
inline constexpr std::array<const char*, 4> status_names = {"settled", "not_settled", "cancelled",
                                                            "failed"};
inline const char* name_of(PackingStatus status) {
  return status_names.at(static_cast<std::size_t>(status));
}

/// Net force that is left on the grains, each in the grain's own weight.
struct Imbalance {
  double mean = 0.0;
  double max = 0.0;
};

/// How far from rest a bed is. Forces in m g, lengths in d, energies in m g d. At exact rest, which
/// is not found by steps, the first three are 0, and `imbalance` is what the forces found leave.
struct RestReport {
  /// How well the last step was solved, motion of the bed included: worst residual of a row, in m
  /// g, or in weights of its lighter grain where that is lighter than m.
  double step_residual = 0.0;
  double kinetic_energy = 0.0;  ///< mean per grain of 1/2 m (dx/dt)^2, m g d, and of turning, with
                                ///< the inertia of hold_turning
  double largest_motion = 0.0;  ///< largest displacement of a grain in the last step, d; of
                                ///< polyhedra also by its turn, at the circumradius
  double overlap_mean = 0.0;    ///< mean over force-bearing contacts of max(0, -gap), d
  double overlap_max = 0.0;     ///< deepest overlap, d
  /// Force-bearing contacts closed to 1e-4 d, walls and floor included, but not those of a sphere
  /// with two walls between which it just fits; of polyhedra a contact along a line counts 2, one
  /// over an area 3.
  std::int64_t contacts = 0;
  /// Further degrees of freedom that contacts hold because their normals turn: a round wall also
  /// holds a grain along the wall, and spheres that push its faces keep a polyhedron from turning.
  std::int64_t held_by_turning = 0;
  /// Contacts that do not depend on others: all of them, unless there are more than needed. NaN if
  /// there are too many to be counted (engine/dynamics/settle.cpp).
  double independent_contacts = 0.0;
  std::int64_t isostatic_contacts = 0;  ///< see isostatic_count
  /// Whether a bed may rest on fewer than the isostatic contacts: polyhedra may, as the faces that
  /// hold them turn.
  bool may_rest_on_fewer = false;
  /// Static imbalance, with all contacts closed to Accuracy::imbalance_gap; see
  /// engine/dynamics/balance.hpp.
  Imbalance imbalance;
};

/// Mean number of touching neighbours per grain whose centre lies in the measured slab.
struct Coordination {
  double gap_tolerance = 0.0;   ///< a pair touches if its gap is below it, d
  double between_grains = 0.0;  ///< walls and floor not counted
  double with_walls = 0.0;      ///< walls and floor counted as neighbours
};

/// A force that two grains exert on each other.
struct PairForce {
  std::int32_t a = 0, b = 0;
  double magnitude = 0.0;  ///< m g
  double height = 0.0;     ///< mean z of the two centres, d
};

/// A force that a wall exerts on a grain; in a tube each vertex of a polyhedron has its own.
struct WallForce {
  /// The walls are those of walls_of(Box): 0 is the floor. Vertices at a tube have numbers of their
  /// own: see wall_of_vertex.
  std::int32_t grain = 0, wall = 0;
  double magnitude = 0.0;  ///< m g
};

/// How a force acts, as it was solved. Of spheres the centres give it; of polyhedra only this does.
struct ForceLine {
  std::array<float, 3> normal{};  ///< unit, from a to b, or from the grain to the wall; box frame
  std::array<float, 3> lever{};   ///< from the centre of a to the mean of its points by their
                                  ///< forces, box frame, d
  std::int32_t constraints = 1;   ///< 1 at a point, 2 along a line, 3 over an area
};

/// WallForce::wall of a sphere at a tube.
inline constexpr std::int32_t tube_wall = 1;

/// The same for vertex `v` of a polyhedron, numbered as in ConvexShape::vertices and
/// Mesh::vertices.
constexpr std::int32_t wall_of_vertex(std::int32_t v) { return tube_wall + 1 + v; }

/// The forces of a bed, of its last step.
struct BedForces {
  std::vector<PairForce> forces;  ///< between the grains
  std::vector<WallForce> wall_forces;
  /// Of each of `forces` and of `wall_forces`; empty if the grains are spheres.
  std::vector<ForceLine> lines, wall_lines;
};

/// One bin of a profile: a slice of the measured part of the bed.
struct ProfileBin {
  double large = 0.0;             ///< solid volume of the large class over the bin's volume
  double small = 0.0;             ///< the same of the small class
  std::int64_t large_grains = 0;  ///< grains of the large class whose centre is in the bin
  std::int64_t small_grains = 0;
  std::int64_t neighbours = 0;  ///< touching grains of the grains in the bin, added up
  std::int64_t walls = 0;       ///< touching walls and floor of the grains in the bin, added up
};

/// Bins of equal width along one axis; bin k reaches from k to k + 1 bin widths.
struct Profile {
  double bin_width = 0.0;  ///< d
  std::vector<ProfileBin> bins;
};

/// A component's part of a bin of a profile.
struct ComponentBin {
  double solid_fraction = 0.0;  ///< solid volume of its grains over the bin's volume
  std::int64_t grains = 0;      ///< grains of its own whose centre is in the bin
  /// Grains that touch those, added up, by their component.
  std::vector<std::int64_t> neighbours;
  std::int64_t walls = 0;           ///< walls and floor that touch those, added up
  std::array<double, 3> nematic{};  ///< of those, as in ShapeOrder; NaN if none can turn
};

/// A component's part of a Profile of the bed, in the same bins.
struct ComponentProfile {
  double bin_width = 0.0;  ///< d
  std::vector<ComponentBin> bins;
};

/// Values in bins of equal width from 0.
struct Curve {
  double bin_width = 0.0;
  std::vector<double> values;
};

/// Shares of the grains that are no larger than a diameter, by number, area or volume as in the
/// distribution of their sizes.
struct SizeRow {
  double diameter = 0.0;  ///< d
  double asked = 0.0;     ///< of the distribution
  double packed = 0.0;    ///< of all grains of the bed
  double slab = 0.0;      ///< of those whose centre lies in the measured slab
};

/// Order, forces and sizes in the measured slab. A number that the slab does not give is NaN.
struct Order {
  double q6_global = 0.0;  ///< bond order of the bonds of all grains together; 0 if they point
                           ///< anywhere
  double q6_local = 0.0;   ///< that of a grain's own bonds, mean over grains
  double three_contact_share = 0.0;  ///< grains that touch exactly three others, walls included
  double segregation = 0.0;   ///< mean height of small less that of large grains, in slab heights
  double force_mean = 0.0;    ///< of the force-bearing contacts between grains, m g
  double force_square = 0.0;  ///< mean square of a contact force over the mean of its layer
};

/// How polyhedra touch and point, in the measured slab. A contact is simple at a point, double
/// along a line, triple over an area. A number that the slab does not give is NaN.
struct ShapeOrder {
  std::array<double, 3> contact_share{};  ///< of the force-bearing contacts, simple, double, triple
  std::array<double, 3> force_share{};    ///< of the sum of their forces
  /// Nematic order of the axes x, y, z of the frame in which the shape is written; spheres, which
  /// have no axes, are left out.
  std::array<double, 3> nematic{};
};

/// A component of a mixture in the measured slab. A number that the slab does not give is NaN.
struct ComponentMeasure {
  std::int64_t grains = 0;               ///< of the whole bed
  std::int64_t slab_grains = 0;          ///< whose centre lies in the slab
  double packed = 0.0;                   ///< share of the solid volume of the whole bed
  double slab_share = 0.0;               ///< share of the solid volume in the slab
  double solid_fraction = 0.0;           ///< its exact solid volume in the slab over the slab's
  double coordination = 0.0;             ///< touching grains of one of its grains, mean
  double coordination_with_walls = 0.0;  ///< the same, walls and floor counted as neighbours
  std::vector<double> neighbours;        ///< `coordination` split by their component
  std::array<double, 3> nematic{};       ///< as in ShapeOrder; NaN for spheres
  /// Force-bearing contacts in the slab of its grains with those of each component: numbers of
  /// simple, double and triple ones as in ShapeOrder. A contact between two components counts for
  /// both.
  std::vector<std::array<std::int64_t, 3>> contacts = {};
  // Filled where the packing has such a profile.
  ComponentProfile profile_x = {};
  ComponentProfile profile_y = {};
  ComponentProfile profile_from_walls = {};
  ComponentProfile profile_z = {};
};

/// The curves and lists of a packing, by far the largest part of what is measured. Empty if nothing
/// was measured.
struct Curves {
  Profile profile_x;           ///< from wall to wall, in the slab; empty without walls and in tubes
  Profile profile_y;           ///< the same along y, from wall to wall or around; empty in tubes
  Profile profile_from_walls;  ///< from the nearest wall inwards; only in ducts and tubes
  Profile profile_z;           ///< from the floor up
  Curve pair_correlation;      ///< g over distance, d, in the slab
  Curve force_density;         ///< probability density of a force over the mean of its layer
  std::vector<SizeRow> sizes;  ///< from fine to coarse; empty without a distribution
  std::vector<ComponentMeasure> components;  ///< of a mixture, in its order; else empty
};

/// What settling alone decides of a packing, whatever is measured of it.
struct SettledPart {
  PackingStatus status = PackingStatus::failed;
  std::string reason;  ///< empty when settled
  std::int64_t grains = 0;
  RestReport rest;
  /// How far contacts strayed while the bed settled because steps were not solved better, d: sum
  /// over all steps of the root mean square of the residuals of the rows that push, times the
  /// square of the step and the number of these rows over that of all degrees of freedom. It is an
  /// error of the solid fraction: engine/dynamics/sleep.hpp.
  double spurious_path = 0.0;
  std::int64_t steps = 0;
  std::int64_t iterations = 0;
  std::uint64_t state_hash = 0;  ///< of the final positions, orientations and radii
};

struct PackingResult : SettledPart, Curves {
  double surface_height = 0.0;  ///< z of the bed's free surface, d
  double slab_bottom = 0.0;     ///< measured slab, d
  double slab_top = 0.0;
  double solid_fraction = 0.0;  ///< exact solid volume in the slab over the slab's volume
  double small_share = 0.0;     ///< share of the small class in the slab's solid volume
  std::optional<double> small_share_of_bed;  ///< the same of the whole bed, also split by size
  std::vector<Coordination> coordination;    ///< one entry per gap tolerance of the spec
  double mean_diameter = 0.0;                ///< of all grains, d
  double mean_diameter_by_volume = 0.0;      ///< the same, each grain weighted by its volume, d
  /// 6 times the volume of all grains over their surface, d: of equal spheres their diameter. A bed
  /// holds 6 solid_fraction / sauter_diameter of surface in its volume.
  std::optional<double> sauter_diameter;
  Order order;                            ///< of the slab
  std::optional<ShapeOrder> shape_order;  ///< of non-spherical grains
};

/// A grain of the finished bed, as `export` writes it.
struct SettledGrain {
  double x = 0.0, y = 0.0, z = 0.0, radius = 0.0;  ///< d; x and y inside the box; half its size
  double force = 0.0;         ///< sum of the magnitudes of its contact forces, m g
  std::int32_t touching = 0;  ///< touching grains at the first gap tolerance, walls not counted
};

/// The surface of a grain of size 1 in its own frame, d. A sphere among polyhedra, whose diameter
/// is d, has neither vertices nor faces.
struct Mesh {
  std::vector<std::array<double, 3>> vertices;
  std::vector<std::vector<std::int32_t>> faces;  ///< counter-clockwise seen from outside

  bool is_ball() const { return vertices.empty(); }
};

/// What only non-spherical grains have.
struct Turned {
  std::vector<Mesh> meshes;              ///< one for each component of a mixture, else one
  std::vector<std::uint8_t> components;  ///< of each grain, from 0; empty if there is one mesh
  /// Unit quaternion x, y, z, w of each grain: a point of the mesh lies at centre + 2 radius times
  /// the turned point.
  std::vector<std::array<double, 4>> orientations;

  std::size_t component(std::size_t grain) const {
    return components.empty() ? 0 : components[grain];
  }
  const Mesh& mesh(std::size_t grain) const { return meshes[component(grain)]; }
};

/// A finished bed: what can be exported, and measured again.
struct SettledBed : BedForces {
  std::vector<SettledGrain> grains;  ///< in the order of the start, empty unless a bed exists
  std::optional<Turned> turned;      ///< unless they are spheres
  /// The same orientations of polyhedra from the principal axes of their shapes, as their bed has
  /// them: what it is rebuilt from.
  std::vector<std::array<double, 4>> axes;
};

struct Packing : SettledBed {
  PackingResult result;
};

/// Where a packing stands; `share_done` is an estimate in [0, 1] that never falls.
struct Progress {
  std::int64_t step = 0;
  double share_done = 0.0;
  std::function<std::string()> save =
      {};  ///< the packing as bytes; only during the call that passed it
};

/// Called after every step or two, and before each round of a search for exact rest and within long
/// ones, while `step` stays as it is; false stops the packing, whose status is then `cancelled`.
using KeepGoing = std::function<bool(const Progress&)>;

}  // namespace grainsweep
