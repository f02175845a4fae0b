#include "runner/sweep/parameter_table.hpp"

#include "runner/sweep/values.hpp"

namespace grainsweep {
namespace {

std::string code(const std::string& text) { return "`" + text + "`"; }

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
    table += "| " + code(parameter.path) + " | " + name_of(parameter.kind) + " | " +
             range_of(parameter) + " | " + default_text(parameter) + " | " + parameter.meaning +
             " |\n";
  }
  return table;
}

}  // namespace grainsweep
