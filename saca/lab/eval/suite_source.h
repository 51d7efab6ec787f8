#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "saca/base/core/result.h"
#include "saca/lab/families/family.h"
#include "saca/lab/families/splits.h"

namespace saca::eval {

/// What comes of the cues that a suite has.
/// @param families  folder with suites.toml and cues.toml
/// @return          out_of_range where there is no such suite, or it has no cues; else what cannot
///                  be read
[[nodiscard]] Result<families::FamilyCues> cues_of_suite(const std::filesystem::path& families,
                                                         const std::string& suite);

/// Which encounters are drawn, and for which car.
struct SuiteDraw {
  std::filesystem::path scenarios;  ///< folder with families/, families/suites.toml and splits.toml
  std::string suite;                ///< its name, or that of a family
  families::Split split = families::Split::tuning;
  std::optional<families::TestLog> test_log;  ///< needed for the test split
  std::string car;                            ///< its name
  world::Footprint footprint;                 ///< of the car
  std::vector<std::string> other_names;       ///< that could have been asked for, to be suggested
};

/// The families of a suite, ready to be drawn from.
class SuiteSource {
 public:
  /// @return  out_of_range where there is no such suite or family, with what was likely meant; else
  /// what
  ///          cannot be read, or why the split may not be used
  [[nodiscard]] static Result<SuiteSource> open(const SuiteDraw& draw);

  /// Encounter `number` of the suite.
  [[nodiscard]] Result<families::FamilySample> sample(std::uint64_t number) const;
  [[nodiscard]] const std::string& family_of(std::uint64_t number) const;

 private:
  std::string car_;
  world::Footprint footprint_;
  families::Suite suite_;
  std::vector<families::Family> families_;  ///< by member of the suite
  std::vector<std::uint64_t> seeds_;        ///< likewise
};

}  // namespace saca::eval
