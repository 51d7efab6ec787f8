#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <vector>

#include "saca/lab/verification/authors_network.h"
#include "saca/thinking/danger/value_table.h"

/// The network that the paper's authors published beside a solved value.
namespace saca::verification {

/// How two values agree about what is unsafe (>= 0), counted over states. "False" is the network's
/// answer, as judged by the solved value.
struct Agreement {
  std::size_t states = 0;
  std::size_t unsafe = 0;       ///< by the solved value
  std::size_t false_safe = 0;   ///< unsafe, and the network says safe
  std::size_t false_alarm = 0;  ///< safe, and the network says unsafe

  [[nodiscard]] double sign_agreement() const;     ///< share of all states; 1 of none
  [[nodiscard]] double false_safe_share() const;   ///< of the unsafe states; 0 of none
  [[nodiscard]] double false_alarm_share() const;  ///< of the safe states; 0 of none
};

struct AuthorsComparison {
  struct AtSpeed {
    double speed = 0.0;  ///< [m/s]
    Agreement agreement;
    double mean_solved = 0.0, mean_network = 0.0;  ///< of the values [m]
  };
  Agreement all;
  std::vector<AtSpeed> by_speed;
  std::size_t outside = 0;  ///< states that the table does not hold: left out
};

/// Over all states of `in_authors_range` on an even lattice: each metre in x and y, each 5 deg of
/// yaw to either side, each m/s.
///
/// @param solved   of x [m], y [m], course [rad], speed [m/s] relative to an obstacle at rest; the
///                 course stands for the yaw, as the solved car does not slip
/// @param network  values of such states [m]: the authors', or any other that is to stand beside it
[[nodiscard]] AuthorsComparison compare_with_authors(
    const danger::ValueAt& solved,
    const std::function<std::vector<double>(std::span<const AuthorsState>)>& network);
[[nodiscard]] AuthorsComparison compare_with_authors(const danger::ValueAt& solved,
                                                     const AuthorsNetwork& network);

}  // namespace saca::verification
