#include "saca/lab/crash_records/csv_columns.h"

#include <fmt/core.h>

#include <algorithm>
#include <boost/algorithm/string/predicate.hpp>
#include <boost/token_functions.hpp>
#include <boost/tokenizer.hpp>

#include "saca/base/core/csv.h"

namespace saca::crash_records {
namespace {

constexpr auto nowhere = static_cast<std::size_t>(-1);

std::vector<std::string> fields_of_line(std::string_view line) {
  using Separator = boost::escaped_list_separator<char>;
  // No escapes: a backslash is a letter like any other. A doubled quote opens and closes at once.
  const Separator separator{std::string(), std::string(","), std::string("\"")};
  const boost::tokenizer<Separator, std::string_view::const_iterator, std::string> tokens(
      line.begin(), line.end(), separator);
  return {tokens.begin(), tokens.end()};
}

/// Where each wanted column stands in the line of names.
Result<std::vector<std::size_t>> places_of(const std::vector<std::string>& names,
                                           const std::string& source,
                                           std::span<const CsvColumn> wanted) {
  std::vector<std::size_t> places;
  places.reserve(wanted.size());
  for (const CsvColumn& column : wanted) {
    const auto found = std::find_if(names.begin(), names.end(), [&](const std::string& name) {
      return boost::algorithm::iequals(trimmed(name), column.name);
    });
    if (found == names.end() && column.needed) {
      constexpr std::size_t shown = 60;  // characters
      std::string list;
      for (const std::string& name : names) {
        list += (list.empty() ? "" : ", ") + name;
      }
      list = list.size() > shown ? list.substr(0, shown) + "..." : list;
      return Error{Error::Code::malformed,
                   fmt::format("{}: want a column {}, got {} columns without it: {}", source,
                               column.name, names.size(), list)};
    }
    places.push_back(found == names.end() ? nowhere
                                          : static_cast<std::size_t>(found - names.begin()));
  }
  return places;
}

}  // namespace

Result<CsvCount> read_columns(
    std::string_view text, const std::string& source, std::span<const CsvColumn> wanted,
    const std::function<std::optional<std::string>(const CsvRow&)>& take) {
  constexpr std::string_view byte_order_mark = "\xEF\xBB\xBF";
  if (text.starts_with(byte_order_mark)) {
    text.remove_prefix(byte_order_mark.size());
  }
  const std::vector<std::string> names = fields_of_line(cut_line(text));
  const auto places = places_of(names, source, wanted);
  if (!places.has_value()) {
    return places.error();
  }
  CsvCount count;
  std::vector<std::string> fields(wanted.size());
  for (std::size_t line = 2; !text.empty(); ++line) {
    const std::string_view row = cut_line(text);
    if (trimmed(row).empty()) {
      continue;
    }
    const std::vector<std::string> all = fields_of_line(row);
    std::optional<std::string> broken;
    if (all.size() == names.size()) {
      for (std::size_t i = 0; i < fields.size(); ++i) {
        const std::size_t place = places.value()[i];
        fields[i] = place == nowhere ? std::string() : std::string(trimmed(all[place]));
      }
      broken = take({.line = line, .fields = fields});
    } else {
      broken = fmt::format("want {} fields, got {}", names.size(), all.size());
    }
    if (!broken) {
      ++count.rows;
      continue;
    }
    if (++count.broken == 1) {
      count.first_broken = fmt::format("{}:{}: {}", source, line, *broken);
    }
  }
  if (count.rows == 0) {
    return Error{Error::Code::malformed, count.broken == 0
                                             ? source + ": want at least one row, got none"
                                             : "no row can be used: " + count.first_broken};
  }
  return count;
}

}  // namespace saca::crash_records
