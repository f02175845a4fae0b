// An outcome as JSON, and back: the fields of the journal, one member each.
#pragma once

#include <string>
#include <string_view>

#include "runner/store/journal.hpp"

namespace grainsweep {

/// Every double reads back with the same bits.
std::string outcome_text(const Outcome& outcome);

/// Nothing if `text` is no such JSON, or its members are not exactly those that outcome_text would
/// write for what was read.
Boxed<Outcome> outcome_from_text(std::string_view text, Detail detail = Detail::whole);

}  // namespace grainsweep
