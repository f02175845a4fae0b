#include "runner/sweep/blocks.hpp"

#include <algorithm>
#include <cctype>
#include <limits>
#include <set>

#include "runner/sweep/random_paths.hpp"
#include "runner/sweep/shape_kind.hpp"
#include "runner/sweep/suggest.hpp"
#include "runner/sweep/values.hpp"

namespace grainsweep {
namespace {

void refuse_unknown_keys(const Json& object, const std::string& pointer,
                         const std::vector<std::string>& known, Problems& problems) {
  for (const auto& [key, value] : object.items()) {
    if (std::find(known.begin(), known.end(), key) != known.end()) continue;
    problems.push_back({child_pointer(pointer, key), unknown_key(key, known), Anchor::key});
  }
}

/// Whether `value` is an object; otherwise a problem is noted.
bool is_object(const Json& value, const std::string& pointer, const char* what,
               Problems& problems) {
  if (value.is_object()) return true;
  problems.push_back({pointer, std::string("must be ") + what + ", is " + describe(value)});
  return false;
}

int read_replicates(const Json& object, const std::string& pointer, int otherwise,
                    Problems& problems) {
  const auto found = object.find("replicates");
  if (found == object.end()) return otherwise;
  const bool whole = found->is_number_integer();
  if (whole && found->get<double>() >= 1.0 && found->get<double>() <= most_replicates) {
    return found->get<int>();
  }
  problems.push_back({child_pointer(pointer, "replicates"), "must be a whole number in [1, " +
                                                                std::to_string(most_replicates) +
                                                                "], is " + describe(*found)});
  return otherwise;
}

std::uint64_t read_seed(const Json& file, Problems& problems) {
  const auto found = file.find("seed");
  if (found == file.end()) return 0;
  const ValueReading reading = read_value(parameters()[parameter_with(Role::seed)], *found);
  if (reading.value) return std::get<std::uint64_t>(*reading.value);
  problems.push_back({"/seed", reading.error});
  return 0;
}

bool is_name_character(char c) {
  return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '-' || c == '_' || c == '.';
}

/// The schema is the business of editors; here it only has to be a text.
void expect_schema_name(const Json& file, Problems& problems) {
  const auto found = file.find("$schema");
  if (found == file.end() || found->is_string()) return;
  problems.push_back(
      {"/$schema", "must be the place of a JSON Schema in double quotes, is " + describe(*found)});
}

/// A name becomes the name of a folder: nothing else, and no way out of it.
std::string read_name(const Json& file, Problems& problems) {
  constexpr std::size_t longest = 100;
  const auto found = file.find("name");
  if (found == file.end()) {
    problems.push_back({"", "\"name\" is missing; add one, e.g. \"name\": \"my-sweep\""});
    return "";
  }
  std::string name = found->is_string() ? found->get<std::string>() : "";
  const bool letters = std::all_of(name.begin(), name.end(), is_name_character);
  if (letters && !name.empty() && name.size() <= longest && name.front() != '.') return name;
  problems.push_back(
      {"/name", "must be 1 to 100 letters, digits, '-', '_' and '.', the first no '.'; is " +
                    describe(*found)});
  return "";
}

std::string read_label(const Json& block, const std::string& pointer, std::size_t number,
                       Problems& problems) {
  constexpr std::size_t longest = 100;
  const auto found = block.find("label");
  if (found == block.end()) return "block " + std::to_string(number);
  std::string label = found->is_string() ? found->get<std::string>() : "";
  const auto is_control = [](char c) { return static_cast<unsigned char>(c) < 0x20; };
  const bool controls = std::any_of(label.begin(), label.end(), is_control);
  if (!label.empty() && label.size() <= longest && !controls) return label;
  problems.push_back({child_pointer(pointer, "label"),
                      "must be a text of 1 to 100 characters on one line, is " + describe(*found)});
  return "block " + std::to_string(number);
}

/// A path that a block varies, for finding what is varied twice.
struct Varied {
  std::string path, pointer;
  std::set<std::size_t> parameters = {};
  std::set<ShapeKind> shapes = {};

