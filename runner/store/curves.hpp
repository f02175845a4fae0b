// Curves of a packing as JSON: one list per column, as short as they can be.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "engine/measure/curves.hpp"

namespace grainsweep {

nlohmann::json to_json(const Profile& profile);

/// Throws nlohmann::json::exception or std::invalid_argument if `from` is not what to_json makes.
Profile profile_from_json(const nlohmann::json& from);

nlohmann::json to_json(const Order& order);

/// Throws nlohmann::json::exception or std::invalid_argument if `from` is not what to_json makes.
Order order_from_json(const nlohmann::json& from);

}  // namespace grainsweep
