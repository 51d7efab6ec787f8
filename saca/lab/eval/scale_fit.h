#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>

#include "saca/onboard/match/similarity.h"
#include "saca/thinking/memory/case.h"

namespace saca::eval {

struct FittedScale {
  const char* name;
  double match::Scales::*value;
};
/// Those that encounters say something of; the others keep what is assumed.
inline constexpr std::array fitted_scales{
    FittedScale{"speed", &match::Scales::speed},
    FittedScale{"log_grip", &match::Scales::log_grip},
    FittedScale{"room", &match::Scales::to_edge},  // the name in documents
    FittedScale{"along_now", &match::Scales::along_now},
    FittedScale{"across_now", &match::Scales::across_now},
    FittedScale{"across_then", &match::Scales::across_then},
    FittedScale{"along_then", &match::Scales::along_then},
    FittedScale{"speed_along", &match::Scales::speed_along},
    FittedScale{"speed_across", &match::Scales::speed_across},
    FittedScale{"acceleration", &match::Scales::acceleration},
    FittedScale{"edge", &match::Scales::edge},
    FittedScale{"turned", &match::Scales::turned},
    FittedScale{"absence", &match::Scales::absence},
};

/// How well the expected harm of every policy in some scenes is predicted by that in the 20 nearest
/// of other encounters, each weighing exp(-d^2 / 2) for its difference d: the mean absolute error
/// over policies and scenes [-]. Cases of which nothing was expected are not asked about.
/// @param cases    that are asked, at least one of another encounter than each query
/// @param queries  may be among them; cases of the same encounter are left out, its twin's too
/// @return         nullopt where there is nothing to be predicted
[[nodiscard]] std::optional<double> scale_error(std::span<const memory::Case> cases,
                                                std::span<const memory::Case> queries,
                                                const match::Scales& scales, int threads);

struct ScaleFit {
  match::Scales scales;
  double error_before = 0.0;  ///< scale_error
  double error = 0.0;
  bool is_done = false;  ///< no step made it better; false: it was stopped before
};

/// Coordinate search for the least error: each of `fitted_scales` in turn is made larger or smaller
/// by a quarter as long as that helps, then by a twelfth.
/// @param go_on  asked after each evaluation, with how many there were and the least error so far
/// @return       nullopt where there is nothing to be predicted
[[nodiscard]] std::optional<ScaleFit> fit_scales(std::span<const memory::Case> cases,
                                                 std::span<const memory::Case> queries,
                                                 const match::Scales& begin, int threads,
                                                 const std::function<bool(int, double)>& go_on);

}  // namespace saca::eval
