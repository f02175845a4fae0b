// What the grains of a packing are, as it is asked for: plain data, worked out into a ConvexShape
// by engine/shape/pinacoid.hpp, engine/shape/named_shapes.hpp and engine/shape/hull.hpp. Spheres
// need no more than their name.
//
// Every length is that of a grain of size 1, in d. With its defaults each shape is d
// high, a pinacoid from ridge to ridge and others on a face; pinacoid, cube and cuboid are d long
// and wide as well.
#pragma once

#include <array>
#include <cstddef>
#include <string_view>
#include <variant>
#include <vector>

namespace grainsweep {

struct SphereShape {};

/// A pinacoid of size 1; see engine/shape/pinacoid.hpp.
struct PinacoidSize {
  double length = 1.0;                ///< d
  double width = 1.0;                 ///< d
  double height = 1.0;                ///< d
  double angle = 1.0471975511965976;  ///< radians, above 0 and at most 89 degrees
};

struct CubeSize {
  double edge = 1.0;  ///< d
};

/// A brick.
struct CuboidSize {
  double length = 1.0;  ///< d
  double width = 1.0;   ///< d
  double height = 1.0;  ///< d
};

/// A regular solid of so many faces.
template <int faces>
struct RegularSolid {
  double height = 1.0;  ///< from a face to what is opposite, d
};
/// Its height, from a face to the corner opposite, is sqrt(2/3) times its edge.
using TetrahedronSize = RegularSolid<4>;
/// Its height, from a face to that opposite, is sqrt(2/3) times its edge.
using OctahedronSize = RegularSolid<8>;
/// Its height, from a face to that opposite, is 2.2270 times its edge.
using DodecahedronSize = RegularSolid<12>;
/// Its height, from a face to that opposite, is 1.5115 times its edge.
using IcosahedronSize = RegularSolid<20>;
/// An upright prism over a regular polygon.
struct PrismSize {
  int sides = 6;          ///< of the polygon
  double height = 1.0;    ///< d
  double diameter = 1.0;  ///< of the circle that the polygon's corners lie on, d
};

/// A cylinder, packed as the prism within it with the fewest sides that are nowhere further from it
/// than `chord_error`.
struct CylinderSize {
  double height = 1.0;        ///< d
  double diameter = 1.0;      ///< d
  double chord_error = 0.01;  ///< from the middle of a side to the cylinder, d
};

/// The convex hull of points, which are its vertices; see engine/shape/hull.hpp.
struct HullVertices {
  std::vector<std::array<double, 3>> points;  ///< of a grain of size 1, d
};

/// Most vertices of a hull: the time of a check grows with their square.
inline constexpr std::size_t most_vertices_of_a_grain = 1'000;

/// What the shares of a mixture are shares of.
enum class ShareBy {
  volume,  ///< "volume": of the solid volume, and so of the mass
  number,  ///< "number": of the grains
};

struct MixtureComponent;

/// Grains of several shapes, none of them itself a mixture. Sizes are drawn alike for all of them.
struct Mixture {
  std::vector<MixtureComponent> components;
  ShareBy by = ShareBy::volume;
};

/// Hull and mixture come last: the others have no part that must be written.
using ShapeSpec =
    std::variant<SphereShape, PinacoidSize, CubeSize, CuboidSize, TetrahedronSize, OctahedronSize,
                 DodecahedronSize, IcosahedronSize, PrismSize, CylinderSize, HullVertices, Mixture>;

struct MixtureComponent {
  double share = 1.0;  ///< 0 to 1
  ShapeSpec shape;
};

/// Most components of a mixture.
inline constexpr std::size_t most_components = 16;

/// Names of the shapes, as sweeps and tables write them, in that order.
inline constexpr std::array<std::string_view, std::variant_size_v<ShapeSpec>> shape_names = {
    "sphere",       "pinacoid",    "cube",  "cuboid",   "tetrahedron", "octahedron",
    "dodecahedron", "icosahedron", "prism", "cylinder", "hull",        "mixture"};

inline std::string_view name_of(const ShapeSpec& shape) { return shape_names[shape.index()]; }

}  // namespace grainsweep
