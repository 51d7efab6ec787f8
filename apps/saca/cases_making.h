#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "apps/saca/cases_sources.h"
#include "apps/saca/planes_making.h"
#include "saca/eval/crash_case.h"
#include "saca/eval/crash_search.h"
#include "saca/memory/case.h"

namespace saca::app {

/// What became of one record; as a line of the journal.
struct CaseRow {
  std::string family;
  eval::CrashEnd end = eval::CrashEnd::cannot_be_drawn;
  std::string problem;                  ///< why it could not be played; else empty
  std::optional<eval::CrashCase> made;  ///< none where it does not happen, or never triggers
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
  CaseMaking(const CaseMakingOptions& options, const CaseSources& sources,
             const PlanesOfCar& planes);

  [[nodiscard]] std::size_t size() const {
    return sources_.prospects.size() + sources_.events.size();
  }
  [[nodiscard]] CaseRow row(std::size_t number) const;
  /// Of all that rows depend on, but for the options.
  [[nodiscard]] std::uint64_t digest() const;

 private:
  [[nodiscard]] CaseRow row_of(const CrashProspect& prospect) const;
  [[nodiscard]] CaseRow row_of(const sim::HundredCarOutcome& event) const;
  void judge(CaseRow& row, eval::CrashCase made, const sim::Scenario& scenario) const;

  const CaseMakingOptions& options_;
  const CaseSources& sources_;
  const PlanesOfCar& planes_;
  std::vector<memory::MadeWith> made_with_;
};

}  // namespace saca::app
