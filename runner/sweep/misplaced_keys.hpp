// Parameters that are known, but written in another place than their own: what to write instead.
#pragma once

#include <string>
#include <vector>

#include "runner/sweep/diagnostic.hpp"
#include "runner/sweep/json_text.hpp"

namespace grainsweep {

/// "box.width" of "box" and "width", "width" of "" and that.
std::string dotted(const std::string& path, const std::string& key);

/// The shortest full path that ends in a key misplaced into `group`; "" if there is none. The parts
/// of a shape or a distribution are looked for only in the groups that it is in, as others have
/// other parts.
std::string path_that_ends_in(const std::string& key, const std::string& group);

/// The shortest full path that has the members of `path`, at least two, in their order, and ends in
/// the same one: "sizes.distribution.lognormal.sigma" for "sizes.lognormal.sigma"; "" if there is
/// none.
std::string path_with_members(const std::string& path);

/// What the object at a place may hold, and where the rest belongs.
struct KeysOfPlace {
  std::vector<std::string> known = {};
  std::string layer = {};  ///< the member that holds parameters, and groups of them
  std::string grid = {};   ///< that of lists of their values; "" if it has none
  std::vector<std::string> elsewhere = {};  ///< keys of another place
  std::string other_place = {};             ///< where those belong: `into an entry of "sweep"`
};

/// Notes each member of `object`, which stands at `pointer`, that is not known there.
void refuse_misplaced_keys(const Json& object, const std::string& pointer, const KeysOfPlace& place,
                           Diagnostics& diagnostics);

/// What to write for an object of lists, {"diameter": [3, 4]}, in the place of a list for the group
/// `path`: `"tube.diameter": [3, 4]`; "" if it holds something else.
std::string dotted_lists(const std::string& path, const Json& object);

}  // namespace grainsweep
