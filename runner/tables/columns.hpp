// The columns of a table: what each is called and means, and how its cell is made from an item (a
// packing, a group, a bin ...). Tables, columns.csv and the manual are made from them.
#pragma once

#include <functional>
#include <set>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "runner/analysis/decay.hpp"
#include "runner/tables/csv.hpp"

namespace grainsweep {

template <class Item>
struct Column {
  std::string name, unit, meaning;
  std::function<std::string(const Item&)> cell;
};

template <class Item>
using Columns = std::vector<Column<Item>>;

template <class Item>
std::string header_line(const Columns<Item>& columns) {
  std::vector<std::string> cells;
  for (const Column<Item>& column : columns) cells.push_back(cell(column.name));
  return csv_line(cells);
}

template <class Item>
std::string row_line(const Columns<Item>& columns, const Item& item) {
  std::vector<std::string> cells;
  cells.reserve(columns.size());
  for (const Column<Item>& column : columns) cells.push_back(column.cell(item));
  return csv_line(cells);
}

/// Appends columns of `Item`, or of what an item is made from.
template <class Item, class Base>
void append(Columns<Item>& columns, const Columns<Base>& more) {
  for (const Column<Base>& column : more) {
    columns.push_back({column.name, column.unit, column.meaning, column.cell});
  }
}

/// Appends columns of `part(item)`.
template <class Item, class Base, class Part>
void append(Columns<Item>& columns, const Columns<Base>& more, Part part) {
  for (const Column<Base>& column : more) {
    columns.push_back({column.name, column.unit, column.meaning,
                       [cell = column.cell, part](const Item& item) { return cell(part(item)); }});
  }
}

/// Removes columns that have the name of one before them: a shape that is varied is a fact of a job
/// and a parameter.
template <class Item>
void remove_repeated(Columns<Item>& columns) {
  std::set<std::string> names;
  std::erase_if(columns, [&](const auto& column) { return !names.insert(column.name).second; });
}

/// A column without what makes its cells.
struct ColumnText {
  std::string file, name, unit, meaning;
};

template <class Item>
std::vector<ColumnText> described(const std::string& file, const Columns<Item>& columns) {
  std::vector<ColumnText> texts;
  for (const Column<Item>& column : columns) {
    texts.push_back({file, column.name, column.unit, column.meaning});
  }
  return texts;
}

/// The cell of what `value` gives for the `fit` of a line; empty if the fit is not determined.
template <class Value>
auto fit_cell(Value value) {
  return [=](const auto& line) {
    return line.fit.not_determined.empty() ? cell(std::invoke(value, line.fit)) : std::string();
  };
}

/// Appends two columns: a value that is fitted and its standard error.
template <class Item, class Fit>
void append_estimate(Columns<Item>& columns, const std::string& name, const std::string& unit,
                     const std::string& meaning, Estimate Fit::*estimate) {
  const auto value = [=](const Fit& fit) { return (fit.*estimate).value; };
  const auto error = [=](const Fit& fit) { return (fit.*estimate).error; };
  columns.push_back({name, unit, meaning, fit_cell(value)});
  columns.push_back({name + "_error", unit, "standard error of it", fit_cell(error)});
}

/// Whether the `fit` of a line is determined.
template <class Line>
Column<Line> fit_status_column() {
  return {"status", "", "determined or not determined", [](const Line& line) {
            return cell(line.fit.not_determined.empty() ? "determined" : "not determined");
          }};
}

/// columns.csv: file, column, unit and meaning.
std::string columns_csv(const std::vector<ColumnText>& texts);

/// The same for people: a table in GitHub's Markdown for each file.
std::string columns_markdown(const std::vector<ColumnText>& texts);

}  // namespace grainsweep