  void add(const Settings& settings) {
    for (const Setting& setting : settings) {
      parameters.insert(setting.parameter);
      shapes.insert(shape_named_by(setting));
    }
  }
};

bool name_different_shapes(const Varied& a, const Varied& b) {
  return std::any_of(a.shapes.begin(), a.shapes.end(), [&](ShapeKind one) {
    return std::any_of(b.shapes.begin(), b.shapes.end(),
                       [&](ShapeKind other) { return exclude_each_other(one, other); });
  });
}

bool vary_the_same(const Varied& a, const Varied& b, std::string& path) {
  for (const std::size_t parameter : b.parameters) {
    const bool fills_again =
        is_fill(parameter) && std::any_of(a.parameters.begin(), a.parameters.end(), is_fill);
    if (a.parameters.count(parameter) == 0 && !fills_again) continue;
    path = fills_again ? "fill" : parameters()[parameter].path;
    return true;
  }
  path = "shape";
  return name_different_shapes(a, b);
}

void refuse_double_variation(const std::vector<Varied>& all, Problems& problems) {
  for (std::size_t i = 0; i < all.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      std::string path;
      if (!vary_the_same(all[j], all[i], path)) continue;
      problems.push_back({all[i].pointer, path + " is already varied at " + all[j].pointer});
      break;
    }
  }
}

/// The entries of the list that `path` runs through.
std::vector<Settings> read_list(const std::string& path, const Json& list,
                                const std::string& pointer, Problems& problems) {
  std::vector<Settings> entries;
  if (!is_known_path(path, pointer, problems)) return entries;
  if (!list.is_array()) {
    problems.push_back({pointer, "must be a list of values, is " + describe(list) +
                                     "; a single value belongs into \"set\""});
  } else if (list.empty()) {
    problems.push_back({pointer, "must hold at least one value"});
  } else {
    for (std::size_t i = 0; i < list.size(); ++i) {
      Settings& entry = entries.emplace_back();
      read_settings(path, list[i], pointer + "/" + std::to_string(i), entry, problems);
      refuse_double_settings(entry, problems);
    }
  }
  return entries;
}

/// Reads one block; holds what its parts share.
class BlockReader {
 public:
  BlockReader(const Json& json, Block& block, Problems& problems)
      : json_(json), block_(block), problems_(problems) {}

  void read() {
    if (const Json* set = part("set")) {
      block_.set = read_layer(*set, child_pointer(block_.pointer, "set"), problems_);
    }
    if (const Json* grid = part("grid")) read_grid(*grid);
    if (const Json* zip = part("zip")) read_zip(*zip);
    if (const Json* random = part("random")) read_random(*random);
    refuse_double_variation(varied_, problems_);
  }

 private:
  const Json* part(const char* key) const {
    const auto found = json_.find(key);
    return found == json_.end() ? nullptr : &*found;
  }

  std::vector<Settings> read_varied(const std::string& path, const Json& list,
                                    const std::string& pointer) {
    std::vector<Settings> entries = read_list(path, list, pointer, problems_);
    Varied varied{path, pointer, {}};
    for (const Settings& entry : entries) varied.add(entry);
    varied_.push_back(std::move(varied));
    return entries;
  }

  void read_grid(const Json& grid) {
    const std::string pointer = child_pointer(block_.pointer, "grid");
    if (!is_object(grid, pointer, "an object of lists, one per path", problems_)) return;
    for (const auto& [path, list] : grid.items()) {
      auto entries = read_varied(path, list, child_pointer(pointer, path));
      if (!entries.empty()) block_.axes.push_back({path, std::move(entries)});
    }
  }

  void read_zip(const Json& zip) {
    const std::string pointer = child_pointer(block_.pointer, "zip");
    if (!is_object(zip, pointer, "an object of equally long lists", problems_)) return;
    Axis axis{"zip", {}};
    std::string lengths;
    std::set<std::size_t> sizes;
    for (const auto& [path, list] : zip.items()) {
      const auto entries = read_varied(path, list, child_pointer(pointer, path));
      if (entries.empty()) continue;
      sizes.insert(entries.size());
      lengths += (lengths.empty() ? "" : ", ") + path + " has " + std::to_string(entries.size());
      axis.entries.resize(std::max(axis.entries.size(), entries.size()));
      for (std::size_t i = 0; i < entries.size(); ++i) {
        axis.entries[i].insert(axis.entries[i].end(), entries[i].begin(), entries[i].end());
      }
    }
    if (sizes.size() > 1) {
      problems_.push_back({pointer, "the lists must be equally long: " + lengths});
      axis.entries.resize(*sizes.begin());
    }
    if (!axis.entries.empty()) block_.axes.push_back(std::move(axis));
  }

