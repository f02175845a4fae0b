// groups.csv: mean and scatter over the replicates of each parameter set.
#pragma once

#include <cstddef>
#include <functional>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "runner/tables/columns.hpp"
#include "runner/tables/job_facts.hpp"
#include "runner/tables/units.hpp"

namespace grainsweep {

/// Mean, sample standard deviation (divisor n - 1) and standard error of the mean of the known
/// values, which NaN is not; NaN where there are too few.
struct Spread {
  double mean = 0.0;
  double sd = 0.0;
  int n = 0;
  /// sd / sqrt(n), or as moderated by `groups_of`, widened as much as Student's distribution with
  /// `degrees_of_freedom` is wider than the normal one: 1.96 of it contain the truth in 95 %.
  double error = 0.0;
  double degrees_of_freedom = 0.0;  ///< of the variance behind the error
};

/// The error of a mean of n values whose variance is known from so many degrees of freedom; see
/// Spread.
double error_of_mean(double variance, int n, double degrees_of_freedom);

/// Whether replicates, of which n scatter like this, are all in the one state that is possible, as
/// single files: no two disordered packings have the same solid fraction to 1e-5, nor the same
/// coordination number and next to the same solid fraction, which scatters by 0.05 over the root of
/// the number of grains. Their coordination numbers alone do not tell it, as multiples of one over
/// the number of grains may be the same by chance; nor are they copies, which scatter by rounding.
bool are_in_one_state(const Spread& phi, const Spread& z, double grains);

/// Error of the solid fraction of packings in one state, which do not show it by their scatter: of
/// where a slab so high, d, cuts their layers. In a pile of spheres the solid below a plane is that
/// of the mean to 1 / (6 sqrt(3)) of a layer's; both ends may add up, and that is sqrt(3) errors.
double error_of_layers(double solid_fraction, double slab_height);

/// Height of the measured slab, d.
double slab_height(const PackingResult& result);

/// A mean over a slab of that volume, d^3.
struct SlabMean {
  Spread* spread;
  double volume;
};

/// Gives means of groups that differ in nothing but the width of their container the errors that
/// follow from their own scatter and that of the others (runner/analysis/moderated.hpp): that of
/// means over a slab goes as the root of one over its volume. s sqrt(V) of 100 beds each was the
/// same to 15 % for W = 4 to 20 d, where s differs by 2.4 (runner/README.md).
void moderate_errors(const std::vector<SlabMean>& means);

Spread spread_of(std::vector<double> values);

/// The spread of what `value` gives for each of `items`, a list of pointers.
template <class Items, class Value>
Spread spread_of_each(const Items& items, Value value) {
  std::vector<double> values;
  values.reserve(items.size());
  for (const auto* item : items) values.push_back(value(*item));
  return spread_of(std::move(values));
}

/// Why a mean has no error that could be trusted: no replicates, or replicates that are copies and
/// scatter by no more than rounding. Empty if it has one.
std::string why_no_error(const Spread& spread);

/// The packings with one label and one parameter set. Only settled ones enter the means. Refers to
/// the rows that it was made of.
struct Group {
  JobFacts job;                ///< the first of them, whose id stands for the group
  std::size_t number = 0;      ///< of its row in groups.csv, from 1
  std::string family;          ///< canonical JSON of the parameters without box.width and box.y
  bool is_of_squares = false;  ///< its family: of square ducts, which differ in their length, too
  std::string family_name;     ///< as Family::name, once families are known
  /// Dotted name -> cell of the parameters that are not the same in all groups.
  std::map<std::string, std::string> varied;
  /// The same as people tell groups apart: where their shapes differ, the name of the shape, of a
  /// mixture those of its components, stands under "shape", and parameters of shapes, but for the
  /// shares of a mixture, are left out unless they also differ among groups of the same shape or
  /// components. Numbers with more digits than people write are short, where they stay apart.
  std::map<std::string, std::string> told;
  /// Those of `varied` that its packings do not depend on, as sizes.size_ratio without small
  /// grains; but not where only these tell it from groups of the same label.
  std::set<std::string> idle;
  /// Whether the name of its preset stands for the parts of its accuracy: presets vary, or all
  /// groups have one. Where parts of a preset are swept, a value that is its own is one of them.
  bool is_told_by_preset = false;
  std::optional<ProtocolBias> bias_bound;  ///< of phi and Z, by the way of settling
  double slab_volume = 0.0;   ///< mean of the settled packings, d^3; NaN if there are none
  std::vector<Spread> means;  ///< of the fields that have one, in the order of the field table
  /// In the order of the rows, with curves as far as they had.
  std::vector<std::reference_wrapper<const Outcome>> settled;
  StatusCounts counts;
};

/// Whether a box has walls on all sides, as long as it is wide.
bool is_square_duct(const Box& box);

/// The parameters of a family, canonical JSON: those of a job without the width of its container
/// and what bounds it along y; over square ducts without their length, too.
std::string parameters_of_family(const JobFacts& job, bool is_over_squares = false);

/// Those of the family that each of these parameter sets belongs to. Square ducts whose length no
/// other gap between walls has are a family: they differ in both.
std::vector<std::string> parameters_of_families(const std::vector<JobFacts>& jobs);

/// The spread of what `value` gives for entry `k` of `list_of(result)`, over the settled packings
/// of a group that have so many entries.
template <class ListOf, class Value>
Spread spread_of_entry(const Group& group, std::size_t k, ListOf list_of, Value value) {
  std::vector<double> values;
  for (const Outcome& outcome : group.settled) {
    const auto& list = std::invoke(list_of, outcome.result);
    if (k < list.size()) values.push_back(static_cast<double>(std::invoke(value, list[k])));
  }
  return spread_of(std::move(values));
}

/// The number of each row's group, in the order in which the groups first appear, from 1.
std::vector<std::size_t> group_numbers(const std::vector<Row>& rows);

/// A group whose settled packings have their curves, 10 kB each, for as long as it lives.
class GroupWithCurves {
 public:
  /// Reads the curves of packings whose bed is stored in `folder`. Throws FileError.
  GroupWithCurves(Group group, const std::string& folder);
  GroupWithCurves(const GroupWithCurves&) = delete;
  GroupWithCurves(GroupWithCurves&&) = default;
  GroupWithCurves& operator=(const GroupWithCurves&) = delete;
  GroupWithCurves& operator=(GroupWithCurves&&) = default;
  ~GroupWithCurves() = default;

