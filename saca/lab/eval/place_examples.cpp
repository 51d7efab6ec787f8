#include "saca/lab/eval/place_examples.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "saca/lab/eval/mixture_lstm.h"
#include "saca/thinking/intent/observed.h"
#include "saca/thinking/intent/vru.h"

namespace saca::eval {
namespace {

using world::Actor;
using world::Scene;

struct SeenAndTrue {
  Scene seen;
  Scene truth;
};

/// Its places, where they are known.
void add_places(const encounter::Stage& stage, const ForecastWindow& window,
                const std::vector<SeenAndTrue>& looks, std::size_t n, const Actor& actor,
                PlaceExample& example) {
  const Scene& seen = looks[n].seen;
  const auto now = true_place(looks[n].truth, actor);
  if (!now || !is_learnt_of(actor) ||
      !can_be_judged(stage, window, actor, *now, seen.time, seen.time)) {
    return;
  }
  const world::Road line = travel_line(seen, actor);
  example.speed = rotated(actor.v_W, -line.X_WL.yaw).x;
  for (std::size_t k = 0; k < forecast_times.size(); ++k) {
    const auto after = static_cast<std::size_t>(std::lround(forecast_times[k] / intent::look_step));
    const auto then = n + after < looks.size() ? true_place(looks[n + after].truth, actor)
                                               : std::optional<Vec2>();
    if (!then) {
      return;
    }
    const world::LanePose at = world::to_lane(line, {*then, 0.0});
    example.places[k] = {at.s, at.d};
  }
  example.known = true;
}

/// Looks 0.1 s apart at an encounter in which nothing is done, to its end.
Result<std::vector<SeenAndTrue>> played_looks(const encounter::Stage& stage) {
  constexpr int steps_apart = 10;  // of the loop: 0.1 s
  std::vector<SeenAndTrue> looks;
  encounter::ClosedLoop loop(stage);
  for (int k = 0; !loop.truth().over(); ++k) {
    if (auto problem = loop.look()) {
      return *std::move(problem);
    }
    if (k % steps_apart == 0) {
      looks.push_back({loop.seen(), loop.truth().whole_scene()});
    }
    loop.advance();
  }
  return looks;
}

}  // namespace

Result<std::vector<std::vector<PlaceExample>>> place_examples(const encounter::Stage& stage,
                                                              const ForecastWindow& window) {
  const auto played = played_looks(stage);
  if (!played.has_value()) {
    return played.error();
  }
  const std::vector<SeenAndTrue>& looks = played.value();
  struct RoadUser {
    intent::ObservationHistory memory;
    std::size_t last = 0;
    std::vector<PlaceExample> examples;
  };
  constexpr std::size_t forgotten_after_looks = 20;  // as MixturePredictor
  std::map<std::pair<world::ActorKind, std::uint8_t>, RoadUser> watched;
  std::vector<std::vector<PlaceExample>> all;
  const auto keep = [&all](RoadUser& one) {
    if (std::any_of(one.examples.begin(), one.examples.end(),
                    [](const PlaceExample& each) { return each.known; })) {
      all.push_back(std::move(one.examples));
    }
    one = {};
  };
  for (std::size_t n = 0; n < looks.size(); ++n) {
    const Scene& seen = looks[n].seen;
    for (std::size_t i = 0; i < seen.actors.size(); ++i) {
      const Actor& actor = seen.actors[i];
      if (actor.kind == world::ActorKind::obstacle || intent::is_vru(actor.kind)) {
        continue;
      }
      RoadUser& one = watched[{actor.kind, actor.id}];
      if (!one.examples.empty() && n > one.last + forgotten_after_looks) {
        keep(one);
      }
      one.last = n;
      one.memory.add(intent::observed(seen, i));
      PlaceExample example{.features = one.memory.features()};
      add_places(stage, window, looks, n, actor, example);
      one.examples.push_back(example);
    }
  }
  for (auto& [who, one] : watched) {
    keep(one);
  }
  return all;
}

}  // namespace saca::eval
