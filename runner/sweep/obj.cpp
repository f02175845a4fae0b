#include "runner/sweep/obj.hpp"

#include <charconv>
#include <cstdint>
#include <optional>
#include <string_view>
#include <system_error>

#include "runner/sweep/suggest.hpp"
#include "runner/sweep/text_lines.hpp"

namespace grainsweep {
namespace {

/// Takes the first word off a line.
std::string_view next_word(std::string_view& line) {
  line = trimmed(line);
  const std::string_view word = line.substr(0, line.find_first_of(" \t"));
  line.remove_prefix(word.size());
  return word;
}

/// Reads the vertices of a face, "1/2/3 4//5 -1", as numbers from 0, a negative one counted back
/// from the last of `known`; returns what is wrong with them, or "".
std::string read_face(std::string_view words, std::size_t known, std::vector<std::int32_t>& face) {
  for (std::string_view word = next_word(words); !word.empty(); word = next_word(words)) {
    const std::string_view number = word.substr(0, word.find('/'));
    std::int32_t value = 0;
    const auto [end, error] = std::from_chars(number.data(), number.data() + number.size(), value);
    if (error != std::errc() || end != number.data() + number.size() || value == 0) {
      return "a face needs numbers of vertices, from 1, has \"" + shortened(word) + "\"";
    }
    face.push_back(value > 0 ? value - 1 : static_cast<std::int32_t>(known) + value);
  }
  return face.size() < 3 ? "a face needs three vertices or more, has " + std::to_string(face.size())
                         : "";
}

/// Notes vertices of faces that are missing; faces may come before their vertices.
void note_missing_vertices(VerticesReading& reading) {
  const auto count = static_cast<std::int32_t>(reading.vertices.size());
  for (std::size_t f = 0; f < reading.faces.size(); ++f) {
    for (const std::int32_t k : reading.faces[f]) {
      if (k >= 0 && k < count) continue;
      return reading.errors.push_back({"",
                                       "the face has a vertex " + std::to_string(k + 1) +
                                           ", and the file has those from 1 to " +
                                           std::to_string(count),
                                       Anchor::value, reading.face_places[f]});
    }
  }
}

}  // namespace

std::string read_vertex(std::string_view coordinates, Vector& vertex) {
  for (int axis = 0; axis < 3; ++axis) {
    const std::string_view word = next_word(coordinates);
    if (word.empty()) {
      return "a vertex needs three coordinates, has " + std::to_string(axis);
    }
    const std::optional<double> value = finite_number(word);
    if (!value) {
      return std::string(1, "xyz"[axis]) + " must be a finite number, is \"" + shortened(word) +
             "\"";
    }
    vertex[axis] = *value;
  }
  return "";
}

VerticesReading parse_obj(const std::string& text, const std::string& file) {
  VerticesReading reading;
  const auto lines = lines_of(text);
  for (std::size_t k = 0; k < lines.size() && reading.errors.size() < most_wrong_lines; ++k) {
    std::string_view line = lines[k];
    const std::string_view kind = next_word(line);
    std::string error;
    if (kind == "v") {
      error = read_vertex(line, reading.vertices.emplace_back(Vector::Zero()));
    } else if (kind == "f") {
      error = read_face(line, reading.vertices.size(), reading.faces.emplace_back());
      reading.face_places.push_back(file + ":" + std::to_string(k + 1));
    }
    if (!error.empty()) note_wrong_line(reading.errors, file, k + 1, error);
  }
  if (reading.errors.empty() && !reading.vertices.empty()) note_missing_vertices(reading);
  if (reading.vertices.empty() && reading.errors.empty()) {
    reading.errors.push_back(wrong_line(file, 1,
                                        "no vertex in it; it is read as Wavefront OBJ, at least 4 "
                                        "lines \"v x y z\"; a file of STL must be called .stl"));
  }
  return reading;
}

VerticesReading read_obj(const std::string& path) { return read_parsed(path, parse_obj); }

}  // namespace grainsweep
