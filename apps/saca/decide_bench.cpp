#include "apps/saca/decide_bench.h"

#include <fmt/core.h>

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "saca/base/core/percentile.h"
#include "saca/onboard/manoeuvre/ego.h"
#include "saca/onboard/reflex/atlas_judge.h"
#include "saca/onboard/reflex/reflex_plane.h"
#include "saca/thinking/arbitration/forecaster.h"
#include "saca/thinking/intent/observer.h"

namespace saca::app {
namespace {

using nlohmann::json;

constexpr int scenes_each = 64;
constexpr double longest = 4.0;  // [s] of the machine's, that one figure is measured for

std::vector<world::Scene> scenes_of(const manoeuvre::Car& car, int num_actors, bool followed) {
  std::mt19937 rng(1);
  std::vector<world::Scene> scenes;
  for (int i = 0; i < scenes_each; ++i) {
    scenes.push_back(crowd(car, num_actors, rng));
    if (followed) {
      world::Actor& last = scenes.back().actors[scenes.back().actors.size() - 1];
      last.X_WA.p = {-20.0, 0.0};
      last.v_W = scenes.back().ego.v_B;
    }
  }
  return scenes;
}

/// Times [us] of up to `num_calls` calls of `work(call)`, as many as `longest` has room for.
template <class Work>
std::vector<double> times_of(const Clock& clock, int num_calls, Work&& work) {
  std::vector<double> times;
  times.reserve(static_cast<std::size_t>(num_calls));
  const Clock::Time end = clock.now() + from_seconds(longest);
  for (int call = 0; call < num_calls && clock.now() < end; ++call) {
    times.push_back(work(static_cast<std::size_t>(call)));
  }
  return times;
}

double since(const Clock& clock, Clock::Time start) {
  return 1e6 * to_seconds(clock.now() - start);
}

/// Times of a loop that does nothing for `wanted` [us]: what is above that is the machine's doing,
/// not the program's.
std::vector<double> machine_times(const Clock& clock, double wanted, int num_calls) {
  return times_of(clock, num_calls, [&](std::size_t) {
    const Clock::Time start = clock.now();
    double time = 0.0;
    while (time < wanted) {
      time = since(clock, start);
    }
    return time;
  });
}

void add_percentiles(const std::string& name, const std::string& suffix,
                     const std::vector<double>& times, json& figures) {
  for (const auto& [percent, share] :
       {std::pair{".p50", 0.5}, {".p99", 0.99}, {".p99.9", 0.999}, {".max", 1.0}}) {
    figures[fmt::format("{}{}{}", name, percent, suffix)] = percentile(times, share);
  }
  figures[fmt::format("{}.n{}", name, suffix)] = times.size();
}

/// One step: six plans and, where there is one, a verdict received, threats looked for, and where
/// the scene triggers, matched and decided.
void bench_reflex(const Inputs& inputs, const atlas::Atlas& atlas, const Clock& clock,
                  int num_calls, const std::vector<world::Scene>& scenes, const std::string& suffix,
                  json& figures) {
  reflex::PlanCache plans;
  for (std::size_t i = 0; i < reflex::PlanCache::capacity(); ++i) {
    plans.push_back({.at_trigger = match::features(scenes[i]),
                     .plan = {manoeuvre::PolicyId::aes_left, std::nullopt}});
  }
  reflex::AtlasJudge judge(inputs.car, atlas, inputs.harm);
  const auto verdict = judge.judge(scenes.front());
  for (const bool fresh : {true, false}) {
    int num_triggered = 0;
    int num_judged = 0;
    const auto step = [&](std::size_t call) {
      reflex::ReflexPlane plane(
          {.car = &inputs.car, .atlas = reflex::AtlasJudge(inputs.car, atlas, inputs.harm)});
      const Clock::Time start = clock.now();
      plane.receive(plans);
      if (fresh && verdict) {
        plane.receive(*verdict);
      }
      num_triggered += plane.step(scenes[call % scenes.size()]).triggered ? 1 : 0;
      const double time = since(clock, start);
      num_judged += plane.decision() && plane.decision()->by_atlas ? 1 : 0;
      return time;
    };
    const std::string all = (fresh ? ".fresh" : "") + suffix;
    const std::vector<double> times = times_of(clock, num_calls, step);
    add_percentiles("decide.reflex_us", all, times, figures);
    figures["decide.reflex_us.triggered_share" + all] =
        num_triggered / static_cast<double>(times.size());
    figures["decide.reflex_us.judged_share" + all] = num_judged / static_cast<double>(times.size());
    if (!fresh) {
      add_percentiles("decide.machine_us", suffix,
                      machine_times(clock, percentile(times, 0.5), num_calls), figures);
    }
  }
}

}  // namespace

/// A scene with `num_actors` others on three lanes; `rng` moves them a little.
world::Scene crowd(const manoeuvre::Car& car, int num_actors, std::mt19937& rng) {
  std::uniform_real_distribution<double> u(-1.0, 1.0);
  world::Scene scene;
  scene.ego.v_B = {20.0 + u(rng), 0.0};
  scene.ego_footprint = manoeuvre::footprint(car);
  scene.ego_mass = car.mass;
  for (int i = 0; i < num_actors; ++i) {
    world::Actor actor{.id = static_cast<std::uint8_t>(i + 1),
                       .footprint = {.length = 4.5, .width = 1.8},
                       .mass = 1'500.0};
    const int lane = (i + 1) % 3 - 1;  // the first is in the ego's own
    const int row = i / 3;
    actor.X_WA.p = {16.0 + 9.0 * row + 5.0 * u(rng), 3.5 * lane + 0.5 * u(rng)};
    actor.v_W = {11.0 + 4.0 * u(rng), 0.3 * u(rng)};
    scene.actors.push_back(actor);
  }
  return scene;
}

void bench_decide(const Inputs& inputs, const atlas::Atlas& atlas, Clock& clock, int num_calls,
                  json& figures) {
  for (const int num_actors : {1, 8, 32}) {
    for (const bool followed : {false, true}) {
      const auto scenes = scenes_of(inputs.car, num_actors, followed);
      const std::string suffix =
          fmt::format(".actors{}{}", num_actors, followed ? ".followed" : "");
      bench_reflex(inputs, atlas, clock, num_calls, scenes, suffix, figures);

      reflex::AtlasJudge judge(inputs.car, atlas, inputs.harm);
      const auto judged = [&](std::size_t call) {
        const Clock::Time start = clock.now();
        (void)judge.judge(scenes[call % scenes.size()]);
        return since(clock, start);
      };
      add_percentiles("decide.atlas_judge_us", suffix,
                      times_of(clock, std::min(num_calls, 10'000), judged), figures);

      const arbitration::Forecaster forecaster({&inputs.car, &inputs.harm, &atlas});
      const auto forecast = [&](std::size_t call) {
        const world::Scene& scene = scenes[call % scenes.size()];
        const intent::Beliefs beliefs = intent::beliefs_at_sight(inputs.intent, scene);
        const Clock::Time start = clock.now();
        (void)forecaster.judge(scene, beliefs);
        return since(clock, start);
      };
      add_percentiles("decide.verdict_us", suffix,
                      times_of(clock, std::min(num_calls, 500), forecast), figures);
    }
  }
}

}  // namespace saca::app
