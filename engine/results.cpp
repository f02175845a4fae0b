#include "engine/results.hpp"

namespace grainsweep {

const char* name_of(PackingStatus status) {
  switch (status) {
    case PackingStatus::settled:
      return "settled";
    case PackingStatus::not_settled:
      return "not_settled";
    case PackingStatus::cancelled:
      return "cancelled";
    case PackingStatus::failed:
      return "failed";
  }
  return "unknown";
}

}  // namespace grainsweep
