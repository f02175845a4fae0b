// One packing from its specification to its measured values: the whole story of a job.
//
// `make_packing` is a pure function of the specification: same spec, same bits, whatever thread or
// instruction set runs it; of what is measured last digits may differ between C libraries
// (engine/README.md). It reads no file and no clock, prints nothing and starts no thread.
#pragma once

#include <string_view>

#include "engine/context.hpp"
#include "engine/results.hpp"
#include "engine/scene/spec.hpp"

namespace grainsweep {

/// Places, settles, certifies and measures one bed. Requires check(spec).empty().
/// `saved`: bytes that Progress::save gave for the same spec; the packing goes on from there and
/// ends with the same bits. Bytes that are torn or of another version are not taken: it then begins
/// anew, to the same end.
Packing make_packing(const PackingSpec& spec, const ExecutionContext& context,
                     const KeepGoing& keep_going, std::string_view saved = {});

}  // namespace grainsweep
