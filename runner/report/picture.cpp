#include "runner/report/picture.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>
#include <zlib.h>

#include <Eigen/Geometry>

#include "runner/export/exported_bed.hpp"

namespace grainsweep {
namespace {

using Vector = Eigen::Vector3d;

/// Directions to the right, upwards and towards the eye, in the frame of the box.
struct View {
  Vector right, up, towards;
};

View view_of_an_edge() {
  constexpr double turn = 0.6, tilt = 0.5;  // rad, as in templates/bed.js
  const Vector towards(std::sin(turn) * std::cos(tilt), -std::cos(turn) * std::cos(tilt),
                       std::sin(tilt));
  const Vector right(std::cos(turn), std::sin(turn), 0.0);
  return {right, towards.cross(right), towards};
}

/// Pixels, and how near to the eye what they show is.
struct Canvas {
  int width, height;
  std::string pixels;
  std::vector<double> nearest;

  Canvas(int wide, int high)
      : width(wide),
        height(high),
        pixels(3 * area(wide, high), '\xFF'),
        nearest(area(wide, high), -std::numeric_limits<double>::infinity()) {}

  static std::size_t area(int wide, int high) {
    return static_cast<std::size_t>(wide) * static_cast<std::size_t>(high);
  }

  /// `light` from 0 to 1.
  void paint(int x, int y, double near, double light, const Colour& colour) {
    if (x < 0 || y < 0 || x >= width || y >= height) return;
    const std::size_t at =
        static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x);
    if (near <= nearest[at]) return;
    nearest[at] = near;
    for (std::size_t k = 0; k < 3; ++k) {
      pixels[3 * at + k] = static_cast<char>(std::lround(light * colour[k]));
    }
  }
};

/// Where the bed lies on the canvas.
struct Placement {
  View view;
  Vector middle;
  double scale = 1.0;  ///< px per d

  /// Pixels to the right and downwards, and d towards the eye.
  Vector on(const Canvas& canvas, const Vector& point) const {
    const Vector from_middle = point - middle;
    return {canvas.width / 2.0 + scale * from_middle.dot(view.right),
            canvas.height / 2.0 - scale * from_middle.dot(view.up), from_middle.dot(view.towards)};
  }
};

Placement placement_of(const StoredBed& bed, const Canvas& canvas) {
  double height = 1.0;
  for (const SettledGrain& grain : bed.grains) height = std::max(height, grain.z + grain.radius);
  const Vector box(bed.box.length, bed.box.width, height);
  const View view = view_of_an_edge();
  const double wide = box.cwiseProduct(view.right.cwiseAbs()).sum();
  const double high = box.cwiseProduct(view.up.cwiseAbs()).sum();
  return {view, 0.5 * box, 0.94 * std::min(canvas.width / wide, canvas.height / high)};
}

double light_on(const Vector& normal, const View& view) {
  const Vector lamp = (view.towards + 0.5 * view.up - 0.4 * view.right).normalized();
  return 0.35 + 0.65 * std::max(0.0, normal.dot(lamp));
}

/// `share` from 0 to 1 of the way along the colours of sizes.
Colour size_colour(double share) {
  const std::vector<Colour>& all = size_colours();
  const double at = share * static_cast<double>(all.size() - 1);
  const std::size_t low = std::min(static_cast<std::size_t>(at), all.size() - 2);
  Colour colour{};
  for (std::size_t k = 0; k < 3; ++k) {
    colour[k] = std::lerp(all[low][k], all[low + 1][k], at - static_cast<double>(low));
  }
  return colour;
}

void paint_sphere(const SettledGrain& grain, const Placement& place, const Colour& colour,
                  Canvas& canvas) {
  const Vector at = place.on(canvas, {grain.x, grain.y, grain.z});
  const double radius = place.scale * grain.radius;
  for (int y = static_cast<int>(at.y() - radius); y <= at.y() + radius; ++y) {
    for (int x = static_cast<int>(at.x() - radius); x <= at.x() + radius; ++x) {
      const double dx = (x + 0.5 - at.x()) / radius, dy = (at.y() - y - 0.5) / radius;
      const double rest = 1.0 - dx * dx - dy * dy;
      if (rest <= 0.0) continue;
      const double depth = std::sqrt(rest);
      const Vector normal = dx * place.view.right + dy * place.view.up + depth * place.view.towards;
      canvas.paint(x, y, at.z() + grain.radius * depth, light_on(normal, place.view), colour);
    }
  }
}

/// The triangle of corners a, b, c on the canvas.
void paint_triangle(const Vector& a, const Vector& b, const Vector& c, double light,
                    const Colour& colour, Canvas& canvas) {
  const auto area = [](const Vector& p, const Vector& q, double x, double y) {
    return (q.x() - p.x()) * (y - p.y()) - (q.y() - p.y()) * (x - p.x());
  };
  const double whole = area(a, b, c.x(), c.y());
  if (std::abs(whole) < 1e-9) return;
  const auto [left, right] = std::minmax({a.x(), b.x(), c.x()});
  const auto [top, bottom] = std::minmax({a.y(), b.y(), c.y()});
  for (int y = static_cast<int>(top); y <= bottom; ++y) {
    for (int x = static_cast<int>(left); x <= right; ++x) {
      const double u = area(b, c, x + 0.5, y + 0.5) / whole;
      const double v = area(c, a, x + 0.5, y + 0.5) / whole;
      if (u < 0.0 || v < 0.0 || u + v > 1.0) continue;
      canvas.paint(x, y, u * a.z() + v * b.z() + (1.0 - u - v) * c.z(), light, colour);
    }
  }
}

void paint_polyhedron(const StoredBed& bed, std::size_t grain, const Placement& place,
                      const Colour& colour, Canvas& canvas) {
  const std::vector<Vector> corners = vertices_in_box(bed, grain);
  std::vector<Vector> on_canvas;
  on_canvas.reserve(corners.size());
  for (const Vector& corner : corners) on_canvas.push_back(place.on(canvas, corner));
  for (const auto& face : bed.turned->mesh(grain).faces) {
    const auto index = [&](std::size_t k) { return static_cast<std::size_t>(face[k]); };
    const Vector normal = (corners[index(1)] - corners[index(0)])
                              .cross(corners[index(2)] - corners[index(0)])
                              .normalized();
    if (normal.dot(place.view.towards) <= 0.0) continue;
    for (std::size_t k = 2; k < face.size(); ++k) {
      paint_triangle(on_canvas[index(0)], on_canvas[index(k - 1)], on_canvas[index(k)],
                     light_on(normal, place.view), colour, canvas);
    }
  }
}

void append_number(std::string& bytes, std::size_t number) {
  for (unsigned shift = 32; shift > 0; shift -= 8) {
    bytes += static_cast<char>((number >> (shift - 8)) & 0xFFu);
  }
}

void append_chunk(std::string& bytes, const std::string& name, const std::string& content) {
  append_number(bytes, content.size());
  const std::string checked = name + content;
  bytes += checked;
  append_number(bytes, ::crc32(0, reinterpret_cast<const Bytef*>(checked.data()),
                               static_cast<uInt>(checked.size())));
}

std::string compressed(const std::string& bytes) {
  uLongf size = compressBound(bytes.size());
  std::string packed(size, '\0');
  compress2(reinterpret_cast<Bytef*>(packed.data()), &size,
            reinterpret_cast<const Bytef*>(bytes.data()), bytes.size(), Z_BEST_SPEED);
  packed.resize(size);
  return packed;
}

}  // namespace

