#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "saca/base/world/footprint.h"
#include "saca/thinking/danger/avoidance_case.h"
#include "saca/thinking/danger/value_table.h"

namespace saca::danger {

/// The ego and one obstacle that keeps its velocity, as the avoidance problem sees them.
struct Meeting {
  world::Footprint ego;         ///< about its centre of mass
  world::Footprint obstacle;    ///< about its own centre: centre_x is not used
  double grip = 0.9;            ///< of the road, in (0, 1.5]
  double obstacle_speed = 0.0;  ///< along its x, >= 0 [m/s]
  State state{};                ///< x, y, course, speed of the ego in the obstacle's frame
};

/// What a meeting does not say of how the bodies move: the avoidance problem has nothing of it.
struct Motion {
  double sideslip = 0.0;               ///< of the ego: its course less its heading [rad]
  double yaw_rate = 0.0;               ///< likewise [rad/s]
  Vec2 a_B;                            ///< likewise [m/s^2]
  double obstacle_acceleration = 0.0;  ///< along its x [m/s^2]
  double obstacle_curvature = 0.0;     ///< of its way [1/m]
};

/// V_h as something else knows it that was learnt (learned_danger/learned.h), so that what it tells
/// safe is safe but for rare exceptions [m]; nullopt: it does not know about such a meeting.
using LearnedValue = std::function<std::optional<double>(const Meeting&, const Motion&)>;

/// V_h of a meeting (eq. 1 of the paper).
struct Danger {
  double value = 0.0;  ///< how deep the best evasion still runs into the obstacle, its known error
                       ///< added [m]; less than 0: minus the room by which it misses
  bool exact = false;  ///< read from a solved table; else learnt, or the best of a few evasions:
                       ///< no evasion need be worse, the best may be better
};

/// A solved avoidance problem: one obstacle at one speed.
struct DangerTable {
  world::Footprint obstacle;
  double obstacle_speed = 0.0;
  View view = View::obstacle;  ///< View::ego, or this: the axes of `values`
  std::shared_ptr<const ValueTable> values;
};

/// By how much two bodies about their own centres differ: what each reaches beyond the other [m].
[[nodiscard]] double misfit(const world::Footprint& a, const world::Footprint& b);

/// How dangerous obstacles are to one car, by solved tables where there are any.
///
/// Tables of one grip serve all lower ones (`scaled_to`), at speeds up to theirs times
/// sqrt(grip / theirs); more grip is taken as theirs. Between two obstacle speeds values are
/// interpolated. A body that reaches beyond that of the table by d adds d to the value: it lies
/// within the table's body grown by d, and a value shifts as its h does. Beyond a table's ends, or
/// without one, what was learnt answers; where it does not know, a few constant inputs are followed
/// to the end, and straight on and braking until a table takes over. All are evasions, so V_h is at
/// most the best of them, which is told.
class DangerModel {
 public:
  /// @param car     limits of the car; its grip is that of the tables
  /// @param ego     the tables' ego
  /// @param tables   of any obstacles and speeds, in any order; may be none
  /// @param learned  of the same car; may be none
  /// @throws ContractViolation  if a table is not over four axes, or a number is out of range
  DangerModel(const Avoidance& car, const world::Footprint& ego, std::vector<DangerTable> tables,
              LearnedValue learned = {});

  /// @throws ContractViolation  if a number of the meeting is not finite, a size not > 0, or the
  ///                            grip or a speed out of range
  [[nodiscard]] Danger danger(const Meeting& meeting, const Motion& motion = {}) const;

  /// The same without evasions, in microseconds: read from a table, else learnt; nullopt: neither
  /// has this meeting.
  [[nodiscard]] std::optional<double> known(const Meeting& meeting,
                                            const Motion& motion = {}) const;

  /// Read from a table, in about a microsecond; nullopt: no table has this meeting.
  [[nodiscard]] std::optional<double> exact(const Meeting& meeting) const;

 private:
  /// Tables of one obstacle, by rising speed.
  using Family = std::vector<DangerTable>;

  [[nodiscard]] const Family* family_for(const world::Footprint& obstacle) const;
  /// The highest h of the best of a few evasions [m].
  [[nodiscard]] double by_few_evasions(const Meeting& meeting) const;

  Avoidance car_;
  world::Footprint ego_;
  std::vector<Family> families_;
  LearnedValue learned_;
};

}  // namespace saca::danger
