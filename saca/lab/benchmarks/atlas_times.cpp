#include "saca/lab/benchmarks/atlas_times.h"

#include <fmt/core.h>

#include <array>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "saca/base/core/percentile.h"
#include "saca/base/world/time_to_conflict.h"
#include "saca/lab/benchmarks/crowd.h"
#include "saca/onboard/forecast/futures.h"

namespace saca::benchmarks {
namespace {

using nlohmann::json;

/// Scenes, and where their actors go: straight on.
struct AtlasScenes {
  std::vector<world::Scene> scenes;
  std::vector<std::vector<world::Track>> tracks;
  std::string suffix;  ///< behind the names of the figures
};

/// Grip, places and speeds are not known exactly.
void spread_out(world::Scene& scene) {
  scene.grip_sd = 0.06;
  for (world::Actor& actor : scene.actors) {
    actor.position_sd = 0.2;
    actor.velocity_sd = 0.3;
  }
}

std::vector<world::Track> going_on(const world::Scene& scene) {
  std::vector<world::Track> tracks;
  for (const world::Actor& actor : scene.actors) {
    world::Track& track = tracks.emplace_back();
    for (int k = 0; k <= 600; ++k) {
      track.X_WA.push_back(world::actor_going_on(actor, track.step * k));
    }
  }
  return tracks;
}

/// They are.
void know_exactly(world::Scene& scene) {
  scene.grip_sd = 0.0;
  for (world::Actor& actor : scene.actors) {
    actor.position_sd = 0.0;
    actor.velocity_sd = 0.0;
  }
}

/// How well a scene is known.
struct Knowledge {
  void (*set)(world::Scene& scene);
  const char* name;  ///< in the names of figures
};

AtlasScenes atlas_scenes(const manoeuvre::Car& car, int num_actors, const Knowledge& knowledge) {
  AtlasScenes all{.scenes = crowds(car, num_actors),
                  .tracks = {},
                  .suffix = fmt::format(".actors{}{}", num_actors, knowledge.name)};
  for (world::Scene& scene : all.scenes) {
    knowledge.set(scene);
    all.tracks.push_back(going_on(scene));
  }
  return all;
}

/// What the atlas is asked with.
struct AtlasReading {
  const atlas::Atlas* atlas = nullptr;
  const collision::HarmModel* harm = nullptr;
  const Clock* clock = nullptr;
  int num_calls = 0;
};

void add_times(const AtlasReading& reading, const AtlasScenes& scenes,
               std::span<const double> target_shares, json& figures) {
  std::vector<double> times;
  int num_outside = 0;
  for (int call = 0; call < reading.num_calls; ++call) {
    const std::size_t i = static_cast<std::size_t>(call) % scenes.scenes.size();
    const Clock::Time start = reading.clock->now();
    const forecast::Futures all =
        forecast::futures(*reading.atlas, scenes.scenes[i], scenes.tracks[i], *reading.harm,
                          {.shares = target_shares});
    times.push_back(1e6 * to_seconds(reading.clock->now() - start));
    num_outside += all[0].outside ? 1 : 0;
  }
  const std::string suffix = scenes.suffix + (target_shares.size() > 1 ? ".targets4" : "");
  figures["atlas.futures_us.p50" + suffix] = percentile(times, 0.5);
  figures["atlas.futures_us.p99" + suffix] = percentile(times, 0.99);
  figures["atlas.futures_us.n" + suffix] = reading.num_calls;
  figures["atlas.outside_share" + suffix] = static_cast<double>(num_outside) / reading.num_calls;
}

}  // namespace

json atlas_times(const manoeuvre::Car& car, const atlas::Atlas& atlas,
                 const collision::HarmModel& harm, const Clock& clock, int num_calls) {
  constexpr std::array half{0.5};
  const AtlasReading reading{&atlas, &harm, &clock, num_calls};
  json figures;
  for (const int num_actors : {1, 8, 32}) {
    for (const Knowledge& knowledge : {Knowledge{know_exactly, ""}, {spread_out, ".spread"}}) {
      const AtlasScenes scenes = atlas_scenes(car, num_actors, knowledge);
      add_times(reading, scenes, half, figures);
      add_times(reading, scenes, forecast::target_shares, figures);
    }
  }
  return figures;
}

}  // namespace saca::benchmarks
