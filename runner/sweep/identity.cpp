#include "runner/sweep/identity.hpp"

#include <algorithm>
#include <charconv>

#include "runner/sweep/parameters.hpp"

namespace grainsweep {
namespace {

std::vector<std::size_t> indices_by_path() {
  std::vector<std::size_t> order(parameters().size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  std::sort(order.begin(), order.end(), [](std::size_t a, std::size_t b) {
    return parameters()[a].path < parameters()[b].path;
  });
  return order;
}

void append_number(double value, std::string& text) {
  char digits[32];
  text.append(digits, std::to_chars(digits, digits + sizeof digits, value).ptr);
}

/// Names and hashes hold no character that JSON would escape.
void append_value(const Parameter& parameter, const Value& value, std::string& text) {
  if (const auto* number = std::get_if<double>(&value)) return append_number(*number, text);
  if (const auto* word = std::get_if<std::string>(&value)) {
    text.append("\"").append(*word).append("\"");
  } else if (const auto* numbers = std::get_if<std::vector<double>>(&value)) {
    text += '[';
    for (const double& entry : *numbers) {
      if (&entry != numbers->data()) text += ',';
      append_number(entry, text);
    }
    text += ']';
  } else if (parameter.kind == ValueKind::choice) {
    const auto index = static_cast<std::size_t>(std::get<std::int64_t>(value));
    text.append("\"").append(parameter.choices[index]).append("\"");
  } else {
    text += std::to_string(std::get<std::int64_t>(value));
  }
}

}  // namespace

std::uint64_t fnv1a(std::string_view bytes) {
  std::uint64_t hash = 0xcbf29ce484222325;
  for (const char c : bytes) {
    hash ^= static_cast<unsigned char>(c);
    hash *= 0x100000001b3;
  }
  return hash;
}

std::uint64_t mixed(std::uint64_t bits) {
  bits = (bits ^ (bits >> 30U)) * 0xbf58476d1ce4e5b9;
  bits = (bits ^ (bits >> 27U)) * 0x94d049bb133111eb;
  return bits ^ (bits >> 31U);
}

std::string hex16(std::uint64_t bits) {
  std::string text(16, '0');
  for (std::size_t i = 16; i-- > 0; bits >>= 4U) text[i] = "0123456789abcdef"[bits & 15U];
  return text;
}

std::string canonical_parameters(const Draft& draft) {
  static const std::vector<std::size_t> order = indices_by_path();
  std::string text = "{";
  std::string_view open_group;
  for (const std::size_t index : order) {
    const Parameter& parameter = parameters()[index];
    const auto value = parameter.get(draft);
    if (!value) continue;
    const std::string_view path = parameter.path;
    const std::size_t dot = path.find('.');
    const std::string_view group = dot == std::string_view::npos ? "" : path.substr(0, dot);
    if (group != open_group && !open_group.empty()) text += '}';
    if (text.size() > 1 && text.back() != '{') text += ',';
    if (group != open_group && !group.empty()) text.append("\"").append(group).append("\":{");
    open_group = group;
    const std::string_view key = group.empty() ? path : path.substr(dot + 1);
    text.append("\"").append(key).append("\":");
    append_value(parameter, *value, text);
  }
  return text.append(open_group.empty() ? "}" : "}}");
}

std::uint64_t job_hash(std::string_view parameters, std::uint64_t seed, int replicate) {
  std::string identity(parameters);
  identity.append("\n").append(std::to_string(seed));
  identity.append("\n").append(std::to_string(replicate));
  return mixed(fnv1a(identity));
}

std::uint64_t random_key_of(std::uint64_t job_hash) {
  constexpr std::uint64_t golden_ratio = 0x9e3779b97f4a7c15;  // 2^64 over it, odd
  return mixed(job_hash + golden_ratio);
}

}  // namespace grainsweep
