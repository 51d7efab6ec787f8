#include "saca/lab/intention_study/evaluation_json.h"

#include <array>
#include <optional>
#include <string>
#include <utility>

#include "saca/lab/intention_study/foresight_names.h"
#include "saca/thinking/intent/intention.h"

namespace saca::intention_study {
namespace {

using intention_scoring::Interval;
using nlohmann::json;

json number(const std::optional<double>& value) {
  return value ? json(*value) : json();
}

json interval_json(const std::optional<Interval>& interval) {
  return interval
             ? json{{"value", interval->value}, {"low", interval->low}, {"high", interval->high}}
             : json();
}

json lead_times_json(const intention_scoring::LeadTimes& lead_times) {
  return {{"events", lead_times.events()},
          {"share_warned", number(lead_times.share_predicted())},
          {"lower_quartile_s", number(lead_times.quantile(0.25))},
          {"median_s", number(lead_times.quantile(0.5))},
          {"upper_quartile_s", number(lead_times.quantile(0.75))}};
}

json events_json(const intention_scoring::ManoeuvreEventsFound& found) {
  json all = json::object();
  for (std::size_t k = 1; k < intention_scoring::num_vehicle_classes; ++k) {
    json recalls = json::array();
    for (std::size_t a = 0; a < intention_scoring::ManoeuvreEventsFound::ages.size(); ++a) {
      const intention_scoring::ManoeuvreEventsFound::Share& frames = found.of[k].frames[a];
      recalls.push_back({{"from_s", intention_scoring::ManoeuvreEventsFound::ages[a]},
                         {"frames", frames.num},
                         {"recall", number(frames.share())}});
    }
    all[std::string(name(static_cast<intent::Intention>(k)))] = {
        {"acts", found.of[k].events.num},
        {"found", found.of[k].events.found},
        {"recall_by_age", recalls}};
  }
  return all;
}

json displacements_json(const intention_scoring::Displacements& found) {
  json all = json::array();
  for (const auto& [which, table] :
       {std::pair("all", &found.all), std::pair("acting", &found.acting)}) {
    for (std::size_t f = 0; f < intention_scoring::num_foresights; ++f) {
      for (std::size_t k = 0; k < intention_scoring::seconds_ahead.size(); ++k) {
        const intention_scoring::Displacement& one = (*table)[f][k];
        all.push_back({{"vehicles", which},
                       {"foresight", foresight_names[f]},
                       {"ahead_s", intention_scoring::seconds_ahead[k]},
                       {"frames", one.num},
                       {"mean_m", one.mean()},
                       {"rms_m", one.rms()}});
      }
    }
  }
  return all;
}

}  // namespace

json method_json(const MethodFigures& method) {
  json heads = json::array();
  for (std::size_t head = 0; head < intention_scoring::num_heads; ++head) {
    const intention_scoring::Tally& tally = method.figures.tallies[head];
    json classes = json::object();
    for (std::size_t k = 0; k < intention_scoring::num_vehicle_classes; ++k) {
      classes[std::string(name(static_cast<intent::Intention>(k)))] = {
          {"frames", tally.confusion.truly(k)},
          {"recall", number(tally.confusion.recall(k))},
          {"precision", number(tally.confusion.precision(k))},
          {"f1", number(tally.confusion.f1(k))}};
    }
    heads.push_back({{"ahead_s", intent::horizons[head]},
                     {"macro_f1", interval_json(method.figures.macro_f1[head])},
                     {"calibration_error", number(tally.top_calibration_error())},
                     {"classwise_calibration_error", number(tally.classwise_calibration_error())},
                     {"log_loss", number(tally.mean_log_loss())},
                     {"brier", number(tally.mean_brier())},
                     {"macro_f1_ours_less_this", interval_json(method.macro_f1_difference[head])},
                     {"log_loss_ours_less_this", interval_json(method.log_loss_difference[head])},
                     {"classes", classes},
                     {"confusion", tally.confusion.counts}});
  }
  return {{"method", method.method},
          {"heads", heads},
          {"warning_before_line", lead_times_json(method.figures.lane_changes)},
          {"warning_before_braking", lead_times_json(method.figures.brakings)},
          {"false_alarms_per_hour", number(method.figures.alarms.per_hour())},
          {"hours", method.figures.alarms.hours},
          {"acts", events_json(method.figures.events)},
          {"illegal_steps", method.figures.illegal_steps},
          {"ours_less_this", interval_json(method.macro_f1_difference[0])}};
}

json evaluation_json(const Evaluation& evaluation) {
  json comparisons = json::array();
  for (const Comparison& each : evaluation.comparisons) {
    json methods = json::array();
    for (const MethodFigures& method : each.methods) {
      methods.push_back(method_json(method));
    }
    comparisons.push_back({{"title", each.title}, {"methods", methods}});
  }
  return {{"schema", "saca.intent_eval/1"},
          {"comparisons", comparisons},
          {"displacements", displacements_json(evaluation.displacements)}};
}

}  // namespace saca::intention_study
