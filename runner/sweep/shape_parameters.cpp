#include <algorithm>
#include <array>
#include <type_traits>
#include <utility>

#include "engine/shape/lengths.hpp"
#include "engine/shape/named_shapes.hpp"
#include "engine/units.hpp"
#include "runner/sweep/identity.hpp"
#include "runner/sweep/parameter_row.hpp"

namespace grainsweep {
namespace {

using Rows = std::vector<Parameter>;

template <std::size_t... indices>
ShapeSpec usual_shape(std::size_t index, std::index_sequence<indices...> /*all*/) {
  const std::array shapes = {ShapeSpec(std::in_place_index<indices>)...};
  return shapes[index];
}

/// The shape at this place among shape_names, with its defaults.
ShapeSpec usual_shape(std::size_t index) {
  return usual_shape(index, std::make_index_sequence<shape_names.size()>());
}

void set_shape(ResolvedSpec& resolved, const Value& value) {
  resolved.spec.shape = usual_shape(static_cast<std::size_t>(std::get<std::int64_t>(value)));
}
/// Other shapes are known by their parts.
std::optional<Value> get_shape(const ResolvedSpec& resolved) {
  if (!std::holds_alternative<SphereShape>(resolved.spec.shape)) return std::nullopt;
  return present(std::int64_t{0});
}

/// The shape that is being written, which becomes one of this kind.
template <class Size>
Size& shape_as(ResolvedSpec& resolved) {
  auto* same = std::get_if<Size>(&resolved.spec.shape);
  return same != nullptr ? *same : resolved.spec.shape.emplace<Size>();
}

template <class Size, auto member>
void set_part(ResolvedSpec& resolved, const Value& value) {
  auto& target = shape_as<Size>(resolved).*member;
  if constexpr (std::is_same_v<std::remove_reference_t<decltype(target)>, int>) {
    target = static_cast<int>(std::get<std::int64_t>(value));
  } else {
    target = std::get<double>(value);
  }
}
template <class Size, auto member>
std::optional<Value> get_part(const ResolvedSpec& resolved) {
  const auto* shape = std::get_if<Size>(&resolved.spec.shape);
  if (shape == nullptr) return std::nullopt;
  if constexpr (std::is_same_v<std::remove_cvref_t<decltype(shape->*member)>, int>) {
    return present(std::int64_t{shape->*member});
  } else {
    return present(shape->*member);
  }
}

/// A member of a shape's description that is set and read as it is.
template <auto member, class Size, class T>
Parameter part_of(T Size::* /*member*/, const char* path, const Interval& range,
                  const char* meaning) {
  return own(path, range, meaning, kind_of<T>(), Role::shape_part, set_part<Size, member>,
             get_part<Size, member>);
}
template <auto member>
Parameter part(const char* path, const char* meaning, const Interval& range) {
  return part_of<member>(member, path, range, meaning);
}
template <auto member>
Parameter length(const char* path, const char* meaning) {
  return in("d", part<member>(path, meaning, lengths_of_shapes));
}

void set_angle(ResolvedSpec& resolved, const Value& value) {
  resolved.pinacoid_angle = std::get<double>(value);
  shape_as<PinacoidSize>(resolved).angle = resolved.pinacoid_angle * (pi / 180.0);
}
std::optional<Value> get_angle(const ResolvedSpec& resolved) {
  const bool is_pinacoid = std::holds_alternative<PinacoidSize>(resolved.spec.shape);
  return is_pinacoid ? present(resolved.pinacoid_angle) : std::nullopt;
}

void set_vertices(ResolvedSpec& resolved, const Value& value) {
  resolved.spec.shape = HullVertices{std::get<Points>(value)};
}
std::optional<Value> get_vertices(const ResolvedSpec& resolved) {
  const auto* hull = std::get_if<HullVertices>(&resolved.spec.shape);
  return hull != nullptr ? present(hash_of(*hull)) : std::nullopt;
}
void set_hull_file(ResolvedSpec& resolved, const Value& value) {
  resolved.spec.shape = HullVertices{};
  resolved.hull_file = std::get<std::string>(value);
}

/// A mixture of one component is that shape.
void set_mixture(ResolvedSpec& resolved, const Value& value) {
  const auto& components = std::get<Components>(value);
  if (components.size() == 1 && components.front().share == 1.0) {
    resolved.spec.shape = components.front().shape;
    resolved.pinacoid_angle = components.front().pinacoid_angle;
    resolved.hull_file = components.front().hull_file;
    return;
  }
  resolved.mixture = components;
  Mixture mixture{{}, resolved.mixture_by};
  for (const WrittenComponent& one : components) {
    mixture.components.push_back({one.share, one.shape});
  }
  resolved.spec.shape = std::move(mixture);
}
std::optional<Value> get_mixture(const ResolvedSpec& resolved) {
  const bool is_mixture = std::holds_alternative<Mixture>(resolved.spec.shape);
  return is_mixture ? present(resolved.mixture) : std::nullopt;
}
void set_mixture_by(ResolvedSpec& resolved, const Value& value) {
  resolved.mixture_by = static_cast<ShareBy>(std::get<std::int64_t>(value));
  auto* mixture = std::get_if<Mixture>(&resolved.spec.shape);
  if (mixture != nullptr) mixture->by = resolved.mixture_by;
}
std::optional<Value> get_mixture_by(const ResolvedSpec& resolved) {
  const auto* mixture = std::get_if<Mixture>(&resolved.spec.shape);
  return mixture != nullptr ? present(static_cast<std::int64_t>(mixture->by)) : std::nullopt;
}

/// The names of shapes that have defaults, in the order of ShapeSpec.
Names usual_shapes() {
  return {
      {"sphere", "a sphere of diameter d"},
      {"pinacoid", "a crystal of eight vertices, as long, wide and high as d, ends at 60 degrees"},
      {"cube", "a cube of edge d"},
      {"cuboid", "a brick, as long, wide and high as d"},
      {"tetrahedron", "a regular tetrahedron d high"},
      {"octahedron", "a regular octahedron, d from face to face"},
      {"dodecahedron", "a regular dodecahedron, d from face to face"},
      {"icosahedron", "a regular icosahedron, d from face to face"},
      {"prism", "a six-sided prism, d high, d across its corners"},
      {"cylinder", "a cylinder of diameter d, d high, of 16 sides"}};
}

Rows pinacoid_rows() {
  using P = PinacoidSize;
  return {length<&P::length>("shape.pinacoid.length", "length of the middle plane, d"),
          length<&P::width>("shape.pinacoid.width", "width of the middle plane, d"),
          length<&P::height>("shape.pinacoid.height", "distance of its two ridges, d"),
          in("degrees", own("shape.pinacoid.angle_deg", Interval{0, 89, true},
                            "angle between ends and middle plane, degrees", ValueKind::number,
                            Role::shape_part, set_angle, get_angle))};
}

Rows solid_rows() {
  using P = PrismSize;
  using C = CylinderSize;
  const Interval sides{3, most_sides};
  return {
      length<&CubeSize::edge>("shape.cube.edge", "edge of a cube, d"),
      length<&CuboidSize::length>("shape.cuboid.length", "first edge of a brick, d"),
      length<&CuboidSize::width>("shape.cuboid.width", "second edge of a brick, d"),
      length<&CuboidSize::height>("shape.cuboid.height", "third edge of a brick, d"),
      length<&TetrahedronSize::height>(
          "shape.tetrahedron.height",
          "from a face to the opposite corner, d: 0.8165 times the edge"),
      length<&OctahedronSize::height>("shape.octahedron.height",
                                      "from a face to that opposite, d: 0.8165 times the edge"),
      length<&DodecahedronSize::height>("shape.dodecahedron.height",
                                        "from a face to that opposite, d: 2.2270 times the edge"),
      length<&IcosahedronSize::height>("shape.icosahedron.height",
                                       "from a face to that opposite, d: 1.5115 times the edge"),
      part<&P::sides>("shape.prism.sides", "sides of the polygon below a prism", sides),
      length<&P::height>("shape.prism.height", "height of a prism, d"),
      length<&P::diameter>("shape.prism.diameter",
                           "of the circle through the corners of its polygon, d"),
      length<&C::height>("shape.cylinder.height", "height of a cylinder, d"),
      length<&C::diameter>("shape.cylinder.diameter", "diameter of a cylinder, d"),
      length<&C::chord_error>("shape.cylinder.chord_error",
                              "from the cylinder to the middle of each side of the prism within it "
                              "that is packed, d, at most"),
  };
}

Rows hull_rows() {
  return {
      own("shape.hull.vertices", WrittenValues{}, "vertices [x, y, z] of a convex grain",
          ValueKind::points, Role::hull_vertices, set_vertices, get_vertices),
      own("shape.hull.file", WrittenValues{},
          "OBJ or STL file of the vertices instead; relative to the sweep file", ValueKind::text,
          Role::hull_file, set_hull_file, no_identity),
      own("shape.hull.size", positive, "the length in the vertices that is d; 1 if left out",
          ValueKind::number, Role::hull_size, set_member<&ResolvedSpec::hull_size>, no_identity),
  };
}

Rows mixture_rows() {
  return {
      own("shape.mixture", WrittenValues{},
          "grains of several shapes, each with its share: "
          "`[{\"share\": 0.7, \"cube\": {}}, {\"share\": 0.3, \"prism\": {\"sides\": 5}}]`",
          ValueKind::components, Role::mixture, set_mixture, get_mixture),
      own("shape.mixture_by",
          Names{{"volume", "of their volume, and so of their mass"},
                {"number", "of the grains, each counted once"}},
          "what the shares of a mixture are shares of", ValueKind::choice, Role::mixture_by,
          set_mixture_by, get_mixture_by),
  };
}

}  // namespace

std::vector<Parameter> shape_parameters() {
  Rows all = {own("shape", usual_shapes(),
                  "what the grains are; a name alone stands for the shape with the parts that base "
                  "gives it, else its defaults",
                  ValueKind::choice, Role::shape, set_shape, get_shape)};
  for (Rows rows : {pinacoid_rows(), solid_rows(), hull_rows(), mixture_rows()}) {
    for (Parameter& parameter : rows) all.push_back(std::move(parameter));
  }
  return all;
}

ShapeSpec shape_with_part(const std::string& path) {
  const std::size_t begin = path.find('.') + 1;
  const std::string name = path.substr(begin, path.find('.', begin) - begin);
  const auto found = std::find(shape_names.begin(), shape_names.end(), name);
  return usual_shape(static_cast<std::size_t>(found - shape_names.begin()));
}

}  // namespace grainsweep
