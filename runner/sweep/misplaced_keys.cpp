#include "runner/sweep/misplaced_keys.hpp"

#include <algorithm>

#include "runner/sweep/parameters.hpp"
#include "runner/sweep/suggest.hpp"

namespace grainsweep {
namespace {

std::vector<std::string> split_at_dots(const std::string& path) {
  std::vector<std::string> members;
  for (std::size_t begin = 0, dot = 0; dot != std::string::npos; begin = dot + 1) {
    dot = path.find('.', begin);
    members.push_back(path.substr(begin, dot - begin));
  }
  return members;
}

bool is_path(const std::string& path) {
  return find_parameter(path) || (is_group(path) && !path.empty());
}

/// The full path that a key stands for if it leaves out groups; "" if there is none.
std::string path_without_groups(const std::string& key) {
  return key.find('.') == std::string::npos ? path_that_ends_in(key, "") : path_with_members(key);
}

/// Whether a value of the parameter is a list itself.
bool takes_list(const std::string& path) {
  const auto index = find_parameter(path);
  if (!index) return false;
  switch (parameters()[*index].kind) {
    case ValueKind::texts:
    case ValueKind::numbers:
    case ValueKind::points:
    case ValueKind::components:
      return true;
    default:
      return false;
  }
}

bool has(const std::vector<std::string>& keys, const std::string& key) {
  return std::find(keys.begin(), keys.end(), key) != keys.end();
}

/// Where `value` belongs that is written as `key` into the wrong place; "" if nobody knows.
std::string where_to_put(const std::string& key, const Json& value, const KeysOfPlace& place) {
  if (has(place.elsewhere, key)) return "put it " + place.other_place;
  if (key == "until" || key == "most") {
    return R"(put it into "replicates": { "until": { "solid_fraction": 0.001 }, "most": 100 })";
  }
  const bool is_meant = is_path(key);
  const bool is_misspelt = !is_meant && !nearest(key, place.known).empty();
  const std::string path = is_meant ? key : is_misspelt ? "" : path_without_groups(key);
  if (path.empty()) return "";
  const bool is_listed = value.is_array() && !place.grid.empty() && !takes_list(path);
  return (path == key ? "put it" : "put \"" + path + "\"") + " into \"" +
         (is_listed ? place.grid : place.layer) + "\"";
}

}  // namespace

std::string dotted(const std::string& path, const std::string& key) {
  return path.empty() ? key : path + "." + key;
}

std::string path_that_ends_in(const std::string& key, const std::string& group) {
  std::string found;
  for (const std::string& path : known_keys("")) {
    if (!path.ends_with("." + key)) continue;
    const std::string home = path.substr(0, path.size() - key.size() - 1);
    const bool is_related =
        group.find('.') == std::string::npos || group.starts_with(home) || home.starts_with(group);
    const bool is_shorter = found.empty() || path.size() < found.size();
    if (is_related && is_shorter) found = path;
  }
  return found;
}

std::string path_with_members(const std::string& path) {
  const std::vector<std::string> members = split_at_dots(path);
  if (members.size() < 2) return "";
  std::string found;
  for (const std::string& known : known_keys("")) {
    const std::vector<std::string> whole = split_at_dots(known);
    auto next = members.begin();
    for (const std::string& member : whole) {
      if (next != members.end() && *next == member) ++next;
    }
    const bool has_all = next == members.end() && whole.back() == members.back();
    if (has_all && (found.empty() || known.size() < found.size())) found = known;
  }
  return found;
}

void refuse_misplaced_keys(const Json& object, const std::string& pointer, const KeysOfPlace& place,
                           Diagnostics& diagnostics) {
  for (const auto& [key, value] : object.items()) {
    if (has(place.known, key)) continue;
    const std::string put = where_to_put(key, value, place);
    diagnostics.push_back(
        {child_pointer(pointer, key),
         put.empty() ? unknown_key(key, place.known) : "unknown key \"" + key + "\" here; " + put,
         Anchor::key});
  }
}

std::string dotted_lists(const std::string& path, const Json& object) {
  std::string lists;
  for (const auto& [key, value] : object.items()) {
    const std::string member = dotted(path, key);
    const std::string written = value.is_object()
                                    ? dotted_lists(member, value)
                                    : (value.is_array() && find_parameter(member)
                                           ? "\"" + member + "\": " + shortened(Json(value).dump())
                                           : "");
    if (written.empty()) return "";
    lists += (lists.empty() ? "" : ", ") + written;
  }
  return lists;
}

}  // namespace grainsweep
