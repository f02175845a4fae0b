// The command `columns`: what the columns of the tables mean.
#include <iostream>

#include <CLI/App.hpp>

#include "runner/commands/commands.hpp"
#include "runner/commands/results.hpp"
#include "runner/exit_codes.hpp"

namespace grainsweep {

void add_command(CLI::App& app, ColumnsOptions& options) {
  CLI::App& columns = *app.add_subcommand("columns", "Say what the columns of the tables mean");
  columns.add_flag("--markdown", options.markdown, "as tables in Markdown, not CSV");
  columns.footer("Example: grainsweep columns");
}

int perform(const ColumnsOptions& options) {
  const std::vector<ColumnText> all = all_columns({}, {});
  std::cout << (options.markdown ? columns_markdown(all) : columns_csv(all));
  return exit_done;
}

}  // namespace grainsweep
