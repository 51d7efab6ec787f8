#include "saca/lab/paper_comparison/table_text.h"

#include <fmt/core.h>

#include <algorithm>
#include <vector>

namespace saca::paper_comparison {

std::string text_of(const report::PageTable& table) {
  std::string out = table.heading + "\n";
  for (const std::string& line : table.lines) {
    out += fmt::format("  {}\n", line);
  }
  std::size_t widest = 0;
  std::vector<std::size_t> widths;
  for (const std::string& column : table.columns) {
    widths.push_back(column.size());
  }
  for (const report::PageTable::Row& row : table.rows) {
    widest = std::max(widest, row.name.size());
    for (std::size_t i = 0; i < row.cells.size(); ++i) {
      widths[i] = std::max(widths[i], row.cells[i].size());
    }
  }
  const auto line = [&](const std::string& name, const std::vector<std::string>& cells) {
    std::string text = fmt::format("  {:{}}", name, widest);
    for (std::size_t i = 0; i < cells.size(); ++i) {
      text += fmt::format("  {:>{}}", cells[i], widths[i]);
    }
    out += text + "\n";
  };
  line("", table.columns);
  for (const report::PageTable::Row& row : table.rows) {
    line(row.name, row.cells);
  }
  return out + "\n";
}

}  // namespace saca::paper_comparison
