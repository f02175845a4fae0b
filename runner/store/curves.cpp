#include "runner/store/curves.hpp"

#include "runner/store/numbers.hpp"

namespace grainsweep {
namespace {

using nlohmann::json;

json volumes(const Profile& profile, double ProfileBin::*member) {
  json list = json::array();
  for (const ProfileBin& bin : profile.bins) list.push_back(number_json(bin.*member));
  return list;
}

json counts(const Profile& profile, std::int64_t ProfileBin::*member) {
  json list = json::array();
  for (const ProfileBin& bin : profile.bins) list.push_back(bin.*member);
  return list;
}

const json& column_of(const json& from, const char* name, const Profile& profile) {
  const json& list = from.at(name);
  if (list.size() != profile.bins.size()) {
    throw std::invalid_argument(std::string("a column of another length: ") + name);
  }
  return list;
}

json curve_json(const Curve& curve) {
  json values = json::array();
  for (const double value : curve.values) values.push_back(number_json(value));
  return {{"bin_width", number_json(curve.bin_width)}, {"values", values}};
}

Curve curve_from(const json& from) {
  Curve curve{number_from(from.at("bin_width")), {}};
  for (const json& value : from.at("values")) curve.values.push_back(number_from(value));
  return curve;
}

void read_volumes(const json& from, const char* name, double ProfileBin::*member,
                  Profile& profile) {
  const json& list = column_of(from, name, profile);
  for (std::size_t k = 0; k < profile.bins.size(); ++k) {
    profile.bins[k].*member = number_from(list[k]);
  }
}

void read_counts(const json& from, const char* name, std::int64_t ProfileBin::*member,
                 Profile& profile) {
  const json& list = column_of(from, name, profile);
  for (std::size_t k = 0; k < profile.bins.size(); ++k) list[k].get_to(profile.bins[k].*member);
}

}  // namespace

json to_json(const Profile& profile) {
  return {{"bin_width", number_json(profile.bin_width)},
          {"large", volumes(profile, &ProfileBin::large)},
          {"small", volumes(profile, &ProfileBin::small)},
          {"large_grains", counts(profile, &ProfileBin::large_grains)},
          {"small_grains", counts(profile, &ProfileBin::small_grains)},
          {"neighbours", counts(profile, &ProfileBin::neighbours)},
          {"walls", counts(profile, &ProfileBin::walls)}};
}

Profile profile_from_json(const json& from) {
  Profile profile;
  profile.bin_width = number_from(from.at("bin_width"));
  profile.bins.resize(from.at("large").size());
  read_volumes(from, "large", &ProfileBin::large, profile);
  read_volumes(from, "small", &ProfileBin::small, profile);
  read_counts(from, "large_grains", &ProfileBin::large_grains, profile);
  read_counts(from, "small_grains", &ProfileBin::small_grains, profile);
  read_counts(from, "neighbours", &ProfileBin::neighbours, profile);
  read_counts(from, "walls", &ProfileBin::walls, profile);
  return profile;
}

json to_json(const Order& order) {
  return {{"q6_global", number_json(order.q6_global)},
          {"q6_local", number_json(order.q6_local)},
          {"three_contact_share", number_json(order.three_contact_share)},
          {"segregation", number_json(order.segregation)},
          {"force_mean", number_json(order.force_mean)},
          {"force_square", number_json(order.force_square)},
          {"pair_correlation", curve_json(order.pair_correlation)},
          {"force_density", curve_json(order.force_density)}};
}

Order order_from_json(const json& from) {
  Order order;
  order.q6_global = number_from(from.at("q6_global"));
  order.q6_local = number_from(from.at("q6_local"));
  order.three_contact_share = number_from(from.at("three_contact_share"));
  order.segregation = number_from(from.at("segregation"));
  order.force_mean = number_from(from.at("force_mean"));
  order.force_square = number_from(from.at("force_square"));
  order.pair_correlation = curve_from(from.at("pair_correlation"));
  order.force_density = curve_from(from.at("force_density"));
  return order;
}

}  // namespace grainsweep
