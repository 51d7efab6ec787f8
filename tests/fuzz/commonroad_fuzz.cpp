#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "saca/lab/importers/traffic_recording.h"
#include "saca/lab/recordings/recording_of_map.h"
#include "saca/lab/recordings/repeats.h"

namespace {

namespace importers = saca::importers;
namespace scenario = saca::scenario;
namespace recordings = saca::recordings;

void require(bool promise) {
  if (!promise) {
    __builtin_trap();
  }
}

void check(const recordings::CommonRoad& file) {
  require(!file.lanelets.empty() && file.time_step > 0.0);
  for (const recordings::Lanelet& lanelet : file.lanelets) {
    require(lanelet.left_W.size() >= 2 && lanelet.left_W.size() == lanelet.right_W.size());
    for (const std::int64_t id : lanelet.successors) {
      require(recordings::find_lanelet(file, id) != nullptr);
    }
  }
  for (const recordings::Obstacle& obstacle : file.obstacles) {
    require(!obstacle.states.empty() && obstacle.footprint.length > 0.0);
    for (const recordings::ObstacleState& state : obstacle.states) {
      require(saca::is_finite(state.X_WO) && std::isfinite(state.speed) && state.step >= 0);
    }
  }
}

/// What is packed of it breaks no rule of a set.
void check_set(const recordings::CommonRoad& file) {
  recordings::RecordedSet set;
  set.recordings.push_back(recordings::recording_of_map(file, "fuzz.xml", set.skipped));
  if (!set.recordings[0].vehicles.empty()) {
    recordings::name_groups(set);
    (void)recordings::drop_repeats(set);
    require(!recordings::broken_rule(set));
  }
}

/// A scenario that was made is one that can be read.
void check(const recordings::CommonRoad& file, const importers::TrafficRequest& request) {
  const auto made = importers::traffic_scenario(file, request);
  if (made.has_value()) {
    require(scenario::read_scenario(scenario::write_scenario(made.value().scenario), "made")
                .has_value());
  }
}

}  // namespace

// Whatever an XML file holds: it is refused with a message, or it is whole, and what is made of it
// is a scenario. A broken promise traps.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  const auto file = recordings::read_commonroad(text, "fuzz.xml");
  if (!file.has_value()) {
    require(file.error().message.rfind("fuzz.xml:", 0) == 0);
    return 0;
  }
  check(file.value());
  check_set(file.value());
  check(file.value(), {});
  for (const recordings::Obstacle& obstacle : file.value().obstacles) {
    check(file.value(), {.ego = obstacle.id});
    check(file.value(), {.ego = obstacle.id, .from = 0.35});
  }
  return 0;
}
