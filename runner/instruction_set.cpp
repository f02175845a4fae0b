#include "runner/instruction_set.hpp"

#include <cstdlib>

#include "runner/exit_codes.hpp"

namespace grainsweep {
namespace {

Isa isa_called(const std::string& name, const std::string& place) {
  Isa isa = Isa::sse2;
  if (!isa_from_name(name.c_str(), isa)) {
    throw BadInput(place + ": \"" + name + "\" is not an instruction set; use one of " +
                   supported_isas());
  }
  if (!is_supported(isa)) {
    throw BadInput(place + ": this machine cannot run " + name + "; it can run " +
                   supported_isas());
  }
  return isa;
}

}  // namespace

Isa choose_isa(const std::string& option) {
  if (!option.empty()) return isa_called(option, "--isa");
  const char* forced = std::getenv("GRAINSWEEP_ISA");
  if (forced != nullptr && *forced != '\0') return isa_called(forced, "GRAINSWEEP_ISA");
  return best_isa();
}

std::string supported_isas() {
  std::string names;
  for (const Isa isa : {Isa::sse2, Isa::avx2, Isa::avx512}) {
    if (is_supported(isa)) names += (names.empty() ? "" : ", ") + std::string(name_of(isa));
  }
  return names;
}

}  // namespace grainsweep
