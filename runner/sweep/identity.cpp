#include "runner/sweep/identity.hpp"

#include <nlohmann/json.hpp>

#include "runner/sweep/parameters.hpp"
#include "runner/sweep/values.hpp"

namespace grainsweep {

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
  nlohmann::json canonical = nlohmann::json::object();
  for (const Parameter& parameter : parameters()) {
    const auto value = parameter.get(draft);
    if (!value) continue;
    const std::size_t dot = parameter.path.find('.');
    nlohmann::json& group =
        dot == std::string::npos ? canonical : canonical[parameter.path.substr(0, dot)];
    group[dot == std::string::npos ? parameter.path : parameter.path.substr(dot + 1)] =
        written_value(parameter, *value);
  }
  return canonical.dump();
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
