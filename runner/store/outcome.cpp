#include "runner/store/outcome.hpp"

#include <array>
#include <stdexcept>

#include <nlohmann/json.hpp>

#include "runner/store/numbers.hpp"

namespace grainsweep {
namespace {

using nlohmann::json;

json rest_json(const RestReport& rest) {
  return {{"residual", number_json(rest.residual)},
          {"kinetic_energy", number_json(rest.kinetic_energy)},
          {"largest_motion", number_json(rest.largest_motion)},
          {"overlap_mean", number_json(rest.overlap_mean)},
          {"overlap_max", number_json(rest.overlap_max)},
          {"contacts", rest.contacts},
          {"isostatic_contacts", rest.isostatic_contacts}};
}

RestReport rest_from(const json& from) {
  RestReport rest;
  rest.residual = number_from(from.at("residual"));
  rest.kinetic_energy = number_from(from.at("kinetic_energy"));
  rest.largest_motion = number_from(from.at("largest_motion"));
  rest.overlap_mean = number_from(from.at("overlap_mean"));
  rest.overlap_max = number_from(from.at("overlap_max"));
  from.at("contacts").get_to(rest.contacts);
  from.at("isostatic_contacts").get_to(rest.isostatic_contacts);
  return rest;
}

/// Nothing if the accuracy asked for no direct solve.
json balance_json(const std::optional<ForceBalance>& balance) {
  if (!balance) return nullptr;
  return {{"unique", balance->unique},
          {"least_force", number_json(balance->least_force)},
          {"unbalance_max", number_json(balance->unbalance_max)},
          {"unbalance_mean", number_json(balance->unbalance_mean)}};
}

std::optional<ForceBalance> balance_from(const json& from) {
  if (from.is_null()) return std::nullopt;
  ForceBalance balance;
  from.at("unique").get_to(balance.unique);
  balance.least_force = number_from(from.at("least_force"));
  balance.unbalance_max = number_from(from.at("unbalance_max"));
  balance.unbalance_mean = number_from(from.at("unbalance_mean"));
  return balance;
}

json coordination_json(const std::vector<Coordination>& coordination) {
  json list = json::array();
  for (const Coordination& at : coordination) {
    list.push_back({{"gap_tolerance", number_json(at.gap_tolerance)},
                    {"between_grains", number_json(at.between_grains)},
                    {"with_walls", number_json(at.with_walls)}});
  }
  return list;
}

std::vector<Coordination> coordination_from(const json& list) {
  std::vector<Coordination> coordination;
  for (const json& at : list) {
    coordination.push_back({number_from(at.at("gap_tolerance")),
                            number_from(at.at("between_grains")),
                            number_from(at.at("with_walls"))});
  }
  return coordination;
}

/// Without its curves.
json order_json(const Order& order) {
  return {{"q6_global", number_json(order.q6_global)},
          {"q6_local", number_json(order.q6_local)},
          {"three_contact_share", number_json(order.three_contact_share)},
          {"segregation", number_json(order.segregation)},
          {"force_mean", number_json(order.force_mean)},
          {"force_square", number_json(order.force_square)}};
}

Order order_from(const json& from) {
  Order order;
  order.q6_global = number_from(from.at("q6_global"));
  order.q6_local = number_from(from.at("q6_local"));
  order.three_contact_share = number_from(from.at("three_contact_share"));
  order.segregation = number_from(from.at("segregation"));
  order.force_mean = number_from(from.at("force_mean"));
  order.force_square = number_from(from.at("force_square"));
  return order;
}

json shares_json(const std::array<double, 3>& shares) {
  json list = json::array();
  for (const double share : shares) list.push_back(number_json(share));
  return list;
}

std::array<double, 3> shares_from(const json& list) {
  std::array<double, 3> shares{};
  for (std::size_t k = 0; k < shares.size(); ++k) shares[k] = number_from(list.at(k));
  return shares;
}

json shape_order_json(const ShapeOrder& order) {
  return {{"contact_share", shares_json(order.contact_share)},
          {"force_share", shares_json(order.force_share)},
          {"nematic", shares_json(order.nematic)}};
}

/// Spheres have none, and their outcomes no member for it.
std::optional<ShapeOrder> shape_order_from(const json& outcome) {
  const auto found = outcome.find("shape_order");
  if (found == outcome.end()) return std::nullopt;
  return ShapeOrder{shares_from(found->at("contact_share")), shares_from(found->at("force_share")),
                    shares_from(found->at("nematic"))};
}

}  // namespace

PackingStatus status_from(std::string_view name) {
  for (const auto status : {PackingStatus::settled, PackingStatus::not_settled,
                            PackingStatus::cancelled, PackingStatus::failed}) {
    if (name == name_of(status)) return status;
  }
  throw std::invalid_argument("no status: " + std::string(name));
}

json to_json(const Outcome& outcome) {
  const PackingResult& result = outcome.result;
  json all = {{"job", outcome.job},
              {"version", outcome.version},
              {"status", name_of(result.status)},
              {"reason", result.reason},
              {"threw", outcome.threw},
              {"grains", result.grains},
              {"stored_grains", outcome.stored_grains},
              {"rest", rest_json(result.rest)},
              {"balance", balance_json(result.balance)},
              {"surface_height", number_json(result.surface_height)},
              {"slab_bottom", number_json(result.slab_bottom)},
              {"slab_top", number_json(result.slab_top)},
              {"solid_fraction", number_json(result.solid_fraction)},
              {"coordination", coordination_json(result.coordination)},
              {"mean_diameter", number_json(result.mean_diameter)},
              {"mean_diameter_by_volume", number_json(result.mean_diameter_by_volume)},
              {"order", order_json(result.order)},
              {"steps", result.steps},
              {"iterations", result.iterations},
              {"state_hash", result.state_hash},
              {"cpu_seconds", number_json(outcome.cpu_seconds)}};
  if (result.shape_order) all["shape_order"] = shape_order_json(*result.shape_order);
  return all;
}

Outcome outcome_from_json(const json& json) {
  Outcome outcome;
  PackingResult& result = outcome.result;
  json.at("job").get_to(outcome.job);
  json.at("version").get_to(outcome.version);
  result.status = status_from(json.at("status").get<std::string>());
  json.at("reason").get_to(result.reason);
  json.at("threw").get_to(outcome.threw);
  json.at("grains").get_to(result.grains);
  json.at("stored_grains").get_to(outcome.stored_grains);
  result.rest = rest_from(json.at("rest"));
  result.balance = balance_from(json.at("balance"));
  result.surface_height = number_from(json.at("surface_height"));
  result.slab_bottom = number_from(json.at("slab_bottom"));
  result.slab_top = number_from(json.at("slab_top"));
  result.solid_fraction = number_from(json.at("solid_fraction"));
  result.coordination = coordination_from(json.at("coordination"));
  result.mean_diameter = number_from(json.at("mean_diameter"));
  result.mean_diameter_by_volume = number_from(json.at("mean_diameter_by_volume"));
  result.order = order_from(json.at("order"));
  result.shape_order = shape_order_from(json);
  json.at("steps").get_to(result.steps);
  json.at("iterations").get_to(result.iterations);
  json.at("state_hash").get_to(result.state_hash);
  outcome.cpu_seconds = number_from(json.at("cpu_seconds"));
  return outcome;
}

}  // namespace grainsweep
