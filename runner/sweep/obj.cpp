#include "runner/sweep/obj.hpp"

#include <optional>
#include <string_view>

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
    if (next_word(line) != "v") continue;
    Vector vertex = Vector::Zero();
    const std::string error = read_vertex(line, vertex);
    if (error.empty()) {
      reading.vertices.push_back(vertex);
    } else {
      note_wrong_line(reading.errors, file, k + 1, error);
    }
  }
  if (reading.vertices.empty() && reading.errors.empty()) {
    reading.errors.push_back(wrong_line(file, 1,
                                        "no vertex in it; it is read as Wavefront OBJ, at least 4 "
                                        "lines \"v x y z\"; a file of STL must be called .stl"));
  }
  return reading;
}

VerticesReading read_obj(const std::string& path) { return read_parsed(path, parse_obj); }

}  // namespace grainsweep
