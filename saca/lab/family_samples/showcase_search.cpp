#include "saca/lab/family_samples/showcase_search.h"

#include <fmt/core.h>

#include <algorithm>
#include <utility>

#include "saca/base/core/clock.h"
#include "saca/lab/eval/oracle.h"
#include "saca/lab/long_work/interrupt.h"

namespace saca::family_samples {
namespace {

using manoeuvre::PolicyId;

/// A sample as a scenario of its own.
void give_name(ShowcaseScene& one, PolicyId policy, std::size_t index) {
  scenario::Scenario& scenario = one.scenario;
  scenario.name = fmt::format("showcase_{}", manoeuvre::index(policy));
  if (wanted(policy) > 1) {
    scenario.name += fmt::format("_{}", static_cast<char>('a' + index));
  }
  scenario.title = fmt::format("{} is right: {}", name(policy), scenario.title);
  scenario.why = why_right(one.oracle, policy);
}

/// Those that are wanted, where the right policy meets somebody least often first.
void choose(std::vector<ShowcaseScene>& found, PolicyId policy) {
  std::stable_sort(found.begin(), found.end(), [](const ShowcaseScene& a, const ShowcaseScene& b) {
    return a.contact_share() < b.contact_share();
  });
  found.resize(std::min(found.size(), static_cast<std::size_t>(wanted(policy))));
  for (std::size_t i = 0; i < found.size(); ++i) {
    give_name(found[i], policy, i);
  }
}

}  // namespace

int wanted(PolicyId policy) {
  return policy == PolicyId::no_intervention ? 3 : 1;
}

Result<std::optional<std::vector<ShowcaseScene>>> showcase_scenes(
    const ShowcaseSearch& search, std::span<const eval::Finding> findings, PolicyId policy) {
  constexpr double hardly_ever = 0.02;
  std::vector<ShowcaseScene> found;
  const auto all = eval::candidates(findings, policy);
  const auto count = std::min(all.size(), static_cast<std::size_t>(search.tries));
  SteadyClock clock;
  long_work::ProgressLine progress(fmt::format("{} under noise", name(policy)),
                                   std::max(1, static_cast<int>(count)), clock, search.display);
  int good = 0;
  for (std::size_t i = 0; i < count && good < wanted(policy); ++i) {
    if (long_work::interrupted()) {
      return std::optional<std::vector<ShowcaseScene>>();
    }
    const auto sample = search.source->sample(all[i].number);
    if (!sample.has_value()) {
      return sample.error();
    }
    const scenario::Scenario& scenario = sample.value().scenario;
    ShowcaseScene one{scenario, eval::oracle(scenario, *search.car, *search.harm,
                                             {.time = *all[i].time,
                                              .draws = search.rule.draws,
                                              .seed = search.seed,
                                              .threads = search.threads,
                                              .only_defaults = true})};
    if (convinces(one.oracle, policy, search.rule)) {
      good += one.contact_share() <= hardly_ever ? 1 : 0;
      found.push_back(std::move(one));
    }
    progress.show(static_cast<int>(i) + 1, 0,
                  fmt::format(" candidates, {} convince", found.size()));
  }
  choose(found, policy);
  return std::optional(std::move(found));
}

}  // namespace saca::family_samples
