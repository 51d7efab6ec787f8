// Longer than 400 lines: one writer for each structure of a record, in the order in which
// docs/formats.md has them.
#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "saca/base/core/units.h"
#include "saca/base/formats/short_numbers.h"
#include "saca/lab/encounter/encounter.h"
#include "saca/lab/encounter/outcome_json.h"
#include "saca/lab/encounter/provenance.h"
#include "saca/lab/encounter/state_json.h"
#include "saca/lab/encounter/verdict_json.h"
#include "saca/onboard/collision/loss.h"
#include "saca/onboard/manoeuvre/ego.h"
#include "saca/thinking/language_model/explanation_json.h"
#include "saca/thinking/language_model/reply.h"
#include "saca/thinking/language_model/truth_json.h"
#include "saca/thinking/memory/scene_json.h"
#include "saca/thinking/rollout/collision_sequence.h"
#include "saca/thinking/rollout/describe.h"

namespace saca::encounter {
namespace {

using nlohmann::json;

constexpr double path_step = 0.05;     // [s] between the points of a hindsight path
constexpr double longest_path = 10.0;  // [s]: whoever drives on longer has left the picture

json number_or_null(const std::optional<double>& number) {
  return number ? json(*number) : json(nullptr);
}

json actors_json(const world::Scene& scene) {
  json actors = json::array();
  for (const world::Actor& actor : scene.actors) {
    actors.push_back(actor_json(actor));
  }
  return actors;
}

json frame_json(const Frame& frame) {
  return {{"t_s", frame.scene.time},
          {"phase", name(frame.phase)},
          {"ego", ego_json(frame.scene.ego, frame.steering)},
          {"actors", actors_json(frame.scene)},
          {"conflict_s", number_or_null(frame.conflict)}};
}

/// Of each that this road user may have, in thousandths: one text, as a row of a danger map.
std::string thousandths(const intent::IntentPosterior& posterior, world::ActorKind kind) {
  constexpr double per_whole = 1'000.0;
  std::string text;
  for (const intent::Intention intention : intent::intentions_of(kind)) {
    text += text.empty() ? "" : " ";
    text += std::to_string(std::lround(per_whole * posterior[static_cast<std::size_t>(intention)]));
  }
  return text;
}

json intentions_json(const IntentionsSeen& seen) {
  json of = json::array();
  for (const intent::Intention intention : intent::intentions_of(seen.kind)) {
    of.push_back(name(intention));
  }
  json now = json::array();
  json soon = json::array();
  for (const intent::Belief& belief : seen.beliefs) {
    now.push_back(thousandths(belief.now(), seen.kind));
    soon.push_back(thousandths(belief.at.back(), seen.kind));
  }
  return {{"actor", actor_name(world::Actor{.id = seen.id, .kind = seen.kind})},
          {"of", of},
          {"times_s", seen.times},
          {"now_permille", now},
          {"soon_permille", soon}};
}

std::span<const world::Actor> actors_of(const world::Scene& scene) {
  return {scene.actors.begin(), scene.actors.size()};
}

/// What a policy is forecast, or known, to end in.
/// @param rolled_out  as all that can be driven beside it
json facts_json(const preview::PolicyFacts& facts, const world::Scene& scene, bool rolled_out) {
  const bool driven = facts.drivable();
  return {
      {"policy", manoeuvre::index(facts.plan.policy)},
      {"name", name(facts.plan.policy)},
      {"target_speed_mps", number_or_null(facts.plan.target_speed)},
      {"strength", number_or_null(facts.plan.strength)},
      {"refusal", driven ? json(nullptr) : json(facts.refusal())},
      {"text", driven ? rollout::describe(facts.outcome(), scene) : facts.refusal()},
      {"contact", driven ? first_contact_json(facts.outcome(), actors_of(scene)) : json(nullptr)},
      {"clearance_m", driven ? json(facts.outcome().clearance) : json(nullptr)},
      {"nearest", driven ? nearest_json(facts.outcome(), actors_of(scene)) : json(nullptr)},
      {"collision_loss", driven ? json(facts.outcome().collision_loss) : json(nullptr)},
      {"harm", driven ? json(facts.outcome().harm) : json(nullptr)},
      {"probability", driven ? json(facts.contact_probability()) : json(nullptr)},
      {"rolled_out", rolled_out}};
}

json answer_json(const language_model::Answer& answer) {
  return {{"t_s", to_seconds(answer.time)},
          {"kind", name(answer.kind)},
          {"probability", answer.probability}};
}

json memory_json(const arbitration::Preview& preview) {
  constexpr std::array<std::string_view, 3> gates{"cache", "check", "reason"};
  return {{"case", preview.nearest ? json(preview.nearest->found.id) : json(nullptr)},
          {"similarity", preview.nearest ? preview.nearest->similarity : 0.0},
          {"confidence", preview.nearest ? preview.nearest->confidence : 0.0},
          {"gate", gates[static_cast<std::size_t>(preview.gate)]}};
}

json preview_json(const arbitration::Preview& preview) {
  const preview::Situation& situation = preview.situation;
  const world::Scene& scene = situation.scene_at_trigger;
  json actors = json::array();
  for (std::size_t i = 0; i < scene.actors.size(); ++i) {
    json posterior;
    for (const intent::Intention intention : intent::intentions_of(scene.actors[i].kind)) {
      posterior[std::string(name(intention))] =
          situation.posteriors[i][static_cast<std::size_t>(intention)];
    }
    actors.push_back(
        {{"id", actor_name(scene.actors[i])},
         {"intention", name(situation.intentions[i])},
         {"posterior", posterior},
         {"risk", situation.risks[i].risk},
         {"value_m", situation.risks[i].judged ? json(situation.risks[i].value) : json()},
         {"value_exact", situation.risks[i].exact},
         {"risk_text", explanation(situation.risks[i])}});
  }
  json facts = json::array();
  for (std::size_t i = 0; i < situation.facts.size(); ++i) {
    facts.push_back(facts_json(situation.facts[i], scene, preview::rolled_out(situation.facts)));
    facts.back()["q_m"] = number_or_null(situation.dangers[i]);
  }
  json answers = json::array();
  std::transform(preview.reply.answers.begin(), preview.reply.answers.end(),
                 std::back_inserter(answers), answer_json);
  return {
      {"probability", situation.probability},
      {"ready_s", number_or_null(preview.ready)},
      {"scene",
       {{"t_s", scene.time}, {"ego", ego_json(scene.ego, 0.0)}, {"actors", actors_json(scene)}}},
      {"actors", actors},
      {"facts", facts},
      {"memory", memory_json(preview)},
      {"prompt", preview.prompt},
      {"reasoning", preview.reply.reasoning},
      {"explanation", language_model::explanation_json(arbitration::explanation(preview))},
      {"truth", preview.truth ? language_model::truth_json(*preview.truth) : json(nullptr)},
      {"answers", answers},
      {"check", preview.check
                    ? json{{"passed", preview.check->passed}, {"text", preview.check->text}}
                    : json(nullptr)},
      {"plan", preview.plan ? plan_json(*preview.plan) : json(nullptr)}};
}

json switches_json(const Record& record) {
  json all = json::array();
  for (const TimedSwitch& one : record.switches) {
    json entry = plan_json(one.change.plan);
    entry["t_s"] = one.time;
    entry["reason"] = name(one.change.reason);
    entry["harm"] = one.change.harm;
    entry["harm_before"] = one.change.harm_before;
    entry["text"] = arbitration::switch_text(one.change);
    all.push_back(entry);
  }
  return all;
}

json decision_json(const Record& record) {
  if (!record.decision) {
    return nullptr;
  }
  const reflex::Decision& decision = *record.decision;
  json out = plan_json(decision.plan);
  out["source"] = name(decision.source);
  out["threat"] = record.threat ? json(*record.threat) : json(nullptr);
  out["similarity"] = number_or_null(decision.similarity);
  out["preview"] = decision.preview ? json(*decision.preview) : json(nullptr);
  out["time_s"] = decision.time;
  out["not_admissible"] = decision.not_admissible;
  out["verdict"] = decision.verdict ? verdict_json(*decision.verdict, std::nullopt) : json(nullptr);
  out["by_atlas"] = decision.by_atlas;
  out["waiting_cost"] = number_or_null(decision.waiting_cost);
  out["text"] = arbitration::decision_text(decision);
  return out;
}

/// Where a body is every `path_step` from `start` on.
json path_json(const world::Track& track, double start, double end) {
  json path = json::array();
  const int count = static_cast<int>(std::floor((end - start) / path_step + 1e-6));
  for (int k = 0; k <= count; ++k) {
    const Pose X = world::pose_at(track, start + k * path_step);
    path.push_back({X.p.x, X.p.y, to_degrees(X.yaw)});
  }
  return path;
}

/// What was done and what came of it, until the ego rests or for `longest_path`.
void add_sequence(const rollout::CollisionSequence& sequence, const world::Scene& scene,
                  json& entry) {
  const double start = scene.time;
  const double end = std::min(world::end_time(sequence.ego.track), start + longest_path);
  entry["path"] = path_json(sequence.ego.track, start, end);
  for (std::size_t i = 0; i < scene.actors.size(); ++i) {
    entry["others"].push_back(
        {{"id", actor_name(scene.actors[i])}, {"path", path_json(sequence.others[i], start, end)}});
  }
  for (const collision::Contact& contact : sequence.outcome.later) {
    entry["later"].push_back(contact_json(contact, actors_of(scene)));
  }
}

json hindsight_json(const Record& record) {
  json all = json::array();
  if (!record.hindsight) {
    return all;
  }
  for (const Hindsight& one : *record.hindsight) {
    json entry = facts_json(one.facts, *record.at_trigger, true);
    entry["path"] = json::array();
    entry["others"] = json::array();
    entry["later"] = json::array();
    if (one.facts.drivable()) {
      add_sequence(one.sequence, *record.at_trigger, entry);
    }
    all.push_back(entry);
  }
  return all;
}

/// The paper's False-Trigger Loss: what was done where doing nothing would have met nobody.
double false_trigger_loss(const Record& record) {
  if (!record.decision) {
    return 0.0;
  }
  const Hindsight& nothing =
      (*record.hindsight)[manoeuvre::index(manoeuvre::PolicyId::no_intervention)];
  const bool no_risk = nothing.facts.drivable() && !nothing.facts.outcome().contact;
  return no_risk ? collision::false_trigger_loss(record.decision->plan.policy) : 0.0;
}

json result_json(const Record& record) {
  json out = outcome_json(record.result, record.met);
  out["false_trigger_loss"] = false_trigger_loss(record);
  return out;
}

/// A row in tenths of a metre, "." where nothing is known: a tenth of what numbers on lines of
/// their own would take.
std::string row_text(const DangerMap& map, int row) {
  constexpr double per_metre = 10.0;
  std::string text;
  for (int column = 0; column < map.columns; ++column) {
    const auto& value = map.values[map.index(column, row)];
    text += column > 0 ? " " : "";
    // Down, so that what is safe stays less than 0.
    text += value ? std::to_string(std::lround(std::floor(per_metre * *value))) : ".";
  }
  return text;
}

json danger_map_json(const DangerMap& map) {
  json rows = json::array();
  for (int row = 0; row < map.rows; ++row) {
    rows.push_back(row_text(map, row));
  }
  return {{"t_s", map.time},
          {"speed_mps", map.ego_speed},
          {"course_deg", to_degrees(map.ego_yaw)},
          {"x_m", map.X_AM.p.x},
          {"y_m", map.X_AM.p.y},
          {"heading_deg", to_degrees(map.X_AM.yaw)},
          {"first_x_m", map.first_M.x},
          {"first_y_m", map.first_M.y},
          {"step_m", map.step},
          {"rows", rows}};
}

json danger_maps_json(const std::optional<DangerMaps>& maps) {
  if (!maps) {
    return nullptr;
  }
  json all = json::array();
  std::transform(maps->maps.begin(), maps->maps.end(), std::back_inserter(all), danger_map_json);
  return {{"actor", maps->actor}, {"interval_s", maps->interval}, {"maps", all}};
}

/// When the first event of a kind came, after SACA took the wheel at T2 [s]; null when none did.
json after_t2(const Record& record, arbitration::EventKind kind) {
  const auto first = [&](arbitration::EventKind wanted) {
    return std::find_if(record.events.begin(), record.events.end(),
                        [&](const arbitration::Event& event) { return event.kind == wanted; });
  };
  const auto t2 = first(arbitration::EventKind::preview);
  const auto found = first(kind);
  if (t2 == record.events.end() || found == record.events.end()) {
    return nullptr;
  }
  return found->time - t2->time;
}

/// As a list.
template <class Things>
json list_json(const Things& things, json (*one_json)(const typename Things::value_type&)) {
  json list = json::array();
  std::transform(things.begin(), things.end(), std::back_inserter(list), one_json);
  return list;
}

json event_json(const arbitration::Event& event) {
  return {{"t_s", event.time},
          {"plane", name(event.plane)},
          {"kind", name(event.kind)},
          {"text", event.text}};
}

json scenario_json(const scenario::Scenario& scenario) {
  return {{"name", scenario.name},
          {"title", scenario.title},
          {"source", scenario.source},
          {"licence", scenario.licence},
          {"driver", scenario.driver.empty() ? json(nullptr) : json(scenario.driver)}};
}

json thresholds_json(const reflex::Thresholds& thresholds) {
  return {{"trigger_s", thresholds.trigger},
          {"preview_s", thresholds.preview},
          {"waiting_cost", number_or_null(thresholds.waiting_cost)},
          {"earliest_swerve_s", thresholds.earliest_swerve},
          {"material_harm", reflex::material_harm}};
}

json ego_body_json(const manoeuvre::Car& car) {
  const world::Footprint body = manoeuvre::footprint(car);
  return {{"length_m", body.length},
          {"width_m", body.width},
          {"centre_x_m", body.centre_x},
          {"front_axle_x_m", car.cg_to_front_axle},
          {"rear_axle_x_m", -car.cg_to_rear_axle},
          {"track_m", car.track_width}};
}

json review_json(const std::optional<language_model::Review>& review) {
  return review ? json{{"prompt", review->prompt},
                       {"text", review->text},
                       {"explanation", language_model::explanation_json(review->shown)},
                       {"truth", language_model::truth_json(review->truth)}}
                : json(nullptr);
}

json timing_json(const Record& record) {
  return {{"reflex_calls", record.timing.calls},
          {"reflex_us_p50", 1e6 * record.timing.p50},
          {"reflex_us_max", 1e6 * record.timing.max},
          {"reflex_us_sum", 1e6 * record.timing.sum},
          {"thinking_cpu_s", number_or_null(record.timing.thinking)},
          {"verdict_cpu_s", number_or_null(record.timing.forecasting)},
          {"preview_s", after_t2(record, arbitration::EventKind::forecast)},
          {"first_answer_s", after_t2(record, arbitration::EventKind::first_answer)},
          {"answer_s", after_t2(record, arbitration::EventKind::answer)},
          {"deadline_misses", record.deadline_misses}};
}

}  // namespace

std::string record_json(const Setup& setup, const Record& record, const Provenance* provenance) {
  const scenario::Scenario& scenario = *setup.scenario;
  json out{{"schema", "saca.record/1"},
           {"scenario", scenario_json(scenario)},
           {"pace", name(setup.pace)},
           {"model", setup.model == nullptr ? "off" : setup.model->description()},
           {"atlas", setup.atlas != nullptr},
           {"grip", record.grip},
           {"thresholds", thresholds_json(setup.thresholds)},
           {"road", road_json(scenario.road)},
           {"cues", memory::cues_json(scenario.cues)},
           {"ego", ego_body_json(*setup.car)},
           {"actors", actor_bodies_json(scenario)},
           {"frames", list_json(record.frames, frame_json)},
           {"intentions", list_json(record.intentions, intentions_json)},
           {"events", list_json(record.events, event_json)},
           {"previews", list_json(record.previews, preview_json)},
           {"decision", decision_json(record)},
           {"switches", switches_json(record)},
           {"verdicts", verdicts_json(record.verdicts)},
           {"hypotheses", hypotheses_json(record.verdicts)},
           {"result", result_json(record)},
           {"driver",
            record.driver ? outcome_json(*record.driver, record.met_by_driver) : json(nullptr)},
           {"hindsight", hindsight_json(record)},
           {"best", record.best ? json(manoeuvre::index(*record.best)) : json(nullptr)},
           {"danger_maps", danger_maps_json(record.danger_maps)},
           {"review", review_json(record.review)},
           {"case", record.stored ? json(*record.stored) : json(nullptr)},
           {"timing", timing_json(record)}};
  out = formats::with_short_numbers(std::move(out));
  if (provenance != nullptr) {
    out["made"] = made_json(setup, *provenance);
    out["made"]["content"] = content_digest(out);
  }
  return out.dump(1, ' ', false, json::error_handler_t::replace);
}

}  // namespace saca::encounter
