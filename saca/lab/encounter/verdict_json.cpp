#include "saca/lab/encounter/verdict_json.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "saca/base/core/contract.h"
#include "saca/base/core/units.h"
#include "saca/lab/encounter/hypotheses.h"
#include "saca/onboard/reflex/supervisor.h"

namespace saca::encounter {
namespace {

using nlohmann::json;

json judged_json(const reflex::JudgedPlan& judged) {
  json entry = plan_json(judged.plan);
  entry["harm"] = judged.drivable ? json(judged.harm) : json(nullptr);
  entry["contact"] = judged.drivable ? json(judged.contact) : json(nullptr);
  if (judged.as_seen) {
    entry["harm_as_seen"] = *judged.as_seen;
  }
  return entry;
}

/// Was a plan begun by this verdict? By its scene and by whose it is, it is known.
bool is_decisive(const NotedVerdict& noted, const std::vector<JudgedScene>& judged) {
  return std::any_of(judged.begin(), judged.end(), [&](const JudgedScene& one) {
    return one.scene.time == noted.verdict.time && one.by_atlas == noted.by_atlas;
  });
}

/// Which verdicts are told.
std::vector<bool> kept(const VerdictLog& log, std::size_t most) {
  expects(most > VerdictLog::most_judged, "room for every verdict whose scene is kept");
  const std::vector<NotedVerdict>& all = log.verdicts();
  std::vector<bool> is_kept(all.size(), true);
  if (all.size() <= most) {
    return is_kept;
  }
  std::transform(all.begin(), all.end(), is_kept.begin(),
                 [&](const NotedVerdict& one) { return is_decisive(one, log.judged()); });
  const auto decisive = static_cast<std::size_t>(std::count(is_kept.begin(), is_kept.end(), true));
  const std::size_t others = all.size() - decisive;
  const std::size_t room = most - decisive;
  std::size_t before = 0;  // of the others
  for (std::size_t k = 0; k < all.size(); ++k) {
    if (!is_kept[k]) {
      is_kept[k] = (before + 1) * room / others > before * room / others;
      ++before;
    }
  }
  return is_kept;
}

/// Whole numbers in one text: a tenth of what they would take on lines of their own.
template <class Number>
std::string row(const std::vector<Pose>& path, Number number) {
  std::string text;
  for (const Pose& X : path) {
    text += text.empty() ? "" : " ";
    text += std::to_string(std::lround(number(X)));
  }
  return text;
}

json hypothetical_path_json(const HypotheticalPath& path) {
  constexpr double per_metre = 100.0;
  return {{"id", path.actor},
          {"x_cm", row(path.X_WA, [](const Pose& X) { return per_metre * X.p.x; })},
          {"y_cm", row(path.X_WA, [](const Pose& X) { return per_metre * X.p.y; })},
          {"heading_deg", row(path.X_WA, [](const Pose& X) { return to_degrees(X.yaw); })}};
}

json hypothetical_motion_json(const HypotheticalMotion& motion) {
  json paths = json::array();
  std::transform(motion.paths.begin(), motion.paths.end(), std::back_inserter(paths),
                 hypothetical_path_json);
  return {{"probability", motion.probability}, {"paths", paths}};
}

}  // namespace

json plan_json(const manoeuvre::Plan& plan) {
  return {{"policy", manoeuvre::index(plan.policy)},
          {"name", name(plan.policy)},
          {"target_speed_mps", plan.target_speed ? json(*plan.target_speed) : json(nullptr)},
          {"strength", plan.strength ? json(*plan.strength) : json(nullptr)}};
}

json verdict_json(const reflex::Verdict& verdict, const std::optional<manoeuvre::Plan>& under_way) {
  json plans = json::array();
  for (const reflex::JudgedPlan& one : verdict.plans) {
    plans.push_back(judged_json(one));
  }
  const reflex::JudgedPlan* const rest =
      under_way ? reflex::going_on(verdict, *under_way) : nullptr;
  const auto admissible = reflex::admissible_harm(verdict);
  const auto waiting = reflex::cost_of_waiting(verdict);
  return {{"t_s", verdict.time},
          {"plans", plans},
          {"speaks_for", plan_json(reflex::plan_of(verdict))},
          {"under_way", rest == nullptr ? json(nullptr) : judged_json(*rest)},
          {"admissible_harm", admissible ? json(*admissible) : json(nullptr)},
          {"waiting_cost", waiting ? json(*waiting) : json(nullptr)}};
}

json verdicts_json(const VerdictLog& log, std::size_t most) {
  const std::vector<bool> is_kept = kept(log, most);
  json in_hand = json::array();
  for (std::size_t k = 0; k < is_kept.size(); ++k) {
    if (is_kept[k]) {
      const NotedVerdict& noted = log.verdicts()[k];
      json entry = verdict_json(noted.verdict, noted.under_way);
      entry["received_s"] = noted.received;
      entry["by_atlas"] = noted.by_atlas;
      in_hand.push_back(entry);
    }
  }
  return {{"left_out", is_kept.size() - in_hand.size()}, {"in_hand", in_hand}};
}

json hypotheses_json(const VerdictLog& log) {
  json all = json::array();
  for (const JudgedScene& judged : log.judged()) {
    const Hypotheses hypotheses = hypotheses_of(judged);
    json motions = json::array();
    std::transform(hypotheses.motions.begin(), hypotheses.motions.end(),
                   std::back_inserter(motions), hypothetical_motion_json);
    all.push_back({{"t_s", hypotheses.begun},
                   {"scene_s", hypotheses.time},
                   {"step_s", Hypotheses::step},
                   {"horizon_s", Hypotheses::horizon},
                   {"reacting", hypotheses.reacting},
                   {"motions", motions}});
  }
  return all;
}

}  // namespace saca::encounter
