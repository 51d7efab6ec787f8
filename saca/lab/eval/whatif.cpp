#include "saca/lab/eval/whatif.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "saca/base/config/toml_number.h"
#include "saca/base/core/parallel.h"
#include "saca/lab/eval/survey.h"
#include "saca/onboard/manoeuvre/ego.h"

namespace saca::eval {
namespace {

using scenario::Scenario;
using scenario::ScenarioActor;
using scenario::Script;

/// Moves a body so that its lane coordinates change by this much, whatever it does.
void move(ScenarioActor& actor, const world::Road& road, double ds, double dd) {
  if (auto* script = std::get_if<Script>(&actor.motion)) {
    script->start.s += ds;
    script->start.d += dd;
    script->to_d += dd;
    return;
  }
  const Vec2 shift_W = rotated({ds, dd}, road.X_WL.yaw);
  for (scenario::Sample& sample : std::get<scenario::Recording>(actor.motion)) {
    sample.X_WA.p = sample.X_WA.p + shift_W;
  }
}

/// Where everybody is at one instant, along the road.
struct PlacesThen {
  world::LanePose ego;
  std::vector<std::optional<world::LanePose>> actors;  ///< of the scenario; nullopt: not there
};

PlacesThen places_at(const Scenario& scenario, const manoeuvre::Car& car, double time) {
  const world::Scene scene = scene_at(scenario, car, time);
  PlacesThen places{.ego = to_lane(scene.road, scene.ego.X_WB), .actors = {}};
  for (const ScenarioActor& actor : scenario.actors) {
    places.actors.emplace_back();
    for (const world::Actor& there : scene.actors) {
      if (there.kind == actor.kind && there.id == actor.id) {
        places.actors.back() = to_lane(scene.road, there.X_WA);
      }
    }
  }
  return places;
}

Error impossible(const Axis& axis, double value, const std::string& why) {
  return {Error::Code::out_of_range, fmt::format("{}={}: {}", axis.what, value, why)};
}

/// How far somebody was off, what he was then moved by, and so how much a move helps: who reacts
/// makes up for part of it on the way.
class Secant {
 public:
  double move_for(double miss) {
    if (moved_ != 0.0) {
      gain_ = std::clamp((missed_ - miss) / moved_, 0.05, 2.0);
    }
    missed_ = miss;
    moved_ = miss / gain_;
    return moved_;
  }

 private:
  double missed_ = 0.0;
  double moved_ = 0.0;
  double gain_ = 1.0;
};

/// Begins everybody elsewhere until all are where they are wanted at the time. Who reacts moves
/// otherwise when others begin elsewhere, so a few rounds are needed.
/// @return  false when they do not get there
bool brought_to(const PlacesThen& wanted, Scenario& scenario, const manoeuvre::Car& car,
                double time) {
  constexpr int most_rounds = 12;
  constexpr double near_enough = 0.01;  // [m]
  std::vector<Secant> along(scenario.actors.size());
  for (int round = 0; round < most_rounds; ++round) {
    const PlacesThen now = places_at(scenario, car, time);
    double off = 0.0;
    const auto miss = [&](const world::LanePose& is, const world::LanePose& should) {
      off = std::max({off, std::abs(should.s - is.s), std::abs(should.d - is.d)});
      return Vec2{should.s - is.s, should.d - is.d};
    };
    const Vec2 ego = miss(now.ego, wanted.ego);
    if (auto* start = std::get_if<scenario::EgoStart>(&scenario.ego)) {
      start->pose.s += ego.x;
      start->pose.d += ego.y;
    }
    for (std::size_t i = 0; i < scenario.actors.size(); ++i) {
      if (now.actors[i].has_value() != wanted.actors[i].has_value()) {
        return false;
      }
      if (now.actors[i]) {
        const Vec2 by = miss(*now.actors[i], *wanted.actors[i]);
        move(scenario.actors[i], scenario.road, along[i].move_for(by.x), by.y);
      }
    }
    if (off < near_enough) {
      return true;
    }
  }
  return false;
}

/// The number itself, where it is not a place.
std::optional<Error> set_number(Scenario& scenario, const Axis& axis, double value) {
  if (axis.key == "grip") {
    scenario.grip = value;
    return std::nullopt;
  }
  if (axis.body == "ego") {
    auto* start = std::get_if<scenario::EgoStart>(&scenario.ego);
    if (start == nullptr) {
      return impossible(axis, value, "the ego follows a recording; what it did cannot be varied");
    }
    if (axis.key == "speed_mps") {
      start->speed = value;
    }
    return std::nullopt;
  }
  if (axis.key == "speed_mps") {
    auto* script = std::get_if<Script>(&scenario.actors[*actor_called(scenario, axis.body)].motion);
    if (script == nullptr || script->behaviour == scenario::Behaviour::hold) {
      return impossible(axis, value, axis.body + " has no speed of its own to vary");
    }
    script->speed = value;
    script->law.desired_speed = std::max(value, 0.1);
  }
  return std::nullopt;
}

/// Harm of the second best above that of the best.
double margin_over(const Finding& finding, std::size_t best) {
  double second = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < finding.harm.size(); ++i) {
    if (i != best && finding.harm[i]) {
      second = std::min(second, *finding.harm[i]);
    }
  }
  return std::max(0.0, second - *finding.harm[best]);
}

bool overlaps(const world::Scene& scene) {
  return std::any_of(scene.actors.begin(), scene.actors.end(), [&](const world::Actor& actor) {
    return world::separation(scene.ego_footprint, scene.ego.X_WB, actor.footprint, actor.X_WA)
               .distance <= 0.0;
  });
}

Cell cell_of(const Finding& finding) {
  const std::size_t best = manoeuvre::index(finding.best);
  return {.best = finding.best,
          .alone = lesson_of(finding).alone == finding.best,
          .margin = margin_over(finding, best),
          .contact = finding.contact[best],
          .harms = finding.harm};
}

/// A number of the scenario's file.
Result<Scenario> varied_in_file(const Scenario& scenario, const world::Footprint& ego, double time,
                                const Axis& axis, double value) {
  const auto text = config::with_number(scenario::write_scenario(scenario), axis.path, value);
  if (!text.has_value()) {
    return impossible(axis, value, text.error().message);
  }
  auto read = scenario::read_scenario(text.value(), "as varied", ego);
  if (!read.has_value()) {
    return impossible(axis, value, read.error().message);
  }
  if (read.value().duration < time) {
    return impossible(axis, value,
                      fmt::format("it ends before the policies begin, at {:g} s", time));
  }
  return read;
}

}  // namespace

