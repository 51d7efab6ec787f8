#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "saca/base/core/result.h"
#include "saca/lab/eval/showcase.h"
#include "saca/lab/eval/suite_source.h"
#include "saca/lab/long_work/progress.h"
#include "saca/lab/scenario/scenario.h"

namespace saca::family_samples {

/// How many scenes are wanted of each policy.
[[nodiscard]] int wanted(manoeuvre::PolicyId policy);

/// A scene that shows what a policy is for.
struct ShowcaseScene {
  scenario::Scenario scenario;
  eval::Oracle oracle;

  /// How often the right policy meets somebody all the same.
  [[nodiscard]] double contact_share() const {
    return oracle.of(oracle.best()).expected.contact.share;
  }
};

/// Where scenes are searched, and by which rule. What it points to outlives the search.
struct ShowcaseSearch {
  const eval::SuiteSource* source = nullptr;
  const manoeuvre::Car* car = nullptr;
  const collision::HarmModel* harm = nullptr;
  eval::ShowcaseRule rule;
  std::uint64_t seed = 1;  ///< of the draws
  int tries = 40;          ///< candidates of each policy that are tried, >= 0
  int threads = 1;         ///< they do not change the result
  long_work::ProgressDisplay display = long_work::ProgressDisplay::shown;
};

/// Of the first candidates those that convince, and of these the ones in which the right policy
/// meets somebody least often, each as a scenario of its own ("showcase_0", or "showcase_7_a" and
/// so on where several are wanted); fewer than wanted where too few do. The search ends with as
/// many as are wanted in which it hardly ever does. Progress on the error stream.
/// @param findings  of encounters of the source
/// @return          nullopt: interrupted; an error where an encounter cannot be drawn again
[[nodiscard]] Result<std::optional<std::vector<ShowcaseScene>>> showcase_scenes(
    const ShowcaseSearch& search, std::span<const eval::Finding> findings,
    manoeuvre::PolicyId policy);

}  // namespace saca::family_samples
