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

}  // namespace grainsweep
