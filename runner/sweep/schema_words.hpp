// What a JSON Schema can say of sweeps, in words: each is a schema, and they combine.
#pragma once

#include <string>
#include <vector>

#include "runner/sweep/values.hpp"

namespace grainsweep {

/// Numbers as people write them, from `least` to `most`, ascending: 1, 1.5, 2, 3, 5, 7, 10, 15.
std::vector<double> round_numbers(double least, double most);

/// That a value does not fit `schema`.
Json no(const Json& schema);

/// That a value does not fit all of them at once.
Json not_all(const std::vector<Json>& schemas);

/// That an object has the member, and it fits.
Json with(const std::string& member, const Json& schema);

/// That an object holds the member `path`, in each way to write it, "a.b": 1 and "a": {"b": 1}, and
/// that the member fits.
std::vector<Json> spellings(const std::string& path, const Json& value = Json::object());

/// That it does so in any of these ways.
Json in_any_way(const std::string& path, const Json& value = Json::object());

/// A number with these bounds, {"minimum": 3}.
Json number_with(const Json& bounds);

/// A list of such entries.
Json list_like(const Json& entry);

/// What may be said of a parameter.
struct Mention {
  std::string path;
  Json value = Json::object();
};

/// That a sweep says nothing about these groups ("box|fill") but what is listed: `anywhere` in its
/// base and its blocks, `in_base` in its base only.
Json says_only(const std::string& groups, const std::vector<Mention>& anywhere,
               const std::vector<Mention>& in_base);

}  // namespace grainsweep
