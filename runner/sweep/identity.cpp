#include "runner/sweep/identity.hpp"

#include <algorithm>
#include <charconv>

#include "engine/shape/given_shape.hpp"
#include "runner/sweep/parameters.hpp"

namespace grainsweep {
namespace {

using GroupNames = std::vector<std::string_view>;

/// A parameter and the groups it lies in, from the outside in.
struct Member {
  const Parameter* parameter;
  GroupNames groups;
  std::string_view key;
};

Member member_of(const Parameter& parameter) {
  Member member{&parameter, {}, parameter.path};
  for (std::size_t dot = member.key.find('.'); dot != std::string_view::npos;
       dot = member.key.find('.')) {
    member.groups.push_back(member.key.substr(0, dot));
    member.key.remove_prefix(dot + 1);
  }
  return member;
}

/// Those parameters that are `wanted`, by their paths.
template <class Wanted>
std::vector<Member> members_where(Wanted wanted) {
  std::vector<Member> members;
  for (const Parameter& parameter : parameters()) {
    if (wanted(parameter)) members.push_back(member_of(parameter));
  }
  std::sort(members.begin(), members.end(),
            [](const Member& a, const Member& b) { return a.parameter->path < b.parameter->path; });
  return members;
}

void append_number(double value, std::string& text) {
  char digits[32];
  text.append(digits, std::to_chars(digits, digits + sizeof digits, value).ptr);
}

/// Names and hashes hold no character that JSON would escape.
void append_value(const Parameter& parameter, const Value& value, std::string& text) {
  if (const auto* number = std::get_if<double>(&value)) return append_number(*number, text);
  if (const auto* word = std::get_if<std::string>(&value)) {
    text.append("\"").append(*word).append("\"");
  } else if (const auto* numbers = std::get_if<std::vector<double>>(&value)) {
    text += '[';
    for (const double& entry : *numbers) {
      if (&entry != numbers->data()) text += ',';
      append_number(entry, text);
    }
    text += ']';
  } else if (const auto* components = std::get_if<Components>(&value)) {
    text += '{';
    for (const WrittenComponent& one : *components) {
      const auto number = static_cast<std::size_t>(&one - components->data()) + 1;
      text.append(number > 1 ? "," : "").append("\"").append(std::to_string(number));
      text.append("\":").append(one.text);
    }
    text += '}';
  } else if (parameter.kind == ValueKind::choice) {
    const auto index = static_cast<std::size_t>(std::get<std::int64_t>(value));
    text.append("\"").append(parameter.choices[index]).append("\"");
  } else {
    text += std::to_string(std::get<std::int64_t>(value));
  }
}

/// Closes the groups of `open` that `groups` does not begin with and opens the others of `groups`.
void change_groups(const GroupNames& open, const GroupNames& groups, std::string& text) {
  const auto last = std::mismatch(open.begin(), open.end(), groups.begin(), groups.end());
  text.append(static_cast<std::size_t>(open.end() - last.first), '}');
  if (text.back() != '{') text += ',';
  for (auto group = last.second; group != groups.end(); ++group) {
    text.append("\"").append(*group).append("\":{");
  }
}

bool is_of_bed(const Parameter& parameter) { return !parameter.path.starts_with("measure."); }

bool is_of_settled_bed(const Parameter& parameter) {
  return is_of_bed(parameter) && parameter.path != "accuracy.max_steps";
}

bool is_of_scene(const Parameter& parameter) {
  return is_of_bed(parameter) && !parameter.path.starts_with("accuracy.");
}

bool is_of_shape(const Parameter& parameter) { return choice_of(parameter) == Choice::shape; }

std::string canonical(const std::vector<Member>& members, const ResolvedSpec& resolved) {
  const GroupNames none;
  const GroupNames* open = &none;
  std::string text = "{";
  for (const auto& [parameter, groups, key] : members) {
    const auto value = parameter->get(resolved);
    if (!value) continue;
    change_groups(*open, groups, text);
    open = &groups;
    text.append("\"").append(key).append("\":");
    append_value(*parameter, *value, text);
  }
  return text.append(open->size() + 1, '}');
}

}  // namespace

std::string hash_of(const HullVertices& hull) {
  std::string text;
  for (const auto& point : hull.points) {
    for (const double coordinate : point) {
      append_number(coordinate, text);
      text += ',';
    }
  }
  return hex16(mixed(fnv1a(text)));
}

std::string hash_of(const SizeTable& table) {
  std::string text;
  for (const auto* list : {&table.diameters, &table.passing, &table.shares}) {
    for (const double number : *list) {
      append_number(number, text);
      text += ',';
    }
    text += ';';
  }
  return hex16(mixed(fnv1a(text)));
}

std::string canonical_component(double share, const ResolvedSpec& shape) {
  static const std::vector<Member> members = members_where(is_of_shape);
  constexpr std::string_view before = R"({"shape":)", after = "}}";
  const std::string all =
      is_sphere(shape.spec.shape) ? R"({"shape":{"sphere":{}}})" : canonical(members, shape);
  std::string text = all.substr(before.size(), all.size() - before.size() - after.size());
  text.append(R"(,"share":)");
  append_number(share, text);
  return text + "}";
}

std::string canonical_parameters(const ResolvedSpec& resolved) {
  static const std::vector<Member> members = members_where([](const Parameter&) { return true; });
  return canonical(members, resolved);
}

std::string canonical_bed(const ResolvedSpec& resolved) {
  static const std::vector<Member> members = members_where(is_of_bed);
  return canonical(members, resolved);
}

std::string canonical_settled_bed(const ResolvedSpec& resolved) {
  static const std::vector<Member> members = members_where(is_of_settled_bed);
  return canonical(members, resolved);
}

std::string canonical_scene(const ResolvedSpec& resolved) {
  static const std::vector<Member> members = members_where(is_of_scene);
  return canonical(members, resolved);
}

JobHash JobHash::followed_by(std::string_view more) const {
  JobHash hash = *this;
  hash.of_parameters_ = fnv1a(more, of_parameters_);
  return hash;
}

std::uint64_t JobHash::operator()(std::uint64_t seed, int replicate) const {
  const std::string rest = "\n" + std::to_string(seed) + "\n" + std::to_string(replicate);
  return mixed(fnv1a(rest, of_parameters_));
}

}  // namespace grainsweep
