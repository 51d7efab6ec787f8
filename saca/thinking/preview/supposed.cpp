#include "saca/thinking/preview/supposed.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

#include "saca/base/core/contract.h"
#include "saca/base/world/usual_body.h"

namespace saca::preview {
namespace {

using world::Actor;
using world::Cue;
using world::LanePose;
using world::Scene;

/// How far the ego's front is from the cue, along the lane [m]; below 0: it has passed.
double way_to(const Scene& scene, const LanePose& cue) {
  const LanePose ego = to_lane(scene.road, scene.ego.X_WB);
  return cue.s - (ego.s + scene.ego_footprint.centre_x + 0.5 * scene.ego_footprint.length);
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

/// Whether whom the cue stands for is there to be seen: somebody of that kind who comes from there.
bool is_seen(const Scene& scene, const LanePose& cue, const intent::Unseen& unseen) {
  const double reach = least_reach + seen_before * unseen.speed;
  return std::any_of(scene.actors.begin(), scene.actors.end(), [&](const Actor& one) {
    const LanePose at = to_lane(scene.road, one.X_WA);
    const double across = rotated(one.v_W, at.heading - one.X_WA.yaw).y;
    const double towards = cue.d < 0.0 ? across : -across;
    return one.kind == unseen.who && towards > 0.5 * unseen.speed &&
           std::hypot(at.s - cue.s, at.d - cue.d) < reach;
  });
}

/// Who crosses from the side of the cue, and is half-way between it and the middle of our lane
/// after `time`.
Actor crossing(const Scene& scene, const LanePose& cue, const intent::Unseen& unseen, double time) {
  const double side = cue.d < 0.0 ? -1.0 : 1.0;
  const LanePose start{cue.s, 0.5 * cue.d + side * unseen.speed * time,
                       -side * 0.5 * std::numbers::pi};
  const world::UsualBody& body = world::usual_body(*unseen.who);
  Actor actor{.kind = *unseen.who, .footprint = body.footprint, .mass = body.mass};
  actor.X_WA = from_lane(scene.road, start);
  actor.v_W = rotated({unseen.speed, 0.0}, actor.X_WA.yaw);
  // Evenly anywhere between the two; along our lane the same error is no more than the cue's own.
  const double even = std::abs(cue.d) / std::sqrt(12.0);
  actor.position_sd = std::clamp(even, 0.5, 2.0);
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

/// Adds whom the cue stands for, where he may still come: he is not seen, and has not come out yet.
bool add_crossing(Supposition& one, const LanePose& cue, const intent::Unseen& unseen,
                  double time) {
  const auto id = free_id(one.scene, *unseen.who);
  const bool has_come_out = unseen.speed * time < 0.5 * std::abs(cue.d);
  if (!id || has_come_out || one.scene.actors.full() || is_seen(one.scene, cue, unseen)) {
    return false;
  }
  Actor actor = crossing(one.scene, cue, unseen, time);
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
  const double speed = scene.ego.v_B.x;
  for (const Cue& cue : scene.cues) {
    const auto& unseen = law.of(cue.kind);
    const LanePose place = to_lane(scene.road, {cue.p_W, 0.0});
    const double way = way_to(scene, place);
    const double behind = unseen && !unseen->who ? slippery_for : 0.0;
    if (!unseen || unseen->probability == 0.0 || !(speed > 0.0) || way < -behind ||
        way > longest_ahead * speed) {
      continue;
    }
    Supposition one{.probability = unseen->probability,
                    .scene = scene,
                    .beliefs = beliefs,
                    .is_slippery = !unseen->who};
    if (one.is_slippery) {
      one.scene.grip *= unseen->grip_share;
    } else if (!add_crossing(one, place, *unseen, way / speed)) {
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
