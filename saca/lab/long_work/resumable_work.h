#pragma once

#include <fmt/core.h>

#include <algorithm>
#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "saca/base/core/clock.h"
#include "saca/base/core/journal.h"
#include "saca/base/core/parallel.h"
#include "saca/lab/long_work/interrupt.h"
#include "saca/lab/long_work/output_file.h"
#include "saca/lab/long_work/progress.h"

namespace saca::long_work {

/// Long work that gives one row after the other, each by itself. What was done stands in a journal,
/// so that the same command goes on from there after an interrupt.
template <class Row>
struct ResumableWork {
  std::string journal;   ///< its file
  std::string title;     ///< of the journal: names everything on which the rows depend
  std::string progress;  ///< what is worked on, for the line of progress
  std::string unit;      ///< what a row is of: "encounters"
  std::size_t count = 0;
  ProgressDisplay display = ProgressDisplay::shown;
  int threads = 1;  ///< they do not change the rows
  std::size_t at_once =
      0;  ///< rows between two looks at the signals; 0: one on one thread, else 32
  std::function<Row(std::size_t number)> row;
  std::function<std::string(const Row& row)> line_of;
  std::function<Result<Row>(const std::string& line)> row_from;
  bool spoilt_by_interrupt = false;  ///< rows that are worked on then are not to be kept
  std::function<std::optional<Error>()> failure = [] {
    return std::nullopt;
  };  ///< why the newest rows are worth nothing, and all is to stop
};

/// All rows, from where the journal ends on, with progress on the error stream.
/// @return  nullopt: interrupted
template <class Row>
[[nodiscard]] Result<std::optional<std::vector<Row>>> rows_of(const ResumableWork<Row>& work) {
  if (auto problem = make_folder_of(work.journal)) {
    return *problem;
  }
  const auto journal = Journal::open(work.journal, work.title);
  if (!journal.has_value()) {
    return journal.error();
  }
  std::vector<Row> rows;
  rows.reserve(work.count);
  for (const std::string& line : journal.value().lines()) {
    if (rows.size() == work.count) {
      break;
    }
    auto row = work.row_from(line);
    if (!row.has_value()) {
      return Error{Error::Code::malformed, fmt::format("{}: line {}: {}", work.journal,
                                                       rows.size() + 2, row.error().message)};
    }
    rows.push_back(std::move(row).value());
  }
  const auto before = static_cast<int>(rows.size());
  SteadyClock clock;
  ProgressLine progress(work.progress, static_cast<int>(work.count), clock, work.display);
  const std::size_t usual = work.threads == 1 ? 1 : 32;
  const std::size_t at_once = work.at_once == 0 ? usual : work.at_once;
  while (rows.size() < work.count) {
    if (interrupted()) {
      return std::optional<std::vector<Row>>();
    }
    const std::size_t first = rows.size();
    std::vector<Row> next(std::min(at_once, work.count - first));
    in_parallel(next.size(), work.threads, [&](std::size_t i) { next[i] = work.row(first + i); });
    if (work.spoilt_by_interrupt && interrupted()) {
      return std::optional<std::vector<Row>>();
    }
    if (auto failed = work.failure()) {
      return *std::move(failed);
    }
    for (Row& row : next) {
      if (!journal.value().add(work.line_of(row))) {
        return Error{Error::Code::unwritable, work.journal + ": cannot be added to"};
      }
      rows.push_back(std::move(row));
    }
    progress.show(static_cast<int>(rows.size()), before, " " + work.unit);
  }
  return std::optional(std::move(rows));
}

}  // namespace saca::long_work