const std::vector<Colour>& size_colours() {
  static const std::vector<Colour> viridis = {{68, 1, 84},    {72, 36, 117},  {65, 68, 135},
                                              {53, 95, 141},  {42, 120, 142}, {33, 145, 140},
                                              {34, 168, 132}, {68, 191, 112}, {122, 209, 81},
                                              {189, 223, 38}, {253, 231, 37}};
  return viridis;
}

Colour colour_of_one_size() { return size_colour(0.5); }

Colour component_colour(std::size_t component) {
  constexpr std::array<Colour, 8> all = {{{0, 114, 178},
                                          {230, 159, 0},
                                          {0, 158, 115},
                                          {204, 121, 167},
                                          {86, 180, 233},
                                          {213, 94, 0},
                                          {240, 228, 66},
                                          {110, 110, 110}}};
  return all[component % all.size()];
}

std::string picture_of(const StoredBed& bed, int width, int height) {
  Canvas canvas(width, height);
  if (bed.grains.empty()) return png_of(canvas.pixels, width, height);
  const Placement place = placement_of(bed, canvas);
  const auto [smallest, largest] = std::minmax_element(
      bed.grains.begin(), bed.grains.end(),
      [](const SettledGrain& a, const SettledGrain& b) { return a.radius < b.radius; });
  for (std::size_t i = 0; i < bed.grains.size(); ++i) {
    const SettledGrain& grain = bed.grains[i];
    const double span = largest->radius - smallest->radius;
    const Colour colour = has_components(bed) ? component_colour(bed.turned->component(i))
                          : span > 0.0 ? size_colour((grain.radius - smallest->radius) / span)
                                       : colour_of_one_size();
    if (is_sphere(bed, i))
      paint_sphere(grain, place, colour, canvas);
    else
      paint_polyhedron(bed, i, place, colour, canvas);
  }
  return png_of(canvas.pixels, width, height);
}

std::string png_of(const std::string& pixels, int width, int height) {
  std::string header;
  append_number(header, static_cast<std::size_t>(width));
  append_number(header, static_cast<std::size_t>(height));
  header += std::string("\x08\x02\x00\x00\x00", 5);  // 8 bits, RGB
  std::string rows;
  const std::size_t row_size = 3 * static_cast<std::size_t>(width);
  for (std::size_t at = 0; at < pixels.size(); at += row_size) {
    rows += '\0';  // no filter
    rows.append(pixels, at, row_size);
  }
  std::string png = "\x89PNG\r\n\x1A\n";
  append_chunk(png, "IHDR", header);
  append_chunk(png, "IDAT", compressed(rows));
  append_chunk(png, "IEND", "");
  return png;
}

}  // namespace grainsweep
