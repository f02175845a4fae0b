// The command `schema`: what a sweep file may hold, for editors.
#include "runner/sweep/schema.hpp"

#include <iostream>

#include "runner/commands/commands.hpp"
#include "runner/exit_codes.hpp"
#include "runner/sweep/parameter_table.hpp"

namespace grainsweep {

int schema(const SchemaOptions& options) {
  std::cout << (options.markdown ? parameter_table() : sweep_schema());
  return exit_done;
}

}  // namespace grainsweep
