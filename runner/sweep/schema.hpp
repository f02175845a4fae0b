// The JSON Schema of sweep files, made from the table of parameters: with it, editors complete keys
// and underline what `validate` would complain about.
#pragma once

#include <string>

namespace grainsweep {

/// JSON Schema, draft 7, as configs/sweep.schema.json holds it. It knows every key and the kind of
/// every value; ranges and rules between values are left to the reader.
std::string sweep_schema();

}  // namespace grainsweep
