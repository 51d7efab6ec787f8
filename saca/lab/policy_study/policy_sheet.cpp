#include "saca/lab/policy_study/policy_sheet.h"

#include <fmt/core.h>

#include "saca/thinking/rollout/describe.h"

namespace saca::policy_study {

report::SceneView view_of(const world::Scene& scene, const encounter::Hindsight& tried) {
  const preview::PolicyFacts& facts = tried.facts;
  report::SceneView view;
  view.policy = facts.plan.policy;
  view.title = name(facts.plan.policy);
  view.scene = scene;
  if (!facts.drivable()) {
    view.lines = {facts.refusal()};
    for (const world::Actor& actor : scene.actors) {
      view.others.push_back({.start = scene.time, .X_WA = {actor.X_WA}});
    }
    return view;
  }
  view.lines = {rollout::describe(facts.outcome(), scene)};
  view.ego = tried.sequence.ego.track;
  view.others = tried.sequence.others;
  if (facts.outcome().contact) {
    view.contacts.push_back(*facts.outcome().contact);
    view.contacts.insert(view.contacts.end(), facts.outcome().later.begin(),
                         facts.outcome().later.end());
  }
  return view;
}

report::ContactSheet sheet_of(const eval::Oracle& oracle, const scenario::Scenario& scenario) {
  report::ContactSheet sheet;
  sheet.heading = scenario.title;
  sheet.lines = {scenario.why, scenario.source};
  sheet.same_ground = true;
  const auto add = [&](const eval::Verdict& verdict, const std::string& badge) {
    sheet.scenes.push_back(view_of(oracle.scene, verdict.written));
    sheet.scenes.back().badge = badge;
    if (verdict.written.facts.drivable()) {
      sheet.scenes.back().lines.push_back(
          fmt::format("expected harm {:.4f} ({:.4f} to {:.4f})", verdict.expected.harm.value,
                      verdict.expected.harm.low, verdict.expected.harm.high));
    }
  };
  for (const manoeuvre::PolicyId policy : oracle.ranking) {
    add(oracle.of(policy), policy == oracle.best() ? "best" : "");
  }
  for (const eval::Verdict& verdict : oracle.verdicts) {
    if (!verdict.written.facts.drivable()) {
      add(verdict, "");
    }
  }
  return sheet;
}

}  // namespace saca::policy_study
