// VTK XML PolyData, in text: the parts of a file.
#pragma once

#include <cstddef>
#include <functional>
#include <string>

namespace grainsweep {

/// An array of `size` values, a line for each; `value(k)` is a number or several with spaces.
std::string vtp_array(const std::string& attributes, std::size_t size,
                      const std::function<std::string(std::size_t)>& value);

/// The element Points, of coordinates "x y z".
std::string vtp_points(std::size_t size, const std::function<std::string(std::size_t)>& point);

/// An element with this content; `name` may have attributes behind it.
std::string vtp_element(const std::string& name, const std::string& content);

/// The cells of a kind, "Verts", "Lines" or "Polys", by their points and where the points of each
/// end.
std::string vtp_cells(const std::string& kind, const std::string& connectivity,
                      const std::string& offsets);

/// A whole file, with `points` points and `cells` cells of one kind, and lengths in `unit`.
std::string vtp_file(const char* kind, std::size_t points, std::size_t cells,
                     const std::string& unit, const std::string& content);

}  // namespace grainsweep