Result<Scenario> varied(const Scenario& scenario, const manoeuvre::Car& car, double time,
                        const Axis& axis, double value) {
  const world::Footprint ego = manoeuvre::footprint(car);
  if (!axis.path.empty()) {
    return varied_in_file(scenario, ego, time, axis, value);
  }
  PlacesThen wanted = places_at(scenario, car, time);
  if (axis.key == "offset_m" && axis.body == "ego") {
    wanted.ego.d = value;
  } else if (!axis.body.empty() && axis.body != "ego") {
    auto& place = wanted.actors[*actor_called(scenario, axis.body)];
    if (!place) {
      return impossible(axis, value, axis.body + " is not there when the policies begin");
    }
    if (axis.key == "offset_m") {
      place->d = value;
    } else if (axis.key == "distance_m") {
      place->s = wanted.ego.s + value;
    }
  }
  Scenario changed = scenario;
  if (const auto problem = set_number(changed, axis, value)) {
    return *problem;
  }
  // Before anybody moves: a number out of range, a lane change that nobody drives.
  const auto is_refused = [&](const Scenario& it) -> std::optional<Error> {
    const auto read = scenario::read_scenario(scenario::write_scenario(it), "as varied", ego);
    return read.has_value() ? std::nullopt
                            : std::optional(impossible(axis, value, read.error().message));
  };
  if (axis.key == "speed_mps" || axis.key == "grip") {
    if (const auto problem = is_refused(changed)) {
      return *problem;
    }
  }
  if (!brought_to(wanted, changed, car, time)) {
    return impossible(axis, value, "who reacts to others cannot be where it was");
  }
  if (const auto problem = is_refused(changed)) {
    return *problem;
  }
  return changed;
}

std::optional<double> nominal(const Scenario& scenario, const manoeuvre::Car& car, double time,
                              const Axis& axis) {
  if (!axis.path.empty()) {
    return config::number_at(scenario::write_scenario(scenario), axis.path);
  }
  if (axis.key == "grip") {
    return scenario.grip;
  }
  const world::Scene scene = scene_at(scenario, car, time);
  const world::LanePose ego = to_lane(scene.road, scene.ego.X_WB);
  if (axis.body == "ego") {
    return axis.key == "speed_mps" ? norm(scene.ego.v_B) : ego.d;
  }
  for (const world::Actor& actor : scene.actors) {
    if (world::actor_name(actor) == axis.body) {
      const world::LanePose place = to_lane(scene.road, actor.X_WA);
      return axis.key == "speed_mps"    ? norm(actor.v_W)
             : axis.key == "distance_m" ? place.s - ego.s
                                        : place.d;
    }
  }
  return std::nullopt;
}

std::vector<Cell> try_cells(std::span<const std::optional<Scenario>> scenarios,
                            const manoeuvre::Car& car, const collision::HarmModel& harm,
                            double time, int threads) {
  std::vector<std::optional<DecisionPoint>> points(scenarios.size());
  in_parallel(scenarios.size(), threads, [&](std::size_t i) {
    if (scenarios[i] && !overlaps(scene_at(*scenarios[i], car, time))) {
      points[i] = decision_point_at(*scenarios[i], car, time);
    }
  });
  const auto tried = tried_from(points, car, harm, threads);
  std::vector<Cell> cells(scenarios.size());
  for (std::size_t i = 0; i < cells.size(); ++i) {
    cells[i] = tried[i] ? cell_of(finding_of(time, *tried[i])) : Cell{.possible = false};
  }
  return cells;
}

}  // namespace saca::eval
