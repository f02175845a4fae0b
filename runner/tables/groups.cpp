#include "runner/tables/groups.hpp"

#include <cmath>
#include <map>
#include <stdexcept>
#include <utility>

#include <nlohmann/json.hpp>

#include "runner/store/fields.hpp"

namespace grainsweep {
namespace {

using Members = std::vector<const Row*>;

/// The fields that have a mean in groups.csv.
const std::vector<Field>& mean_fields() {
  static const auto some = [] {
    std::vector<Field> chosen;
    for (const Field& field : fields()) {
      if (field.use.groups) chosen.push_back(field);
    }
    return chosen;
  }();
  return some;
}

/// Over the settled packings of a group.
Spread spread_over(const Members& members, const Field& field) {
  std::vector<double> values;
  for (const Row* row : members) {
    if (is_settled(*row)) values.push_back(number_of(field, *row->outcome));
  }
  return spread_of(values);
}

std::string parameters_without_width(const JobFacts& job) {
  nlohmann::json parameters = nlohmann::json::parse(job.parameters);
  if (parameters.contains("box")) {
    parameters["box"].erase("width");
    parameters["box"].erase("y");
  }
  return parameters.dump();
}

Group group_of(const Members& members) {
  Group group;
  group.job = members.front()->job;
  group.family = parameters_without_width(group.job);
  for (const Field& field : mean_fields()) group.means.push_back(spread_over(members, field));
  for (const Row* row : members) {
    count(*row, group.counts);
    if (is_settled(*row)) group.settled.emplace_back(row->outcome->result);
  }
  return group;
}

/// Gives the mean number `k` of the groups of one family the error of their pooled variance.
void pool_errors(const std::vector<Group*>& family, std::size_t k) {
  double squares = 0.0;
  int degrees_of_freedom = 0;
  for (const Group* group : family) {
    const Spread& spread = group->means[k];
    if (!std::isfinite(spread.sd)) continue;
    squares += (spread.n - 1) * spread.sd * spread.sd;
    degrees_of_freedom += spread.n - 1;
  }
  for (Group* group : family) {
    Spread& spread = group->means[k];
    if (spread.n == 0 || degrees_of_freedom == 0) continue;
    spread.error = std::sqrt(squares / degrees_of_freedom / spread.n);
    spread.degrees_of_freedom = degrees_of_freedom;
  }
}

void pool_errors(std::vector<Group>& groups) {
  std::map<std::string, std::vector<Group*>> families;
  for (Group& group : groups) families[group.family].push_back(&group);
  for (const auto& [name, family] : families) {
    for (std::size_t k = 0; k < mean_fields().size(); ++k) pool_errors(family, k);
  }
}

const JobFacts& job_of_group(const Group& group) { return group.job; }

Columns<Group> group_count_columns() {
  using In = const Group&;
  return {
      {"n", "", "settled packings, the only ones that enter means",
       [](In group) { return cell(group.counts.settled); }},
      {"not_settled", "", "packings that did not settle",
       [](In group) { return cell(group.counts.not_settled); }},
      {"failed", "", "packings that failed", [](In group) { return cell(group.counts.failed); }},
      {"pending", "", "packings not made yet", [](In group) { return cell(group.counts.pending); }},
  };
}

}  // namespace

Spread spread_of(const std::vector<double>& values) {
  Spread spread{no_number, no_number, static_cast<int>(values.size()), no_number, 0};
  if (values.empty()) return spread;
  double sum = 0.0, squares = 0.0;
  for (const double value : values) sum += value;
  spread.mean = sum / spread.n;
  for (const double value : values) squares += (value - spread.mean) * (value - spread.mean);
  if (spread.n < 2) return spread;
  spread.degrees_of_freedom = spread.n - 1;
  spread.sd = std::sqrt(squares / spread.degrees_of_freedom);
  spread.error = spread.sd / std::sqrt(spread.n);
  return spread;
}

std::string why_no_error(const Spread& spread) {
  constexpr double rounding = 1e-12;  // of sums over the grains of a bed
  if (spread.n == 0) return "no packing has settled";
  if (spread.degrees_of_freedom == 0) return "needs 2 or more settled replicates to know the error";
  if (spread.error > rounding * std::abs(spread.mean)) return "";
  return "the replicates do not scatter: they are copies, and tell no error";
}

std::vector<Group> groups_of(const std::vector<Row>& rows) {
  std::map<std::pair<std::string, std::string>, std::size_t> index_of;
  std::vector<Members> members;
  for (const Row& row : rows) {
    const auto [known, is_new] =
        index_of.try_emplace({row.job.label, row.job.parameters}, members.size());
    if (is_new) members.emplace_back();
    members[known->second].push_back(&row);
  }
  std::vector<Group> groups;
  groups.reserve(members.size());
  for (const Members& some : members) groups.push_back(group_of(some));
  pool_errors(groups);
  return groups;
}

const Spread& mean_of(const Group& group, std::string_view field) {
  for (std::size_t k = 0; k < group.means.size(); ++k) {
    if (mean_fields()[k].name == field) return group.means[k];
  }
  throw std::out_of_range("no mean of " + std::string(field));
}

Columns<GroupLine> group_line_columns() {
  Columns<GroupLine> columns = {{"group", "", "number of its row in groups.csv, from 1",
                                 [](const GroupLine& line) { return cell(line.number); }}};
  append(columns, job_columns({"label", "width", "boundary_y", "small_share"}),
         [](const GroupLine& line) -> const JobFacts& { return line.group.job; });
  return columns;
}

Columns<Group> groups_columns() {
  Columns<Group> columns;
  append(columns,
         job_columns({"label", "shape", "length", "width", "boundary_x", "boundary_y",
                      "small_share", "accuracy"}),
         job_of_group);
  append(columns, group_count_columns());
  for (std::size_t k = 0; k < mean_fields().size(); ++k) {
    const Field& field = mean_fields()[k];
    if (field.name == "contacts_simple") {
      append(columns, job_columns({"parameters"}), job_of_group);
    }
    append_spread(columns, std::string(field.name), std::string(field.unit),
                  std::string(field.meaning), [k](const Group& group) { return group.means[k]; });
  }
  return columns;
}

std::string groups_csv(const std::vector<Group>& groups) {
  const Columns<Group> columns = groups_columns();
  std::string text = header_line(columns);
  for (const Group& group : groups) text += row_line(columns, group);
  return text;
}

}  // namespace grainsweep
