#include "saca/lab/report/drive_json.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>

#include "saca/base/core/percentile.h"
#include "saca/base/core/proportion.h"
#include "saca/base/core/units.h"
#include "saca/base/formats/short_numbers.h"

namespace saca::report {
namespace {

using nlohmann::json;
using vehicle::Vehicle;

constexpr int steps_per_sample = 10;

/// A list with one value of each element.
template <class Element, class Value>
json column(const std::vector<Element>& elements, const Value& value) {
  json list = json::array();
  for (const Element& element : elements) {
    list.push_back(value(element));
  }
  return list;
}

json car_json(const DriveRecord& record) {
  const Vehicle& car = record.car;
  return {{"name", record.car_name},
          {"mass_kg", car.mass},
          {"front_arm_m", car.cg_to_front_axle},
          {"rear_arm_m", car.cg_to_rear_axle},
          {"track_width_m", car.track_width},
          {"wheel_radius_m", car.wheel_radius},
          {"length_m", car.body_length},
          {"width_m", car.body_width},
          {"front_end_m", car.front_end},
          {"steering_limit_deg", to_degrees(car.steering_limit)},
          {"motor_limit_Nm", car.motor_limit},
          {"brake_limit_Nm", car.brake_limit}};
}

json wheel_json(const DriveRecord& record, std::size_t i) {
  constexpr std::array names{"front left", "front right", "rear left", "rear right"};
  const Vec2 p_B = vehicle::wheel_position(record.car, i);
  const auto of = [&](const auto& value) { return column(record.samples, value); };
  using Sample = const DriveSample&;
  return {
      {"name", names[i]},
      {"x_m", p_B.x},
      {"y_m", p_B.y},
      {"angle_deg", of([&](Sample s) { return to_degrees(s.contacts[i].angle); })},
      {"load_N", of([&](Sample s) { return s.contacts[i].load; })},
      {"F_x_N", of([&](Sample s) { return s.contacts[i].F_T.x; })},
      {"F_y_N", of([&](Sample s) { return s.contacts[i].F_T.y; })},
      {"peak_N", of([&](Sample s) { return s.contacts[i].peak_force; })},
      {"slip", of([&](Sample s) { return s.contacts[i].slip; })},
      {"speed_mps", of([&](Sample s) { return s.state.wheel_speed[i] * record.car.wheel_radius; })},
      {"brake_Nm", of([&](Sample s) { return s.state.brake_torque[i]; })},
      {"brake_command_Nm",
       of([&](Sample s) { return std::min(s.command.brake_torque[i], record.car.brake_limit); })}};
}

json end_json(const DriveRecord& record) {
  const DriveSample& last = record.samples.back();
  const Pose end_L = inverse(record.scene.road.X_WL) * last.state.X_WB;
  const char* state = "still moving";
  if (record.ended) {
    state = vehicle::at_rest(last.state) ? "at rest" : "lane recovered";
  }
  return {{"state", state},
          {"time_s", last.time},
          {"forward_m", end_L.p.x},
          {"sideways_m", end_L.p.y},
          {"heading_deg", to_degrees(end_L.yaw)},
          {"speed_mps", norm(last.state.v_B)}};
}

json spread_json(const std::vector<tune::Ending>& endings, double (*value)(const tune::Ending&)) {
  std::vector<double> values;
  values.reserve(endings.size());
  for (const tune::Ending& ending : endings) {
    values.push_back(value(ending));
  }
  return {{"p05", percentile(values, 0.05)},
          {"p50", percentile(values, 0.5)},
          {"p95", percentile(values, 0.95)}};
}

json draws_json(const DriveRecord& record, const DriveDraws& draws) {
  using manoeuvre::perturbation_sd;
  using tune::Ending;
  const auto& endings = draws.endings;
  json across;
  if (manoeuvre::drifts(record.plan.policy)) {
    const Proportion share = proportion(tune::num_across(endings, record.plan, record.scene.road),
                                        static_cast<int>(endings.size()));
    across = {{"share", share.share}, {"low", share.low}, {"high", share.high}};
  }
  json paths = json::array();
  for (const Ending& ending : endings) {
    if (!ending.path.empty()) {
      paths.push_back(
          {{"x_m", column(ending.path, [](const Pose& X) { return X.p.x; })},
           {"y_m", column(ending.path, [](const Pose& X) { return X.p.y; })},
           {"heading_deg", column(ending.path, [](const Pose& X) { return to_degrees(X.yaw); })}});
    }
  }
  return {
      {"seed", draws.seed},
      {"count", endings.size()},
      {"unknown",
       {{"grip_sd", perturbation_sd.grip},
        {"mass_sd", perturbation_sd.mass},
        {"yaw_inertia_sd", perturbation_sd.yaw_inertia},
        {"stiffness_sd", perturbation_sd.stiffness},
        {"lag_sd_s", perturbation_sd.lag},
        {"speed_sd_mps", perturbation_sd.speed}}},
      {"within_10_deg", across},
      {"time_s", spread_json(endings, [](const Ending& e) { return e.time; })},
      {"forward_m", spread_json(endings, [](const Ending& e) { return e.X_WB.p.x; })},
      {"sideways_m", spread_json(endings, [](const Ending& e) { return e.X_WB.p.y; })},
      {"heading_deg", spread_json(endings, [](const Ending& e) { return to_degrees(e.X_WB.yaw); })},
      {"paths", paths},
      {"ends", column(endings, [](const Ending& e) {
         return json{
             {"x_m", e.X_WB.p.x}, {"y_m", e.X_WB.p.y}, {"heading_deg", to_degrees(e.X_WB.yaw)}};
       })}};
}

}  // namespace

void ride_into(DriveRecord& record, double horizon) {
  manoeuvre::Ride ride(record.car, record.plan, record.scene, record.scene.grip);
  record.samples = {{0.0, ride.state(), ride.command(), ride.contacts()}};
  const auto samples = std::lround(horizon / (steps_per_sample * vehicle::usual_step));
  for (long sample = 1; sample <= samples && !ride.ended(); ++sample) {
    for (int i = 0; i < steps_per_sample; ++i) {
      ride.step();
    }
    record.samples.push_back({static_cast<double>(sample) * steps_per_sample * vehicle::usual_step,
                              ride.state(), ride.command(), ride.contacts()});
  }
  record.ended = ride.ended();
}

std::string drive_json(const DriveRecord& record) {
  const auto of = [&](const auto& value) { return column(record.samples, value); };
  using Sample = const DriveSample&;
  json wheels = json::array();
  for (std::size_t i = 0; i < vehicle::num_wheels; ++i) {
    wheels.push_back(wheel_json(record, i));
  }
  const json document{
      {"schema", "saca.drive/1"},
      {"program", record.program},
      {"command", record.command},
      {"car", car_json(record)},
      {"policy",
       {{"id", manoeuvre::index(record.plan.policy)},
        {"name", manoeuvre::name(record.plan.policy)},
        {"target_speed_mps", record.plan.target_speed ? json(*record.plan.target_speed) : json()},
        {"strength", record.plan.strength ? json(*record.plan.strength) : json()}}},
      {"road",
       {{"lane_width_m", record.scene.road.lane_width},
        {"curvature_1pm", record.scene.road.curvature},
        {"grip", record.scene.grip}}},
      {"start", {{"speed_mps", norm(record.scene.ego.v_B)}}},
      {"end", end_json(record)},
      {"time_s", of([](Sample s) { return s.time; })},
      {"x_m", of([](Sample s) { return s.state.X_WB.p.x; })},
      {"y_m", of([](Sample s) { return s.state.X_WB.p.y; })},
      {"heading_deg", of([](Sample s) { return to_degrees(s.state.X_WB.yaw); })},
      {"v_x_mps", of([](Sample s) { return s.state.v_B.x; })},
      {"v_y_mps", of([](Sample s) { return s.state.v_B.y; })},
      {"yaw_rate_degps", of([](Sample s) { return to_degrees(s.state.yaw_rate); })},
      {"a_x_mps2", of([](Sample s) { return s.state.a_B.x; })},
      {"a_y_mps2", of([](Sample s) { return s.state.a_B.y; })},
      {"steering_deg", of([](Sample s) { return to_degrees(s.state.steering); })},
      {"steering_command_deg", of([&](Sample s) {
         return to_degrees(
             std::clamp(s.command.steering, -record.car.steering_limit, record.car.steering_limit));
       })},
      {"motor_Nm", of([](Sample s) { return s.state.motor_torque; })},
      {"motor_command_Nm", of([&](Sample s) {
         return std::clamp(s.command.motor_torque, -record.car.motor_limit, record.car.motor_limit);
       })},
      {"wheels", wheels},
      {"draws", record.draws ? draws_json(record, *record.draws) : json()}};
  return formats::with_short_numbers(json(document))
      .dump(-1, ' ', false, json::error_handler_t::replace);
}

}  // namespace saca::report
