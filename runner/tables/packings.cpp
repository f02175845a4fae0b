#include "runner/tables/packings.hpp"

#include <algorithm>
#include <cstddef>
#include <string_view>

#include "runner/hash.hpp"
#include "runner/store/fields.hpp"

namespace grainsweep {
namespace {

struct ToCell {
  std::string operator()(std::monostate /*none*/) const { return ""; }
  std::string operator()(double value) const { return cell(value); }
  std::string operator()(std::int64_t value) const { return cell(value); }
  std::string operator()(std::uint64_t hash) const { return hex16(hash); }
  std::string operator()(bool value) const { return value ? "yes" : "no"; }
  std::string operator()(const std::string& text) const { return cell(text); }
  std::string operator()(PackingStatus status) const { return name_of(status); }
  std::string operator()(const std::vector<Coordination>& /*list*/) const { return ""; }
};

Column<Row> column_of(const Field& field) {
  return {std::string(field.name), std::string(field.unit), std::string(field.meaning),
          [&field](const Row& row) {
            const bool has_value =
                field.use.measured ? is_measured(row) : static_cast<bool>(row.outcome);
            return has_value ? std::visit(ToCell(), field.value(*row.outcome)) : std::string();
          }};
}

const JobFacts& job_of(const Row& row) { return row.job; }

/// Empty where the job did not measure at the tolerance.
Column<Row> column_at(double tolerance, const std::string& name,
                      double Coordination::*coordination) {
  return {name + "_at_" + cell(tolerance), "", name + " at a gap tolerance of so many d",
          [=](const Row& row) {
            const Coordination* at =
                is_measured(row) ? coordination_at(tolerance, row.outcome->result) : nullptr;
            return at == nullptr ? std::string() : cell(at->*coordination);
          }};
}

/// What comes before the column of a field: facts of the job, in places that readers rely on.
void append_before(std::string_view field, const std::vector<double>& tolerances,
                   Columns<Row>& columns) {
  const auto append_facts = [&](const std::vector<std::string>& names) {
    append(columns, job_columns(names), job_of);
  };
  if (field == "grains") append_facts({"job", "label", "replicate", "seed", "shape"});
  if (field == "solid_fraction") {
    append_facts({"width", "boundary_y", "small_share"});
    columns.push_back({"status", "", "settled, not_settled, failed or pending", status_of});
  }
  if (field != "surface_height") return;
  append_facts({"length", "boundary_x", "accuracy", "gap_tolerance"});
  for (const double tolerance : tolerances) {
    columns.push_back(column_at(tolerance, "coordination", &Coordination::between_grains));
    columns.push_back(column_at(tolerance, "coordination_with_walls", &Coordination::with_walls));
  }
}

}  // namespace

Columns<PackingLine> packings_columns(const std::vector<double>& further_tolerances,
                                      const Varied& varied, const GivenUnits& units) {
  Columns<Row> of_row;
  for (const Field& field : fields()) {
    if (!field.use.packings) continue;
    append_before(field.name, further_tolerances, of_row);
    of_row.push_back(column_of(field));
  }
  append(of_row, job_columns({"start"}), job_of);
  Columns<PackingLine> columns;
  append(columns, of_row, [](const PackingLine& line) -> const Row& { return line.row; });
  Columns<Group> of_group = group_key_columns();
  append(of_group, varied_columns(varied));
  append(columns, of_group, [](const PackingLine& line) -> const Group& { return line.group; });
  remove_repeated(columns);
  append_in_units(columns, units);
  return columns;
}

void write_packings_csv(const std::vector<Row>& rows, const std::vector<Group>& groups,
                        const GivenUnits& units,
                        const std::function<void(const std::string&)>& write) {
  const Columns<PackingLine> columns =
      packings_columns(further_tolerances(groups), varied_of(groups), units);
  const std::vector<std::size_t> numbers = group_numbers(rows);
  write(header_line(columns));
  for (std::size_t k = 0; k < rows.size(); ++k) {
    write(row_line(columns, PackingLine{rows[k], groups[numbers[k] - 1]}));
  }
}

}  // namespace grainsweep
