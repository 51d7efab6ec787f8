#include "saca/base/core/csv.h"

#include <algorithm>
#include <charconv>
#include <cmath>

namespace saca {
namespace {

Error malformed_line(std::string_view source, std::size_t line, const std::string& message) {
  return {Error::Code::malformed,
          std::string(source) + ":" + std::to_string(line) + ": " + message};
}

// What came, for a message: one line of printable characters, not too long.
std::string shown(std::string_view field) {
  std::string text(field.substr(0, 30));
  std::replace_if(
      text.begin(), text.end(), [](char c) { return c < ' ' || c > '~'; }, '?');
  return "`" + text + "`";
}

std::string list_of(std::span<const std::string_view> names) {
  std::string list;
  for (const std::string_view name : names) {
    list += (list.empty() ? "" : ", ") + std::string(name);
  }
  return list;
}

std::optional<Error> read_names(std::string_view line, std::size_t number, std::string_view source,
                                std::span<const std::string_view> known, CsvTable& table) {
  if (line.find(',') == std::string_view::npos && line.find(';') != std::string_view::npos) {
    return malformed_line(source, number, "want columns separated by commas, got semicolons");
  }
  for (const std::string_view field : fields_of(line, ',')) {
    const std::string_view name = trimmed(field);
    if (std::find(known.begin(), known.end(), name) == known.end()) {
      return malformed_line(source, number,
                            "unknown column " + shown(name) + "; want some of " + list_of(known));
    }
    if (std::find(table.names.begin(), table.names.end(), name) != table.names.end()) {
      return malformed_line(source, number, "column " + shown(name) + " is there twice");
    }
    table.names.emplace_back(name);
  }
  table.columns.resize(table.names.size());
  return std::nullopt;
}

std::optional<Error> read_row(std::string_view line, std::size_t number, std::string_view source,
                              CsvTable& table) {
  const std::vector<std::string_view> fields = fields_of(line, ',');
  if (fields.size() != table.names.size()) {
    return malformed_line(source, number,
                          "want " + std::to_string(table.names.size()) + " columns, got " +
                              std::to_string(fields.size()));
  }
  for (std::size_t i = 0; i < fields.size(); ++i) {
    const std::optional<double> value = finite_number(fields[i]);
    if (!value) {
      return malformed_line(source, number,
                            table.names[i] + ": want a finite number, got " + shown(fields[i]));
    }
    table.columns[i].push_back(*value);
  }
  table.lines.push_back(number);
  return std::nullopt;
}

}  // namespace

std::string_view cut_line(std::string_view& rest) {
  const std::size_t at = rest.find('\n');
  std::string_view line = rest.substr(0, at);
  rest.remove_prefix(at == std::string_view::npos ? rest.size() : at + 1);
  if (line.ends_with('\r')) {
    line.remove_suffix(1);
  }
  return line;
}

std::vector<std::string_view> fields_of(std::string_view line, char mark) {
  std::vector<std::string_view> fields;
  std::size_t begin = 0;
  for (std::size_t end = line.find(mark); end != std::string_view::npos;
       end = line.find(mark, begin)) {
    fields.push_back(line.substr(begin, end - begin));
    begin = end + 1;
  }
  fields.push_back(line.substr(begin));
  return fields;
}

std::string_view trimmed(std::string_view text) {
  constexpr std::string_view blank = " \t";
  const std::size_t first = text.find_first_not_of(blank);
  if (first == std::string_view::npos) {
    return {};
  }
  return text.substr(first, text.find_last_not_of(blank) - first + 1);
}

std::optional<double> finite_number(std::string_view field) {
  field = trimmed(field);
  double value = 0.0;
  const auto [end, problem] = std::from_chars(field.data(), field.data() + field.size(), value);
  if (problem != std::errc{} || end != field.data() + field.size() || !std::isfinite(value)) {
    return std::nullopt;
  }
  return value;
}

Result<CsvTable> read_csv(std::string_view text, std::string_view source,
                          std::span<const std::string_view> known) {
  constexpr std::string_view byte_order_mark = "\xEF\xBB\xBF";
  std::string_view rest = text;
  if (rest.starts_with(byte_order_mark)) {
    rest.remove_prefix(byte_order_mark.size());
  }
  CsvTable table;
  for (std::size_t number = 1; !rest.empty(); ++number) {
    const std::string_view line = cut_line(rest);
    if (trimmed(line).empty() || line.starts_with('#')) {
      continue;
    }
    const std::optional<Error> problem = table.names.empty()
                                             ? read_names(line, number, source, known, table)
                                             : read_row(line, number, source, table);
    if (problem) {
      return *problem;
    }
  }
  if (table.lines.empty()) {
    const std::string got = table.names.empty() ? "an empty file" : "only a line of names";
    return Error{Error::Code::malformed,
                 std::string(source) + ": want rows of numbers below a line of names, got " + got};
  }
  return table;
}

}  // namespace saca
