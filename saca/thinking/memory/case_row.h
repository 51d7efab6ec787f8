#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <variant>

#include "saca/base/core/result.h"
#include "saca/thinking/memory/case.h"

namespace saca::memory {

// A case as one row of a table, whatever database keeps the table (docs/formats.md).

enum class ColumnKind : std::uint8_t { integer, number, text };

struct Column {
  const char* name;
  ColumnKind kind;
  bool may_be_null = false;
  int since = 1;                        ///< version of the table that has it first
  const char* of_older_rows = nullptr;  ///< SQL, what it is where it was not known
};

/// All but the first, `id`, in the order of the table.
inline constexpr std::array case_columns{
    Column{"policy", ColumnKind::integer},
    Column{"target_speed_mps", ColumnKind::number, true},
    Column{"best_policy", ColumnKind::integer},
    Column{"harm", ColumnKind::number},
    Column{"best_harm", ColumnKind::number},
    Column{"collision_loss", ColumnKind::number},
    Column{"review", ColumnKind::text},
    Column{"source", ColumnKind::text},
    Column{"scene", ColumnKind::text},
    Column{"strength", ColumnKind::number, true, 2},
    Column{"details", ColumnKind::text, false, 3, "'{}'"},
};
constexpr int table_version = 3;

/// Nothing: NULL.
using Cell = std::variant<std::monostate, std::int64_t, double, std::string>;
/// In the order of `case_columns`.
using Cells = std::array<Cell, case_columns.size()>;

/// A number in as many digits as bring it back to the last bit; empty: nothing.
[[nodiscard]] std::string text_of(const Cell& cell);

[[nodiscard]] Cells cells_of(const Case& one);

/// @param where  the bank as people know it, for messages
/// @return       malformed, naming bank, id, column, what was wanted and what came
[[nodiscard]] Result<Case> case_from_cells(match::CaseId id, const Cells& cells,
                                           const std::string& where);

// What a table says that is not as it should be, whatever database keeps it.

/// @return  nullopt: it is table_version or older
[[nodiscard]] std::optional<Error> wrong_version(std::int64_t version, const std::string& where);
[[nodiscard]] Error no_such_bank(const std::string& where);

/// "id, policy, ...": what is selected where rows are read.
[[nodiscard]] std::string column_names();

// Of statements that write rows: parameter 1 is the id, those after it are the columns.

/// "?2, ?3, ...", of all columns.
/// @param mark  before the number of a parameter
[[nodiscard]] std::string parameters(char mark);
/// "policy = ?2, ..."
[[nodiscard]] std::string assignments(char mark);

/// One column as CREATE TABLE and ALTER TABLE take it.
/// @param types  what the database calls the kinds, in their order
[[nodiscard]] std::string column_definition(const Column& column,
                                            const std::array<const char*, 3>& types);

}  // namespace saca::memory
