#include "runner/tables/groups.hpp"

#include <cmath>
#include <map>
#include <utility>

#include "runner/tables/csv.hpp"

namespace grainsweep {
namespace {

using Members = std::vector<const Row*>;

/// The spread of `value` over the settled packings of a group.
template <class Value>
Spread spread_over(const Members& members, Value value) {
  std::vector<double> values;
  for (const Row* row : members) {
    if (is_settled(*row)) values.push_back(value(*row));
  }
  return spread_of(values);
}

double contact_ratio(const Row& row) {
  const RestReport& rest = row.outcome->result.rest;
  if (rest.isostatic_contacts == 0) return no_number;
  return static_cast<double>(rest.contacts) / static_cast<double>(rest.isostatic_contacts);
}

/// What a column of shapes holds of a packing; nothing for spheres.
double shape_value(const Row& row, std::size_t column) {
  const auto& order = row.outcome->result.shape_order;
  return order ? shape_values(*order)[column] : no_number;
}

Group group_of(const Members& members) {
  Group group;
  group.job = members.front()->job;
  group.solid_fraction =
      spread_over(members, [](const Row& row) { return row.outcome->result.solid_fraction; });
  group.coordination = spread_over(
      members, [](const Row& row) { return headline_coordination(row).between_grains; });
  group.coordination_with_walls =
      spread_over(members, [](const Row& row) { return headline_coordination(row).with_walls; });
  group.contact_ratio = spread_over(members, contact_ratio);
  group.overlap_mean =
      spread_over(members, [](const Row& row) { return row.outcome->result.rest.overlap_mean; });
  for (std::size_t k = 0; k < group.shape_order.size(); ++k) {
    group.shape_order[k] =
        spread_over(members, [k](const Row& row) { return shape_value(row, k); });
  }
  for (const Row* row : members) {
    count(*row, group.counts);
    if (!is_settled(*row)) continue;
    group.settled.push_back(row->outcome->result);
    group.jobs.push_back(row->job.id);
  }
  return group;
}

void append_spread(const Spread& spread, std::vector<std::string>& cells) {
  cells.push_back(cell(spread.mean));
  cells.push_back(cell(spread.sd));
}

std::string group_line(const Group& group) {
  const JobFacts& job = group.job;
  std::vector<std::string> cells = {cell(job.label),
                                    cell(job.shape),
                                    cell(job.box.length),
                                    cell(job.box.width),
                                    name_of(job.box.x),
                                    name_of(job.box.y),
                                    cell(job.small_share),
                                    cell(job.accuracy),
                                    cell(group.counts.settled),
                                    cell(group.counts.not_settled),
                                    cell(group.counts.failed),
                                    cell(group.counts.pending)};
  for (const Spread& spread :
       {group.solid_fraction, group.coordination, group.coordination_with_walls,
        group.contact_ratio, group.overlap_mean}) {
    append_spread(spread, cells);
  }
  cells.push_back(cell(job.parameters));
  for (const Spread& spread : group.shape_order) append_spread(spread, cells);
  return csv_line(cells);
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

std::string groups_csv(const std::vector<Group>& groups) {
  std::string text =
      "label,shape,length,width,boundary_x,boundary_y,small_share,accuracy,n,not_settled,failed,"
      "pending,solid_fraction,solid_fraction_sd,coordination,coordination_sd,"
      "coordination_with_walls,coordination_with_walls_sd,contact_ratio,contact_ratio_sd,"
      "overlap_mean,overlap_mean_sd,parameters,";
  text += csv_line(shape_header(true));
  for (const Group& group : groups) text += group_line(group);
  return text;
}

}  // namespace grainsweep
