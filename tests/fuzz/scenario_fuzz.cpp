#include <cstddef>
#include <cstdint>
#include <string_view>

#include "saca/lab/scenario/motion.h"
#include "saca/lab/scenario/scenario.h"
#include "saca/lab/sim/traffic.h"

// Whatever a scenario file holds: it is refused with a message, or it can be played, and comes back
// the same from its own writing. A broken promise traps.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  namespace scenario = saca::scenario;
  namespace sim = saca::sim;
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  const auto first = scenario::read_scenario(text, "fuzz.toml");
  if (!first.has_value()) {
    if (first.error().message.rfind("fuzz.toml:", 0) != 0) {
      __builtin_trap();
    }
    return 0;
  }
  const scenario::Scenario& drawn = first.value();
  const std::string written = scenario::write_scenario(drawn);
  const auto second = scenario::read_scenario(written, "fuzz.toml");
  if (!second.has_value() || scenario::write_scenario(second.value()) != written) {
    __builtin_trap();
  }
  for (const double time : {0.0, 0.05, drawn.duration}) {
    if (!saca::is_finite(scenario::ego_at(drawn, time).X_WB)) {
      __builtin_trap();
    }
  }
  const sim::Traffic traffic(drawn);
  const saca::manoeuvre::EgoMotion ego{.track = {.X_WA = {scenario::ego_at(drawn, 0.0).X_WB}},
                                       .v_B = {saca::Vec2{}},
                                       .yaw_rate = {0.0}};
  const double until = drawn.duration < 1.0 ? drawn.duration : 1.0;
  for (const auto& track : traffic.against(ego, scenario::standard_ego, until)) {
    for (const saca::Pose& X_WA : track.X_WA) {
      if (!saca::is_finite(X_WA)) {
        __builtin_trap();
      }
    }
  }
  for (std::size_t i = 0; i < drawn.actors.size(); ++i) {
    if (scenario::reacts(drawn.actors[i])) {
      continue;
    }
    for (const saca::Pose& X_WA : scenario::actor_track(drawn, i, drawn.duration / 16.0).X_WA) {
      if (!saca::is_finite(X_WA)) {
        __builtin_trap();
      }
    }
  }
  return 0;
}
