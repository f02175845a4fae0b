// The command `schema`: what a sweep file may hold, for editors.
#include "runner/sweep/schema.hpp"

#include <iostream>

#include "runner/commands/commands.hpp"
#include "runner/exit_codes.hpp"

namespace grainsweep {

int schema(const SchemaOptions& /*options*/) {
  std::cout << sweep_schema();
  return exit_done;
}

}  // namespace grainsweep
