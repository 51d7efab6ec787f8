#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "saca/base/core/pose.h"
#include "saca/base/world/scene.h"
#include "saca/thinking/danger/danger.h"

namespace saca::encounter {

struct Record;

/// V_h of one actor over the places where the ego's centre of mass could be, at the course and
/// speed that it has: where no evasion would help any more, and by how much one would elsewhere.
///
/// Frame M: at the obstacle's centre, x where the ego comes from; it moves with the actor.
struct DangerMap {
  double time = 0.0;       ///< [s]
  double ego_speed = 0.0;  ///< [m/s]
  double ego_yaw = 0.0;    ///< the ego's course, in W [rad]
  Pose X_AM;               ///< M in the actor's body frame
  Vec2 first_M;            ///< of the first point [m]
  double step = 1.0;       ///< between points, in x and in y [m]
  int columns = 0;
  int rows = 0;
  std::vector<std::optional<double>> values;  ///< row by row from the lowest y, x runs first [m];
                                              ///< nullopt: beyond the tables, or what was learnt

  /// In M.
  [[nodiscard]] Vec2 point(int column, int row) const {
    return first_M + Vec2{column * step, row * step};
  }
  [[nodiscard]] std::size_t index(int column, int row) const {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(columns) +
           static_cast<std::size_t>(column);
  }
};

/// The map of one instant, on about 1200 points around the actor and the ego, and from where it is
/// too late to swerve.
/// @return  nullopt when neither a table nor what was learnt holds the ego's own state
[[nodiscard]] std::optional<DangerMap> danger_map(const world::Scene& scene,
                                                  const world::Actor& actor,
                                                  const danger::DangerModel& model);

/// The maps of a run: one actor's.
struct DangerMaps {
  std::string actor;            ///< its name
  double interval = 0.25;       ///< for which each holds [s]
  std::vector<DangerMap> maps;  ///< by time, 1 to 16
};

/// Of the threat that set off the trigger; without one, or where nothing is known of it, of the
/// actor with the largest risk in the preview that the decision was made by, or else in the last
/// one. From T2 on, while the ego moves and its state is known. In the true scenes, on the true
/// grip: a map tells what could be avoided, not what SACA took for avoidable.
/// @return  nullopt when there is no such actor or no such instant
[[nodiscard]] std::optional<DangerMaps> danger_maps(const Record& record,
                                                    const danger::DangerModel& model);

}  // namespace saca::encounter
