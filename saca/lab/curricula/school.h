#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "saca/base/core/result.h"
#include "saca/lab/eval/curriculum_figures.h"
#include "saca/lab/long_work/progress.h"

namespace saca::curricula {

/// The curricula of several seeds, gone through at the same time. Each seed has encounters of its
/// own: those of seed k, from 0 on, are the numbers k * count to k * count + count - 1.
class School {
 public:
  using EncounterAt = std::function<Result<eval::SuiteEncounter>(std::uint64_t number)>;

  /// @param curricula     by seed, at least one
  /// @param encounter_at  may be called by several threads at once
  /// @param count         encounters of each seed
  /// @param threads       they do not change what is learnt, >= 1
  School(std::vector<eval::Curriculum> curricula, EncounterAt encounter_at, std::uint64_t count,
         int threads);

  [[nodiscard]] std::uint64_t count() const { return count_; }
  /// Of the encounter of each seed.
  /// @param number  < count
  [[nodiscard]] std::vector<std::uint64_t> numbers_of(std::uint64_t number) const;

  /// This encounter of all seeds, played and learnt. What cannot be had is an episode with a fault.
  [[nodiscard]] eval::Episodes teach(std::uint64_t number);
  /// Learns what was played before, and says how large the banks are then.
  /// @return  what a bank could not do
  [[nodiscard]] std::optional<Error> learn(eval::Episodes& episodes);
  /// What a bank could not do when it was taught; nullopt: it could all.
  [[nodiscard]] const std::optional<Error>& failure() const { return failure_; }

 private:
  std::vector<eval::Curriculum> curricula_;
  EncounterAt encounter_at_;
  std::uint64_t count_;
  int threads_;
  std::optional<Error> failure_;
};

/// As many curricula as seeds, with banks in `folder`/seed-1 and so on, which are replaced.
/// @param first  of the first seed; the seeds of the others follow on its own
/// @param start  what all memories know at the beginning
/// @return       what cannot be written
[[nodiscard]] Result<std::vector<eval::Curriculum>> begin_curricula(
    const eval::CurriculumSetup& first, std::span<const memory::Case> start,
    const std::filesystem::path& folder, int seeds);

/// The journal of a school, from which it goes on.
struct SchoolJournal {
  std::filesystem::path file;
  std::string title;  ///< names all on which the episodes depend
  long_work::ProgressDisplay display = long_work::ProgressDisplay::shown;
  bool spoilt_by_interrupt = false;  ///< episodes that are played then are not to be kept
  std::function<std::optional<Error>()> failure = [] {
    return std::nullopt;
  };  ///< why the newest episode is worth nothing, and all is to stop
};

/// All encounters one after the other, from where the journal ends on; what stands in it is learnt
/// again.
/// @return  nullopt: interrupted; an error as long_work::rows_of
[[nodiscard]] Result<std::optional<std::vector<eval::Episodes>>> taught_by(
    School& school, const SchoolJournal& journal);

}  // namespace saca::curricula
