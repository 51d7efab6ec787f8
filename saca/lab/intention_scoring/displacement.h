#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "saca/lab/intention_scoring/score.h"
#include "saca/lab/intention_scoring/sequence.h"
#include "saca/thinking/intent/motion.h"

namespace saca::intention_scoring {

/// How far ahead places are compared [s].
constexpr std::array<std::size_t, 3> seconds_ahead{1, 2, 3};

/// Ways to say where a vehicle will be.
enum class Foresight : std::uint8_t {
  constant_velocity,  ///< goes on with its speed, along the lane and across it
  lane_keeping,       ///< with its speed, straight along the lane
  likeliest,          ///< intent::motion_under the likeliest intention now
  expected,           ///< mean place over all intentions, by their probabilities
};
constexpr std::size_t num_foresights = 4;

/// Distances between where it was said to be and where it was.
struct Displacement {
  std::size_t num = 0;
  double sum = 0.0;      ///< [m]
  double squares = 0.0;  ///< [m^2]

  void add(double distance);
  Displacement& operator+=(const Displacement& other);
  [[nodiscard]] double mean() const;  ///< 0 when there is none
  [[nodiscard]] double rms() const;
};

/// [foresight][second ahead]; over all vehicles in lanes every half a second, and over those only
/// that do not just maintain.
struct Displacements {
  using Table = std::array<std::array<Displacement, seconds_ahead.size()>, num_foresights>;
  Table all{};
  Table acting{};

  Displacements& operator+=(const Displacements& other);
};

/// In the lane's coordinates, as the sequence shows them: the way along is the integral of its
/// speed. Frames whose lane is lost within 3 s are left out.
[[nodiscard]] Displacements displacements(const Sequence& sequence, const Forecasts& forecasts,
                                          const intent::MotionLaw& law);

}  // namespace saca::intention_scoring
