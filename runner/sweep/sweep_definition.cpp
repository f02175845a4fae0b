#include "runner/sweep/sweep_definition.hpp"

#include <algorithm>
#include <cctype>
#include <limits>
#include <map>
#include <set>
#include <string_view>
#include <utility>

#include "runner/sweep/misplaced_keys.hpp"
#include "runner/sweep/random_paths.hpp"
#include "runner/sweep/read_replicates.hpp"
#include "runner/sweep/read_units.hpp"
#include "runner/sweep/shape_kind.hpp"
#include "runner/sweep/spaced_values.hpp"
#include "runner/sweep/suggest.hpp"
#include "runner/sweep/text_lines.hpp"
#include "runner/sweep/values.hpp"

namespace grainsweep {
namespace {

/// Whether `value` is an object; otherwise a problem is noted.
bool is_object(const Json& value, const std::string& pointer, const char* what,
               Diagnostics& diagnostics) {
  if (value.is_object()) return true;
  diagnostics.push_back({pointer, std::string("must be ") + what + ", is " + describe(value)});
  return false;
}

std::uint64_t read_seed(const Json& file, Diagnostics& diagnostics) {
  const auto found = file.find("seed");
  if (found == file.end()) return 0;
  const ValueReading reading = read_value(parameters()[parameter_with(Role::seed)], *found);
  if (reading.value) return std::get<std::uint64_t>(*reading.value);
  diagnostics.push_back({"/seed", reading.error});
  return 0;
}

bool is_name_character(char c) {
  return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '-' || c == '_' || c == '.';
}

/// The schema matters only to editors; here it only has to be a text.
void expect_schema_name(const Json& file, Diagnostics& diagnostics) {
  const auto found = file.find("$schema");
  if (found == file.end() || found->is_string()) return;
  diagnostics.push_back(
      {"/$schema", "must be the place of a JSON Schema in double quotes, is " + describe(*found)});
}

/// A name becomes the name of a folder: nothing else, and no way out of it.
std::string read_name(const Json& file, Diagnostics& diagnostics) {
  const auto found = file.find("name");
  if (found == file.end()) {
    diagnostics.push_back({"", "\"name\" is missing; add one, e.g. \"name\": \"my-sweep\""});
    return "";
  }
  std::string name = found->is_string() ? found->get<std::string>() : "";
  if (is_sweep_name(name)) return name;
  diagnostics.push_back(
      {"/name", "must be 1 to 100 letters, digits, '-', '_' and '.', the first no '.'; is " +
                    describe(*found)});
  return "";
}

std::string read_label(const Json& block, const std::string& pointer, std::size_t number,
                       Diagnostics& diagnostics) {
  constexpr std::size_t longest = 100;
  const auto found = block.find("label");
  if (found == block.end()) return "block " + std::to_string(number);
  std::string label = found->is_string() ? found->get<std::string>() : "";
  const bool is_text =
      !label.empty() && characters(label) <= longest && without_controls(label) == label;
  if (is_text && !begins_a_formula(label)) return label;
  diagnostics.push_back(
      {child_pointer(pointer, "label"),
       is_text ? "must not begin with =, +, - or @, which spreadsheets take for a formula"
               : "must be a text of 1 to 100 characters on one line, none of them a control, is " +
                     describe(*found)});
  return "block " + std::to_string(number);
}

/// A path that a block varies, for finding what is varied twice.
struct Varied {
  std::string pointer;
  bool is_zipped = false;  ///< meets the other lists of the zip row by row
  std::set<std::size_t> parameters = {};
  std::set<std::string_view> shapes = {};

