#include "saca/lab/vehicle_study/drive_study.h"

#include <fmt/core.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <utility>

#include "saca/lab/tune/draws.h"
#include "saca/onboard/manoeuvre/drive.h"

namespace saca::vehicle_study {
namespace {

using nlohmann::json;

/// How long it is watched when it does not end by itself [s].
double horizon_of(const DriveQuestion& question) {
  const bool ends = question.policy != manoeuvre::PolicyId::no_intervention;
  return question.seconds.value_or(ends ? 30.0 : 3.0);
}

/// A size with its side in words, e.g. "1.48 m to the right".
/// @param left  > 0 to the left
std::string sided(double left, int digits, const char* unit) {
  const std::string size = fmt::format("{:.{}f}", std::abs(left), digits);
  const bool is_none = size.find_first_not_of("0.") == std::string::npos;
  return size + " " + unit + (is_none ? "" : left > 0.0 ? " to the left" : " to the right");
}

std::string draws_text(const json& draws) {
  std::string text =
      fmt::format("  {} draws of what the controller does not know (left is positive):\n",
                  draws["count"].get<int>());
  if (const json& across = draws["within_10_deg"]; !across.is_null()) {
    text += fmt::format(
        "    within 10 deg of across the lane: {:.1f} % (95 % interval {:.1f} to {:.1f})\n",
        100.0 * across["share"].get<double>(), 100.0 * across["low"].get<double>(),
        100.0 * across["high"].get<double>());
  }
  for (const auto& [key, what] : {std::pair{"time_s", "time, s"},
                                  {"forward_m", "forward, m"},
                                  {"sideways_m", "aside, m"},
                                  {"heading_deg", "heading, deg"}}) {
    const json& spread = draws[key];
    text += fmt::format("    {:16} p05 {:8.2f}   p50 {:8.2f}   p95 {:8.2f}\n", what,
                        spread["p05"].get<double>(), spread["p50"].get<double>(),
                        spread["p95"].get<double>());
  }
  return text;
}

}  // namespace

std::string command_line(const DriveQuestion& question) {
  std::string line =
      fmt::format("saca drive --policy {} --speed {:g} --grip {:g} --car {}",
                  manoeuvre::index(question.policy), question.speed, question.grip, question.car);
  line += question.target_speed ? fmt::format(" --target-speed {:g}", *question.target_speed) : "";
  line += question.strength ? fmt::format(" --strength {:g}", *question.strength) : "";
  line += question.seconds ? fmt::format(" --seconds {:g}", *question.seconds) : "";
  line +=
      question.draws > 0 ? fmt::format(" --draws {} --seed {}", question.draws, question.seed) : "";
  return line;
}

report::DriveRecord record_of(const DriveQuestion& question, const std::string& program,
                              const std::string& car_name, const manoeuvre::Car& car) {
  report::DriveRecord record{.program = program,
                             .command = command_line(question),
                             .car_name = car_name,
                             .car = car,
                             .plan = manoeuvre::default_plan(question.policy, question.speed)};
  if (question.target_speed) {
    record.plan.target_speed = question.target_speed;
  }
  record.plan.strength = question.strength;
  record.scene.ego.v_B = {question.speed, 0.0};
  record.scene.grip = question.grip;
  return record;
}

std::optional<Error> drive_into(report::DriveRecord& record, const DriveQuestion& question) {
  if (const auto why = manoeuvre::refusal(record.car, record.plan, record.scene)) {
    return Error{Error::Code::out_of_range, *why};
  }
  report::ride_into(record, horizon_of(question));
  if (question.draws > 0) {
    constexpr int shown_paths = 50;
    record.draws = {.seed = question.seed,
                    .endings = tune::draw_endings(record.car, record.plan, record.scene,
                                                  {.grip = question.grip,
                                                   .horizon = horizon_of(question),
                                                   .count = question.draws,
                                                   .seed = question.seed,
                                                   .with_paths = shown_paths,
                                                   .threads = question.threads})};
  }
  return std::nullopt;
}

std::string text_of_drive(const json& record) {
  const json& end = record["end"];
  std::string text = fmt::format(
      "{} from {:g} m/s on grip {:g} with {}: {} after {:.2f} s\n",
      record["policy"]["name"].get<std::string>(), record["start"]["speed_mps"].get<double>(),
      record["road"]["grip"].get<double>(), record["car"]["name"].get<std::string>(),
      end["state"].get<std::string>(), end["time_s"].get<double>());
  text += fmt::format(
      "  centre of mass {:.2f} m forward, {}; heading {}, {:.1f} m/s\n",
      end["forward_m"].get<double>(), sided(end["sideways_m"].get<double>(), 2, "m"),
      sided(end["heading_deg"].get<double>(), 1, "deg"), end["speed_mps"].get<double>());
  const json& draws = record["draws"];
  return draws.is_null() ? text : text + draws_text(draws);
}

}  // namespace saca::vehicle_study
