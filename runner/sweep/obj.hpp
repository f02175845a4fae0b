// Vertices from a Wavefront OBJ file: where the shape of a hull comes from.
//
// The hull is made from the lines "v x y z"; the lines of faces, "f 1 2 3", tell whether that is
// the intended body. All other lines are ignored. Decimal points; a fourth number (weight) and
// colours after it are ignored.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "engine/shape/build.hpp"
#include "engine/shape/convex_shape.hpp"
#include "runner/sweep/diagnostic.hpp"

namespace grainsweep {

/// What is read from a file of a shape.
struct VerticesReading {
  std::vector<Vector> vertices;  ///< in the file's own unit of length
  Loops faces = {};              ///< by number of vertex, from 0; empty where a file has none
  std::vector<std::string> face_places = {};  ///< "rock.obj:30", "rock.stl: triangle 7"
  std::string note = {};                      ///< worth knowing of a file without faces, or ""
  std::vector<Diagnostic> errors;             ///< with places "rock.obj:12"; at most 20 of a file
};

/// Reads the coordinates of a vertex, words separated by blanks; returns what is wrong with them,
/// or "". Words after the third are ignored.
std::string read_vertex(std::string_view coordinates, Vector& vertex);

/// Reads vertices from the file at `path`. Refuses coordinates that are missing or no finite
/// numbers, faces of vertices that are not there, and files without a vertex.
VerticesReading read_obj(const std::string& path);

/// The same from `text`, the content of `file`.
VerticesReading parse_obj(const std::string& text, const std::string& file);

}  // namespace grainsweep
