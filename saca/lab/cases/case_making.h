#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "saca/base/core/result.h"
#include "saca/lab/cases/case_sources.h"
#include "saca/lab/cases/case_tools.h"
#include "saca/lab/cases/crash_case.h"
#include "saca/lab/cases/crash_search.h"
#include "saca/lab/long_work/progress.h"
#include "saca/lab/scenario/scenario.h"
#include "saca/thinking/memory/case.h"

namespace saca::cases {

/// What became of one record; as a line of the journal.
struct CaseRow {
  std::string family;
  CrashEnd end = CrashEnd::cannot_be_drawn;
  std::string problem;            ///< why it could not be played; else empty
  std::optional<CrashCase> made;  ///< none where it does not happen, or never triggers
};
[[nodiscard]] std::string case_row_line(const CaseRow& row);
[[nodiscard]] Result<CaseRow> case_row_from(const std::string& line);

/// How cases are made of records.
struct CaseMakingOptions {
  std::uint64_t seed = 1;
  eval::JudgingOptions judging;  ///< its own seed is not used
  int tries = 20;                ///< samples of a record's family until its crash happens
};

/// Makes a row of each record; what it is given outlives it. One row does not depend on the others.
class CaseMaking {
 public:
  CaseMaking(const CaseMakingOptions& options, const CaseSources& sources, CaseTools tools);

  [[nodiscard]] std::size_t size() const {
    return sources_.prospects.size() + sources_.events.size();
  }
  [[nodiscard]] CaseRow row(std::size_t number) const;
  /// Of all that rows depend on, but for the options.
  [[nodiscard]] std::uint64_t digest() const;

 private:
  [[nodiscard]] CaseRow row_of(const CrashProspect& prospect) const;
  [[nodiscard]] CaseRow row_of(const importers::HundredCarOutcome& event) const;
  void judge(CaseRow& row, CrashCase made, const scenario::Scenario& scenario) const;

  const CaseMakingOptions& options_;
  const CaseSources& sources_;
  CaseTools tools_;
  std::vector<memory::MadeWith> made_with_;
};

/// How the rows are worked out, and kept in between.
struct CaseWork {
  std::string journal;  ///< its file
  std::string title;    ///< of the journal: program and command
  long_work::ProgressDisplay display = long_work::ProgressDisplay::shown;
  int threads = 1;
};

/// All rows, from where the journal ends on.
/// @return  nullopt: interrupted
[[nodiscard]] Result<std::optional<std::vector<CaseRow>>> case_rows(const CaseMaking& making,
                                                                    const CaseWork& work);

}  // namespace saca::cases
