#include "saca/lab/importers/import_json.h"

#include <algorithm>
#include <cstddef>
#include <iterator>

#include "saca/base/core/units.h"

namespace saca::importers {
namespace {

using nlohmann::json;

json outcome_json(const HundredCarOutcome& outcome) {
  json told{{"event", outcome.event}, {"severity", outcome.severity}};
  if (const HundredCarRefusal* refusal = outcome.refusal()) {
    told["refused"] = name(refusal->reason);
    told["message"] = refusal->message;
    return told;
  }
  const HundredCarReport& report = outcome.rebuilt()->report;
  told["scenario"] = outcome.rebuilt()->scenario.name;
  told["first_row"] = report.first_row;
  told["last_row"] = report.last_row;
  told["gyro_bias_degps"] = to_degrees(report.gyro_bias);
  told["curvature_1pm"] = report.curvature;
  told["lane_kept_s"] = report.kept_for;
  told["lane_rms_m"] = report.keeping_rms;
  return told;
}

}  // namespace

json import_json(const std::vector<HundredCarOutcome>& outcomes) {
  json reasons = json::object();
  for (const auto& [reason, count] : refusals(outcomes)) {
    reasons[std::string(name(reason))] = count;
  }
  json list = json::array();
  std::transform(outcomes.begin(), outcomes.end(), std::back_inserter(list), outcome_json);
  return {{"schema", "saca.hundred_car_import/1"},
          {"events", outcomes.size()},
          {"rebuilt", num_rebuilt(outcomes)},
          {"refused", reasons},
          {"list", list}};
}

json import_json(const TrafficImport& made, const TrafficRequest& request,
                 const std::string& output) {
  const TrafficReport& report = made.report;
  const recordings::LaneFit& lane = report.lane;
  json actors = nlohmann::json::array();
  for (const TrafficActor& actor : report.actors) {
    actors.push_back({{"name", actor.name}, {"obstacle", actor.obstacle}});
  }
  return {{"schema", "saca.traffic_import/1"},
          {"name", made.scenario.name},
          {"output", output},
          {"ego", request.ego ? json(*request.ego) : json()},
          {"from_s", report.from},
          {"duration_s", made.scenario.duration},
          {"origin_x_m", report.origin_W.x},
          {"origin_y_m", report.origin_W.y},
          {"lane",
           {{"lanelets", lane.lanelets},
            {"behind_m", lane.behind},
            {"ahead_m", lane.ahead},
            {"rms_m", lane.rms},
            {"largest_m", lane.largest},
            {"widened_left_m", report.widened_left},
            {"widened_right_m", report.widened_right}}},
          {"smoothing",
           {{"outliers", report.num_outliers},
            {"filled", report.num_filled},
            {"rms_shift_m", report.rms_shift},
            {"largest_shift_m", report.largest_shift},
            {"hardest_mps2", report.hardest}}},
          {"actors", actors},
          {"left_out", report.left_out},
          {"ignored", report.ignored}};
}

}  // namespace saca::importers
