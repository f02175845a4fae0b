// The sweep reader for libFuzzer; built by fuzz.sh with the address and the undefined-behaviour
// sanitizer.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>

#include "tests/faults/any_text.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string text(reinterpret_cast<const char*>(data), size);
  if (!grainsweep::testing::read_any_text(text).is_sound) std::abort();
  return 0;
}
