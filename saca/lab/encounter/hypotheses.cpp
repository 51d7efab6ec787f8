#include "saca/lab/encounter/hypotheses.h"

#include <algorithm>
#include <cmath>

#include "saca/base/core/units.h"
#include "saca/onboard/reflex/followers.h"
#include "saca/thinking/arbitration/forecaster.h"
#include "saca/thinking/preview/expected_harm.h"

namespace saca::encounter {
namespace {

using world::Scene;

constexpr double heading_resolution = 1.0;  // [deg]

double rounded(double value, double resolution) {
  return resolution * std::round(value / resolution);
}

bool same(const HypotheticalMotion& a, const HypotheticalMotion& b) {
  return std::equal(a.paths.begin(), a.paths.end(), b.paths.begin(), b.paths.end(),
                    [](const auto& one, const auto& other) { return one.X_WA == other.X_WA; });
}

/// What stands in the end stands there once.
HypotheticalPath thinned(const world::Actor& actor, const world::Track& track, double start) {
  HypotheticalPath path{.actor = actor_name(actor), .X_WA = {}};
  const int count = static_cast<int>(std::lround(Hypotheses::horizon / Hypotheses::step));
  for (int k = 0; k <= count; ++k) {
    const Pose X = world::pose_at(track, start + k * Hypotheses::step);
    path.X_WA.push_back(
        {{rounded(X.p.x, Hypotheses::resolution), rounded(X.p.y, Hypotheses::resolution)},
         from_degrees(rounded(to_degrees(X.yaw), heading_resolution))});
  }
  while (path.X_WA.size() > 1 && path.X_WA.back() == path.X_WA[path.X_WA.size() - 2]) {
    path.X_WA.pop_back();
  }
  return path;
}

/// The nearest to the ego who do not react, in the order of the scene.
std::vector<std::size_t> shown(const Scene& scene, const reflex::Followers& followers) {
  std::vector<std::size_t> all;
  for (std::size_t i = 0; i < scene.actors.size(); ++i) {
    if (std::find(followers.begin(), followers.end(), i) == followers.end()) {
      all.push_back(i);
    }
  }
  const auto distance = [&](std::size_t i) {
    return norm(scene.actors[i].X_WA.p - scene.ego.X_WB.p);
  };
  std::stable_sort(all.begin(), all.end(),
                   [&](std::size_t a, std::size_t b) { return distance(a) < distance(b); });
  all.resize(std::min(all.size(), Hypotheses::most_actors));
  std::sort(all.begin(), all.end());
  return all;
}

}  // namespace

Hypotheses hypotheses_of(const JudgedScene& judged) {
  const Scene& scene = judged.scene;
  Hypotheses hypotheses{.begun = judged.begun, .time = scene.time, .reacting = {}, .motions = {}};
  const reflex::Followers followers = reflex::followers_of(scene);
  for (const std::size_t i : followers) {
    hypotheses.reacting.push_back(actor_name(scene.actors[i]));
  }
  const std::vector<std::size_t> actors = shown(scene, followers);
  const std::vector<preview::JointMotion> joint =
      judged.by_atlas ? std::vector{preview::all_going_on(scene)}
                      : arbitration::draws_of(scene, judged.beliefs);
  for (const preview::JointMotion& one : joint) {
    HypotheticalMotion motion{.probability = one.probability, .paths = {}};
    for (const std::size_t i : actors) {
      motion.paths.push_back(thinned(scene.actors[i], one.tracks[i], scene.time));
    }
    const auto known =
        std::find_if(hypotheses.motions.begin(), hypotheses.motions.end(),
                     [&](const HypotheticalMotion& other) { return same(other, motion); });
    if (known == hypotheses.motions.end()) {
      hypotheses.motions.push_back(motion);
    } else {
      known->probability += motion.probability;
    }
  }
  return hypotheses;
}

}  // namespace saca::encounter
