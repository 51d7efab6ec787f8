#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "saca/base/core/result.h"
#include "saca/lab/eval/judged_encounter.h"
#include "saca/lab/eval/suite.h"
#include "saca/lab/eval/suite_figures.h"
#include "saca/thinking/memory/case.h"
#include "saca/thinking/memory/store.h"

namespace saca::eval {

/// The same SACA with three memories that begin alike.
enum class Learner : std::uint8_t {
  frozen,    ///< remembers nothing
  learning,  ///< remembers every encounter
  poisoned,  ///< likewise, but some of what it is told is the opposite of the truth
};
constexpr std::size_t num_learners = 3;

/// Who is run in every encounter: the three learners; the best of eight over draws; the same
/// corrected by what the learning memory knows, what it began with included; AEB.
constexpr std::array<std::string_view, 6> curriculum_methods{"frozen", "learning",  "poisoned",
                                                             "drawn",  "corrected", "aeb"};

/// One encounter of a curriculum, and what it teaches.
struct Episode {
  SuiteRow row;                     ///< its methods are curriculum_methods; without a twin
  std::optional<memory::Case> one;  ///< as carried out counts the best; nullopt: the trigger never
                                    ///< fires, and there is nothing to be learnt
  bool is_lie = false;              ///< the poisoned memory is told the opposite
  /// By Learner: the case that memory went by and that did materially more harm than braking.
  std::array<std::optional<match::CaseId>, num_learners> refuted;
};

/// As JSON, for journals; and back. Error::Code::malformed: no such episode.
[[nodiscard]] nlohmann::json to_json(const Episode& episode);
[[nodiscard]] Result<Episode> episode_from_json(const nlohmann::json& in);

/// The same case, in which what harms least is told as what harms most, and the other way round:
/// what happened with each policy is mirrored between the least and the largest harm, and told as
/// what was expected as well. Where nothing is known of what happened it stays as it is.
[[nodiscard]] memory::Case upside_down(memory::Case one);

/// Is the poisoned memory told something that speaks for nothing that the truth speaks for? Where
/// all policies harm alike a lie changes nothing.
[[nodiscard]] bool misleads(const Episode& episode);

/// What the episode teaches whoever did this: what was carried out, what it came to, what would
/// have been best, and which policy was told most wrongly, in one line of figures.
/// @throws ContractViolation  if it teaches nothing
[[nodiscard]] memory::Case taught(const Episode& episode, Learner who);

/// How a curriculum is gone through. What it points to outlives it.
struct CurriculumSetup {
  runtime::PlanesSetup saca;  ///< its memory is not looked at
  const intent::Model* intent = nullptr;
  std::vector<memory::MadeWith> made_with;  ///< encounter::made_with of these
  std::uint64_t seed = 1;                   ///< of what is left to chance, of twins and of lies
  bool exact = false;                       ///< as SuiteOptions::exact
  double lies = 0.05;                       ///< share of what the poisoned memory is told, [0, 1]
  JudgingOptions judging;                   ///< what is learnt; its seed is not looked at
};

/// Memories that go through the same encounters, one after the other.
class Curriculum {
 public:
  /// @param start   what all three know at the beginning
  /// @param folder  for their banks, which is there; banks that it has are replaced
  /// @return        what cannot be written
  /// @throws ContractViolation  if the share of lies is none
  [[nodiscard]] static Result<Curriculum> begin(CurriculumSetup setup,
                                                std::span<const memory::Case> start,
                                                const std::filesystem::path& folder);

  /// Plays an encounter, or in half of the cases its twin where it has one, with all that was
  /// learnt until now. Nothing is learnt of it yet.
  [[nodiscard]] Episode play(const SuiteEncounter& encounter);

  /// The memories learn it, each by what it did itself; where there is nothing to be learnt, they
  /// quarantine what it refutes all the same. Of an episode with a fault they learn nothing.
  /// @return  what they could not do
  [[nodiscard]] std::optional<Error> learn(const Episode& episode);

  /// How many cases each knows, by Learner.
  [[nodiscard]] std::array<std::size_t, num_learners> sizes() const;

 private:
  explicit Curriculum(CurriculumSetup setup) : setup_(std::move(setup)) {}
  /// All curriculum_methods, in this encounter.
  /// @return  what went wrong; empty: nothing
  [[nodiscard]] std::string compare_all(const SuiteEncounter& encounter,
                                        const encounter::Stage& stage, Episode& episode);
  [[nodiscard]] memory::Store& of(Learner who) {
    return memories_.at(static_cast<std::size_t>(who));
  }

  CurriculumSetup setup_;
  std::vector<memory::Store> memories_;  ///< by Learner
};

/// Mean of what several seeds came to, with the interval of Student's t; of one seed, without one:
/// low and high are the value.
/// @param values  at least one
[[nodiscard]] Estimate mean_over_seeds(std::span<const double> values);

}  // namespace saca::eval
