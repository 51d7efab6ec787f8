#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "saca/base/core/result.h"
#include "saca/lab/crash_records/facts.h"
#include "saca/lab/eval/judged_encounter.h"

namespace saca::cases {

/// Where a case comes from.
struct RecordId {
  std::string study;                 ///< "FARS" or "100-Car"
  std::string name;                  ///< of the record's family or scenario
  std::optional<std::string> state;  ///< in words
  std::optional<int> year;
  std::int64_t number = 0;  ///< ST_CASE, or the study's event
};

/// One number of the family that the encounter was drawn from.
struct RecordRange {
  std::string key;
  double min = 0.0;
  double max = 0.0;
  std::string source;  ///< what was recorded, or that it is an assumption
};

/// An encounter that was made of a record, judged at SACA's trigger. One line of a file of them:
/// schema "saca.crash_case/1", docs/formats.md.
struct CrashCase {
  RecordId record;
  std::string family;                ///< what kind of crash
  std::optional<std::string> place;  ///< where it was
  std::vector<crash_records::Fact> facts;
  std::optional<std::string> kind;  ///< of the family it was drawn from; nullopt: it was recorded
  std::vector<RecordRange> ranges;  ///< of that family
  std::uint64_t seed = 0;           ///< of the sample
  std::uint64_t sample = 0;         ///< its number
  double grip = 0.0;                ///< true friction coefficient
  std::optional<eval::WithoutAvoidance> without;
  bool as_recorded = false;           ///< without avoidance what was recorded happens
  std::optional<bool> impact_agrees;  ///< the side hit is the recorded one; nullopt: not recorded
  eval::JudgedEncounter judged;
};

/// The encounter again, as it was drawn, and its twin without risk.
/// @param ego   body of the car that it was drawn for, whose name is `car`
/// @param cues  that it is to have: then another encounter of the same ranges; nullopt: none
/// @return      out_of_range where it was recorded, or cannot be drawn
[[nodiscard]] Result<families::FamilySample> drawn_again(
    const CrashCase& one, std::string_view car, const world::Footprint& ego,
    const std::optional<families::FamilyCues>& cues = std::nullopt);

[[nodiscard]] nlohmann::json to_json(const CrashCase& one);
/// Strict.
/// @return  Error::Code::malformed, naming the key, what was wanted, what came
[[nodiscard]] Result<CrashCase> crash_case_from_json(const nlohmann::json& document);

/// Cases as JSON Lines: one line that says what follows and how many, then one per case.
[[nodiscard]] std::string crash_cases_text(std::span<const CrashCase> cases);
/// @param name  of the file, for messages
/// @return      malformed, naming file, line and key: also where a line is missing
[[nodiscard]] Result<std::vector<CrashCase>> crash_cases_from_text(std::string_view text,
                                                                   const std::string& name);

}  // namespace saca::cases
