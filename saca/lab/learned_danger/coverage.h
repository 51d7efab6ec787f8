#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "saca/base/world/footprint.h"
#include "saca/lab/learned_danger/net_inputs.h"
#include "saca/lab/learned_danger/transitions.h"
#include "saca/onboard/manoeuvre/demand.h"
#include "saca/thinking/danger/avoidance.h"
#include "saca/thinking/danger/danger.h"

/// Whether a data set holds the inputs that matter: V_h cannot be learnt where nobody did what is
/// best.
namespace saca::learned_danger {

/// Of states at like speeds on like grip, beside one obstacle, within 2 m of the boundary.
struct Coverage {
  double slowest = 0.0;  ///< [m/s]
  double fastest = 0.0;
  double least_grip = 0.0;
  double most_grip = 0.0;
  std::size_t states = 0;  ///< whose best input was looked for
  std::size_t others = 0;  ///< among which it was looked for
  /// Distance from the best demand to the nearest of what was done in the `num_alike` states most
  /// alike, on the unit disc of demands: over the states.
  double median = 0.0;
  double p90 = 0.0;
};

/// Goes through a data set, part by part.
class CoverageSurvey {
 public:
  static constexpr std::size_t speeds = 4;      ///< bins of 10 m/s
  static constexpr std::size_t grips = 4;       ///< bins of 0.2, from 0.2 on
  static constexpr std::size_t num_alike = 32;  ///< by what the networks read of them

  /// @param limits  of the car
  /// @param body    of the ego, about its centre of mass
  /// @param model   with the tables that know the best input
  /// @param states  of a bin whose best inputs are looked for, at most
  /// @param others  likewise, among which
  CoverageSurvey(const danger::Avoidance& limits, const world::Footprint& body,
                 const danger::DangerModel& model, std::size_t states, std::size_t others);

  /// The states of each tenth drive ask, those of the others answer.
  void add(const Transitions& part);
  /// Whether no more is wanted.
  [[nodiscard]] bool is_full() const;
  /// Of the bins that have both, the slow ones and the slippery ones first.
  [[nodiscard]] std::vector<Coverage> figures(int threads) const;

 private:
  struct Row {
    NetInputs inputs;
    manoeuvre::Demand demand;  ///< the best one of who asks, else what was done
  };
  struct Bin {
    std::vector<Row> asks;
    std::vector<Row> answers;
  };
  [[nodiscard]] static double nearest(const Row& asks, const std::vector<Row>& answers);

  danger::Avoidance limits_;
  world::Footprint body_;
  const danger::DangerModel& model_;
  std::size_t states_;
  std::size_t others_;
  std::array<Bin, speeds * grips> bins_;
};

}  // namespace saca::learned_danger
