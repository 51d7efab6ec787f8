#include "saca/preview/supposed.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

#include "saca/core/contract.h"
#include "saca/world/usual_body.h"

namespace saca::preview {
namespace {

using world::Actor;
using world::Cue;
using world::LanePose;
using world::Scene;

/// When the ego's front is at the cue, if it goes on [s]; nullopt: it has passed, or it is far.
std::optional<double> time_until(const Scene& scene, const LanePose& cue) {
  const LanePose ego = to_lane(scene.road, scene.ego.X_WB);
  const double front = ego.s + scene.ego_footprint.centre_x + 0.5 * scene.ego_footprint.length;
  const double way = cue.s - front;
  const double speed = scene.ego.v_B.x;
  if (way < 0.0 || way > longest_ahead * speed) {
    return std::nullopt;
  }
  return way / speed;
}

/// An id that nobody else of this kind has; nullopt: there is none.
std::optional<std::uint8_t> free_id(const Scene& scene, world::ActorKind kind) {
  for (std::uint8_t id = std::numeric_limits<std::uint8_t>::max(); id > 0; --id) {
    const auto has_it = [&](const Actor& one) { return one.kind == kind && one.id == id; };
    if (std::none_of(scene.actors.begin(), scene.actors.end(), has_it)) {
      return id;
    }
  }
  return std::nullopt;
}

/// Whether whom the cue stands for is there to be seen.
bool is_seen(const Scene& scene, const Cue& cue, world::ActorKind kind) {
  constexpr double moving = 0.3;  // [m/s]
  return std::any_of(scene.actors.begin(), scene.actors.end(), [&](const Actor& one) {
    return one.kind == kind && norm(one.v_W) > moving && norm(one.X_WA.p - cue.p_W) < seen_near;
  });
}

/// Who crosses from the side of the cue, and is in the middle of the lane after `time`.
Actor crossing(const Scene& scene, const LanePose& cue, const intent::Unseen& unseen, double time) {
  const double side = cue.d < 0.0 ? -1.0 : 1.0;
  const LanePose start{cue.s, side * unseen.speed * time, -side * 0.5 * std::numbers::pi};
  const world::UsualBody& body = world::usual_body(*unseen.who);
  Actor actor{.kind = *unseen.who, .footprint = body.footprint, .mass = body.mass};
  actor.X_WA = from_lane(scene.road, start);
  actor.v_W = rotated({unseen.speed, 0.0}, actor.X_WA.yaw);
  constexpr double sooner_or_later = 1.0;  // [s], standard deviation: assumption
  constexpr double widest = 2.0;           // [m]: the error is the same along our lane
  actor.position_sd = std::min(widest, sooner_or_later * unseen.speed);
  actor.occluded = true;
  return actor;
}

/// It goes on as it does, whatever is asked.
intent::Belief going_on() {
  intent::Belief belief;
  for (intent::IntentPosterior& posterior : belief.at) {
    posterior = {};
    posterior[static_cast<std::size_t>(intent::Intention::maintain)] = 1.0;
  }
  return belief;
}

/// Adds whom the cue stands for. @return  false: there is no room, or it is seen already
bool add_crossing(Supposition& one, const LanePose& place, const Cue& cue,
                  const intent::Unseen& unseen, double time) {
  const auto id = free_id(one.scene, *unseen.who);
  if (!id || one.scene.actors.full() || is_seen(one.scene, cue, *unseen.who)) {
    return false;
  }
  Actor actor = crossing(one.scene, place, unseen, time);
  actor.id = *id;
  one.scene.actors.push_back(actor);
  one.beliefs.push_back(going_on());
  return true;
}

}  // namespace

Suppositions suppositions(const Scene& scene, const intent::Beliefs& beliefs,
                          const intent::CueLaw& law) {
  expects(beliefs.size() == scene.actors.size(), "one belief per actor");
  Suppositions all;
  double sum = 0.0;
  for (const Cue& cue : scene.cues) {
    const auto& unseen = law.of(cue.kind);
    const LanePose place = to_lane(scene.road, {cue.p_W, 0.0});
    const auto time = time_until(scene, place);
    if (!unseen || !time || unseen->probability == 0.0) {
      continue;
    }
    Supposition one{.probability = unseen->probability,
                    .scene = scene,
                    .beliefs = beliefs,
                    .is_slippery = !unseen->who};
    if (one.is_slippery) {
      one.scene.grip *= unseen->grip_share;
    } else if (!add_crossing(one, place, cue, *unseen, *time)) {
      continue;
    }
    sum += one.probability;
    all.push_back(one);
  }
  for (Supposition& one : all) {
    one.probability *= std::min(1.0, most_likely / sum);
  }
  return all;
}

}  // namespace saca::preview
