#include "runner/sweep/shape_kind.hpp"

#include <variant>

namespace grainsweep {
namespace {

constexpr std::string_view group = "shape.";

}  // namespace

std::string_view shape_named_by(const Assignment& assignment) {
  const Parameter& parameter = parameters()[assignment.parameter];
  if (choice_of(parameter) != Choice::shape) return "";
  if (parameter.role == Role::shape) {
    return parameter.choices[static_cast<std::size_t>(std::get<std::int64_t>(assignment.value))];
  }
  const std::string_view path = std::string_view(parameter.path).substr(group.size());
  if (parameter.role == Role::mixture_by) return "mixture";
  const bool says_whence =
      parameter.role == Role::hull_vertices || parameter.role == Role::hull_file;
  return says_whence ? path : path.substr(0, path.find('.'));
}

bool exclude_each_other(std::string_view a, std::string_view b) {
  return !a.starts_with(b) && !b.starts_with(a);
}

std::string_view more_exact(std::string_view a, std::string_view b) {
  return a.size() < b.size() ? b : a;
}

}  // namespace grainsweep
