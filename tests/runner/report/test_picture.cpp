#include <zlib.h>

#include <catch2/catch.hpp>

#include "runner/report/picture.hpp"
#include "tests/runner/sample_rows.hpp"

using namespace grainsweep;

namespace {

std::size_t number_at(const std::string& png, std::size_t at) {
  std::size_t number = 0;
  for (std::size_t k = 0; k < 4; ++k) {
    number = number << 8u | static_cast<unsigned char>(png[at + k]);
  }
  return number;
}

/// The rows of a PNG of three chunks, each behind the byte of its filter.
std::string rows_of(const std::string& png, std::size_t size) {
  const std::size_t data = 8 + 25;  // signature and header
  std::string rows(size, '\0');
  uLongf length = size;
  const int result =
      uncompress(reinterpret_cast<Bytef*>(rows.data()), &length,
                 reinterpret_cast<const Bytef*>(png.data() + data + 8), number_at(png, data));
  return result == Z_OK && length == size ? rows : "";
}

}  // namespace

TEST_CASE("a PNG has its size, checksums and pixels", "[report]") {
  const std::string pixels("\x01\x02\x03\x04\x05\x06\x07\x08\x09\x0A\x0B\x0C", 12);
  const std::string png = png_of(pixels, 2, 2);
  CHECK(png.substr(1, 3) == "PNG");
  CHECK(number_at(png, 16) == 2);
  CHECK(number_at(png, 20) == 2);
  CHECK(number_at(png, 29) == crc32(0, reinterpret_cast<const Bytef*>(png.data() + 12), 4 + 13));
  CHECK(rows_of(png, 14) ==
        std::string(1, '\0') + pixels.substr(0, 6) + std::string(1, '\0') + pixels.substr(6));
}

TEST_CASE("a sphere stands in the middle of its picture, and nothing in the corners", "[report]") {
  StoredBed bed;
  bed.box.length = bed.box.width = 1.0;
  bed.grains = {{0.5, 0.5, 0.5, 0.5, 1.0, 0}};
  const std::string rows = rows_of(picture_of(bed, 40, 40), 40 * 121);
  REQUIRE_FALSE(rows.empty());
  const auto is_white = [&](std::size_t x, std::size_t y) {
    return rows.substr(121 * y + 1 + 3 * x, 3) == "\xFF\xFF\xFF";
  };
  CHECK_FALSE(is_white(20, 20));
  CHECK(is_white(0, 0));
  CHECK(is_white(39, 39));
}

TEST_CASE("the smallest and largest grains have the ends of the scale that the key shows",
          "[report]") {
  StoredBed bed;
  bed.box.length = bed.box.width = 2.0;
  bed.grains = {{0.5, 0.5, 0.5, 0.5, 1.0, 0}, {1.5, 1.5, 0.5, 0.4, 1.0, 0}};
  const std::string rows = rows_of(picture_of(bed, 60, 60), 60 * 181);
  std::size_t purple = 0, yellow = 0;
  for (std::size_t at = 0; at < 60 * 60; ++at) {
    const auto part = [&](std::size_t k) {
      return static_cast<unsigned char>(rows[181 * (at / 60) + 1 + 3 * (at % 60) + k]);
    };
    purple += part(1) < 5 && part(2) > part(0) ? 1 : 0;
    yellow += part(0) > 80 && part(2) < part(0) / 4 ? 1 : 0;
  }
  CHECK(size_colours().front() == Colour{68, 1, 84});
  CHECK(size_colours().back() == Colour{253, 231, 37});
  CHECK((purple > 100 && yellow > 100));
}

TEST_CASE("polyhedra are seen, too", "[report]") {
  StoredBed bed;
  bed.box.length = bed.box.width = 2.0;
  bed.grains = {{0.5, 0.5, 0.5, 0.5, 1.0, 0}, {1.0, 1.0, 0.5, 0.4, 1.0, 0}};
  bed.turned = sample_turned();
  const std::string rows = rows_of(picture_of(bed, 60, 60), 60 * 181);
  CHECK(rows.find_first_not_of(std::string("\x00\xFF", 2)) != std::string::npos);
}

TEST_CASE("components of a mixture have colours of their own, spheres among them", "[report]") {
  StoredBed bed;
  bed.box.length = bed.box.width = 2.0;
  bed.grains = {{0.5, 0.5, 0.5, 0.5, 1.0, 0}, {1.5, 1.5, 0.5, 0.5, 1.0, 0}};
  bed.turned = sample_turned();
  bed.turned->meshes.emplace_back();
  bed.turned->components = {0, 1};
  const std::string rows = rows_of(picture_of(bed, 60, 60), 60 * 181);
  std::size_t blue = 0, orange = 0;
  for (std::size_t y = 0; y < 60; ++y) {
    for (std::size_t x = 0; x < 60; ++x) {
      const auto part = [&](std::size_t k) {
        return static_cast<unsigned char>(rows[181 * y + 1 + 3 * x + k]);
      };
      blue += part(0) < part(2) ? 1 : 0;
      orange += part(0) > part(2) ? 1 : 0;
    }
  }
  CHECK((blue > 20 && orange > 200));  // a small tetrahedron, and a sphere
}

TEST_CASE("a bed without grains gives a white picture", "[report]") {
  const std::string rows = rows_of(picture_of({}, 8, 8), 8 * 25);
  CHECK(rows.find_first_not_of(std::string("\x00\xFF", 2)) == std::string::npos);
}
