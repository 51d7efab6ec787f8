#pragma once

#include <nlohmann/json.hpp>

#include "saca/lab/intention_study/evaluation.h"

namespace saca::intention_study {

/// The document of `saca intent eval --json`: schema saca.intent_eval/1. What there is no figure of
/// is null.
[[nodiscard]] nlohmann::json evaluation_json(const Evaluation& evaluation);

/// Of one method as it stands there.
[[nodiscard]] nlohmann::json method_json(const MethodFigures& method);

}  // namespace saca::intention_study