  void add(const Assignments& assignments) {
    for (const Assignment& assignment : assignments) {
      parameters.insert(assignment.parameter);
      shapes.insert(shape_named_by(assignment));
    }
  }
};

bool name_different_shapes(const Varied& a, const Varied& b) {
  return std::any_of(a.shapes.begin(), a.shapes.end(), [&](std::string_view one) {
    return std::any_of(b.shapes.begin(), b.shapes.end(),
                       [&](std::string_view other) { return exclude_each_other(one, other); });
  });
}

/// What is wrong with varying `b` beside `a`; "" if nothing is.
std::string double_variation(const Varied& a, const Varied& b) {
  const std::string varied_already = " is already varied at " + a.pointer;
  const auto is_in_a = [&](const auto& matches) {
    return std::any_of(a.parameters.begin(), a.parameters.end(), matches);
  };
  for (const std::size_t index : b.parameters) {
    const Parameter& parameter = parameters()[index];
    if (is_fill(index) && is_in_a(is_fill)) return "fill" + varied_already;
    if (a.parameters.count(index) != 0) return parameter.path + varied_already;
    const auto excludes_it = [&](std::size_t other) {
      return are_alternatives(parameters()[other], parameter);
    };
    if (is_in_a(excludes_it)) return described_already(choice_of(parameter), a.pointer);
  }
  return name_different_shapes(a, b) ? "shape" + varied_already : "";
}

void refuse_double_variation(const std::vector<Varied>& all, Diagnostics& diagnostics) {
  for (std::size_t i = 0; i < all.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      if (all[i].is_zipped && all[j].is_zipped) continue;  // read_zip looks at each row
      const std::string problem = double_variation(all[j], all[i]);
      if (problem.empty()) continue;
      diagnostics.push_back({all[i].pointer, problem});
      break;
    }
  }
}

/// The entries of the list that `path` runs through.
std::vector<Assignments> read_list(const std::string& path, const Json& list,
                                   const std::string& pointer, Diagnostics& diagnostics) {
  std::vector<Assignments> entries;
  if (!is_known_path(path, pointer, diagnostics)) return entries;
  if (!list.is_array()) {
    const std::string lists = list.is_object() ? dotted_lists(path, list) : "";
    diagnostics.push_back({pointer, "must be a list of values, is " + describe(list) +
                                        (lists.empty() ? "; a single value belongs into \"set\""
                                                       : "; write " + lists)});
  } else if (list.empty()) {
    diagnostics.push_back({pointer, "must hold at least one value"});
  } else {
    for (std::size_t i = 0; i < list.size(); ++i) {
      Assignments& entry = entries.emplace_back();
      read_assignments(path, list[i], pointer + "/" + std::to_string(i), entry, diagnostics);
    }
  }
  return entries;
}

/// An empty object of lists: the block has the points that it has without it.
void note_if_empty(const Json& lists, const std::string& pointer, Diagnostics& diagnostics) {
  if (!lists.empty()) return;
  diagnostics.push_back({pointer,
                         "varies nothing; name paths with lists of values, or leave it out",
                         Anchor::key, "", true});
}

/// What an entry of a list says, for finding another that says the same.
std::vector<std::pair<std::size_t, Value>> said_by(const Assignments& entry) {
  std::vector<std::pair<std::size_t, Value>> said;
  for (const Assignment& assignment : entry)
    said.emplace_back(assignment.parameter, assignment.value);
  std::sort(said.begin(), said.end());  // in whatever order it is written
  return said;
}

/// Notes entries of an axis that say the same as an earlier one; `pointer` leads to its list.
void refuse_repeats(const std::vector<Assignments>& entries, const std::string& pointer,
                    const char* what, Diagnostics& diagnostics) {
  std::map<std::vector<std::pair<std::size_t, Value>>, std::size_t> first;
  for (std::size_t i = 0; i < entries.size(); ++i) {
    if (entries[i].empty()) continue;
    const auto [known, is_new] = first.emplace(said_by(entries[i]), i);
    if (is_new) continue;
    diagnostics.push_back(
        {entries[i].front().pointer, std::string("repeats ") + what + " " +
                                         std::to_string(known->second + 1) + " of " + pointer +
                                         "; for more packings of a point raise replicates"});
  }
}

/// How many values a path of a grid has; 1 for what is no list or range.
std::uint64_t values_in(const Json& list) {
  if (list.is_array()) return std::max<std::size_t>(list.size(), 1);
  const auto count = list.is_object() ? list.find("count") : list.end();
  Diagnostics told_later;
  if (!list.is_object() || count == list.end()) return 1;
  const auto number = whole_number_in(*count, 2, most_spaced_values, "", told_later);
  return static_cast<std::uint64_t>(number.value_or(1));
}

/// Whether a grid has more points than there is room for.
bool is_too_large(const Json& grid, std::uint64_t room) {
  std::uint64_t points = 1;
  for (const Json& list : grid) {
    points *= values_in(list);
    if (points > room) return true;  // before the product is no number
  }
  return false;
}

/// Reads one block; holds what its parts share. Ranges of a grid with more points than `room` are
/// read as their ends: the sweep will be refused, and all their values could fill the memory.
class BlockReader {
 public:
  BlockReader(const Json& json, Block& block, std::uint64_t room, Diagnostics& diagnostics)
      : json_(json), block_(block), room_(room), diagnostics_(diagnostics) {}

