#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "apps/saca/cases_sources.h"
#include "apps/saca/planes_making.h"
#include "saca/lab/eval/crash_case.h"
#include "saca/lab/eval/crash_search.h"
#include "saca/thinking/memory/case.h"

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

// How an encounter of a record is played. Perception and chance are drawn by its name: which others
// are worked on does not matter.

/// Its number, by the record's name.
[[nodiscard]] std::uint64_t number_of_record(const std::string& name);

/// @param drawn  as its family or record has it
[[nodiscard]] scenario::Scenario case_world(const scenario::Scenario& drawn, std::uint64_t seed);
/// @param world   outlives the stage, as do the inputs
/// @param name    of the record, or of its twin
[[nodiscard]] encounter::Stage case_stage(const scenario::Scenario& world, const Inputs& inputs,
                                          std::uint64_t seed, const std::string& name);

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
  [[nodiscard]] CaseRow row_of(const importers::HundredCarOutcome& event) const;
  void judge(CaseRow& row, eval::CrashCase made, const scenario::Scenario& scenario) const;

  const CaseMakingOptions& options_;
  const CaseSources& sources_;
  const PlanesOfCar& planes_;
  std::vector<memory::MadeWith> made_with_;
};

}  // namespace saca::app
