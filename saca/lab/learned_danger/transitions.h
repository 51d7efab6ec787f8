#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "saca/base/world/footprint.h"
#include "saca/lab/learned_danger/behaviour.h"
#include "saca/lab/learned_danger/draws.h"
#include "saca/lab/learned_danger/network.h"
#include "saca/lab/learned_danger/state.h"
#include "saca/onboard/manoeuvre/car.h"
#include "saca/onboard/manoeuvre/demand.h"
#include "saca/thinking/danger/danger.h"

namespace saca::learned_danger {

/// What a data set is made of. Part of its file, and of what it is resumed by.
struct Mixture {
  int looks = 40;           ///< in a drive of the ego
  int situations = 10;      ///< obstacles that a drive is seen beside: the first is driven for, the
                            ///< others are put there afterwards (relabelled)
  double near_share = 0.5;  ///< of the situations, that start within 2 m of the boundary
  /// All drives by the network's Q, without noise, to the end: what its policy comes to (`reached`
  /// of Experience). The behaviours do not count then.
  bool outcomes = false;
  /// Of the drives, in the order of Behaviour.
  std::array<double, num_behaviours> behaviours{0.25, 0.2, 0.25, 0.3};
};

/// That of outcomes: drives of up to 12 s, one situation each.
[[nodiscard]] inline Mixture mixture_of_outcomes() {
  return {.looks = 120, .situations = 1, .outcomes = true};
}

/// One look: x, u, h and x'.
struct Transition {
  Observation observation{};
  manoeuvre::Demand demand;
  double h = 0.0;
  Observation next_observation{};
  double next_h = 0.0;
  bool is_settled = false;
  bool is_cut_off = false;
};

/// Many transitions, one after another, those of a situation in sequence. Each array has a row for
/// each.
struct Transitions {
  std::vector<float> observations;       ///< x: rows of num_features
  std::vector<float> next_observations;  ///< x', `look_step` later
  std::vector<float> actions;            ///< u: rows of 2, along and across (manoeuvre::Demand)
  /// The deepest intrusion from x to x', both ends included [m]: what Q(x, u) is at least.
  std::vector<float> h;
  std::vector<float> next_h;   ///< at x' [m]
  std::vector<float> settled;  ///< 1: nothing can happen after x' any more; V(x') is next_h
  std::vector<float> cut_off;  ///< 1: the drive ended at x', the situation not
  std::vector<float> drive;    ///< number of the ego's drive in this part
  std::size_t drives = 0;      ///< of the ego that are in there
  std::size_t near = 0;        ///< situations that start near the boundary
  std::size_t situations = 0;

  [[nodiscard]] std::size_t size() const { return h.size(); }
  /// Adds a row to each array, of the drive with the number `drives`.
  void add(const Transition& one);
};

/// How many drives are made, and from what.
struct DriveDraws {
  int count = 0;  ///< >= 1
  std::uint64_t seed = 1;
};

/// Drives and what they meet, from a seed: a part of a data set. The same seed, the same bytes.
///
/// A drive: grip between 0.2 and 1, a drawn start, one to three obstacles, a behaviour. Where it is
/// told how to evade (Behaviour::evasion), it looks for the demand after which the first obstacle's
/// `model` value is least (danger::by_look_ahead), by the best arc where no table has it, and by
/// the least Q where there is a network. Beside each other situation the drive is seen from one of
/// its looks on. A situation ends when it is settled, or with the drive.
/// @param body   of the ego, about its centre of mass
/// @param model  of the car, of any tables
/// @param network  learnt from an earlier data set; nullptr: none
/// @throws ContractViolation  if a number of the mixture is out of range, or outcomes are wanted of
///                            no network
[[nodiscard]] Transitions made_transitions(const manoeuvre::Car& car, const world::Footprint& body,
                                           const danger::DangerModel& model, const Mixture& mixture,
                                           const DriveDraws& draws,
                                           const Network* network = nullptr);

}  // namespace saca::learned_danger
