#include "saca/lab/family_samples/sample_sheet.h"

#include <fmt/core.h>

#include <utility>
#include <variant>

#include "saca/lab/eval/decision_point.h"
#include "saca/lab/policy_study/policy_sheet.h"

namespace saca::family_samples {
namespace {

/// A sample with what comes of doing nothing from the trigger on.
report::SceneView thumbnail(const scenario::Scenario& scenario,
                            const std::vector<families::DrawnCue>& cues, const manoeuvre::Car& car,
                            const collision::HarmModel& harm) {
  const auto trigger = eval::trigger_time(scenario, car);
  const eval::DecisionPoint point = eval::decision_point_at(scenario, car, trigger.value_or(0.0));
  const auto tried = encounter::hindsight(point, car, harm);
  report::SceneView view = policy_study::view_of(
      point.scene, tried[manoeuvre::index(manoeuvre::PolicyId::no_intervention)]);
  view.policy = std::nullopt;
  view.title = scenario.name;
  view.lines.insert(view.lines.begin(),
                    fmt::format("{:.1f} m/s, grip {:.2f}{}", norm(point.scene.ego.v_B),
                                scenario.grip, trigger ? "" : "; never triggers"));
  for (std::size_t k = 0; k < cues.size(); ++k) {
    const Vec2 p_W = scenario.cues[k].p_W;
    view.lines.insert(view.lines.begin() + 1,
                      fmt::format("{} at {:.0f}, {:.1f} m{}", name(cues[k].kind), p_W.x, p_W.y,
                                  cues[k].comes ? ", and it comes" : ""));
  }
  return view;
}

}  // namespace

report::ContactSheet empty_sheet(const families::Family& family) {
  report::ContactSheet sheet;
  sheet.heading = fmt::format("{}: {}", family.name, family.title);
  sheet.lines = {family.why, "Drawn: nobody intervenes."};
  return sheet;
}

const scenario::Scenario& chosen(const families::FamilySample& sample, SampleSide side) {
  return side == SampleSide::risk ? sample.scenario : sample.twin;
}

report::SceneView picture_of(const families::FamilySample& sample, SampleSide side,
                             const manoeuvre::Car& car, const collision::HarmModel& harm) {
  std::vector<families::DrawnCue> cues = sample.cues;
  for (families::DrawnCue& cue : cues) {
    cue.comes = cue.comes && side == SampleSide::risk;
  }
  return thumbnail(chosen(sample, side), cues, car, harm);
}

nlohmann::json json_of(const scenario::Scenario& scenario, const std::filesystem::path& file) {
  return {{"name", scenario.name},
          {"file", file.empty() ? nlohmann::json() : nlohmann::json(file.string())},
          {"grip", scenario.grip},
          {"ego_speed_mps", std::get<scenario::EgoStart>(scenario.ego).speed},
          {"actors", scenario.actors.size()}};
}

}  // namespace saca::family_samples
