#include "saca/lab/recordings/commonroad.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "saca/base/core/csv.h"
#include "saca/lab/recordings/xml_reading.h"

namespace saca::recordings {
namespace {

using pugi::xml_node;
using Reading = XmlReading;

constexpr double farthest = 1e8;         // of a coordinate [m]: projected maps begin far away
constexpr double fastest = 150.0;        // [m/s]
constexpr double largest_angle = 100.0;  // [rad]: some writers do not wrap
constexpr double largest_body = 100.0;   // [m]
constexpr double last_step = 1e7;

Vec2 read_point(Reading& reading, xml_node node) {
  return {reading.inner(node, "x", -farthest, farthest),
          reading.inner(node, "y", -farthest, farthest)};
}

std::vector<Vec2> read_bound(Reading& reading, xml_node bound) {
  std::vector<Vec2> points_W;
  for (const xml_node point : bound.children("point")) {
    points_W.push_back(read_point(reading, point));
  }
  reading.ignore_but(bound, {"point"});
  return points_W;
}

std::optional<Neighbour> read_neighbour(Reading& reading, xml_node lanelet, const char* name) {
  const xml_node node = lanelet.child(name);
  if (!node) {
    return std::nullopt;
  }
  const std::string_view direction = node.attribute("drivingDir").value();
  if (direction != "same" && direction != "opposite") {
    reading.fail(node, "attribute drivingDir: want same or opposite, got " + shown_text(direction));
  }
  return Neighbour{reading.id(node, "ref"), direction == "same"};
}

std::vector<std::int64_t> read_references(Reading& reading, xml_node lanelet, const char* name) {
  std::vector<std::int64_t> ids;
  for (const xml_node node : lanelet.children(name)) {
    ids.push_back(reading.id(node, "ref"));
  }
  return ids;
}

Lanelet read_lanelet(Reading& reading, xml_node node) {
  Lanelet lanelet;
  lanelet.id = reading.id(node, "id");
  lanelet.left_W = read_bound(reading, reading.element(node, "leftBound"));
  lanelet.right_W = read_bound(reading, reading.element(node, "rightBound"));
  if (lanelet.left_W.size() < 2 || lanelet.left_W.size() != lanelet.right_W.size()) {
    reading.fail(node, "want two points or more on the left bound and as many on the right, got " +
                           std::to_string(lanelet.left_W.size()) + " and " +
                           std::to_string(lanelet.right_W.size()));
  }
  lanelet.predecessors = read_references(reading, node, "predecessor");
  lanelet.successors = read_references(reading, node, "successor");
  lanelet.left = read_neighbour(reading, node, "adjacentLeft");
  lanelet.right = read_neighbour(reading, node, "adjacentRight");
  reading.ignore_but(node, {"leftBound", "rightBound", "predecessor", "successor", "adjacentLeft",
                            "adjacentRight"});
  return lanelet;
}

/// Takes out references to lanelets that the file does not hold, and counts them.
void drop_dangling(Reading& reading, xml_node node, Lanelet& lanelet,
                   const std::set<std::int64_t>& ids) {
  constexpr std::string_view note = " (names no lanelet)";
  const auto dangles = [&ids](std::int64_t id) { return !ids.contains(id); };
  const auto clean = [&](std::vector<std::int64_t>& names, const char* element) {
    for (std::size_t k = std::erase_if(names, dangles); k > 0; --k) {
      reading.ignore(node.child(element), note);
    }
  };
  clean(lanelet.predecessors, "predecessor");
  clean(lanelet.successors, "successor");
  if (lanelet.left && dangles(lanelet.left->lanelet)) {
    reading.ignore(node.child("adjacentLeft"), note);
    lanelet.left.reset();
  }
  if (lanelet.right && dangles(lanelet.right->lanelet)) {
    reading.ignore(node.child("adjacentRight"), note);
    lanelet.right.reset();
  }
}

void read_lanelets(Reading& reading, xml_node root, CommonRoad& file) {
  std::set<std::int64_t> ids;
  for (const xml_node node : root.children("lanelet")) {
    file.lanelets.push_back(read_lanelet(reading, node));
    if (!ids.insert(file.lanelets.back().id).second) {
      reading.fail(node, "want a new id, got one that another lanelet has");
    }
  }
  if (file.lanelets.empty()) {
    reading.fail(root, "want at least one <lanelet>, got none");
  }
  auto lanelet = file.lanelets.begin();
  for (const xml_node node : root.children("lanelet")) {
    drop_dangling(reading, node, *lanelet++, ids);
  }
}

ObstacleState read_state(Reading& reading, xml_node node, bool moving) {
  ObstacleState state;
  const double step = reading.exact(node, "time", 0.0, last_step);
  if (step != std::floor(step)) {
    reading.fail(node.child("time"), "want a whole number of time steps, got " +
                                         shown_text(node.child("time").child_value("exact")));
  }
  state.step = static_cast<std::int64_t>(step);
  const xml_node position = reading.element(node, "position");
  if (position && !position.child("point")) {
    reading.fail(position, "want <point>: regions are predictions, not recordings");
  } else if (position) {
    state.X_WO.p = read_point(reading, position.child("point"));
  }
  state.X_WO.yaw =
      wrap_angle(std::clamp(reading.exact(node, "orientation", -largest_angle, largest_angle),
                            -largest_angle, largest_angle));
  if (moving || node.child("velocity")) {
    state.speed = reading.exact(node, "velocity", -fastest, fastest);
  }
  reading.ignore_but(node, {"time", "position", "orientation", "velocity"});
  return state;
}

/// The obstacle's body; nullopt, counted, when it is neither one rectangle nor one disc.
bool read_shape(Reading& reading, xml_node node, Obstacle& obstacle) {
  const xml_node shape = reading.element(node, "shape");
  const xml_node body = shape.first_child();
  const std::string_view form = body.name();
  if (body != shape.last_child() || (form != "rectangle" && form != "circle")) {
    for (const xml_node part : shape.children()) {
      reading.ignore(part);
    }
    reading.ignore(node, " (shape is neither one rectangle nor one circle)");
    return false;
  }
  constexpr double least = 1e-3;  // [m]
  if (form == "rectangle") {
    obstacle.footprint = {world::Shape::box, reading.inner(body, "length", least, largest_body),
                          reading.inner(body, "width", least, largest_body), 0.0};
    if (body.child("orientation")) {
      obstacle.X_OA.yaw =
          wrap_angle(std::clamp(reading.inner(body, "orientation", -largest_angle, largest_angle),
                                -largest_angle, largest_angle));
    }
  } else {
    const double diameter = 2.0 * reading.inner(body, "radius", least, 0.5 * largest_body);
    obstacle.footprint = {world::Shape::ellipse, diameter, diameter, 0.0};
  }
  if (body.child("center")) {
    obstacle.X_OA.p = read_point(reading, body.child("center"));
  }
  reading.ignore_but(body, {"length", "width", "radius", "orientation", "center"});
  return true;
}

void read_trajectory(Reading& reading, xml_node node, Obstacle& obstacle) {
  for (const xml_node state : node.child("trajectory").children("state")) {
    obstacle.states.push_back(read_state(reading, state, true));
    const std::int64_t before = (obstacle.states.end() - 2)->step;
    if (obstacle.states.back().step <= before) {
      reading.fail(state.child("time"), "want a time step after " + std::to_string(before) +
                                            ", got " + std::to_string(obstacle.states.back().step));
    }
  }
  reading.ignore_but(node.child("trajectory"), {"state"});
}

void read_obstacles(Reading& reading, xml_node root, bool dynamic, CommonRoad& file,
                    std::set<std::int64_t>& ids) {
  for (const xml_node node : root.children(dynamic ? "dynamicObstacle" : "staticObstacle")) {
    if (const xml_node set = node.child("occupancySet")) {
      reading.fail(set, "want a recorded <trajectory>, got a set-based prediction");
    }
    Obstacle obstacle;
    obstacle.id = reading.id(node, "id");
    obstacle.dynamic = dynamic;
    obstacle.type = node.child_value("type");
    if (!ids.insert(obstacle.id).second) {
      reading.fail(node, "want a new id, got one that another obstacle has");
    }
    if (!read_shape(reading, node, obstacle)) {
      continue;
    }
    if (const xml_node start = reading.element(node, "initialState")) {
      obstacle.states.push_back(read_state(reading, start, dynamic));
      read_trajectory(reading, node, obstacle);
    }
    reading.ignore_but(node, {"type", "shape", "initialState", "trajectory"});
    file.obstacles.push_back(std::move(obstacle));
  }
}

void read_problems(Reading& reading, xml_node root, CommonRoad& file) {
  for (const xml_node node : root.children("planningProblem")) {
    PlanningProblem problem;
    problem.id = reading.id(node, "id");
    if (const xml_node start = reading.element(node, "initialState")) {
      problem.start = read_state(reading, start, true);
    }
    reading.ignore_but(node, {"initialState"});
    file.problems.push_back(problem);
  }
}

void read_location(Reading& reading, xml_node root, CommonRoad& file) {
  const xml_node location = root.child("location");
  if (location.child("gpsLatitude")) {
    // The format writes 999 for unknown.
    const double latitude = reading.inner(location, "gpsLatitude", -farthest, farthest);
    const double longitude = reading.inner(location, "gpsLongitude", -farthest, farthest);
    if (std::abs(latitude) <= 90.0 && std::abs(longitude) <= 180.0) {
      file.latitude_deg = latitude;
      file.longitude_deg = longitude;
    }
  }
  reading.ignore_but(location, {"gpsLatitude", "gpsLongitude"});
}

constexpr std::string_view set_based_mark = "SPOT";

void read_about(Reading& reading, xml_node root, CommonRoad& file) {
  const std::string_view version = root.attribute("commonRoadVersion").value();
  if (version != "2020a") {
    reading.fail(root, "attribute commonRoadVersion: want 2020a, got " + shown_text(version));
  }
  file.benchmark = reading.text(root, "benchmarkID");
  file.author = reading.text(root, "author");
  file.affiliation = reading.text(root, "affiliation");
  file.source = reading.text(root, "source");
  if (file.source.find(set_based_mark) != std::string::npos) {
    reading.fail(root, "attribute source: want a recording, got set-based predictions (SPOT)");
  }
  const char* const step = root.attribute("timeStepSize").value();
  file.time_step = finite_number(step).value_or(0.0);
  if (!(file.time_step >= 0.01 && file.time_step <= 10.0)) {
    reading.fail(root, "attribute timeStepSize: want 0.01 to 10 s, got " + shown_text(step));
  }
  for (const xml_node tag : root.child("scenarioTags").children()) {
    file.tags.emplace_back(tag.name());
  }
}

}  // namespace

Result<CommonRoad> read_commonroad(std::string_view text, std::string_view source) {
  Reading reading(text, source);
  if (const std::optional<std::size_t> fault = first_fault_of_utf8(text)) {
    return reading.error_at(static_cast<std::ptrdiff_t>(*fault),
                            "byte " + std::to_string(*fault) + ": want UTF-8");
  }
  pugi::xml_document document;
  const pugi::xml_parse_result parsed =
      document.load_buffer(text.data(), text.size(), pugi::parse_default, pugi::encoding_utf8);
  if (!parsed) {
    return reading.error_at(parsed.offset, "byte " + std::to_string(parsed.offset) +
                                               ": want XML, got: " + parsed.description());
  }
  const xml_node root = document.document_element();
  if (std::string_view(root.name()) != "commonRoad") {
    return reading.error_at(root.offset_debug(), "want a root element <commonRoad>, got <" +
                                                     std::string(root.name()) + ">");
  }
  CommonRoad file;
  read_about(reading, root, file);
  if (!reading.problem()) {
    read_location(reading, root, file);
    read_lanelets(reading, root, file);
    std::set<std::int64_t> ids;
    read_obstacles(reading, root, true, file, ids);
    read_obstacles(reading, root, false, file, ids);
    read_problems(reading, root, file);
    reading.ignore_but(root, {"location", "scenarioTags", "lanelet", "dynamicObstacle",
                              "staticObstacle", "planningProblem"});
  }
  if (reading.problem()) {
    return *reading.problem();
  }
  file.ignored = reading.ignored();
  return file;
}

bool is_set_based(std::string_view text) {
  pugi::xml_document document;
  if (!document.load_buffer(text.data(), text.size(), pugi::parse_default, pugi::encoding_utf8)) {
    return false;
  }
  const std::string_view source = document.document_element().attribute("source").value();
  return source.find(set_based_mark) != std::string_view::npos;
}

const Lanelet* find_lanelet(const CommonRoad& file, std::int64_t id) {
  const auto found = std::find_if(file.lanelets.begin(), file.lanelets.end(),
                                  [id](const Lanelet& lanelet) { return lanelet.id == id; });
  return found == file.lanelets.end() ? nullptr : &*found;
}

}  // namespace saca::recordings
