#pragma once

#include <optional>

#include "saca/lab/encounter/method.h"
#include "saca/lab/eval/lane_view.h"

namespace saca::eval {

// Drivers and braking systems as UN R157 (automated lane keeping) and the Joint Research Centre of
// the European Commission publish them. Numbers: UN R157, paragraph 5.2.5.2 and annex 3, and JRC's
// reference implementation (github.com/ec-jrc/JRC-FSM, utility/vehicle.py and models.py). All see
// lanes: somebody ahead whose path overlaps the ego's, and how fast it closes.

/// Brakes once a risk has stood for its reaction time, until rest; the braking builds up with a
/// jerk.
class Reacting {
 public:
  /// @param reaction  from the risk to the first braking [s]
  /// @param jerk      [m/s^3]; infinite: at once
  /// @param most      largest deceleration [m/s^2]
  Reacting(double reaction, double jerk, double most)
      : reaction_(reaction), jerk_(jerk), most_(most) {}

  /// @param risk  is there one now? Once there was, the reaction runs its course
  [[nodiscard]] std::optional<encounter::Action> step(double time, bool risk);

 private:
  double reaction_;
  double jerk_;
  double most_;
  std::optional<double> seen_;  ///< when the risk was [s]
  double asked_ = 0.0;          ///< deceleration [m/s^2]
};

/// The rule of paragraph 5.2.5.2 for systems: the time to collision of who is in the lane, or
/// within 0.5 m of the ego's path, is not above closing speed / (2 x 6 m/s^2) + 0.35 s. Then 6
/// m/s^2, 0.35 s later.
class R157Braking final : public encounter::Method {
 public:
  [[nodiscard]] std::optional<encounter::Action> step(const encounter::View& view) override;

 private:
  Reacting reacting_{0.35, std::numeric_limits<double>::infinity(), 6.0};
};

/// The competent and careful driver of annex 3: sees the risk at a time to collision of 2 s, takes
/// 0.75 s, then brakes with 12.65 m/s^3 up to 0.774 g. Until then it holds its speed, where JRC's
/// driver has left the accelerator and loses 0.4 m/s^2.
class CompetentDriver final : public encounter::Method {
 public:
  [[nodiscard]] std::optional<encounter::Action> step(const encounter::View& view) override;

 private:
  Reacting reacting_{0.75, 12.65, 0.774 * 9.81};
};

/// How unsafe the distance to who is ahead is, both in [0, 1].
struct FuzzySurrogates {
  double proactive = 0.0;  ///< PFS: should the other brake as hard as it can
  double critical = 0.0;   ///< CFS: as both move now
};

/// @param gap           [m]
/// @param speed         of who follows [m/s]
/// @param ahead         likewise of who is ahead
/// @param acceleration  of who follows [m/s^2]
///
/// Source: K. Mattas et al., Fuzzy surrogate safety metrics for real-time assessment of rear-end
/// collision risk, Accident Analysis and Prevention 148 (2020) 105794.
[[nodiscard]] FuzzySurrogates fuzzy_surrogates(double gap, double speed, double ahead,
                                               double acceleration);

/// JRC's fuzzy safety model: once one of the two surrogates has been above 0 for 0.75 s, all in
/// all, it brakes as hard as they say; it lets go when both are 0 again. It reacts once: a risk
/// that comes back is braked for at once, from the deceleration that it had last.
class FuzzySafety final : public encounter::Method {
 public:
  [[nodiscard]] std::optional<encounter::Action> step(const encounter::View& view) override;

 private:
  int looks_ = 0;       ///< at a risk, until it has reacted
  double asked_ = 0.0;  ///< deceleration [m/s^2]
  bool brakes_ = false;
};

}  // namespace saca::eval
