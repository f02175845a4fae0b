#include "runner/sweep/stl.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <set>
#include <tuple>
#include <utility>

#include "runner/sweep/text_lines.hpp"

namespace grainsweep {
namespace {

// A file of bytes: a heading, the number of triangles, and of each a normal, three corners, all
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

/// The bytes that a file of so many triangles has.
std::uint64_t size_with(std::uint64_t triangles) {
  return heading + sizeof(std::uint32_t) + triangle * triangles;
}

/// Takes vertices, each once, in the order in which they come.
class Vertices {
 public:
  void take(const Vector& vertex) {
    if (known_.insert({vertex.x(), vertex.y(), vertex.z()}).second) all_.push_back(vertex);
  }
  std::vector<Vector> all() && { return std::move(all_); }

 private:
  std::vector<Vector> all_;
  std::set<std::tuple<double, double, double>> known_;
};

VerticesReading parse_bytes(const std::string& bytes, const std::string& file) {
  VerticesReading reading;
  Vertices vertices;
  for (std::uint64_t k = 0; k < triangles_of(bytes); ++k) {
    const std::size_t first = size_with(k) + corner;  // past the normal
    for (std::size_t at = first; at < first + 3 * corner; at += corner) {
      const Vector vertex(number_at<float>(bytes, at), number_at<float>(bytes, at + 4),
                          number_at<float>(bytes, at + 8));
      if (!vertex.allFinite()) {
        reading.errors.push_back({"",
                                  "triangle " + std::to_string(k + 1) +
                                      " has a corner whose coordinates are no finite numbers",
                                  Anchor::value, file});
        return reading;
      }
      vertices.take(vertex);
    }
  }
  reading.vertices = std::move(vertices).all();
  return reading;
}

VerticesReading parse_text(const std::string& text, const std::string& file) {
  constexpr std::string_view keyword = "vertex";
  VerticesReading reading;
  Vertices vertices;
  const auto lines = lines_of(text);
  for (std::size_t k = 0; k < lines.size() && reading.errors.size() < most_wrong_lines; ++k) {
    const std::string_view line = trimmed(lines[k]);
    if (!line.starts_with(keyword)) continue;
    Vector vertex = Vector::Zero();
    const std::string error = read_vertex(line.substr(keyword.size()), vertex);
    if (error.empty()) vertices.take(vertex);
    if (!error.empty()) note_wrong_line(reading.errors, file, k + 1, error);
  }
  reading.vertices = std::move(vertices).all();
  return reading;
}

}  // namespace

bool is_stl(const std::string& path) {
  std::string ending = path.substr(path.size() - std::min<std::size_t>(path.size(), 4));
  for (char& letter : ending) letter = static_cast<char>(letter | 0x20);  // '.' has that bit
  return ending == ".stl";
}

/// Files of bytes may begin with the word that files of text begin with, "solid": their size tells.
VerticesReading parse_stl(const std::string& bytes, const std::string& file) {
  const std::uint64_t triangles = triangles_of(bytes);
  if (triangles > 0 && bytes.size() == size_with(triangles)) return parse_bytes(bytes, file);
  VerticesReading reading = parse_text(bytes, file);
  if (reading.vertices.empty() && reading.errors.empty()) {
    reading.errors.push_back(wrong_line(
        file, 1,
        "no vertex in it; STL is text with lines \"vertex x y z\", or bytes: a heading of 80, the "
        "number of triangles and 50 for each, " +
            std::to_string(size_with(triangles)) + " in all, not " + std::to_string(bytes.size())));
  }
  return reading;
}

VerticesReading read_stl(const std::string& path) { return read_parsed(path, parse_stl); }

VerticesReading read_vertices(const std::string& path) {
  return is_stl(path) ? read_stl(path) : read_obj(path);
}

}  // namespace grainsweep
