// Vertices from a Wavefront OBJ file: where the shape of a hull comes from.
//
// Only the lines "v x y z" matter; faces are worked out anew from the vertices, all others are left
// alone. Decimal points; a fourth number (weight) and colours after it are ignored.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "engine/shape/convex_shape.hpp"
#include "runner/sweep/diagnostic.hpp"

namespace grainsweep {

/// What is read from a file of a shape.
struct VerticesReading {
  std::vector<Vector> vertices;    ///< in the file's own unit of length
  std::vector<Diagnostic> errors;  ///< with places "rock.obj:12"; at most 20 of a file
};

/// The coordinates of a vertex, words separated by blanks; what is wrong with them, or "". Words
/// behind the third are left alone.
std::string read_vertex(std::string_view coordinates, Vector& vertex);

/// Reads vertices from the file at `path`. Refuses coordinates that are missing or no finite
/// numbers, and files without a vertex.
VerticesReading read_obj(const std::string& path);

/// The same from `text`, the content of `file`.
VerticesReading parse_obj(const std::string& text, const std::string& file);

}  // namespace grainsweep
