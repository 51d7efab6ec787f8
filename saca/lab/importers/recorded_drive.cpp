#include "saca/lab/importers/recorded_drive.h"

#include <algorithm>
#include <cmath>

#include "saca/base/core/contract.h"
#include "saca/lab/scenario/motion.h"

namespace saca::importers {
namespace {

constexpr double look = 0.02;  // [s]

/// Who touches the ego at that time.
std::optional<std::size_t> touched(const scenario::Scenario& scenario, const world::Footprint& ego,
                                   const Pose& X_WB, double time) {
  for (std::size_t i = 0; i < scenario.actors.size(); ++i) {
    const scenario::ScenarioActor& actor = scenario.actors[i];
    const auto* recording = std::get_if<scenario::Recording>(&actor.motion);
    if (recording == nullptr || actor.ghost || time < recording->front().time ||
        time > recording->back().time) {
      continue;
    }
    const Pose X_WA = scenario::actor_pose(scenario, i, time, {});
    if (world::separation(ego, X_WB, actor.footprint, X_WA).distance <= 0.0) {
      return i;
    }
  }
  return std::nullopt;
}

void note_departure(const world::Road& road, const world::Footprint& ego, const Pose& X_WB,
                    double time, std::optional<RecordedDeparture>& departure) {
  for (const collision::Side side : {collision::Side::left, collision::Side::right}) {
    const double beyond = -collision::edge_clearance(road, side, ego, X_WB);
    if (beyond > 0.0 && !departure) {
      departure = RecordedDeparture{time, side, beyond};
    } else if (beyond > 0.0 && departure->side == side) {
      departure->beyond = std::max(departure->beyond, beyond);
    }
  }
}

}  // namespace

RecordedDrive recorded_drive(const scenario::Scenario& scenario, const world::Footprint& ego) {
  const auto* recording = std::get_if<scenario::Recording>(&scenario.ego);
  expects(recording != nullptr && recording->size() >= 2,
          "the ego has a recording of two samples or more");
  RecordedDrive drive;
  const auto num_looks = static_cast<std::size_t>(std::floor(recording->back().time / look + 1e-6));
  for (std::size_t k = 0; k <= num_looks; ++k) {
    const double time = static_cast<double>(k) * look;
    const Pose X_WB = scenario::ego_at(scenario, time).X_WB;
    if (const auto actor = touched(scenario, ego, X_WB, time)) {
      drive.touch = RecordedTouch{time, *actor};
      break;
    }
    note_departure(scenario.road, ego, X_WB, time, drive.departure);
  }
  return drive;
}

}  // namespace saca::importers
