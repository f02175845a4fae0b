// Solid fraction and coordination number over each parameter that a random design varies.

#include "runner/report/figures.hpp"
#include "runner/report/plots.hpp"
#include "runner/tables/fits.hpp"

namespace grainsweep {
namespace {

const std::string parameters_table = "parameters.csv";
constexpr std::size_t most_parameters = 6;

std::string parameters_csv(const Axes& axes, const std::vector<std::string>& parameters) {
  std::vector<std::string> header = {"series", "group"};
  header.insert(header.end(), parameters.begin(), parameters.end());
  header.insert(header.end(), {"solid_fraction", "solid_fraction_error", "coordination",
                               "coordination_error", "name"});
  std::string text = csv_line(header);
  for (const Series& series : axes.series) {
    const std::string number = series_cell(axes, series);
    for (const Group* group : series.groups) {
      const Spread &phi = mean_of(*group, "solid_fraction"), &z = mean_of(*group, "coordination");
      std::vector<std::string> cells = {number, cell(group->number)};
      for (const std::string& parameter : parameters)
        cells.push_back(cell(value_of(*group, parameter)));
      cells.insert(cells.end(), {cell(phi.mean), cell(phi.error), cell(z.mean), cell(z.error),
                                 cell(series.name)});
      text += csv_line(cells);
    }
  }
  return text;
}

std::string parameter_panel(const Axes& axes, const std::string& parameter,
                            const std::string& column) {
  std::vector<std::string> parts;
  if (has_other_series(axes)) {
    parts.push_back(
        plot_part({parameters_table, "series", 0, parameter, column, "", other_series_style}));
  }
  for (std::size_t k = 0; k < shown_series(axes).size(); ++k) {
    parts.push_back(plot_part({parameters_table, "series", k + 1, parameter, column,
                               column + "_error", "points ls " + cell(k + 1)}));
  }
  return plot_command(parts);
}

/// All values that the groups reach, with their errors.
Range range_of_all(const Axes& axes, Quantity quantity) {
  return range_of(shown_ends(bars_of(axes, quantity)), 0.07);
}

Range range_of_parameter(const Axes& axes, const std::string& parameter) {
  std::vector<double> values;
  for (const Group* group : groups_on(axes)) values.push_back(value_of(*group, parameter));
  return range_of(values, 0.04);
}

std::string parameters_commands(const Axes& axes, Figure& figure,
                                const std::vector<std::string>& parameters) {
  const std::vector<double> heights(parameters.size(),
                                    1.0 / static_cast<double>(parameters.size()));
  const Panels panels(figure, 2, heights, key_with_others(axes), {.right = 24.0, .row = 70.0});
  const std::string solid = range_command("y", range_of_all(axes, Quantity::solid_fraction)),
                    touching = range_command("y", range_of_all(axes, Quantity::coordination));
  std::string text = reference_colours(axes) + "set multiplot\n" + panels.key();
  for (std::size_t row = 0; row < parameters.size(); ++row) {
    const std::string& parameter = parameters[row];
    text += range_command("x", range_of_parameter(axes, parameter)) +
            label_command("x", parameter == axes.parameter ? axes.title : axis_title(parameter)) +
            panels.place(0, row) + solid + label_command("y", "solid fraction φ") +
            parameter_panel(axes, parameter, "solid_fraction") + panels.place(1, row) + touching +
            label_command("y", "coordination number Z") +
            parameter_panel(axes, parameter, "coordination");
  }
  return text;
}

}  // namespace

Figure parameters_figure(const Axes& axes) {
  Figure figure{.name = "parameters",
                .title = "Over each parameter",
                .caption =
                    "Solid fraction and coordination number of all groups over each number that "
                    "is varied, whatever the others are"};
  if (shown_series(axes).empty()) return undrawn(std::move(figure), "no packing has settled");
  std::vector<std::string> parameters = axes.scattered;
  std::string first_text;
  if (parameters.size() > most_parameters) {
    first_text = " The first " + cell(most_parameters) + " of " + cell(parameters.size()) +
                 " are drawn; all are in the folder's groups.csv.";
    parameters.resize(most_parameters);
  }
  const Axes drawn = thinned(axes, most_points / (2 * parameters.size()));
  figure.caption += bars_text({bars_of(drawn, Quantity::solid_fraction),
                               bars_of(drawn, Quantity::coordination)}) +
                    "." + first_text + grey_series_text(drawn) + thinned_text(drawn, axes);
  figure.height = 120 + 230 * static_cast<int>(parameters.size());
  figure.tables = {{parameters_table, parameters_csv(drawn, parameters)}};
  figure.commands = parameters_commands(drawn, figure, parameters);
  return figure;
}

}  // namespace grainsweep