  void read() {
    if (const Json* set = part("set")) {
      block_.set = read_layer(*set, child_pointer(block_.pointer, "set"), diagnostics_);
    }
    if (const Json* grid = part("grid")) read_grid(*grid);
    if (const Json* zip = part("zip")) read_zip(*zip);
    if (const Json* random = part("random")) read_random(*random);
    refuse_double_variation(varied_, diagnostics_);
  }

 private:
  const Json* part(const char* key) const {
    const auto found = json_.find(key);
    return found == json_.end() ? nullptr : &*found;
  }

  std::vector<Assignments> read_varied(const std::string& path, const Json& list,
                                       const std::string& pointer, bool is_zipped = false) {
    std::vector<Assignments> entries = read_list(path, list, pointer, diagnostics_);
    Varied varied{pointer, is_zipped};
    for (const Assignments& entry : entries) {
      varied.add(entry);
      if (!is_zipped) refuse_double_assignments(entry, diagnostics_);
    }
    varied_.push_back(std::move(varied));
    return entries;
  }

  void read_grid(const Json& grid) {
    const std::string pointer = child_pointer(block_.pointer, "grid");
    if (!is_object(grid, pointer, "an object of lists, one per path", diagnostics_)) return;
    note_if_empty(grid, pointer, diagnostics_);
    const bool has_room = !is_too_large(grid, room_);
    for (const auto& [path, list] : grid.items()) {
      const bool is_shortened = !has_room && list.is_object() && values_in(list) > 2;
      Json shorter = is_shortened ? list : Json();
      if (is_shortened) shorter["count"] = 2;
      const Json& read = is_shortened ? shorter : list;
      auto entries = list.is_object() ? read_spaced(path, read, child_pointer(pointer, path))
                                      : read_varied(path, list, child_pointer(pointer, path));
      refuse_repeats(entries, child_pointer(pointer, path), "value", diagnostics_);
      if (entries.empty()) continue;
      const std::uint64_t left_out = is_shortened ? values_in(list) - entries.size() : 0;
      block_.axes.push_back({path, std::move(entries), left_out});
    }
  }

  std::vector<Assignments> read_spaced(const std::string& path, const Json& range,
                                       const std::string& pointer) {
    if (!is_known_path(path, pointer, diagnostics_)) return {};
    const Json values = spaced_values(path, range, pointer, diagnostics_);
    if (values.is_null()) return {};
    std::vector<Assignments> entries = read_varied(path, values, pointer);
    for (Assignments& entry : entries) {
      for (Assignment& assignment : entry) assignment.pointer = pointer;
    }
    return entries;
  }

  void read_zip(const Json& zip) {
    const std::string pointer = child_pointer(block_.pointer, "zip");
    if (!is_object(zip, pointer, "an object of equally long lists", diagnostics_)) return;
    note_if_empty(zip, pointer, diagnostics_);
    Axis axis{"zip", {}};
    std::string lengths;
    std::set<std::size_t> sizes;
    for (const auto& [path, list] : zip.items()) {
      const auto entries = read_varied(path, list, child_pointer(pointer, path), true);
      if (entries.empty()) continue;
      sizes.insert(entries.size());
      lengths += (lengths.empty() ? "" : ", ") + path + " has " + std::to_string(entries.size());
      axis.entries.resize(std::max(axis.entries.size(), entries.size()));
      for (std::size_t i = 0; i < entries.size(); ++i) {
        axis.entries[i].insert(axis.entries[i].end(), entries[i].begin(), entries[i].end());
      }
    }
    for (const Assignments& row : axis.entries) refuse_double_assignments(row, diagnostics_);
    if (sizes.size() > 1) {
      diagnostics_.push_back({pointer, "the lists must be equally long: " + lengths});
      axis.entries.resize(*sizes.begin());
    }
    refuse_repeats(axis.entries, pointer, "row", diagnostics_);
    if (!axis.entries.empty()) block_.axes.push_back(std::move(axis));
  }

  void read_random(const Json& random) {
    const std::string pointer = child_pointer(block_.pointer, "random");
    if (!is_object(random, pointer, "an object of distributions and \"count\"", diagnostics_))
      return;
    block_.random_count = read_random_count(random, pointer, diagnostics_);
    block_.random = read_random_paths(random, pointer, diagnostics_);
    for (const RandomPath& path : block_.random) {
      Varied varied{path.pointer};
      for (const Assignments& choice : path.choices) varied.add(choice);
      if (path.choices.empty()) varied.add({{path.parameter, path.low, path.pointer}});
      varied_.push_back(std::move(varied));
    }
  }

