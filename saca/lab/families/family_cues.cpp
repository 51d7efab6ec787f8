#include "saca/lab/families/family_cues.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>
#include <optional>
#include <utility>

#include "saca/base/core/contract.h"

namespace saca::families {
namespace {

using world::ActorKind;
using world::CueKind;

constexpr double seen_before = 1.5;  // [s] that he comes, whom nothing hides

/// Where a cue is.
struct Spot {
  double s = 0.0;     ///< [m]
  double side = 1.0;  ///< +1 left, -1 right
  double edge = 0.0;  ///< of our outermost lane on that side, from the middle of ours [m]
};

/// Evenly between two numbers.
double between(Dice& dice, double low, double high) {
  return low + (high - low) * dice.even();
}

Spot draw_spot(Stage& stage) {
  const double ahead = between(stage.dice, -8.0, 12.0);
  const double side = stage.dice.even() < 0.3 ? 1.0 : -1.0;
  const world::Road& road = stage.scenario.road;
  const double room = side > 0.0 ? road.left_edge : -road.right_edge;
  const double lanes = std::floor(room / stage.lane() - 0.5);  // beside ours, whole ones
  return {stage.head() + ahead, side, (0.5 + std::max(lanes, 0.0)) * stage.lane()};
}

/// What stands there and hides; its end is a metre before the spot, so that who comes passes it.
struct Screen {
  ActorKind kind = ActorKind::van;
  double length = 0.0;  ///< [m]
  int count = 1;        ///< one behind the other
};

std::optional<Screen> screen_of(CueKind kind) {
  switch (kind) {
    case CueKind::school_zone:
      return Screen{ActorKind::car, Stage::length_of(ActorKind::car), 2};
    case CueKind::bus_at_stop:
      return Screen{ActorKind::truck, 12.0, 1};
    case CueKind::parked_vans:
      return Screen{ActorKind::van, Stage::length_of(ActorKind::van), 3};
    case CueKind::work_zone:
      return Screen{ActorKind::obstacle, 10.0, 1};
    case CueKind::emergency_vehicle:
    case CueKind::low_sun:
    case CueKind::wet_leaves:
      break;
  }
  return std::nullopt;
}

constexpr double beside_lane = 0.4;  // [m] from our outermost lane to what stands beside it

/// How far from the middle of our lane the far side of what hides is [m].
double set_up(Stage& stage, const Spot& spot, const Screen& screen) {
  constexpr double room = 1.0;  // [m] from one to the next, and to who comes
  const double width = Stage::width_of(screen.kind);
  const double aside = spot.edge + beside_lane + 0.5 * width;
  for (int k = 0; k < screen.count; ++k) {
    const double s = spot.s - room - 0.5 * screen.length - k * (screen.length + room);
    scenario::ScenarioActor& body =
        stage.add(screen.kind,
                  {.start = {s, spot.side * aside, 0.0}, .behaviour = scenario::Behaviour::hold});
    body.footprint.length = screen.length;
  }
  stage.widen(spot.side, aside + 0.5 * width);
  return aside + 0.5 * width;
}

/// Crosses at a constant pace, and is `d` to the side when the approach is over for an ego that
/// just goes on to the spot. From `since` on.
scenario::Recording coming(const Spot& spot, double d, double time, double pace, double since,
                           double until) {
  constexpr double step = 0.1;  // [s]
  scenario::Recording recording;
  for (int k = 0; since + k * step < until; ++k) {
    const double t = since + k * step;
    recording.push_back(
        {.time = t,
         .X_WA = {{spot.s, d + spot.side * pace * (time - t)}, -spot.side * 0.5 * std::numbers::pi},
         .speed = pace});
  }
  return recording;
}

void let_come(Stage& stage, const Spot& spot, const intent::Unseen& unseen,
              const std::optional<double>& hidden_until) {
  Dice& dice = stage.dice;
  const double pace = unseen.speed * between(dice, 0.8, 1.2);
  const double d = spot.side * between(dice, 0.0, spot.edge);
  const double time = Stage::approach + (spot.s - stage.head()) / stage.speed;
  // Behind what hides him he stands, so to speak: the recording begins when he comes out of it.
  const double since = hidden_until ? std::max(0.0, time - (*hidden_until - std::abs(d)) / pace)
                                    : std::max(0.0, time - seen_before);
  scenario::ScenarioActor& who = stage.add(*unseen.who, {});
  who.motion = coming(spot, d, time, pace, since, stage.scenario.duration);
}

/// Nobody brakes harder than the road allows.
void make_slippery(scenario::Scenario& scenario, double share) {
  constexpr double g = 9.81;  // [m/s^2]
  if (!scenario.perception.grip_believed) {
    scenario.perception.grip_believed = scenario.grip;
  }
  scenario.grip *= share;
  for (scenario::ScenarioActor& actor : scenario.actors) {
    auto* const script = std::get_if<scenario::Script>(&actor.motion);
    if (script != nullptr && script->behaviour == scenario::Behaviour::brake) {
      script->acceleration = std::min(script->acceleration, scenario.grip * g);
    }
  }
}

}  // namespace

std::vector<DrawnCue> draw_cues(const FamilyCues& cues, std::mt19937_64& rng) {
  expects(!cues.kinds.empty(), "a family with cues has kinds of them");
  constexpr double two_share = 0.3;
  std::uniform_real_distribution<double> even;
  std::vector<CueKind> kinds = cues.kinds;
  const std::size_t count = std::min<std::size_t>(kinds.size(), even(rng) < two_share ? 2 : 1);
  std::vector<DrawnCue> drawn;
  for (std::size_t k = 0; k < count; ++k) {
    const auto i = static_cast<std::size_t>(even(rng) * static_cast<double>(kinds.size()));
    const auto& unseen = cues.law.of(kinds[i]);
    drawn.push_back({kinds[i], even(rng) < (unseen ? unseen->probability : 0.0)});
    kinds.erase(kinds.begin() + static_cast<std::ptrdiff_t>(i));
  }
  return drawn;
}

std::vector<Comer> add_cues(Stage& stage, const std::vector<DrawnCue>& cues,
                            const intent::CueLaw& law) {
  std::vector<Comer> all;
  for (const DrawnCue& cue : cues) {
    const Spot spot = draw_spot(stage);
    std::optional<double> hidden_until;
    if (const auto screen = screen_of(cue.kind)) {
      hidden_until = set_up(stage, spot, *screen);
    }
    stage.scenario.cues.push_back({cue.kind, {spot.s, spot.side * spot.edge}});
    const auto& unseen = law.of(cue.kind);
    if (unseen && unseen->who) {
      let_come(stage, spot, *unseen, hidden_until);
      all.push_back({stage.scenario.actors.size() - 1, cue.comes});
    } else if (unseen && cue.comes) {
      make_slippery(stage.scenario, unseen->grip_share);
    }
  }
  return all;
}

void take_all_away(scenario::Scenario& scenario, const std::vector<Comer>& all) {
  for (auto one = all.rbegin(); one != all.rend(); ++one) {  // places of those before stay
    scenario.actors.erase(scenario.actors.begin() + static_cast<std::ptrdiff_t>(one->actor));
  }
}

void take_absent_away(scenario::Scenario& scenario, const std::vector<Comer>& all) {
  std::vector<Comer> absent;
  std::copy_if(all.begin(), all.end(), std::back_inserter(absent),
               [](const Comer& one) { return !one.comes; });
  take_all_away(scenario, absent);
}

void take_leaves_away(scenario::Scenario& scenario) {
  if (const auto believed = std::exchange(scenario.perception.grip_believed, std::nullopt)) {
    scenario.grip = *believed;
  }
}

}  // namespace saca::families
