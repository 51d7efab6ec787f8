#include "saca/lab/encounter/verdict_log.h"

#include <algorithm>

#include "saca/base/core/contract.h"

namespace saca::encounter {

void VerdictLog::note(const world::Scene& scene, const intent::Beliefs& beliefs,
                      const std::optional<reflex::Verdict>& got) {
  expects(beliefs.size() == scene.actors.size(), "one belief per actor");
  constexpr double rounding = 1e-9;  // [s]
  now_ = scene.time;
  recent_.push_back({scene, beliefs});
  while (recent_.front().scene.time < now_ - reflex::verdict_expiry - rounding) {
    recent_.pop_front();
  }
  if (got) {
    add(*got, false);
  }
}

void VerdictLog::note(const reflex::Decision& decision) {
  if (decision.verdict) {
    if (decision.by_atlas) {
      add(*decision.verdict, true);
    }
    keep_judged(decision.verdict->time, decision.by_atlas);
  }
  begun_.push_back({now_, decision.plan});
}

void VerdictLog::note(const reflex::Switch& change) {
  const auto newest = std::find_if(verdicts_.rbegin(), verdicts_.rend(),
                                   [](const NotedVerdict& one) { return !one.by_atlas; });
  if (newest != verdicts_.rend()) {
    keep_judged(newest->verdict.time, false);
  }
  begun_.push_back({now_, change.plan});
}

void VerdictLog::add(const reflex::Verdict& verdict, bool by_atlas) {
  NotedVerdict noted{
      .received = now_, .verdict = verdict, .by_atlas = by_atlas, .under_way = std::nullopt};
  for (const Begun& one : begun_) {
    if (one.time < verdict.time) {
      noted.under_way = one.plan;
    }
  }
  verdicts_.push_back(noted);
}

void VerdictLog::keep_judged(double verdict_time, bool by_atlas) {
  const auto found = std::find_if(recent_.begin(), recent_.end(), [&](const Look& look) {
    return look.scene.time == verdict_time;
  });
  if (found != recent_.end() && judged_.size() < most_judged) {
    judged_.push_back({now_, found->scene, found->beliefs, by_atlas});
  }
}

}  // namespace saca::encounter
