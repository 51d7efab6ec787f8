#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "saca/lab/curricula/learn_request.h"
#include "saca/lab/curricula/start_digest.h"
#include "saca/lab/eval/curriculum_figures.h"
#include "saca/lab/suites/opened_suite.h"
#include "saca/lab/vehicle_study/car_planes.h"

namespace saca::curricula {

/// What curricula are made of.
struct Lessons {
  suites::EncounterSource encounters;
  std::uint64_t count = 0;  ///< encounters of each seed
  std::shared_ptr<const vehicle_study::PlanesOfCar> planes;
  std::vector<memory::MadeWith> made_with;
  std::unique_ptr<suites::SuiteThinking> thinking;
  std::vector<memory::Case> start;  ///< what memories know at the beginning
  StartDigest digest;               ///< of that
};

/// Opens what a request names.
/// @return  an error where there are fewer encounters than seeds, too
[[nodiscard]] Result<Lessons> open_lessons(const installation::Installation& here,
                                           const LearnRequest& request);

/// Where the journal of these lessons lies: in the request's folder.
[[nodiscard]] std::filesystem::path journal_place(const LearnRequest& request);

/// Goes through all lessons, with progress on the error stream, from where the journal ends on. The
/// request's folder is held meanwhile (long_work::FolderHold): whoever else would replace its banks
/// is refused.
/// @return  nullopt: interrupted; Error::Code::unwritable where somebody else holds the folder
[[nodiscard]] Result<std::optional<std::vector<eval::Episodes>>> taught(
    const installation::Installation& here, Lessons& lessons, const LearnRequest& request);

}  // namespace saca::curricula
