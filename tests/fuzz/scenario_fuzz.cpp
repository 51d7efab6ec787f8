#include <cstddef>
#include <cstdint>
#include <string_view>

#include "saca/sim/motion.h"
#include "saca/sim/scenario.h"
#include "saca/sim/traffic.h"

// Whatever a scenario file holds: it is refused with a message, or it can be played, and comes back
// the same from its own writing. A broken promise traps.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  namespace sim = saca::sim;
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  const auto first = sim::read_scenario(text, "fuzz.toml");
  if (!first.has_value()) {
    if (first.error().message.rfind("fuzz.toml:", 0) != 0) {
      __builtin_trap();
    }
    return 0;
  }
  const sim::Scenario& scenario = first.value();
  const std::string written = sim::write_scenario(scenario);
  const auto second = sim::read_scenario(written, "fuzz.toml");
  if (!second.has_value() || sim::write_scenario(second.value()) != written) {
    __builtin_trap();
  }
  for (const double time : {0.0, 0.05, scenario.duration}) {
    if (!saca::is_finite(sim::ego_at(scenario, time).X_WB)) {
      __builtin_trap();
    }
  }
  const sim::Traffic traffic(scenario);
  const saca::manoeuvre::EgoMotion ego{.track = {.X_WA = {sim::ego_at(scenario, 0.0).X_WB}},
                                       .v_B = {saca::Vec2{}},
                                       .yaw_rate = {0.0}};
  const double until = scenario.duration < 1.0 ? scenario.duration : 1.0;
  for (const auto& track : traffic.against(ego, sim::standard_ego, until)) {
    for (const saca::Pose& X_WA : track.X_WA) {
      if (!saca::is_finite(X_WA)) {
        __builtin_trap();
      }
    }
  }
  for (std::size_t i = 0; i < scenario.actors.size(); ++i) {
    if (sim::reacts(scenario.actors[i])) {
      continue;
    }
    for (const saca::Pose& X_WA : sim::actor_track(scenario, i, scenario.duration / 16.0).X_WA) {
      if (!saca::is_finite(X_WA)) {
        __builtin_trap();
      }
    }
  }
  return 0;
}
