// Rows and grains as a sweep would leave them, with values that tests choose.
#pragma once

#include <algorithm>
#include <limits>
#include <string>
#include <vector>

#include "runner/analysis/student.hpp"
#include "runner/store/states.hpp"
#include "runner/sweep/bed_kind.hpp"
#include "runner/tables/job_facts.hpp"

namespace grainsweep {

/// An error known from so many degrees of freedom, as tables have it.
inline double widened(double error, int degrees_of_freedom) {
  return error * student_quantile(degrees_of_freedom) / normal_quantile;
}

inline std::string sample_parameters(double width, Boundary y, double small_share) {
  return R"({"accuracy":"balanced","box":{"length":20.0,"width":)" + std::to_string(width) +
         R"(,"x":"periodic","y":")" + name_of(y) +
         R"("},"shape":"sphere","sizes":{"small_share":)" + std::to_string(small_share) + "}}";
}

inline JobFacts sample_job(const std::string& id, double width, int replicate = 1,
                           Boundary y = Boundary::walls, double small_share = 0.0) {
  JobFacts job;
  job.id = id;
  job.label = "MSP";
  job.parameters = sample_parameters(width, y, small_share);
  job.replicate = replicate;
  job.seed = 7;
  job.shape = "sphere";
  job.accuracy = "balanced";
  job.box.width = width;
  job.box.y = y;
  job.small_share = small_share;
  PackingSpec spec;
  spec.box = job.box;
  spec.sizes.small_share = small_share;
  job.kind = bed_kind(spec);
  return job;
}

inline Outcome sample_outcome(const std::string& job, double solid_fraction, double coordination) {
  Outcome outcome;
  outcome.job = job;
  PackingResult& result = outcome.result;
  result.status = PackingStatus::settled;
  result.grains = 2000;
  result.rest = {5e-4, 1e-9, 2e-5, 8e-5, 3e-4, 5990, 0, 5990, 5991, false, {0.02, 0.25}};
  result.surface_height = 15.5;
  result.slab_bottom = 3.0;
  result.slab_top = 12.5;
  result.solid_fraction = solid_fraction;
  result.coordination = {{1e-4, coordination, coordination + 0.25},
                         {1e-5, coordination - 0.125, coordination}};
  result.mean_diameter = 0.98;
  result.mean_diameter_by_volume = 0.99;
  result.sauter_diameter = 0.985;
  result.order.q6_global = 0.03;
  result.order.q6_local = 0.4;
  result.order.three_contact_share = 0.1;
  result.order.segregation = std::numeric_limits<double>::quiet_NaN();
  result.order.force_mean = 5.5;
  result.order.force_square = 1.6;
  result.steps = 265;
  result.iterations = 20000;
  result.state_hash = 0xABCDEF0123456789u;
  outcome.cpu_seconds = 0.75;
  return outcome;
}

inline Curves sample_curves() {
  Curves curves;
  curves.profile_y = {0.1, {{0.1 + 0.2, 1.0 / 3.0, 1, 2, 3, 4}, {5e-324, -0.0, 5, 6, 7, 8}}};
  curves.profile_z = {0.25, {{0.5, 0, 9, 0, -1, 0}}};
  curves.pair_correlation = {0.05, {0, 0.1, 3}};
  curves.force_density = {0.1, {1, std::numeric_limits<double>::quiet_NaN()}};
  curves.sizes = {{0.5, 0.25, 1.0 / 3.0, 0.125}, {1, 1, 1, 1}};
  curves.components = {{10, 5, 0.5, 0.25, 0.125, 4, 5, {3, 1}, {0.25, 0.5, 0.75}},
                       {20, 9, 0.5, 0.75, 0.375, 3, 3, {2, 1}, {0.5, 0.5, 0.5}}};
  curves.components[0].contacts = {{7, 8, 9}, {1, 2, 3}};
  curves.components[1].contacts = {{1, 2, 3}, {4, 5, 6}};
  curves.components[1].profile_z = {
      0.25, {{1.0 / 3.0, 7, {8, 9}, -1, {-0.0, 0.5, 1}}, {0, 0, {0, 0}, 0, {}}}};
  return curves;
}

