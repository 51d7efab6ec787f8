#include "saca/base/formats/hdf5_rows.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <string_view>

#include "saca/base/core/contract.h"
#include "saca/base/core/csv.h"

namespace saca::formats {
namespace {

constexpr double largest_whole = 9007199254740992.0;  // 2^53: exact as a double

std::string part_of(const char* name) {
  return fmt::format("data set {}", name);
}

}  // namespace

void write_row(Hdf5Writer& writer, const char* name, const std::vector<double>& row) {
  expects(!row.empty(), "a row has at least one number");
  writer.numbers<double>(name, {row.size()}, {row.data()});
}

void write_lines(Hdf5Writer& writer, const char* name, std::span<const std::string> lines) {
  std::string text;
  for (const std::string& line : lines) {
    expects(line.find_first_of("\r\n") == std::string::npos, "lines have no line ends in them");
    text += line;
    text += '\n';
  }
  writer.text(name, text);
}

std::size_t row_size(Hdf5Reader& reader, const char* name) {
  const std::vector<std::size_t> extents = reader.extents(name);
  if (!reader.problem() && extents.size() != 1) {
    reader.reject(part_of(name), "a row of numbers", "another shape");
  }
  return reader.problem() ? 0 : extents[0];
}

std::vector<double> read_row(Hdf5Reader& reader, const char* name, std::size_t size,
                             Numbers allowed) {
  reader.want_numbers<double>(name, {size});  // before memory is taken
  std::vector<double> row(reader.problem() ? 0 : size);
  if (!reader.problem()) {
    reader.numbers<double>(name, {size}, {row.data()}, allowed);
  }
  row.resize(size);
  return row;
}

std::vector<std::size_t> read_counts(Hdf5Reader& reader, const char* name, std::size_t size,
                                     std::size_t least) {
  std::vector<std::size_t> counts;
  counts.reserve(size);
  for (const double value : read_row(reader, name, size)) {
    if (!reader.problem() && !(value >= static_cast<double>(least) && value <= largest_whole &&
                               value == std::floor(value))) {
      reader.reject(part_of(name), fmt::format("whole numbers from {} on", least),
                    fmt::format("{}", value));
    }
    counts.push_back(reader.problem() ? least : static_cast<std::size_t>(value));
  }
  return counts;
}

std::vector<std::size_t> read_parts(Hdf5Reader& reader, const char* name, std::size_t size,
                                    std::size_t least, std::size_t sum) {
  std::vector<std::size_t> parts = read_counts(reader, name, size, least);
  constexpr std::size_t too_much = std::size_t{1} << 62U;
  std::size_t came = 0;
  for (const std::size_t part : parts) {
    came = std::min(came + part, too_much);
  }
  if (!reader.problem() && came != sum) {
    reader.reject(part_of(name), fmt::format("counts of {} together", sum),
                  fmt::format("{}", came));
  }
  return parts;
}

std::vector<bool> read_flags(Hdf5Reader& reader, const char* name, std::size_t size) {
  std::vector<bool> flags;
  flags.reserve(size);
  for (const double value : read_row(reader, name, size)) {
    if (!reader.problem() && value != 0.0 && value != 1.0) {
      reader.reject(part_of(name), "0 or 1", fmt::format("{}", value));
    }
    flags.push_back(value == 1.0);
  }
  return flags;
}

std::vector<std::string> read_lines(Hdf5Reader& reader, const char* name, std::size_t size) {
  const std::string text = reader.text(name);
  std::vector<std::string> lines;
  for (std::string_view rest = text; !rest.empty();) {
    lines.emplace_back(cut_line(rest));
  }
  if (!reader.problem() && lines.size() != size) {
    reader.reject(part_of(name), fmt::format("{} lines", size), fmt::format("{}", lines.size()));
  }
  lines.resize(reader.problem() ? size : lines.size());
  return lines;
}

}  // namespace saca::formats
