#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "saca/base/core/result.h"

namespace saca::crash_records {

/// A column that is asked for. Names are compared without regard to case.
struct CsvColumn {
  std::string_view name;
  bool needed = true;  ///< else it may be missing, and its fields are empty
};

/// One line of a table.
struct CsvRow {
  std::size_t line = 0;                 ///< from 1
  std::span<const std::string> fields;  ///< in the order of the wanted columns
};

/// What was read, and what was passed over.
struct CsvCount {
  std::size_t rows = 0;      ///< handed on and accepted
  std::size_t broken = 0;    ///< passed over
  std::string first_broken;  ///< where and why, of the first of them
};

/// Reads some columns of a comma-separated file with one line of names; fields may be quoted with
/// `"` and then hold commas (Boost.Tokenizer). A line that has another number of fields than there
/// are names, and one that `take` does not accept, is broken: it is counted and passed over.
///
/// @param source  name for messages, usually the path
/// @param take    says why a row is broken; nullopt: it is not
/// @return        Error::Code::malformed, naming source, column, wanted and got, where a needed
///                column is missing, or where there is no row that is not broken
[[nodiscard]] Result<CsvCount> read_columns(
    std::string_view text, const std::string& source, std::span<const CsvColumn> wanted,
    const std::function<std::optional<std::string>(const CsvRow&)>& take);

}  // namespace saca::crash_records
