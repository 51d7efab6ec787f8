#include "saca/runtime/tape_json.h"

#include <algorithm>
#include <iterator>

#include "saca/thinking/memory/scene_json.h"

namespace saca::runtime {
namespace {

using nlohmann::json;

template <class T, class Json>
json or_null(const std::optional<T>& value, Json&& json_of) {
  return value ? json(json_of(*value)) : json(nullptr);
}

json itself(double number) {
  return number;
}

template <class List, class Json>
json list_json(const List& list, Json&& json_of) {
  json all = json::array();
  std::transform(list.begin(), list.end(), std::back_inserter(all), json_of);
  return all;
}

json plan_json(const manoeuvre::Plan& plan) {
  return {{"policy", manoeuvre::index(plan.policy)},
          {"target_speed_mps", or_null(plan.target_speed, itself)},
          {"strength", or_null(plan.strength, itself)}};
}

json judged_json(const reflex::JudgedPlan& one) {
  return {{"plan", plan_json(one.plan)},
          {"drivable", one.drivable},
          {"harm", one.harm},
          {"contact", one.contact},
          {"harm_as_seen", or_null(one.as_seen, itself)}};
}

json ego_features_json(const match::EgoFeatures& ego) {
  return {{"usable", ego.usable},
          {"along_mps", ego.v_L.x},
          {"across_mps", ego.v_L.y},
          {"offset_m", ego.offset},
          {"heading_rad", ego.heading},
          {"yaw_rate_radps", ego.yaw_rate},
          {"length_m", ego.length},
          {"width_m", ego.width},
          {"log_grip", ego.log_grip},
          {"lane_width_m", ego.lane_width},
          {"curve_mps2", ego.curve},
          {"room_left_m", ego.to_left_edge},
          {"room_right_m", ego.to_right_edge},
          {"topology", world::name(ego.topology)},
          {"left_beyond", world::name(ego.left_beyond)},
          {"right_beyond", world::name(ego.right_beyond)},
          {"oncoming_left", ego.oncoming_left},
          {"oncoming_right", ego.oncoming_right}};
}

json actor_features_json(const match::ActorFeatures& actor) {
  return {{"ahead_m", actor.p_rel_L.x},      {"left_m", actor.p_rel_L.y},
          {"along_mps", actor.v_rel_L.x},    {"across_mps", actor.v_rel_L.y},
          {"sideways_mps2", actor.sideways}, {"forward_s", actor.forward_L.x},
          {"forward_d", actor.forward_L.y},  {"length_m", actor.length},
          {"width_m", actor.width},          {"threat", actor.threat},
          {"kind", world::name(actor.kind)}};
}

json cached_json(const reflex::CachedPlan& cached) {
  return {{"ego", ego_features_json(cached.at_trigger.ego)},
          {"actors", list_json(cached.at_trigger.actors, actor_features_json)},
          {"trigger_s", cached.trigger},
          {"plan", plan_json(cached.plan)},
          {"source", name(cached.source)},
          {"worse_than_aeb", cached.worse_than_aeb},
          {"preview", cached.preview}};
}

json plans_json(const reflex::PlanCache& plans) {
  return list_json(plans, cached_json);
}

json threat_json(const reflex::Threat& threat) {
  return {{"actor", threat.actor}, {"time_s", threat.time}};
}

json numbered_json(const NumberedVerdict& numbered) {
  json out = verdict_json(numbered.verdict);
  out["scene"] = numbered.scene;
  return out;
}

json step_json(const TapeStep& step) {
  const bool usable = !world::broken_rule(step.scene);
  return {{"type", "step"},
          {"number", step.number},
          {"forgotten", name(step.forgotten)},
          {"scene", usable ? memory::to_json(step.scene) : json(nullptr)},
          {"beliefs", usable ? beliefs_json(step.beliefs) : json::array()},
          {"finished", step.finished},
          {"plans", or_null(step.plans, plans_json)},
          {"verdict", or_null(step.verdict, numbered_json)},
          {"reflex", reflex_json(step.reflex)},
          {"decision", or_null(step.decision, decision_json)}};
}

json before_json(const TapeContent& content) {
  return {{"type", "before"},
          {"dropped", content.dropped},
          {"lost", content.lost},
          {"plans", plans_json(content.plans)},
          {"verdict", or_null(content.verdict, verdict_json)}};
}

json header_json(const TapeHeader& header) {
  return {{"type", "header"},
          {"schema", tape_schema},
          {"program", header.program},
          {"level", header.level},
          {"car", header.car},
          {"car_digest", header.car_digest},
          {"intent_digest", header.intent_digest},
          {"harm_digest", header.harm_digest},
          {"atlas_digest", header.atlas ? json(*header.atlas) : json(nullptr)},
          {"cues_digest", header.cues ? json(*header.cues) : json(nullptr)},
          {"danger", header.danger},
          {"model", header.model},
          {"memory", header.memory},
          {"num_draws", header.num_draws},
          {"guarded", header.guarded},
          {"forced", or_null(header.forced, plan_json)},
          {"thresholds",
           {{"trigger_s", header.thresholds.trigger},
            {"preview_s", header.thresholds.preview},
            {"trigger_tolerance_s", header.thresholds.trigger_tolerance},
            {"preview_tolerance_s", header.thresholds.preview_tolerance},
            {"least_posterior", header.thresholds.least_posterior},
            {"waiting_cost", or_null(header.thresholds.waiting_cost, itself)},
            {"earliest_swerve_s", header.thresholds.earliest_swerve}}},
          {"pace", name(header.pace)},
          {"costs",
           {{"preview_s", header.costs.preview},
            {"verdict_s", header.costs.verdict},
            {"prompt_token_s", header.costs.prompt_token},
            {"reply_token_s", header.costs.reply_token}}},
          {"scenario", header.scenario},
          {"seed", header.seed ? json(*header.seed) : json(nullptr)}};
}

std::string line_of(const json& object) {
  return object.dump(-1, ' ', false, json::error_handler_t::replace) + '\n';
}

}  // namespace

json verdict_json(const reflex::Verdict& verdict) {
  return {{"t_s", verdict.time},
          {"plans", list_json(verdict.plans, judged_json)},
          {"later", or_null(verdict.later, itself)},
          {"under_way", or_null(verdict.under_way, judged_json)}};
}

json switch_json(const reflex::Switch& change) {
  return {{"plan", plan_json(change.plan)},
          {"reason", name(change.reason)},
          {"harm", change.harm},
          {"harm_before", change.harm_before}};
}

json reflex_json(const reflex::Reflex& reflex) {
  return {{"plan", plan_json(reflex.plan)},
          {"threat", or_null(reflex.threat, threat_json)},
          {"triggered", reflex.triggered},
          {"switched", or_null(reflex.switched, switch_json)},
          {"refused_scene", reflex.refused_scene}};
}

json refused_json(const reflex::RefusedPlan& refused) {
  return {{"plan", plan_json(refused.plan)}, {"why", static_cast<int>(refused.why)}};
}

json decision_json(const reflex::Decision& decision) {
  return {{"plan", plan_json(decision.plan)},
          {"source", name(decision.source)},
          {"similarity", or_null(decision.similarity, itself)},
          {"preview", decision.preview ? json(*decision.preview) : json(nullptr)},
          {"not_admissible", decision.not_admissible},
          {"verdict", or_null(decision.verdict, verdict_json)},
          {"by_atlas", decision.by_atlas},
          {"refused", or_null(decision.refused, refused_json)},
          {"t_s", decision.time},
          {"waiting_cost", or_null(decision.waiting_cost, itself)}};
}

json beliefs_json(const intent::Beliefs& beliefs) {
  return list_json(beliefs, [](const intent::Belief& belief) {
    json numbers = json::array();
    for (const intent::IntentPosterior& posterior : belief.at) {
      for (const double number : posterior) {
        numbers.push_back(number);
      }
    }
    return numbers;
  });
}

std::string tape_text(const TapeFile& tape) {
  std::string text = line_of(header_json(tape.header)) + line_of(before_json(tape.content));
  for (const TapeStep& step : tape.content.steps) {
    text += line_of(step_json(step));
  }
  Fnv hash;
  hash.add(text);
  return text + line_of({{"type", "end"},
                         {"steps", tape.content.steps.size()},
                         {"digest", digest_text(hash)}});
}

}  // namespace saca::runtime