  const Json& json_;
  Block& block_;
  std::uint64_t room_;
  Diagnostics& diagnostics_;
  std::vector<Varied> varied_;
};

const KeysOfPlace& keys_of_file() {
  static const KeysOfPlace keys = {
      .known = {"name", "seed", "replicates", "units", "base", "sweep", "$schema"},
      .layer = "base",
      .elsewhere = {"label", "set", "grid", "zip", "random"},
      .other_place = R"(into an entry of the list "sweep")"};
  return keys;
}

const KeysOfPlace& keys_of_block() {
  static const KeysOfPlace keys = {
      .known = {"label", "set", "grid", "zip", "random", "replicates"},
      .layer = "set",
      .grid = "grid",
      .elsewhere = {"name", "units", "base", "sweep", "$schema"},
      .other_place = R"(beside "sweep", where it holds for all of the sweep)"};
  return keys;
}

/// `room`: how many more points the sweep may have.
Block read_block(const Json& json, std::size_t index, std::uint64_t room,
                 const SweepDefinition& definition, Diagnostics& diagnostics) {
  Block block;
  block.pointer = "/sweep/" + std::to_string(index);
  block.label = "block " + std::to_string(index + 1);
  if (!is_object(json, block.pointer, "an object with label, set, grid, zip, random, replicates",
                 diagnostics)) {
    return block;
  }
  refuse_misplaced_keys(json, block.pointer, keys_of_block(), diagnostics);
  block.label = read_label(json, block.pointer, index + 1, diagnostics);
  block.replicates = read_replicates(json, block.pointer, definition.replicates, diagnostics);
  BlockReader(json, block, room, diagnostics).read();
  return block;
}

void read_sweep_list(const Json& file, SweepDefinition& definition, Diagnostics& diagnostics) {
  const auto sweep = file.find("sweep");
  if (sweep == file.end()) {
    definition.blocks.emplace_back();
    definition.blocks.back().label = definition.name;
    definition.blocks.back().replicates = definition.replicates;
  } else if (!sweep->is_array()) {
    diagnostics.push_back({"/sweep", "must be a list of blocks, is " + describe(*sweep)});
  } else if (sweep->empty()) {
    diagnostics.push_back({"/sweep", "holds no block; leave it out to pack \"base\" alone"});
  } else {
    std::uint64_t room = most_jobs;
    for (std::size_t i = 0; i < sweep->size(); ++i) {
      definition.blocks.push_back(read_block((*sweep)[i], i, room, definition, diagnostics));
      room -= std::min(room, point_count(definition.blocks.back()));
    }
  }
}

Assignments read_base(const Json& file, Diagnostics& diagnostics) {
  const auto base = file.find("base");
  if (base == file.end()) return {};
  Assignments assignments = read_layer(*base, "/base", diagnostics);
  for (const Assignment& assignment : assignments) {
    if (parameters()[assignment.parameter].role != Role::seed) continue;
    diagnostics.push_back(
        {assignment.pointer, "\"seed\" belongs beside \"base\", not into it", Anchor::key});
  }
  return assignments;
}

}  // namespace

bool is_sweep_name(const std::string& name) {
  constexpr std::size_t longest = 100;
  return !name.empty() && name.size() <= longest && name.front() != '.' &&
         std::all_of(name.begin(), name.end(), is_name_character);
}

SweepDefinition read_definition(const Json& file, Diagnostics& diagnostics) {
  SweepDefinition definition;
  if (!is_object(file, "", "an object with name, seed, replicates, units, base, sweep",
                 diagnostics)) {
    return definition;
  }
  refuse_misplaced_keys(file, "", keys_of_file(), diagnostics);
  expect_schema_name(file, diagnostics);
  definition.name = read_name(file, diagnostics);
  definition.seed = read_seed(file, diagnostics);
  definition.replicates = read_replicates(file, "", {}, diagnostics);
  definition.units = read_units(file, diagnostics);
  definition.base = read_base(file, diagnostics);
  read_sweep_list(file, definition, diagnostics);
  return definition;
}

std::uint64_t point_count(const Block& block) {
  constexpr std::uint64_t most = std::numeric_limits<std::uint64_t>::max();
  std::uint64_t points = block.random.empty() ? 1 : std::max<std::uint64_t>(block.random_count, 1);
  for (const Axis& axis : block.axes) {
    if (points > most / axis.size()) return most;
    points *= axis.size();
  }
  return points;
}

}  // namespace grainsweep
