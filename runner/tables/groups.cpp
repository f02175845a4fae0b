#include "runner/tables/groups.hpp"

#include <cmath>
#include <map>
#include <stdexcept>
#include <utility>

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

Group group_of(const Members& members) {
  Group group;
  group.job = members.front()->job;
  for (const Field& field : mean_fields()) group.means.push_back(spread_over(members, field));
  for (const Row* row : members) {
    count(*row, group.counts);
    if (is_settled(*row)) group.settled.emplace_back(row->outcome->result);
  }
  return group;
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
  Spread spread{no_number, no_number, static_cast<int>(values.size())};
  if (values.empty()) return spread;
  double sum = 0.0, squares = 0.0;
  for (const double value : values) sum += value;
  spread.mean = sum / spread.n;
  for (const double value : values) squares += (value - spread.mean) * (value - spread.mean);
  if (spread.n > 1) spread.sd = std::sqrt(squares / (spread.n - 1));
  return spread;
}

double standard_error(const Spread& spread) {
  return spread.n > 1 ? spread.sd / std::sqrt(spread.n) : no_number;
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
