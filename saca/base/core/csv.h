#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "saca/base/core/result.h"

namespace saca {

// Text in lines and columns.

/// Cuts the first line off the front of `rest`, without its end (LF or CR LF).
[[nodiscard]] std::string_view cut_line(std::string_view& rest);

/// The pieces of a line between the marks; one more than there are marks.
[[nodiscard]] std::vector<std::string_view> fields_of(std::string_view line, char mark);

/// Without the spaces and tabs around it.
[[nodiscard]] std::string_view trimmed(std::string_view text);

/// nullopt for anything but one finite number in C's notation, spaces around it allowed.
[[nodiscard]] std::optional<double> finite_number(std::string_view field);

/// A table of numbers.
struct CsvTable {
  std::vector<std::string> names;            ///< of the columns, none twice
  std::vector<std::vector<double>> columns;  ///< (names x rows), all finite
  std::vector<std::size_t> lines;            ///< where each row stands, from 1
};

/// Reads comma-separated numbers below one line of names. Lines that are empty or begin with `#`
/// are passed over, and so is a byte order mark.
///
/// @param source  name for messages, usually the path
/// @param known   the names that a column may have
/// @return        at least one row; else Error::Code::malformed, naming source, line, column,
///                wanted and got: an unknown or repeated name, a row too short or too long, what
///                is no finite number, nothing at all
[[nodiscard]] Result<CsvTable> read_csv(std::string_view text, std::string_view source,
                                        std::span<const std::string_view> known);

}  // namespace saca
