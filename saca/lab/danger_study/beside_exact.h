#pragma once

#include <string>
#include <vector>

#include "saca/base/core/result.h"
#include "saca/lab/learned_danger/network.h"
#include "saca/lab/learned_danger/point_mass.h"

namespace saca::danger_study {

/// What of a network beside the exact value is to be shown.
struct BesideExactRequest {
  std::string weights;         ///< file of the network
  std::string table;           ///< file of the exact value: its name where the case has none
  std::vector<double> speeds;  ///< a row of maps for each [m/s]
  double course = 0.0;         ///< of the ego, one for all [rad]
};

/// Learnt V_h of the point mass, without margins, beside its exact value (report::BesideExact).
/// @return  bytes of a PNG file; an error when there is no memory for a picture
[[nodiscard]] Result<std::string> beside_exact_png(const learned_danger::Network& network,
                                                   const learned_danger::ExactPointMass& exact,
                                                   const BesideExactRequest& request);

}  // namespace saca::danger_study
