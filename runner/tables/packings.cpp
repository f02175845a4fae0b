#include "runner/tables/packings.hpp"

#include <algorithm>
#include <array>
#include <cinttypes>
#include <cstdio>
#include <limits>

#include "runner/tables/csv.hpp"
#include "runner/tables/shape_columns.hpp"

namespace grainsweep {
namespace {

using RowCells = std::vector<std::string>;

const RowCells first_columns = {"job",
                                "label",
                                "replicate",
                                "seed",
                                "shape",
                                "grains",
                                "width",
                                "boundary_y",
                                "small_share",
                                "status",
                                "solid_fraction",
                                "coordination",
                                "coordination_with_walls",
                                "contacts",
                                "isostatic_contacts",
                                "overlap_mean",
                                "overlap_max",
                                "residual",
                                "kinetic_energy",
                                "steps",
                                "iterations",
                                "cpu_seconds",
                                "length",
                                "boundary_x",
                                "accuracy",
                                "gap_tolerance"};
const RowCells last_columns = {"surface_height",
                               "slab_bottom",
                               "slab_top",
                               "largest_motion",
                               "forces_unique",
                               "least_force",
                               "unbalance_max",
                               "unbalance_mean",
                               "mean_diameter",
                               "mean_diameter_by_volume",
                               "q6_global",
                               "q6_local",
                               "three_contact_share",
                               "segregation",
                               "force_mean",
                               "force_square",
                               "state_hash",
                               "reason"};

void append(RowCells& cells, RowCells more) {
  std::move(more.begin(), more.end(), std::back_inserter(cells));
}

/// Every gap tolerance of the sweep that is not first in all of its jobs, ascending.
std::vector<double> further_tolerances(const std::vector<Row>& rows) {
  std::vector<double> tolerances;
  for (const Row& row : rows) {
    const auto& own = row.job.measure.gap_tolerances;
    if (!own.empty()) tolerances.insert(tolerances.end(), own.begin() + 1, own.end());
  }
  std::sort(tolerances.begin(), tolerances.end());
  tolerances.erase(std::unique(tolerances.begin(), tolerances.end()), tolerances.end());
  return tolerances;
}

std::string hex(std::uint64_t hash) {
  std::array<char, 17> text{};
  std::snprintf(text.data(), text.size(), "%016" PRIx64, hash);
  return text.data();
}

RowCells measured_cells(const Row& row) {
  if (!is_measured(row)) return RowCells(9);
  const PackingResult& result = row.outcome->result;
  const Coordination coordination = headline_coordination(row);
  return {cell(result.solid_fraction),          cell(coordination.between_grains),
          cell(coordination.with_walls),        cell(result.rest.contacts),
          cell(result.rest.isostatic_contacts), cell(result.rest.overlap_mean),
          cell(result.rest.overlap_max),        cell(result.rest.residual),
          cell(result.rest.kinetic_energy)};
}

RowCells effort_cells(const Row& row) {
  if (!row.outcome) return RowCells(3);
  const PackingResult& result = row.outcome->result;
  return {cell(result.steps), cell(result.iterations), cell(row.outcome->cpu_seconds)};
}

/// Both conventions at each tolerance; empty where the job did not measure at it.
RowCells coordination_cells(const Row& row, const std::vector<double>& tolerances) {
  RowCells cells;
  for (const double tolerance : tolerances) {
    Coordination at{tolerance, std::numeric_limits<double>::quiet_NaN(),
                    std::numeric_limits<double>::quiet_NaN()};
    if (is_measured(row)) {
      for (const Coordination& measured : row.outcome->result.coordination) {
        if (measured.gap_tolerance == tolerance) at = measured;
      }
    }
    append(cells, {cell(at.between_grains), cell(at.with_walls)});
  }
  return cells;
}

/// Empty where the accuracy asked for no direct solve of force balance.
RowCells balance_cells(const std::optional<ForceBalance>& balance) {
  if (!balance) return RowCells(4);
  return {balance->unique ? "yes" : "no", cell(balance->least_force), cell(balance->unbalance_max),
          cell(balance->unbalance_mean)};
}

RowCells order_cells(const PackingResult& result) {
  const Order& order = result.order;
  return {cell(result.mean_diameter),      cell(result.mean_diameter_by_volume),
          cell(order.q6_global),           cell(order.q6_local),
          cell(order.three_contact_share), cell(order.segregation),
          cell(order.force_mean),          cell(order.force_square)};
}

RowCells state_cells(const Row& row) {
  if (!row.outcome) return RowCells(last_columns.size());
  const PackingResult& result = row.outcome->result;
  RowCells cells(last_columns.size() - 1);
  if (is_measured(row)) {
    cells = {cell(result.surface_height), cell(result.slab_bottom), cell(result.slab_top),
             cell(result.rest.largest_motion)};
    append(cells, balance_cells(result.balance));
    append(cells, order_cells(result));
    cells.push_back(hex(result.state_hash));
  }
  cells.push_back(cell(result.reason));
  return cells;
}

/// Empty for spheres.
RowCells shape_cells(const Row& row) {
  RowCells cells(shape_columns.size());
  if (!is_measured(row) || !row.outcome->result.shape_order) return cells;
  const auto values = shape_values(*row.outcome->result.shape_order);
  std::transform(values.begin(), values.end(), cells.begin(),
                 [](double value) { return cell(value); });
  return cells;
}

RowCells header(const std::vector<double>& tolerances) {
  RowCells cells = first_columns;
  for (const double tolerance : tolerances) {
    append(cells,
           {"coordination_at_" + cell(tolerance), "coordination_with_walls_at_" + cell(tolerance)});
  }
  append(cells, last_columns);
  append(cells, shape_header(false));
  return cells;
}

RowCells row_cells(const Row& row, const std::vector<double>& tolerances) {
  const JobFacts& job = row.job;
  const auto& gaps = job.measure.gap_tolerances;
  RowCells cells = {job.id,
                    cell(job.label),
                    cell(job.replicate),
                    cell(job.seed),
                    cell(job.shape),
                    row.outcome ? cell(row.outcome->result.grains) : "",
                    cell(job.box.width),
                    name_of(job.box.y),
                    cell(job.small_share),
                    status_of(row)};
  append(cells, measured_cells(row));
  append(cells, effort_cells(row));
  append(cells, {cell(job.box.length), name_of(job.box.x), cell(job.accuracy),
                 gaps.empty() ? "" : cell(gaps.front())});
  append(cells, coordination_cells(row, tolerances));
  append(cells, state_cells(row));
  append(cells, shape_cells(row));
  return cells;
}

}  // namespace

std::string packings_csv(const std::vector<Row>& rows) {
  const std::vector<double> tolerances = further_tolerances(rows);
  std::string text = csv_line(header(tolerances));
  for (const Row& row : rows) text += csv_line(row_cells(row, tolerances));
  return text;
}

}  // namespace grainsweep