/// Two grains that are turned: a tetrahedron with an edge along each axis.
inline Turned sample_turned() {
  Turned turned;
  turned.meshes = {{{{0, 0, 0}, {1.0 / 3.0, 0, 0}, {0, 1, 0}, {0, 0, 1}},
                    {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}}}};
  turned.orientations = {{0, 0, 0, 1}, {0.6, -0.0, 0, 0.8}};
  return turned;
}

/// Its slab has the same volume whatever the width is.
inline Row settled_row(const std::string& id, double width, double solid_fraction,
                       double coordination, Boundary y = Boundary::walls,
                       double small_share = 0.0) {
  Row row{sample_job(id, width, 1, y, small_share),
          sample_outcome(id, solid_fraction, coordination)};
  PackingResult& result = row.outcome->result;
  result.slab_top = result.slab_bottom + 47.5 / width;
  return row;
}

/// The row of a packing of pinacoids.
inline Row polyhedra_row(const std::string& id, double width) {
  Row row = settled_row(id, width, 0.65, 7.5);
  row.job.shape = "pinacoid";
  row.job.kind.reset();
  row.outcome->result.shape_order =
      ShapeOrder{{0.5, 0.25, 0.25}, {0.25, 0.25, 0.5}, {0.125, 0.0625, 0.75}};
  return row;
}

/// The parameters of a mixture of cubes and spheres.
inline std::string sample_mixture(double width, double cubes = 0.75) {
  return R"({"box":{"width":)" + std::to_string(width) +
         R"(},"shape":{"mixture":{"1":{"cube":{"edge":1},"share":)" + std::to_string(cubes) +
         R"(},"2":{"sphere":{},"share":)" + std::to_string(1.0 - cubes) +
         R"(}},"mixture_by":"volume"}})";
}

/// The row of a packing of a mixture of two components with a profile along y, a bin of which holds
/// grains of the first alone.
inline Row mixture_row(const std::string& id, double width) {
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  Row row = polyhedra_row(id, width);
  row.job.shape = "mixture";
  row.job.parameters = sample_mixture(width);
  auto& components = row.outcome->result.components;
  components = {{30, 10, 0.75, 0.75, 0.5, 6, 6.5, {4, 2}, {0.25, 0.25, 0.5}},
                {40, 20, 0.25, 0.25, 0.125, 5, 5, {1, 4}, {0.5, 0.5, 0.75}}};
  components[0].contacts = {{6, 2, 0}, {3, 1, 4}};
  components[1].contacts = {{3, 1, 4}, {0, 0, 0}};
  components[0].profile_y = {
      0.5, {{0.25, 4, {8, 12}, 4, {0.25, 0.5, 1}}, {0.5, 2, {4, 6}, 0, {1, 1, 1}}}};
  components[1].profile_y = {
      0.5, {{0.125, 4, {8, 2}, 0, {0.5, 0.5, 0.5}}, {0, 0, {0, 0}, 0, {none, none, none}}}};
  return row;
}

inline Row row_with_status(const std::string& id, double width, PackingStatus status,
                           const std::string& reason) {
  Row row = settled_row(id, width, 0.5, 5.0);
  row.outcome->result.status = status;
  row.outcome->result.reason = reason;
  return row;
}

/// The cells of each line of a table; within quotes a comma is a part of its cell.
inline std::vector<std::vector<std::string>> cells_of_table(const std::string& csv) {
  std::vector<std::vector<std::string>> lines;
  bool is_quoted = false, is_new = true;
  for (const char c : csv) {
    if (is_new) lines.push_back({""});
    is_new = c == '\n' && !is_quoted;
    if (c == '"') is_quoted = !is_quoted;
    if (is_new) continue;
    if (c == ',' && !is_quoted) lines.back().emplace_back();
    if (is_quoted || c != ',') lines.back().back() += c;
  }
  return lines;
}

/// The cell of a table in this line (from 1) and column, with its quotes.
inline std::string cell_in(const std::string& csv, std::size_t line, const std::string& column) {
  const auto lines = cells_of_table(csv);
  const auto& header = lines.at(0);
  const auto at = std::find(header.begin(), header.end(), column) - header.begin();
  return lines.at(line).at(static_cast<std::size_t>(at));
}

}  // namespace grainsweep
