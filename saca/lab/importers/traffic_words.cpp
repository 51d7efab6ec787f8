#include "saca/lab/importers/traffic_words.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>

#include "saca/base/core/units.h"

namespace saca::importers {
namespace {

using world::ActorKind;

bool is_one_of(std::string_view word, std::initializer_list<std::string_view> words) {
  return std::find(words.begin(), words.end(), word) != words.end();
}

ActorKind kind_by_size(const world::Footprint& footprint) {
  if (footprint.length >= 7.0) {
    return ActorKind::truck;
  }
  if (footprint.length >= 5.5) {
    return ActorKind::van;
  }
  return footprint.length < 3.0 && footprint.width < 1.5 ? ActorKind::motorcycle : ActorKind::car;
}

ActorKind kind_of(const recordings::Obstacle& obstacle) {
  const std::string_view type = obstacle.type;
  if (is_one_of(type, {"truck", "bus", "train"})) {
    return ActorKind::truck;
  }
  if (type == "motorcycle") {
    return ActorKind::motorcycle;
  }
  if (type == "bicycle") {
    return ActorKind::bicycle;
  }
  if (type == "pedestrian") {
    return ActorKind::pedestrian;
  }
  if (!obstacle.dynamic && !is_one_of(type, {"car", "parkedVehicle", "taxi", "priorityVehicle"})) {
    return ActorKind::obstacle;
  }
  return kind_by_size(obstacle.footprint);
}

double mass_of(ActorKind kind, double length) {
  switch (kind) {
    case ActorKind::car:
      return 1500.0;
    case ActorKind::van:
      return 2200.0;
    case ActorKind::truck:
    case ActorKind::obstacle:
      return length > 12.0 ? 25000.0 : 12000.0;
    case ActorKind::motorcycle:
      return 300.0;
    case ActorKind::bicycle:
      return 95.0;  // a rider and a bicycle
    case ActorKind::pedestrian:
      return 75.0;
  }
  return 1500.0;
}

std::string counted(const std::map<std::string, std::size_t>& counts) {
  std::string text;
  for (const auto& [what, count] : counts) {
    text += fmt::format("{}{} {}", text.empty() ? "" : ", ", count, what);
  }
  return text.empty() ? "none" : text;
}

std::string who_is_who(const TrafficReport& report) {
  std::string text;
  for (const TrafficActor& actor : report.actors) {
    text += fmt::format("{}{} = {}", text.empty() ? "" : ", ", actor.name, actor.obstacle);
  }
  return text.empty() ? "nobody" : text;
}

std::string lane_notes(const TrafficReport& report) {
  const recordings::LaneFit& lane = report.lane;
  std::string ids;
  for (const std::int64_t id : lane.lanelets) {
    ids += fmt::format("{}{}", ids.empty() ? "" : ", ", id);
  }
  return fmt::format(
      "Road: an arc fitted to the centre of lanelets {} from {:.0f} m behind the start to {:.0f} m "
      "ahead; the centre lies {:.2f} m off rms, {:.2f} m at most. Lane width and edges: medians "
      "over "
      "that stretch; edges moved out by {:.2f} m on the left and {:.2f} m on the right, to hold "
      "who "
      "was recorded there.\n",
      ids, lane.behind, lane.ahead, lane.rms, lane.largest, report.widened_left,
      report.widened_right);
}

std::string notes_of_traffic(const TrafficRequest& request, const TrafficReport& report) {
  std::string notes = fmt::format(
      "Made by `saca import commonroad`. t_s is the file's time less {:g} s, x_m and y_m are the "
      "file's less {:.0f} and {:.0f}.\n",
      report.from, report.origin_W.x, report.origin_W.y);
  notes += request.ego
               ? fmt::format(
                     "Ego: takes the place of obstacle {} and drives as that did; its body "
                     "is that of SACA's car, its centre where the recorded centre was.\n",
                     *request.ego)
               : "Ego: begins at the planning problem's start and goes on along its lane at that "
                 "speed; its heading against the lane is set to 0.\n";
  notes += lane_notes(report);
  notes += fmt::format(
      "Others, with their ids in the file: {}. Left out: {}.\nSmoothing: positions and velocities "
      "by "
      "a parabola over +-0.7 s, heading and speed by lines over +-0.5 s; {} positions that jump by "
      "1.5 m or more thrown away, {} missing samples bridged; positions moved by {:.2f} m rms, "
      "{:.2f} m at most; hardest acceleration left {:.1f} m/s2. After its last sample everybody "
      "goes "
      "straight on at the last speed.\n",
      who_is_who(report), counted(report.left_out), report.num_outliers, report.num_filled,
      report.rms_shift, report.largest_shift, report.hardest);
  notes +=
      "Assumed: kinds by size where the file says car, masses by kind, grip of a dry road, open "
      "ground beyond the road's edges.\n";
  notes += fmt::format("Passed over in the file: {}.\n", counted(report.ignored));
  return notes;
}

/// Who must be named when this is shown to anyone.
std::string licence_of(const recordings::CommonRoad& file) {
  const auto says = [&file](std::string_view word) {
    return file.source.find(word) != std::string::npos;
  };
  std::string text = "CommonRoad scenario " + file.benchmark + " by " + file.author + " (" +
                     file.affiliation + ")";
  if (says("NGSIM")) {
    text +=
        "; trajectories: U.S. Department of Transportation, Federal Highway Administration, NGSIM "
        "Vehicle Trajectories and Supporting Data, doi:10.21949/1504477";
  }
  if (says("OpenStreetMap") || says("OSM")) {
    text += "; map: OpenStreetMap contributors, ODbL 1.0";
  }
  return text + ". See data/README.md before passing it on.";
}

}  // namespace

TrafficBody assumed_traffic_body(const recordings::Obstacle& obstacle) {
  const ActorKind kind = kind_of(obstacle);
  return {kind, mass_of(kind, obstacle.footprint.length)};
}

std::string traffic_name(const recordings::CommonRoad& file, const TrafficRequest& request) {
  std::string name;
  for (const char c : file.benchmark) {
    const auto code = static_cast<unsigned char>(c);
    name += code < 128 && std::isalnum(code) != 0 ? static_cast<char>(std::tolower(code)) : '_';
  }
  if (name.empty()) {
    name = "commonroad";
  }
  if (request.ego) {
    name += fmt::format("_ego{}", *request.ego);
  }
  if (request.from.value_or(0.0) > 0.0) {
    name += fmt::format("_from{:.0f}ms", 1000.0 * *request.from);
  }
  return name;
}

void describe(scenario::Scenario& scenario, const recordings::CommonRoad& file,
              const TrafficRequest& request, const TrafficReport& report) {
  scenario.name = traffic_name(file, request);
  scenario.title = fmt::format("Recorded traffic {}, {} vehicles around the ego", file.benchmark,
                               scenario.actors.size());
  scenario.source = "CommonRoad " + file.benchmark + ": " + file.source;
  scenario.licence = licence_of(file);
  scenario.driver =
      request.ego ? fmt::format("Drove as obstacle {} was recorded.", *request.ego) : std::string{};
  scenario.notes = notes_of_traffic(request, report);
  scenario.car = "compact_rwd_ev";
}

}  // namespace saca::importers
