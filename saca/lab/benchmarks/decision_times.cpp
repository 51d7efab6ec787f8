#include "saca/lab/benchmarks/decision_times.h"

#include <fmt/core.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "saca/base/core/percentile.h"
#include "saca/lab/benchmarks/crowd.h"
#include "saca/onboard/match/similarity.h"
#include "saca/onboard/reflex/atlas_judge.h"
#include "saca/onboard/reflex/reflex_plane.h"
#include "saca/thinking/arbitration/forecaster.h"
#include "saca/thinking/intent/observer.h"

namespace saca::benchmarks {
namespace {

using nlohmann::json;

constexpr double longest = 4.0;  // [s] of the machine's, that one figure is measured for

/// What is measured in which scenes.
struct Measurement {
  const std::vector<world::Scene>* scenes = nullptr;
  std::string suffix;  ///< behind the names of the figures
  const Clock* clock = nullptr;
  int num_calls = 0;
};

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

/// Scenes, and the names of their figures behind those of what is measured.
struct Scenes {
  std::vector<world::Scene> all;
  std::string suffix;
};

/// One step: six plans and, where there is one, a verdict received, threats looked for, and where
/// the scene triggers, matched and decided.
/// @param verdict  nullopt: none is there, and the plane makes its own
/// @param names    behind those of the figures
/// @return         times [us]
std::vector<double> reflex_times(const DecisionTools& tools, const Measurement& work,
                                 const std::optional<reflex::Verdict>& verdict,
                                 const std::string& names, json& figures) {
  const std::vector<world::Scene>& scenes = *work.scenes;
  reflex::PlanCache plans;
  for (std::size_t i = 0; i < reflex::PlanCache::capacity(); ++i) {
    plans.push_back({.at_trigger = match::features(scenes[i]),
                     .plan = {manoeuvre::PolicyId::aes_left, std::nullopt}});
  }
  int num_triggered = 0;
  int num_judged = 0;
  const auto step = [&](std::size_t call) {
    reflex::ReflexPlane plane(
        {.car = tools.car, .atlas = reflex::AtlasJudge(*tools.car, *tools.atlas, *tools.harm)});
    const Clock::Time start = work.clock->now();
    plane.receive(plans);
    if (verdict) {
      plane.receive(*verdict);
    }
    num_triggered += plane.step(scenes[call % scenes.size()]).triggered ? 1 : 0;
    const double time = since(*work.clock, start);
    num_judged += plane.decision() && plane.decision()->by_atlas ? 1 : 0;
    return time;
  };
  std::vector<double> times = times_of(*work.clock, work.num_calls, step);
  add_percentiles("decide.reflex_us", names, times, figures);
  const auto count = static_cast<double>(times.size());
  figures["decide.reflex_us.triggered_share" + names] = num_triggered / count;
  figures["decide.reflex_us.judged_share" + names] = num_judged / count;
  return times;
}

void add_reflex_times(const DecisionTools& tools, const Measurement& work, json& figures) {
  reflex::AtlasJudge judge(*tools.car, *tools.atlas, *tools.harm);
  const auto verdict = judge.judge(work.scenes->front());
  (void)reflex_times(tools, work, verdict, ".fresh" + work.suffix, figures);
  const std::vector<double> alone = reflex_times(tools, work, std::nullopt, work.suffix, figures);
  add_percentiles("decide.machine_us", work.suffix,
                  machine_times(*work.clock, percentile(alone, 0.5), work.num_calls), figures);
}

void add_judge_times(const DecisionTools& tools, const Measurement& work, json& figures) {
  reflex::AtlasJudge judge(*tools.car, *tools.atlas, *tools.harm);
  const auto judged = [&](std::size_t call) {
    const Clock::Time start = work.clock->now();
    (void)judge.judge((*work.scenes)[call % work.scenes->size()]);
    return since(*work.clock, start);
  };
  add_percentiles("decide.atlas_judge_us", work.suffix,
                  times_of(*work.clock, std::min(work.num_calls, 10'000), judged), figures);
}

void add_verdict_times(const DecisionTools& tools, const Measurement& work, json& figures) {
  const arbitration::Forecaster forecaster({tools.car, tools.harm, tools.atlas});
  const auto forecast = [&](std::size_t call) {
    const world::Scene& scene = (*work.scenes)[call % work.scenes->size()];
    const intent::Beliefs beliefs = intent::beliefs_at_sight(*tools.intent, scene);
    const Clock::Time start = work.clock->now();
    (void)forecaster.judge(scene, beliefs);
    return since(*work.clock, start);
  };
  add_percentiles("decide.verdict_us", work.suffix,
                  times_of(*work.clock, std::min(work.num_calls, 500), forecast), figures);
}

}  // namespace

json decision_times(const DecisionTools& tools, const Clock& clock, int num_calls) {
  json figures;
  for (const int num_actors : {1, 8, 32}) {
    for (const bool followed : {false, true}) {
      std::vector<world::Scene> scenes = crowds(*tools.car, num_actors);
      if (followed) {
        follow_ego(scenes);
      }
      const Measurement work{
          .scenes = &scenes,
          .suffix = fmt::format(".actors{}{}", num_actors, followed ? ".followed" : ""),
          .clock = &clock,
          .num_calls = num_calls};
      add_reflex_times(tools, work, figures);
      add_judge_times(tools, work, figures);
      add_verdict_times(tools, work, figures);
    }
  }
  return figures;
}

}  // namespace saca::benchmarks
