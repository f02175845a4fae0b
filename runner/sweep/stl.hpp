// Vertices from an STL file, of text or of bytes: where the shape of a hull comes from.
//
// Each corner of a triangle is taken once, and the hull is made from these; the triangles tell
// whether that is the intended body.
#pragma once

#include <string>

#include "runner/sweep/obj.hpp"

namespace grainsweep {

/// Whether a file's name ends in .stl, in capitals or not.
bool is_stl(const std::string& path);

/// Reads vertices from the STL file at `path`. Refuses coordinates that are missing or no finite
/// numbers, files cut short and files without a triangle.
VerticesReading read_stl(const std::string& path);

/// The same from `bytes`, the content of `file`.
VerticesReading parse_stl(const std::string& bytes, const std::string& file);

/// Vertices from a file of either kind, by its name: STL, or else OBJ. Refuses bodies that are not
/// convex, as far as faces tell.
VerticesReading read_vertices(const std::string& path);

}  // namespace grainsweep