  void read_random(const Json& random) {
    const std::string pointer = child_pointer(block_.pointer, "random");
    if (!is_object(random, pointer, "an object of distributions and \"count\"", problems_)) return;
    block_.random_count = read_random_count(random, pointer, problems_);
    block_.random = read_random_paths(random, pointer, problems_);
    for (const RandomPath& path : block_.random) {
      Varied varied{path.path, path.pointer, {}};
      for (const Settings& choice : path.choices) varied.add(choice);
      if (path.choices.empty()) varied.add({{path.parameter, path.low, path.pointer}});
      varied_.push_back(std::move(varied));
    }
  }

  const Json& json_;
  Block& block_;
  Problems& problems_;
  std::vector<Varied> varied_;
};

Block read_block(const Json& json, std::size_t index, int replicates, Problems& problems) {
  Block block;
  block.pointer = "/sweep/" + std::to_string(index);
  block.label = "block " + std::to_string(index + 1);
  if (!is_object(json, block.pointer, "an object with label, set, grid, zip, random", problems)) {
    return block;
  }
  refuse_unknown_keys(json, block.pointer, {"label", "set", "grid", "zip", "random", "replicates"},
                      problems);
  block.label = read_label(json, block.pointer, index + 1, problems);
  block.replicates = read_replicates(json, block.pointer, replicates, problems);
  BlockReader(json, block, problems).read();
  return block;
}

void read_sweep_list(const Json& file, Blocks& blocks, Problems& problems) {
  const auto sweep = file.find("sweep");
  if (sweep == file.end()) {
    blocks.blocks.emplace_back();
    blocks.blocks.back().label = blocks.name;
    blocks.blocks.back().replicates = blocks.replicates;
  } else if (!sweep->is_array()) {
    problems.push_back({"/sweep", "must be a list of blocks, is " + describe(*sweep)});
  } else if (sweep->empty()) {
    problems.push_back({"/sweep", "holds no block; leave it out to pack \"base\" alone"});
  } else {
    for (std::size_t i = 0; i < sweep->size(); ++i) {
      blocks.blocks.push_back(read_block((*sweep)[i], i, blocks.replicates, problems));
    }
  }
}

Settings read_base(const Json& file, Problems& problems) {
  const auto base = file.find("base");
  if (base == file.end()) return {};
  Settings settings = read_layer(*base, "/base", problems);
  for (const Setting& setting : settings) {
    if (parameters()[setting.parameter].role != Role::seed) continue;
    problems.push_back(
        {setting.pointer, "\"seed\" belongs beside \"base\", not into it", Anchor::key});
  }
  return settings;
}

}  // namespace

Blocks read_blocks(const Json& file, Problems& problems) {
  Blocks blocks;
  if (!is_object(file, "", "an object with name, seed, replicates, base, sweep", problems)) {
    return blocks;
  }
  refuse_unknown_keys(file, "", {"name", "seed", "replicates", "base", "sweep", "$schema"},
                      problems);
  expect_schema_name(file, problems);
  blocks.name = read_name(file, problems);
  blocks.seed = read_seed(file, problems);
  blocks.replicates = read_replicates(file, "", 1, problems);
  blocks.base = read_base(file, problems);
  read_sweep_list(file, blocks, problems);
  return blocks;
}

std::uint64_t point_count(const Block& block) {
  constexpr std::uint64_t most = std::numeric_limits<std::uint64_t>::max();
  std::uint64_t points = block.random.empty() ? 1 : std::max<std::uint64_t>(block.random_count, 1);
  for (const Axis& axis : block.axes) {
    if (points > most / axis.entries.size()) return most;
    points *= axis.entries.size();
  }
  return points;
}

}  // namespace grainsweep
