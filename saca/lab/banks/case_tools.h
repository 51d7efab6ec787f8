#pragma once

#include <cstddef>
#include <vector>

#include "saca/thinking/intent/model.h"
#include "saca/thinking/memory/case.h"
#include "saca/thinking/preview/forecast_facts.h"

namespace saca::banks {

/// What cases are worked out with; what it points to outlives it.
struct CaseTools {
  preview::ForecastTools forecast;          ///< of the car at hand
  const intent::Model* intent = nullptr;    ///< tells intentions that a case does not
  std::vector<memory::MadeWith> made_with;  ///< encounter::made_with of these
  std::size_t draws = 1;                    ///< that an expected harm is the mean of, >= 1
};

}  // namespace saca::banks
