#include "runner/sweep/parameter_table.hpp"

#include "runner/sweep/values.hpp"

namespace grainsweep {
namespace {

std::string code(const std::string& text) { return "`" + text + "`"; }

const char* type_of(const Parameter& parameter) {
  switch (parameter.kind) {
    case ValueKind::number:
      return "number";
    case ValueKind::whole:
    case ValueKind::natural:
      return "whole number";
    case ValueKind::choice:
      return "name";
    case ValueKind::text:
      return "text";
    case ValueKind::texts:
      return "list of texts";
    case ValueKind::numbers:
      return "list of numbers";
    case ValueKind::points:
      return "list of points";
    case ValueKind::components:
      return "list of components";
  }
  return "";
}

/// Where a number may lie, or the names to choose from.
std::string range_of(const Parameter& parameter) {
  if (parameter.kind == ValueKind::natural) return "[0, 18446744073709551615]";
  if (parameter.range) return parameter.range->text();
  std::string names;
  for (const std::string& name : parameter.choices) {
    names += (names.empty() ? "" : ", ") + code("\"" + name + "\"");
  }
  return names;
}

std::string default_text(const Parameter& parameter) {
  if (parameter.role == Role::preset) return code("\"" + std::string(default_preset) + "\"");
  const auto value = default_of(parameter);
  return value ? code(written_value(parameter, *value).dump()) : "";
}

}  // namespace

std::string parameter_table() {
  std::string table =
      "| parameter | type | range | default | meaning |\n"
      "|---|---|---|---|---|\n";
  for (const Parameter& parameter : parameters()) {
    table += "| " + code(parameter.path) + " | " + type_of(parameter) + " | " +
             range_of(parameter) + " | " + default_text(parameter) + " | " + parameter.meaning +
             " |\n";
  }
  return table;
}

}  // namespace grainsweep
