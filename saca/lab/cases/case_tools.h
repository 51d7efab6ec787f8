#pragma once

#include <string>

#include "saca/thinking/intent/model.h"
#include "saca/thinking/preview/forecast_facts.h"

namespace saca::cases {

/// A car, and what encounters are played and judged with in it. What it points to outlives it.
struct CaseTools {
  std::string car_name;
  preview::ForecastTools forecast;        ///< with car and harm
  const intent::Model* intent = nullptr;  ///< pictures need none
};

}  // namespace saca::cases
