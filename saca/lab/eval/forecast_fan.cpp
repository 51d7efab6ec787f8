#include "saca/lab/eval/forecast_fan.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "saca/thinking/intent/likely_motions.h"

namespace saca::eval {
namespace {

using world::Actor;
using world::Scene;
using world::Track;

Result<std::size_t> index_of(const Scene& seen, std::string_view who) {
  std::string names;
  for (std::size_t i = 0; i < seen.actors.size(); ++i) {
    const std::string name = world::actor_name(seen.actors[i]);
    if (name == who) {
      return i;
    }
    names += (names.empty() ? "" : ", ") + name;
  }
  return Error{Error::Code::out_of_range,
               fmt::format("want somebody who is perceived at {:g} s: {}, got \"{}\"", seen.time,
                           names.empty() ? "nobody is" : names, who)};
}

/// Adds where each actor of `seen` is in the true scene; who is not there stays where it was.
void keep(const Scene& truth, const Scene& seen, ForecastFan& fan) {
  fan.ego.X_WA.push_back(truth.ego.X_WB);
  for (std::size_t i = 0; i < seen.actors.size(); ++i) {
    const Actor& actor = seen.actors[i];
    const auto there = std::find_if(truth.actors.begin(), truth.actors.end(), [&](const Actor& a) {
      return a.kind == actor.kind && a.id == actor.id;
    });
    std::vector<Pose>& poses = fan.others[i].X_WA;
    poses.push_back(there != truth.actors.end() ? there->X_WA
                    : poses.empty()             ? actor.X_WA
                                                : poses.back());
  }
}

}  // namespace

Result<ForecastFan> forecast_fan(const encounter::Stage& stage, std::string_view who, double time) {
  constexpr double step = encounter::ClosedLoop::step;
  if (time < 0.0) {
    return Error{
        Error::Code::out_of_range,
        fmt::format("want an instant of the encounter, which begins at 0 s, got {:g} s", time)};
  }
  encounter::ClosedLoop loop(stage);
  std::optional<ForecastFan> fan;
  while (!loop.truth().over() &&
         (!fan || loop.time() < fan->seen.time + fan_horizon + 0.5 * step)) {
    if (auto problem = loop.look()) {
      return *std::move(problem);
    }
    if (!fan && loop.time() > time - 0.5 * step) {
      fan = ForecastFan{.seen = loop.seen()};
      const auto actor = index_of(fan->seen, who);
      if (!actor.has_value()) {
        return actor.error();
      }
      fan->actor = actor.value();
      const Actor& one = fan->seen.actors[fan->actor];
      for (const intent::LikelyMotion& motion :
           intent::likely_motions(fan->seen, one, loop.beliefs()[fan->actor])) {
        fan->ways.push_back(
            {motion.probability,
             intent::forecast_of(motion, fan->seen, one, fan_horizon, intent::MotionLaw{})});
      }
      const Track from_now{.start = fan->seen.time, .step = step, .X_WA = {}};
      fan->ego = from_now;
      fan->others.assign(fan->seen.actors.size(), from_now);
    }
    if (fan) {
      keep(loop.truth().whole_scene(), fan->seen, *fan);
    }
    loop.advance();
  }
  if (!fan) {
    return Error{Error::Code::out_of_range,
                 fmt::format("want an instant of the encounter, which ends at {:g} s, got {:g} s",
                             loop.time(), time)};
  }
  return *std::move(fan);
}

}  // namespace saca::eval