  const Group& operator*() const { return group_; }
  const Group* operator->() const { return &group_; }

 private:
  std::vector<Outcome> outcomes_;
  Group group_;  ///< refers to the outcomes
};

/// A table whose lines are made of one group after the other, each with its curves.
struct CurveTable {
  std::string file;  ///< its name
  std::vector<ColumnText> columns;
  std::string header;
  std::function<std::string(const Group&)> lines;
};

/// The table whose lines are those that `lines_of` lists for a group, which may refer to it.
template <class Line, class LinesOf>
CurveTable curve_table(const std::string& file, const Columns<Line>& columns, LinesOf lines_of) {
  return {file, described(file, columns), header_line(columns), [=](const Group& group) {
            std::string text;
            for (const Line& line : lines_of(group)) text += row_line(columns, line);
            return text;
          }};
}

/// In the order of their numbers. The errors of their phi and Z come from the variance of single
/// packings, moderated by that of the other groups of a family (moderate_errors): the standard
/// deviation of three replicates alone is uncertain by half its value. A single packing has an
/// error of these, too, if others of its family have replicates.
std::vector<Group> groups_of(const std::vector<Row>& rows);
std::vector<Group> groups_of(std::vector<Row>&& rows) = delete;

/// The mean of the field of that name, which must have a mean in groups.csv: "solid_fraction".
const Spread& mean_of(const Group& group, std::string_view field);

/// The parameters that are not the same in all groups, by their dotted names.
using Varied = std::vector<std::string>;
Varied varied_of(const Group& any);
Varied varied_of(const std::vector<Group>& groups);

/// Number and family of a group: what tables are joined by.
Columns<Group> group_key_columns();

/// A column for each of the varied parameters.
Columns<Group> varied_columns(const Varied& varied);

/// The first columns of tables with several lines per group: number, id and a few facts of the
/// group, and what is varied.
Columns<Group> group_line_columns(const Varied& varied);

/// The same for lines that have a `group`.
template <class Line>
Columns<Line> columns_of_group(const Varied& varied) {
  Columns<Line> columns;
  append(columns, group_line_columns(varied),
         [](const Line& line) -> const Group& { return line.group; });
  return columns;
}

/// Appends three columns to a table: mean, standard deviation and standard error of what `spread`
/// gives for an item.
template <class Item, class SpreadOf>
void append_spread(Columns<Item>& columns, const std::string& name, const std::string& unit,
                   const std::string& meaning, SpreadOf spread) {
  columns.push_back(
      {name, unit, meaning, [=](const Item& item) { return cell(spread(item).mean); }});
  columns.push_back({name + "_sd", unit, "standard deviation of it over the replicates",
                     [=](const Item& item) { return cell(spread(item).sd); }});
  columns.push_back({name + "_error", unit,
                     "standard error of the mean, widened by Student's distribution where packings "
                     "are few",
                     [=](const Item& item) { return cell(spread(item).error); }});
}

/// What a packing measured at a gap tolerance, d; null if it did not.
const Coordination* coordination_at(double tolerance, const PackingResult& result);

/// Every gap tolerance that some group has behind its first one, ascending.
std::vector<double> further_tolerances(const std::vector<Group>& groups);

/// Columns coordination_at_<gap> hold the means at further gap tolerances, d, with errors from the
/// replicates of each group alone.
Columns<Group> groups_columns(const std::vector<double>& further_tolerances, const Varied& varied,
                              const GivenUnits& units = {});

/// The whole file.
std::string groups_csv(const std::vector<Group>& groups, const GivenUnits& units = {});

}  // namespace grainsweep
