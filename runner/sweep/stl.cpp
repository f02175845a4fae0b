#include "runner/sweep/stl.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <map>
#include <tuple>
#include <utility>

#include "engine/shape/hull.hpp"
#include "engine/text.hpp"
#include "runner/sweep/resolved_spec.hpp"
#include "runner/sweep/text_lines.hpp"

namespace grainsweep {
namespace {

constexpr std::string_view end_of_solid = "endsolid";  // of a file of text

// A file of bytes: a heading, the number of triangles, and for each a normal and three corners, all
// little-endian f32, and a number that nothing uses.
constexpr std::size_t heading = 80, triangle = 50, corner = 12;

template <class Number>
Number number_at(const std::string& bytes, std::size_t at) {
  Number number = 0;
  std::memcpy(&number, bytes.data() + at, sizeof number);
  return number;
}

std::uint64_t triangles_of(const std::string& bytes) {
  const bool has_count = bytes.size() >= heading + sizeof(std::uint32_t);
  return has_count ? number_at<std::uint32_t>(bytes, heading) : 0;
}

/// The size in bytes of a file of so many triangles.
std::uint64_t size_with(std::uint64_t triangles) {
  return heading + sizeof(std::uint32_t) + triangle * triangles;
}

/// Takes the corners of triangles, three at a time; each is a vertex once, in the order in which
/// they come.
class Triangles {
 public:
  explicit Triangles(std::string file) : file_(std::move(file)) {}
  void take(const Vector& point) {
    const auto next = static_cast<std::int32_t>(number_.size());
    const auto [known, is_new] = number_.try_emplace({point.x(), point.y(), point.z()}, next);
    if (is_new) reading_.vertices.push_back(point);
    face_.push_back(known->second);
    if (face_.size() < 3) return;
    reading_.faces.push_back(std::exchange(face_, {}));
    reading_.face_places.push_back(file_ + ": triangle " + std::to_string(reading_.faces.size()));
  }
  /// Ends a triangle. Returns how many corners it has if they are too few, else 0.
  std::size_t end() { return std::exchange(face_, {}).size(); }
  VerticesReading reading() && { return std::move(reading_); }

