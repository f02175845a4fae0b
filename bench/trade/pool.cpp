#include "bench/trade/pool.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include <nlohmann/json.hpp>

#include "runner/store/files.hpp"
#include "runner/tables/csv.hpp"

namespace grainsweep::bench {
namespace {

using Json = nlohmann::ordered_json;

Json json_of(const MeanError& of) {
  return std::isnan(of.mean) ? Json() : Json::array({of.mean, of.error, of.n});
}

double number_of(const Json& of) { return of.is_null() ? no_number : of.get<double>(); }

/// The error of a single pair, which has none, is null.
MeanError mean_error_of(const Json& of) {
  if (of.is_null()) return {no_number, no_number, 0};
  return {of.at(0), number_of(of.at(1)), of.at(2)};
}

Json json_of(const Compared& row) {
  return {{"accuracy", row.setting->name},
          {"made", row.made},
          {"settled", row.settled},
          {"cpu_seconds", row.cpu_seconds},
          {"relative_cost", row.relative_cost},
          {"solid_fraction", json_of(row.solid_fraction)},
          {"coordination", json_of(row.coordination)},
          {"force_square", json_of(row.force_square)},
          {"lambda", json_of(row.lambda)},
          {"contact_ratio", row.contact_ratio},
          {"own",
           {json_of(row.own_solid_fraction), json_of(row.own_coordination),
            json_of(row.own_force_square)}}};
}

/// `row` of one seed more: what of both is a mean over beds weighs by the beds.
void add(const Json& more, Compared& row) {
  const auto mean = [&](double& value, const Json& other, double of_row, double of_other) {
    if (of_other == 0.0) return;
    const double before = of_row == 0.0 ? 0.0 : of_row * value;
    value = (before + of_other * number_of(other)) / (of_row + of_other);
  };
  const int made = more.at("made"), settled = more.at("settled");
  mean(row.cpu_seconds, more.at("cpu_seconds"), row.made, made);
  mean(row.relative_cost, more.at("relative_cost"), row.made, made);
  mean(row.contact_ratio, more.at("contact_ratio"), row.settled, settled);
  const Json& own = more.at("own");
  row.own_solid_fraction = pooled(row.own_solid_fraction, mean_error_of(own.at(0)));
  row.own_coordination = pooled(row.own_coordination, mean_error_of(own.at(1)));
  row.own_force_square = pooled(row.own_force_square, mean_error_of(own.at(2)));
  row.solid_fraction = pooled(row.solid_fraction, mean_error_of(more.at("solid_fraction")));
  row.coordination = pooled(row.coordination, mean_error_of(more.at("coordination")));
  row.force_square = pooled(row.force_square, mean_error_of(more.at("force_square")));
  row.lambda = pooled(row.lambda, mean_error_of(more.at("lambda")));
  row.made += made;
  row.settled += settled;
}

/// Null if `rows`, those of a seed, have none of that accuracy.
const Json* find_row(const Json& rows, const std::string& accuracy) {
  const auto same = std::find_if(rows.begin(), rows.end(),
                                 [&](const Json& one) { return one.at("accuracy") == accuracy; });
  return same == rows.end() ? nullptr : &*same;
}

/// The pairs of a row do not know of the starts that the reference has in addition.
void compare_means(const Compared& reference, Compared& row) {
  row.solid_fraction = difference_of_means(row.own_solid_fraction, reference.own_solid_fraction);
  row.coordination = difference_of_means(row.own_coordination, reference.own_coordination);
  row.force_square = difference_of_means(row.own_force_square, reference.own_force_square);
  row.lambda = {no_number, no_number, 0};
}

Json read_pool(const std::string& path, const Scene& scene) {
  if (!file_exists(path)) return {{"scene", scene.name}, {"seeds", Json::object()}};
  Json pool = Json::parse(read_file(path), nullptr, false);
  if (!pool.is_object() || !pool.contains("seeds")) {
    throw std::runtime_error(path + ": is no file of rows by seed");
  }
  if (pool.at("scene") != scene.name) {
    throw std::runtime_error(path + ": is of " + pool.at("scene").dump() + ", not of \"" +
                             scene.name + "\"");
  }
  return pool;
}

}  // namespace

MeanError pooled(const MeanError& a, const MeanError& b) {
  if (b.n == 0) return a;
  if (a.n == 0) return b;
  const double n = a.n + b.n;
  return {(a.n * a.mean + b.n * b.mean) / n, std::hypot(a.n * a.error, b.n * b.error) / n,
          a.n + b.n};
}

void pool_with(const std::string& path, const Scene& scene, std::vector<Compared>& rows) {
  Json pool = read_pool(path, scene);
  Json own = Json::array();
  for (const Compared& row : rows) own.push_back(json_of(row));
  const std::string seed = std::to_string(scene.seed);
  pool["seeds"][seed] = own;
  replace_file(path, pool.dump(1) + "\n");
  const std::string reference = rows.front().setting->name;
  for (const auto& [other, of_other] : pool["seeds"].items()) {
    if (other == seed) continue;
    const bool has_reference = find_row(of_other, reference) != nullptr;
    for (Compared& row : rows) {
      const Json* same = find_row(of_other, row.setting->name);
      if (same != nullptr) add(*same, row);
      if (same == nullptr && has_reference) row.are_paired = false;
    }
  }
  for (Compared& row : rows) {
    if (!row.are_paired) compare_means(rows.front(), row);
  }
  mark_front(rows);
}

}  // namespace grainsweep::bench
