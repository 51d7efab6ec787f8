#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "saca/sim/traffic_recording.h"

namespace {

namespace sim = saca::sim;
namespace traffic = saca::traffic;

void require(bool promise) {
  if (!promise) {
    __builtin_trap();
  }
}

void check(const traffic::CommonRoad& file) {
  require(!file.lanelets.empty() && file.time_step > 0.0);
  for (const traffic::Lanelet& lanelet : file.lanelets) {
    require(lanelet.left_W.size() >= 2 && lanelet.left_W.size() == lanelet.right_W.size());
    for (const std::int64_t id : lanelet.successors) {
      require(traffic::find_lanelet(file, id) != nullptr);
    }
  }
  for (const traffic::Obstacle& obstacle : file.obstacles) {
    require(!obstacle.states.empty() && obstacle.footprint.length > 0.0);
    for (const traffic::ObstacleState& state : obstacle.states) {
      require(saca::is_finite(state.X_WO) && std::isfinite(state.speed) && state.step >= 0);
    }
  }
}

/// A scenario that was made is one that can be read.
void check(const traffic::CommonRoad& file, const sim::TrafficRequest& request) {
  const auto made = sim::traffic_scenario(file, request);
  if (made.has_value()) {
    require(sim::read_scenario(sim::write_scenario(made.value().scenario), "made").has_value());
  }
}

}  // namespace

// Whatever an XML file holds: it is refused with a message, or it is whole, and what is made of it
// is a scenario. A broken promise traps.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  const auto file = traffic::read_commonroad(text, "fuzz.xml");
  if (!file.has_value()) {
    require(file.error().message.rfind("fuzz.xml:", 0) == 0);
    return 0;
  }
  check(file.value());
  check(file.value(), {});
  for (const traffic::Obstacle& obstacle : file.value().obstacles) {
    check(file.value(), {.ego = obstacle.id});
    check(file.value(), {.ego = obstacle.id, .from = 0.35});
  }
  return 0;
}
