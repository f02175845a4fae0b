#include "runner/store/turned.hpp"

#include <array>
#include <cstdint>
#include <stdexcept>
#include <vector>

#include "runner/store/bytes.hpp"

namespace grainsweep {
namespace {

template <std::size_t size>
void put_numbers(std::string& bytes, const std::vector<std::array<double, size>>& items) {
  for (const auto& item : items) {
    for (const double number : item) put(bytes, number);
  }
}

template <std::size_t size>
std::vector<std::array<double, size>> take_numbers(std::string_view& bytes, std::size_t count) {
  need(bytes, count, size * sizeof(double));
  std::vector<std::array<double, size>> items(count);
  for (auto& item : items) {
    for (double& number : item) number = take_double(bytes);
  }
  return items;
}

std::size_t take_count(std::string_view& bytes) {
  need(bytes, 1, sizeof(std::uint32_t));
  return take<std::uint32_t>(bytes);
}

void put_count(std::string& bytes, std::size_t count) {
  put(bytes, static_cast<std::uint32_t>(count));
}

void put_face(std::string& bytes, const std::vector<std::int32_t>& face) {
  put_count(bytes, face.size());
  for (const std::int32_t vertex : face) put(bytes, static_cast<std::uint32_t>(vertex));
}

std::vector<std::int32_t> take_face(std::string_view& bytes, std::size_t vertices) {
  const std::size_t corners = take_count(bytes);
  need(bytes, corners, sizeof(std::uint32_t));
  std::vector<std::int32_t> face(corners);
  for (std::int32_t& vertex : face) {
    const std::size_t named = take_count(bytes);
    if (named >= vertices) throw std::out_of_range("a face names no vertex");
    vertex = static_cast<std::int32_t>(named);
  }
  return face;
}

}  // namespace

void put_turned(std::string& bytes, const Turned& turned) {
  put_numbers(bytes, turned.orientations);
  put_count(bytes, turned.mesh.vertices.size());
  put_numbers(bytes, turned.mesh.vertices);
  put_count(bytes, turned.mesh.faces.size());
  for (const auto& face : turned.mesh.faces) put_face(bytes, face);
}

Turned take_turned(std::string_view& bytes, std::size_t grains) {
  Turned turned;
  turned.orientations = take_numbers<4>(bytes, grains);
  const std::size_t vertices = take_count(bytes);
  turned.mesh.vertices = take_numbers<3>(bytes, vertices);
  const std::size_t faces = take_count(bytes);
  need(bytes, faces, sizeof(std::uint32_t));
  turned.mesh.faces.reserve(faces);
  for (std::size_t k = 0; k < faces; ++k) turned.mesh.faces.push_back(take_face(bytes, vertices));
  return turned;
}

}  // namespace grainsweep
