#pragma once

#include <functional>
#include <nlohmann/json.hpp>
#include <string>

#include "saca/base/core/clock.h"
#include "saca/base/core/result.h"
#include "saca/lab/installation/installation.h"

namespace saca::benchmarks {

/// Which parts are timed (`saca bench`), with the usual car.
struct TimesRequest {
  std::string what = "all";  ///< all, vehicle, decide, atlas, reach, or air3d: a part of reach
  int calls = 1'000'000;     ///< of the reflex plane, for each number of actors
};

/// Figures of all that is asked for.
/// @param note  called with each step of "reach" before it begins
[[nodiscard]] Result<nlohmann::json> chosen_times(
    const installation::Installation& here, const TimesRequest& request, const Clock& clock,
    const std::function<void(const std::string& what)>& note);

}  // namespace saca::benchmarks
