// The command `columns`: what the columns of the tables mean.
#include <iostream>

#include "runner/commands/commands.hpp"
#include "runner/commands/results.hpp"
#include "runner/exit_codes.hpp"

namespace grainsweep {

int columns(const ColumnsOptions& options) {
  const std::vector<ColumnText> all = all_columns({});
  std::cout << (options.markdown ? columns_markdown(all) : columns_csv(all));
  return exit_done;
}

}  // namespace grainsweep
