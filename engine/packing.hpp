// One packing from its specification to its measured values: the whole story of a job.
//
// `make_packing` is a pure function of the specification: same spec, same bits, whatever thread or
// instruction set runs it. With another C library last digits of measured values may differ and, in
// rare cases, a comparison with a tolerance comes out otherwise (engine/README.md). It reads no
// file and no clock, prints nothing and starts no thread.
#pragma once

#include <optional>
#include <string_view>

#include "engine/context.hpp"
#include "engine/results.hpp"
#include "engine/scene/spec.hpp"

namespace grainsweep {

/// Places, settles, certifies and measures one bed. Requires check(spec).empty().
/// `saved`: bytes that Progress::save gave for the same spec; the packing goes on from there and
/// ends with the same bits. Damaged bytes and those of another version are ignored: the packing
/// then begins anew, with the same result.
Packing make_packing(const PackingSpec& spec, const ExecutionContext& context,
                     const KeepGoing& keep_going, std::string_view saved = {});

/// What make_packing(spec) would give, bit for bit, without settling: measures the bed of `made`, a
/// packing, settled or not, of a spec that differs in `measure` alone. Nothing if the grains of
/// `made` are missing or are others than those of `spec`.
std::optional<Packing> measure_again(const PackingSpec& spec, const Kernels& kernels,
                                     const Packing& made);

}  // namespace grainsweep
