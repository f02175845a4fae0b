#include "runner/tables/columns.hpp"

namespace grainsweep {

std::string columns_csv(const std::vector<ColumnText>& texts) {
  std::string text = "file,column,unit,meaning\n";
  for (const ColumnText& one : texts) {
    text += csv_line({cell(one.file), cell(one.name), cell(one.unit), cell(one.meaning)});
  }
  return text;
}

std::string columns_markdown(const std::vector<ColumnText>& texts) {
  std::string text, file;
  for (const ColumnText& one : texts) {
    if (one.file != file) {
      text += (file.empty() ? "### `" : "\n### `") + one.file +
              "`\n\n| column | unit | meaning |\n|---|---|---|\n";
    }
    file = one.file;
    text += "| `" + one.name + "` | " + one.unit + " | " + one.meaning + " |\n";
  }
  return text;
}

}  // namespace grainsweep
