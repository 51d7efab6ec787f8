#include "saca/lab/importers/hundred_car_words.h"

#include <algorithm>
#include <array>
#include <charconv>

#include "saca/base/core/units.h"

namespace saca::importers {
namespace {

namespace fs = std::filesystem;

bool contains(std::string_view text, std::string_view part) {
  return text.find(part) != std::string_view::npos;
}

/// 0 when the words are no number.
int leading_number(std::string_view text) {
  int number = 0;
  std::from_chars(text.data(), text.data() + text.size(), number);
  return number;
}

std::string shown_ids(const std::vector<std::int64_t>& ids) {
  std::string text;
  for (const std::int64_t id : ids) {
    text += (text.empty() ? "" : ", ") + std::to_string(id);
  }
  return text;
}

std::string treatment(std::string_view who, std::string_view radar, const TreatedTrack& track) {
  return std::string(who) + ": " + std::string(radar) + " radar, target id " +
         shown_ids(track.ids) + ", rows " + std::to_string(track.first_row) + " to " +
         std::to_string(track.last_row) + " of the event; seen in " +
         std::to_string(track.num_seen) + " rows, " + std::to_string(track.num_filled) +
         " interpolated across " + std::to_string(track.num_gaps) + " gaps, " +
         std::to_string(track.num_outliers) +
         " outliers removed; slope of the ranges against range rate: " +
         shown(track.rate_disagreement, 2) +
         " m/s rms; correction so that it never reverses: at most " +
         shown(track.largest_correction, 2) + " m.\n";
}

std::string notes_of(const scenario::Scenario& scenario, const recordings::HundredCarEvent& event,
                     const HundredCarReport& report) {
  std::string notes;
  const bool second = -scenario.road.right_edge > scenario.road.lane_width;
  notes += "Rebuilt by `saca import 100car`. The sample at t_s is row " +
           std::to_string(report.first_row) + " + 10 t_s of the event (rows counted from 1).\n";
  notes += "Ego: speed from the composite speed (" + std::to_string(report.num_speed_missing) +
           " rows without it), held values interpolated, straight-line fit over +-0.5 s; heading "
           "from the yaw rate less a bias of " +
           shown(to_degrees(report.gyro_bias), 2) +
           " deg/s; the driver is taken to keep a lane for " + shown(report.kept_for, 1) +
           " s until the conflict begins (offset from its middle " + shown(report.keeping_rms, 2) +
           " m rms), which fixes that bias and the lane's curvature.\n";
  notes += treatment("Vehicle ahead", "front", report.lead);
  notes += report.follower ? treatment("Vehicle behind", "rear", *report.follower)
                           : "Vehicle behind: none seen by the rear radar for 2 s or more.\n";
  notes +=
      "Others: range and range rate fitted together by a parabola over +-0.5 s, sideways position "
      "by a line over +-1 s; ranges run from our car's bumper to the other's; heading along the "
      "lane.\n";
  notes += "Assumed: sizes and masses (typical of \"" + event.lead_type +
           "\"), lane width 12 ft, the ego in the " +
           std::string(second ? "second from the right, since the driver steered to the right, of"
                              : "right-most of") +
           " \"" + event.lanes + "\" lanes (" + event.flow + "), open ground on the right, grip " +
           shown(scenario.grip, 1) + " for a surface that was \"" + event.surface +
           "\" (Wong, Theory of Ground Vehicles).\n";
  notes += "Study: " + event.severity + "; " + event.nature + "; " + event.precipitating + "; " +
           event.locality + "; " + event.light + "; " + event.weather + "; " + event.alignment +
           ".\n";
  return notes;
}

std::string driver_of(const recordings::HundredCarEvent& event, const HundredCarRequest& request,
                      const DriverAction& action) {
  std::string text = "Before: " + event.manoeuvre_before + ". Reaction: " + event.reaction + "; " +
                     event.control_after + ". Behaviour: " + event.behaviour + ".";
  text += " Largest deceleration " + shown(action.deceleration, 1) + " m/s2 at " +
          shown(action.hardest_time, 1) + " s";
  if (action.brake_time) {
    text += ", brake lights on from " + shown(*action.brake_time, 1) + " s";
  }
  text += '.';
  if (!request.narrative.empty()) {
    text += " The study's narrative: \"" + request.narrative + "\"";
  }
  return text;
}

}  // namespace

AssumedBody assumed_body(std::string_view type) {
  using world::ActorKind;
  if (contains(type, "Sport Utility")) {
    return {ActorKind::car, 4.7, 1.9, 2000.0};
  }
  if (type.starts_with("Van")) {
    return {ActorKind::van, 5.0, 2.0, 2000.0};
  }
  if (contains(type, "Pickup")) {
    return {ActorKind::van, 5.4, 2.0, 2200.0};
  }
  if (contains(type, "Tractor-trailer")) {
    return {ActorKind::truck, 18.0, 2.6, 25000.0};
  }
  if (contains(type, "truck") || contains(type, "bus")) {
    return {ActorKind::truck, 10.0, 2.5, 12000.0};
  }
  if (contains(type, "otorcycle")) {
    return {ActorKind::motorcycle, 2.2, 0.8, 300.0};
  }
  return {ActorKind::car, 4.8, 1.8, 1500.0};
}

double assumed_grip(std::string_view surface) {
  if (surface.starts_with("Wet")) {
    return 0.6;
  }
  if (surface.starts_with("Snowy")) {
    return 0.2;
  }
  return surface.starts_with("Icy") ? 0.1 : 0.9;
}

bool is_rear_end(const recordings::HundredCarEvent& event) {
  return event.nature.starts_with("Rear-end");
}

bool is_struck(const recordings::HundredCarEvent& event) {
  return event.nature.starts_with("Rear-end, struck");
}

bool may_steer_into_right_lane(const recordings::HundredCarEvent& event) {
  const bool steered =
      contains(event.reaction, "steered right") || contains(event.reaction, "Steered to right");
  const int lanes = leading_number(event.lanes);
  return steered && (event.flow.starts_with("Not divided") ? lanes / 2 : lanes) >= 2;
}

bool leaves_lane(const recordings::HundredCarEvent& event) {
  constexpr std::array<std::string_view, 8> words{"Changing lanes", "Merging",  "Passing",
                                                  "Turning",        "Entering", "Leaving",
                                                  "Making",         "Backing"};
  return std::any_of(words.begin(), words.end(), [&event](std::string_view word) {
    return event.manoeuvre_before.starts_with(word);
  });
}

std::string shown(double value, int decimals) {
  std::array<char, 64> text{};
  const auto [end, problem] = std::to_chars(text.data(), text.data() + text.size(), value,
                                            std::chars_format::fixed, decimals);
  if (problem != std::errc()) {  // too long: as short as it is exact
    return {text.data(), std::to_chars(text.data(), text.data() + text.size(), value).ptr};
  }
  return {text.data(), end};
}

LanesAround lanes_around(const recordings::HundredCarEvent& event) {
  const int lanes = std::max(1, leading_number(event.lanes));
  if (event.flow.starts_with("Not divided")) {
    // The study counts the lanes of both directions.
    return {.left = lanes - 1, .divided = false, .oncoming_left = lanes <= 2 && lanes > 1};
  }
  return {.left = lanes - 1, .divided = event.flow.starts_with("Divided"), .oncoming_left = false};
}

void describe(scenario::Scenario& scenario, const recordings::HundredCarEvent& event,
              const HundredCarRequest& request, const HundredCarReport& report,
              const DriverAction& action) {
  const std::string id = std::to_string(request.event);
  scenario.name = "100car_" + id;
  scenario.title = event.severity + " " + id + " of the 100-Car study: " + event.precipitating;
  scenario.source = "100-Car Naturalistic Driving Study, event " + id +
                    ", Virginia Tech Transportation Institute, doi:10.15787/VTT1/CEU6RB";
  scenario.licence =
      "CC0-1.0. Data: Virginia Tech Transportation Institute, 100-Car data (Custer 2018), CC0 1.0.";
  scenario.car = "compact_rwd_ev";
  scenario.notes = notes_of(scenario, event, report);
  scenario.driver = driver_of(event, request, action);
}

HundredCarFiles find_hundred_car_files(const fs::path& path, std::int64_t event) {
  HundredCarFiles found;
  std::error_code problem;
  const bool folder = fs::is_directory(path, problem);
  const fs::path base = folder ? path : path.parent_path();
  const std::vector<std::string> names{"HundredCar_Public_" + std::to_string(event) + ".txt",
                                       "HundredCar_Crash_Public_Compiled.txt",
                                       "HundredCar_NearCrash_Public_Compiled.txt"};
  if (!folder) {
    found.series.push_back(path);
  }
  for (const fs::path& place : {base, base / "timeseries"}) {
    for (const std::string& name : names) {
      if (folder && fs::is_regular_file(place / name, problem)) {
        found.series.push_back(place / name);
      }
    }
  }
  const std::string table = "100CarEventVideoReducedData_v1_5.txt";
  for (const fs::path& place : {base, base / "meta", base / "..", base / ".." / "meta"}) {
    if (found.table.empty() && fs::is_regular_file(place / table, problem)) {
      found.table = place / table;
    }
  }
  if (found.series.empty()) {
    found.problem = path.string() + ": want " + names[0] +
                    " or the compiled files in it or in its folder timeseries/, got none";
  } else if (found.table.empty()) {
    found.problem =
        path.string() + ": want " + table + " beside it, in meta/, or one folder up, got none";
  }
  return found;
}

}  // namespace saca::importers
