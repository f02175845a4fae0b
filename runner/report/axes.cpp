#include "runner/report/axes.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <set>

#include "runner/sweep/parameters.hpp"
#include "runner/sweep/text_lines.hpp"
#include "runner/tables/component_names.hpp"
#include "runner/tables/csv.hpp"
#include "runner/text.hpp"

namespace grainsweep {
namespace {

const std::string width_parameter = "box.width";
const std::string diameter_parameter = "tube.diameter";

/// The number in a cell; NaN if it holds anything else.
double number_of_cell(const std::string& cell) {
  double value = 0.0;
  const auto [end, error] = std::from_chars(cell.data(), cell.data() + cell.size(), value);
  return error == std::errc() && end == cell.data() + cell.size() ? value : no_number;
}

/// Parts of a preset count as one value: its name.
bool is_part_of_preset(const Group& group, const std::string& path) {
  return path.starts_with("accuracy.") && group.is_told_by_preset;
}

using Values = std::map<std::string, std::string>;  // by parameter

enum class Idle { left_out, kept };

/// Whether a group lies along the width of others by its diameter.
bool lies_by_diameter(const Group& group, const std::string& parameter) {
  return parameter == width_parameter && group.job.box.is_tube;
}

bool is_periodic_along_y(const Group& group) { return group.job.box.y == Boundary::periodic; }

bool has_walls(const Series& series) {
  return !std::all_of(series.groups.begin(), series.groups.end(),
                      [](const Group* group) { return is_periodic_along_y(*group); });
}

/// What a group does not share with all others, except `left_out`: shares of components with the
/// names of these, "sphere 0.3". Of two components each share tells the other. Values on which
/// nothing depends are kept where groups are sorted, not named: the ratio of two sizes belongs to
/// the series of a share that begins at 0.
Values distinctions(const Group& group, const std::string& left_out, Idle idle = Idle::left_out) {
  Values values;
  const std::vector<std::string> components = component_names(group.job);
  const bool is_mixture_of_two = components.size() == 2 && component_of_share(left_out) > 0;
  bool names_components = false;
  for (const auto& [path, cell] : group.told) {
    if (path == left_out || (idle == Idle::left_out && group.idle.contains(path))) continue;
    if (path == diameter_parameter && lies_by_diameter(group, left_out)) continue;
    if (path == "box.length" && left_out == width_parameter && group.is_of_squares) continue;
    const std::size_t component = component_of_share(path);
    if (component > 0 && is_mixture_of_two) continue;
    if (component > 0 && component <= components.size()) {
      values[path] = components[component - 1] + " " + cell;
      names_components = true;
    } else if (is_part_of_preset(group, path))
      values["accuracy"] = group.job.accuracy;
    else
      values[path] = unquoted(cell);
  }
  if (names_components) values.erase("shape");
  return values;
}

/// The shortest end of a path, in whole parts, that no other of the values has: "sigma".
std::string symbol_of(const std::string& path, const Values& values) {
  if (path == width_parameter) return "W";
  if (path == diameter_parameter) return "D";
  const std::string whole = "." + path;
  std::size_t dot = whole.rfind('.');
  const auto ends_so = [&](const Values::value_type& other) {
    return ("." + other.first).ends_with(whole.substr(dot));
  };
  while (dot > 0 && std::count_if(values.begin(), values.end(), ends_so) > 1)
    dot = whole.rfind('.', dot - 1);
  return whole.substr(dot + 1);
}

bool is_extent(const std::string& path) {
  return path == width_parameter || path == diameter_parameter;
}

/// "W = 5, small_share = 0.25, y periodic": the extent first, as titles may be cut at their end.
std::string words(const Values& values) {
  std::string text;
  const auto add = [&](const std::string& path, const std::string& value) {
    if (value.empty() || value == "walls") return;
    text += text.empty() ? "" : ", ";
    if (path == "box.y" || path == "box.x")
      text += path.substr(4) + " " + value;
    else if (component_of_share(path) > 0)
      text += value;
    else
      text += symbol_of(path, values) + " = " + value;
  };
  for (const auto& [path, value] : values) {
    if (is_extent(path)) add(path, value);
  }
  for (const auto& [path, value] : values) {
    if (!is_extent(path)) add(path, value);
  }
  return text;
}

std::vector<const Group*> pointers_to(const std::vector<Group>& groups) {
  std::vector<const Group*> all;
  all.reserve(groups.size());
  for (const Group& group : groups) all.push_back(&group);
  return all;
}

/// Whether the group has the parameter, and depends on it; cubes have none of prisms.
bool has_parameter(const Group& group, const std::string& path) {
  if (lies_by_diameter(group, path)) return true;
  return !group.varied.at(path).empty() && !group.idle.contains(path);
}

/// Whether most groups have the parameter, so that the others may be left out along it.
bool is_usual(const std::vector<const Group*>& groups, const std::string& path) {
  const auto with = std::count_if(groups.begin(), groups.end(),
                                  [&](const Group* group) { return has_parameter(*group, path); });
  return 3 * static_cast<std::size_t>(with) >= 2 * groups.size();
}

/// The values that a parameter takes in the groups that have it; none if any of them is no number.
std::set<double> values_of(const std::vector<const Group*>& groups, const std::string& path) {
  std::set<double> values;
  for (const Group* group : groups) {
    if (lies_by_diameter(*group, path) || !has_parameter(*group, path)) continue;
    const double value = number_of_cell(group->varied.at(path));
    if (std::isnan(value) || is_part_of_preset(*group, path)) return {};
    values.insert(value);
  }
  return values;
}

/// The numbers that these groups vary, if they look like points of a random design: many, and for
/// at least one number most have a value of their own.
std::vector<std::string> scattered_numbers(const std::vector<const Group*>& groups) {
  constexpr std::size_t few = 8;
  if (groups.size() < few) return {};
  std::vector<std::string> numbers;
  std::size_t most = 0;
  for (const std::string& path : varied_of(*groups.front())) {
    const std::size_t count = values_of(groups, path).size();
    if (count > 1) numbers.push_back(path);
    most = std::max(most, count);
  }
  return numbers.size() > 1 && 2 * most > groups.size() ? numbers : std::vector<std::string>();
}

/// Whether groups are compared along the parameter: some that differ in nothing else have several
/// values of it, or some of one label, as of a zip.
bool is_compared(const std::vector<const Group*>& groups, const std::string& path) {
  std::map<Values, double> first_alike;
  std::map<std::string, double> first_of_label;
  return std::any_of(groups.begin(), groups.end(), [&](const Group* group) {
    if (!has_parameter(*group, path)) return false;
    const double value = value_of(*group, path);
    const Values others = distinctions(*group, path, Idle::kept);
    return first_alike.try_emplace(others, value).first->second != value ||
           first_of_label.try_emplace(group->job.label, value).first->second != value;
  });
}

/// The extent of containers wherever it is varied; else the number with most values, if groups are
/// compared along it or it is one of a random design. Beds that differ in several things at a time,
/// each under its own label, have none.
std::string axis_parameter(const std::vector<const Group*>& groups) {
  const bool is_random = !scattered_numbers(groups).empty();
  std::string chosen;
  std::size_t most = 1;
  for (const std::string& path : {width_parameter, diameter_parameter}) {
    const bool is_varied = groups.front()->varied.contains(path);
    if (is_varied && values_of(groups, path).size() > 1 && is_usual(groups, path)) return path;
  }
  for (const std::string& path : varied_of(*groups.front())) {
    const std::size_t count = values_of(groups, path).size();
    if (count <= most || !is_usual(groups, path)) continue;
    if (!is_random && !is_compared(groups, path)) continue;
    most = count;
    chosen = path;
  }
  return chosen;
}

/// What a point of a random design does not share with all other groups, except its numbers.
Values distinctions_but(const Group& group, const std::vector<std::string>& numbers) {
  Values values = distinctions(group, "");
  for (const std::string& number : numbers) values.erase(number);
  if (group.job.box.is_tube) values.erase(diameter_parameter);
  return values;
}

/// Makes series of the groups that are alone on the axis if these are a random design: each would
/// otherwise have a mark of its own, and of two hundred only the first would be seen.
void join_scattered(Axes& axes) {
  std::vector<const Group*> alone;
  for (const Series& series : axes.series) {
    if (series.groups.size() == 1) alone.push_back(series.groups.front());
  }
  axes.scattered = scattered_numbers(alone);
  if (axes.scattered.empty()) return;
  std::erase_if(axes.series, [](const Series& series) { return series.groups.size() == 1; });
  std::map<std::pair<std::string, Values>, std::size_t> index_of;
  for (const Group* group : alone) {
    const auto [at, is_new] = index_of.try_emplace(
        {group->job.label, distinctions_but(*group, axes.scattered)}, axes.series.size());
    if (is_new) axes.series.push_back({.name = "", .groups = {}, .is_scattered = true});
    axes.series[at->second].groups.push_back(group);
  }
}

/// The label that all groups of a series have; nothing if they have several.
std::optional<std::string> common_label(const Series& series) {
  const std::string& label = series.groups.front()->job.label;
  const bool is_common = std::all_of(series.groups.begin(), series.groups.end(),
                                     [&](const Group* group) { return group->job.label == label; });
  return is_common ? std::optional(label) : std::nullopt;
}

/// What tells a series from others: of some of its groups that may have no effect.
Values distinctions_of(const Series& series, const Axes& axes) {
  Values all;
  for (const Group* group : series.groups) {
    all.merge(series.is_scattered ? distinctions_but(*group, axes.scattered)
                                  : distinctions(*group, axes.parameter));
  }
  return all;
}

/// Names series by their common label where it tells a series from the others, else by what does.
void name_series(Axes& axes) {
  std::map<std::string, int> uses;
  for (const Series& series : axes.series) ++uses[common_label(series).value_or("")];
  for (Series& series : axes.series) {
    const Group& first = *series.groups.front();
    const auto label = common_label(series);
    const std::string distinction = words(distinctions_of(series, axes));
    if (label && (uses[*label] == 1 || distinction.empty()))
      series.name = *label;
    else
      series.name = distinction.empty() ? first.job.label
                    : label             ? shortened(*label, figure_label) + ", " + distinction
                                        : distinction;
    if (label && series.name != *label) series.distinction = distinction;
  }
}

/// "share of sphere": of the component that all these groups have, or by its number; of another
/// parameter its title.
std::string share_title(const std::vector<Group>& groups, const std::string& parameter) {
  const std::size_t component = component_of_share(parameter);
  if (component == 0) return axis_title(parameter);
  std::set<std::string> names;
  for (const Group& group : groups) {
    const std::vector<std::string> all = component_names(group.job);
    if (component <= all.size()) names.insert(all[component - 1]);
  }
  return "share of " + (names.size() == 1 ? *names.begin() : "component " + cell(component));
}

}  // namespace

Axes axes_of(const std::vector<Group>& groups) {
  Axes axes;
  if (groups.empty()) return axes;
  axes.parameter = axis_parameter(pointers_to(groups));
  axes.title = share_title(groups, axes.parameter);
  if (std::all_of(groups.begin(), groups.end(), is_periodic_along_y) &&
      axes.parameter == width_parameter) {
    axes.title = "width of the box, W / d";
  }
  if (std::any_of(groups.begin(), groups.end(),
                  [&](const Group& group) { return lies_by_diameter(group, axes.parameter); })) {
    axes.title += ", and diameter of tubes, D / d";
  }
  std::map<Values, std::size_t> index_of;
  for (const Group& group : groups) {
    const auto [at, is_new] =
        index_of.try_emplace(distinctions(group, axes.parameter, Idle::kept), axes.series.size());
    if (is_new) axes.series.emplace_back();
    axes.series[at->second].groups.push_back(&group);
  }
  join_scattered(axes);
  for (Series& series : axes.series) {
    const auto place = [&](const Group* group) {  // those without one are the last
      const double on_axis = place_on(axes, *group);
      return std::isnan(on_axis) ? std::numeric_limits<double>::infinity() : on_axis;
    };
    std::stable_sort(series.groups.begin(), series.groups.end(),
                     [&](auto* a, auto* b) { return place(a) < place(b); });
  }
  name_series(axes);
  return axes;
}

double place_on(const Axes& axes, const Group& group) {
  if (axes.parameter.empty()) return static_cast<double>(group.number);
  return value_of(group, axes.parameter);
}

double value_of(const Group& group, const std::string& parameter) {
  if (lies_by_diameter(group, parameter)) return group.job.box.width;
  return has_parameter(group, parameter) ? number_of_cell(group.varied.at(parameter)) : no_number;
}

namespace {

/// "creep steps" of "accuracy.creep_steps"; parts of shapes, distributions and containers with what
/// they are parts of: "prism height".
std::string words_of_path(const std::string& path) {
  const std::size_t last = path.rfind('.');
  const std::size_t before = last == std::string::npos ? last : path.rfind('.', last - 1);
  const bool is_part = path.starts_with("box.") || before != std::string::npos;
  const std::size_t begin = !is_part ? last : before;
  std::string text = begin == std::string::npos ? path : path.substr(begin + 1);
  std::replace_if(
      text.begin(), text.end(), [](char c) { return c == '.' || c == '_'; }, ' ');
  if (text.ends_with(" deg")) text.erase(text.rfind(' '));  // as its unit says
  return text;
}

}  // namespace

std::string axis_title(const std::string& parameter) {
  if (parameter.empty()) return "parameter set";
  if (parameter == width_parameter) return "gap between the walls, W / d";
  if (parameter == diameter_parameter) return "diameter of the tube, D / d";
  if (parameter == "sizes.small_share") return "share of small grains in the solid volume";
  const auto known = find_parameter(parameter);
  if (!known) return parameter;
  const std::string& unit = parameters()[*known].unit;
  return words_of_path(parameter) + (unit.empty() ? "" : " / " + unit);
}

bool is_over_width(const Axes& axes) {
  const bool is_width = axes.parameter == width_parameter || axes.parameter == diameter_parameter;
  return is_width && std::any_of(axes.series.begin(), axes.series.end(), has_walls);
}

std::string width_symbol(const Axes& axes) {
  return axes.parameter == diameter_parameter ? "D" : "W";
}

std::string title_of(const Group& group, std::size_t longest_label) {
  const std::string distinction = words(distinctions(group, ""));
  const std::string label = shortened(group.job.label, longest_label);
  return distinction.empty() ? label : label + ", " + distinction;
}

namespace {

std::string joined_title(const std::string& label, const std::string& distinction) {
  return label.empty() || distinction.empty() ? label + distinction : label + ", " + distinction;
}

enum class Among { all, label };

/// Their distinctions without those that all of `sweep` share, or all with the same label. An
/// extent is left out only where all have it: labels do not tell it.
std::vector<Values> not_shared(const std::vector<const Group*>& groups, Among among,
                               const std::vector<const Group*>& sweep) {
  const auto set_of = [&](const Group& group, const std::string& path) {
    return among == Among::label && !is_extent(path) ? group.job.label : std::string();
  };
  std::map<std::string, std::size_t> sizes;
  std::map<std::pair<std::string, Values::value_type>, std::size_t> uses;
  for (const Group* group : sweep) {
    ++sizes[group->job.label];
    for (const auto& one : distinctions(*group, "")) ++uses[{set_of(*group, one.first), one}];
  }
  sizes[""] = sweep.size();
  std::vector<Values> all;
  for (const Group* group : groups) {
    std::erase_if(all.emplace_back(distinctions(*group, "")), [&](const auto& one) {
      const std::string set = set_of(*group, one.first);
      return uses[{set, one}] == sizes[set];
    });
  }
  return all;
}

/// The same with short numbers, unless some would then be alike.
std::vector<Values> with_short_numbers(const std::vector<Values>& all) {
  std::vector<Values> rounded = all;
  for (Values& values : rounded) {
    for (auto& [path, value] : values) {
      const double number = number_of_cell(value);
      if (!std::isnan(number) && value.size() > short_number(number).size()) {
        value = short_number(number);
      }
    }
  }
  const std::set<Values> before(all.begin(), all.end()), after(rounded.begin(), rounded.end());
  return after.size() == before.size() ? rounded : all;
}

bool have_room(const std::vector<std::string>& texts, std::size_t longest) {
  return std::all_of(texts.begin(), texts.end(),
                     [&](const std::string& text) { return characters(text) <= longest; });
}

/// Where character number `n` begins, from 0; the end of a text that has no more than `n`.
std::size_t byte_of(const std::string& text, std::size_t n) {
  std::size_t at = 0;
  while (at < text.size() && (!begins_character(text[at]) || n-- > 0)) ++at;
  return at;
}

/// How many characters two texts begin with alike.
std::size_t shared_characters(const std::string& a, const std::string& b) {
  auto differ = std::mismatch(a.begin(), a.end(), b.begin(), b.end()).first;
  while (differ != a.end() && !begins_character(*differ)) --differ;
  return characters({a.begin(), differ});
}

/// `longest` characters: the beginning of a longer text, "…", and what stands about character
/// number `place`.
std::string without_middle(const std::string& text, std::size_t place, std::size_t longest) {
  const std::size_t head = (longest - 1) / 2, tail = longest - 1 - head;
  const std::size_t from = std::min(place - tail / 2, characters(text) - tail);
  return text.substr(0, byte_of(text, head)) + "…" +
         shortened(text.substr(byte_of(text, from)), tail);
}

bool are_different(const std::vector<std::string>& texts) {
  return std::set<std::string>(texts.begin(), texts.end()).size() == texts.size();
}

/// Labels and values; labels are shortened where that makes room, each alike wherever it stands.
std::vector<std::string> titles_with(const std::vector<Values>& values,
                                     const std::vector<const Group*>& groups, std::size_t longest) {
  constexpr std::size_t shortest_label = 6;
  std::map<std::string, std::size_t> rooms;  // by label
  for (std::size_t k = 0; k < groups.size(); ++k) {
    const std::size_t taken = characters(joined_title(" ", words(values[k]))) - 1;
    std::size_t& room = rooms.try_emplace(groups[k]->job.label, longest).first->second;
    room = std::min(room, longest - std::min(longest, taken));
  }
  std::vector<std::string> titles;
  titles.reserve(groups.size());
  for (std::size_t k = 0; k < groups.size(); ++k) {
    const std::string& label = groups[k]->job.label;
    const std::size_t room = std::max(rooms[label], shortest_label);
    titles.push_back(joined_title(shortened(label, room), words(values[k])));
  }
  return titles;
}

/// Titles with room for all that leave out what all of `sweep` share, then what all of a label do,
/// then labels; none if there are no such.
std::vector<std::string> titles_within(const std::vector<const Group*>& groups, std::size_t longest,
                                       const std::vector<const Group*>& sweep) {
  const std::vector<Values> values = with_short_numbers(not_shared(groups, Among::all, sweep));
  std::vector<std::string> titles = titles_with(values, groups, longest);
  if (have_room(titles, longest)) return told_apart(titles, longest);
  titles =
      titles_with(with_short_numbers(not_shared(groups, Among::label, sweep)), groups, longest);
  if (have_room(titles, longest) && are_different(titles)) return titles;
  titles.clear();
  for (const Values& one : values) titles.push_back(words(one));
  if (have_room(titles, longest) && are_different(titles)) return titles;
  return {};
}

}  // namespace

std::vector<std::string> titles_of(const std::vector<const Group*>& groups, std::size_t longest,
                                   const std::vector<const Group*>& sweep) {
  std::vector<std::string> titles;
  titles.reserve(groups.size());
  for (const Group* group : groups) titles.push_back(title_of(*group));
  if (have_room(titles, longest)) return titles;
  for (const auto* among : {&sweep, &groups}) {
    titles = titles_within(groups, longest, *among);
    if (!titles.empty()) return titles;
  }
  const auto values = with_short_numbers(not_shared(groups, Among::all, groups));
  return told_apart(titles_with(values, groups, longest), longest);
}

std::vector<std::string> told_apart(const std::vector<std::string>& texts, std::size_t longest) {
  std::vector<std::string> told;
  told.reserve(texts.size());
  for (const std::string& text : texts) told.push_back(shortened(text, longest));
  const std::vector<std::string> beginnings = told;
  for (std::size_t k = 0; k < texts.size(); ++k) {
    const std::size_t length = characters(texts[k]);
    std::size_t alike = 0, place = length;  // of the first difference
    for (std::size_t j = 0; j < texts.size(); ++j) {
      if (beginnings[j] != beginnings[k]) continue;
      ++alike;
      place = std::min(place, shared_characters(texts[k], texts[j]));
    }
    if (alike > 1 && length > longest) told[k] = without_middle(texts[k], place, longest);
  }
  if (are_different(told) || !are_different(texts)) return told;
  for (std::size_t k = 0; k < texts.size(); ++k) {
    told[k] = shortened(std::to_string(k + 1) + ": " + texts[k], longest);
  }
  return told;
}

std::string shortened(const std::string& text, std::size_t longest) {
  std::size_t begun = 0;
  for (std::size_t at = 0; at < text.size(); ++at) {
    if (begins_character(text[at]) && ++begun == longest) {
      const bool is_last = std::none_of(text.begin() + static_cast<std::ptrdiff_t>(at) + 1,
                                        text.end(), begins_character);
      return is_last ? text : text.substr(0, at) + "…";
    }
  }
  return text;
}

}  // namespace grainsweep
