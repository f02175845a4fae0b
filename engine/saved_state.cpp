#include "engine/saved_state.hpp"

namespace grainsweep {

namespace {

// Rises with what is saved; within a version of the program callers compare builds.
constexpr std::uint64_t format = 0x6772'6169'6e73'0011;

struct Header {
  std::uint64_t format, kind, size, check;
};

/// FNV-1a, 64 bits.
std::uint64_t check_of(std::string_view bytes) {
  std::uint64_t hash = 0xcbf29ce484222325U;
  for (const char byte : bytes) {
    hash = (hash ^ static_cast<unsigned char>(byte)) * 0x100000001b3U;
  }
  return hash;
}

}  // namespace

std::string sealed(std::uint64_t kind, std::string_view payload) {
  StateWriter writer;
  writer.value(Header{format, kind, payload.size(), check_of(payload)});
  return writer.bytes() + std::string(payload);
}

std::optional<std::string_view> unsealed(std::uint64_t kind, std::string_view bytes) {
  if (bytes.size() < sizeof(Header)) {
    return std::nullopt;
  }
  Header header{};
  StateReader(bytes).value(header);
  const std::string_view payload = bytes.substr(sizeof(Header));
  const bool is_whole = header.format == format && header.kind == kind &&
                        header.size == payload.size() && header.check == check_of(payload);
  return is_whole ? std::optional(payload) : std::nullopt;
}

}  // namespace grainsweep