 private:
  std::string file_;
  VerticesReading reading_;
  std::vector<std::int32_t> face_;
  std::map<std::tuple<double, double, double>, std::int32_t> number_;
};

VerticesReading parse_bytes(const std::string& bytes, const std::string& file) {
  Triangles triangles(file);
  for (std::uint64_t k = 0; k < triangles_of(bytes); ++k) {
    const std::size_t first = size_with(k) + corner;  // past the normal
    for (std::size_t at = first; at < first + 3 * corner; at += corner) {
      const Vector vertex(number_at<float>(bytes, at), number_at<float>(bytes, at + 4),
                          number_at<float>(bytes, at + 8));
      if (!vertex.allFinite()) {
        VerticesReading wrong;
        wrong.errors.push_back({"",
                                "triangle " + std::to_string(k + 1) +
                                    " has a corner whose coordinates are no finite numbers",
                                Anchor::value, file});
        return wrong;
      }
      triangles.take(vertex);
    }
  }
  return std::move(triangles).reading();
}

/// What is wrong with a line, or "".
std::string take_line(std::string_view line, Triangles& triangles) {
  constexpr std::string_view keyword = "vertex";
  if (line.starts_with(keyword)) {
    Vector vertex = Vector::Zero();
    std::string error = read_vertex(line.substr(keyword.size()), vertex);
    if (error.empty()) triangles.take(vertex);
    return error;
  }
  const bool ends_facet = line.starts_with("endfacet") || line.starts_with(end_of_solid);
  const std::size_t corners = ends_facet ? triangles.end() : 0;
  return corners == 0 ? "" : "a facet needs three corners, has " + std::to_string(corners);
}

VerticesReading parse_text(const std::string& text, const std::string& file) {
  Diagnostics errors;
  Triangles triangles(file);
  bool is_whole = false;
  const auto lines = lines_of(text);
  for (std::size_t k = 0; k < lines.size() && errors.size() < most_wrong_lines; ++k) {
    const std::string_view line = trimmed(lines[k]);
    const std::string error = take_line(line, triangles);
    if (!error.empty()) note_wrong_line(errors, file, k + 1, error);
    is_whole = line.starts_with(end_of_solid) || (is_whole && line.empty());
  }
  VerticesReading reading = std::move(triangles).reading();
  if (!is_whole && errors.empty() && !reading.vertices.empty()) {
    note_wrong_line(errors, file, lines.size(),
                    "the file ends without \"endsolid\": it is cut off");
  }
  reading.errors = std::move(errors);
  return reading;
}

/// A body that is not convex would become its hull, which is another body: a ring a cylinder.
void note_dent(VerticesReading& reading) {
  const auto dent = deepest_dent(reading.vertices, reading.faces);
  if (!dent) return;
  reading.errors.push_back(
      {"",
       joined("this face lies inside the hull of the vertices, ",
              number_text(100.0 * dent->depth / dent->extent),
              " % of the shape's extent deep: the shape is not convex, and only convex ones are "
              "packed; give a file of its hull if that is meant"),
       Anchor::value, reading.face_places[dent->face]});
}

/// Without faces nothing tells a ring from a cylinder with superfluous vertices.
void note_hidden_vertices(VerticesReading& reading) {
  const Hull hull = convex_hull(reading.vertices, flat_as_written);
  const std::size_t vertices = reading.vertices.size();
  const std::size_t corners = hull.shape ? hull.shape->vertices.size() : vertices;
  if (corners == vertices) return;
  reading.note = joined(vertices - corners, " of its ", vertices,
                        " vertices lie on edges or faces of their hull, which is packed; if they "
                        "are of a hole or a notch, the shape is not convex, and the hull another");
}

}  // namespace

bool is_stl(const std::string& path) {
  std::string ending = path.substr(path.size() - std::min<std::size_t>(path.size(), 4));
  for (char& letter : ending) letter = static_cast<char>(letter | 0x20);  // '.' has that bit
  return ending == ".stl";
}

/// Files of bytes may begin with the word that files of text begin with, "solid": their size
/// decides.
VerticesReading parse_stl(const std::string& bytes, const std::string& file) {
  const std::uint64_t triangles = triangles_of(bytes);
  if (triangles > 0 && bytes.size() == size_with(triangles)) return parse_bytes(bytes, file);
  VerticesReading reading = parse_text(bytes, file);
  if (!reading.vertices.empty() || !reading.errors.empty()) return reading;
  if (triangles > 0 && bytes.find('\0') != std::string::npos) {
    reading.errors.push_back({"",
                              joined("is cut off, or its number of triangles is wrong: ", triangles,
                                     " take ", size_with(triangles),
                                     " bytes (a heading of 80, the "
                                     "number, and 50 for each), and it has ",
                                     bytes.size()),
                              Anchor::value, file});
    return reading;
  }
  reading.errors.push_back(
      wrong_line(file, 1,
                 "no vertex in it; STL is text with lines \"vertex x y z\", or bytes: a heading of "
                 "80, the number of triangles and 50 for each"));
  return reading;
}

VerticesReading read_stl(const std::string& path) { return read_parsed(path, parse_stl); }

VerticesReading read_vertices(const std::string& path) {
  VerticesReading reading = is_stl(path) ? read_stl(path) : read_obj(path);
  const bool is_looked_at =
      reading.errors.empty() && reading.vertices.size() <= most_vertices_of_a_grain;
  if (is_looked_at && reading.faces.empty()) note_hidden_vertices(reading);
  if (is_looked_at) note_dent(reading);
  return reading;
}

}  // namespace grainsweep
