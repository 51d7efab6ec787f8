#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "saca/lab/importers/hundred_car.h"

namespace saca::importers {

// What the study says in words, as numbers of ours: every one an assumption, told in the notes.

/// Width of a lane: 12 ft. Source: AASHTO, A Policy on Geometric Design of Highways and Streets:
/// the usual width on the study's kind of roads. The study measured none that could be trusted.
constexpr double assumed_lane_width = 3.66;

/// Size and mass of a body of a type that the study names; typical of such vehicles on US roads
/// about 2003, not measured.
struct AssumedBody {
  world::ActorKind kind = world::ActorKind::car;
  double length = 0.0;  ///< [m]
  double width = 0.0;   ///< [m]
  double mass = 0.0;    ///< [kg]
};
[[nodiscard]] AssumedBody assumed_body(std::string_view type);

/// Friction coefficient of a surface condition. Source: J. Y. Wong, Theory of Ground Vehicles,
/// table of average peak values (Taborek 1957): asphalt dry 0.8-0.9, wet 0.5-0.7, hard snow 0.2,
/// ice 0.1.
[[nodiscard]] double assumed_grip(std::string_view surface);

/// Lanes to the left of the ego's, which is taken to be the right-most one.
struct LanesAround {
  int left = 0;
  bool divided = false;        ///< a median or barrier ends the road on the left
  bool oncoming_left = false;  ///< the next lane is oncoming traffic's
};
[[nodiscard]] LanesAround lanes_around(const recordings::HundredCarEvent& event);

/// Whether the other was ahead or behind, says the study.
[[nodiscard]] bool is_rear_end(const recordings::HundredCarEvent& event);
/// Whether it was behind and ran, or nearly ran, into the ego.
[[nodiscard]] bool is_struck(const recordings::HundredCarEvent& event);

/// Whether the driver's manoeuvre before the conflict takes the car out of a lane: a change of
/// lanes, merging, passing, turning, parking, backing. Source: Researcher Dictionary for Video
/// Reduction Data, version 1.3, pre-event manoeuvre.
[[nodiscard]] bool leaves_lane(const recordings::HundredCarEvent& event);

/// Whether the study says that the driver steered to the right, and counts two lanes or more of his
/// direction: all lanes, or half of them where the road is not divided. Then he may have been in
/// the second lane from the right.
[[nodiscard]] bool may_steer_into_right_lane(const recordings::HundredCarEvent& event);

/// A number with so many decimals, for people.
[[nodiscard]] std::string shown(double value, int decimals);

/// What was measured of the driver's braking.
struct DriverAction {
  double deceleration = 0.0;         ///< the largest, of the smoothed speed [m/s^2], >= 0
  double hardest_time = 0.0;         ///< when [s]
  std::optional<double> brake_time;  ///< when the brake lights came on for it [s]
};

/// Fills the scenario's texts: name, title, source, licence, driver, notes, car.
void describe(scenario::Scenario& scenario, const recordings::HundredCarEvent& event,
              const HundredCarRequest& request, const HundredCarReport& report,
              const DriverAction& action);

/// Where the event's data lie.
struct HundredCarFiles {
  std::vector<std::filesystem::path> series;  ///< to be tried in turn
  std::filesystem::path table;
  std::string problem;  ///< what was not found, in words; empty when all is well
};
[[nodiscard]] HundredCarFiles find_hundred_car_files(const std::filesystem::path& path,
                                                     std::int64_t event);

}  // namespace saca::importers
