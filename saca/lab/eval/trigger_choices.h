#pragma once

#include <string_view>

#include "saca/lab/eval/at_trigger.h"
#include "saca/lab/eval/methods.h"

namespace saca::eval {

/// How a method chooses that acts once, at T1.
/// @param name   of methods()
/// @param tools  with what it needs; what they point to outlives the choice
/// @return       empty: the method is of another kind
[[nodiscard]] AtTrigger::Choose trigger_choice(std::string_view name, const MethodTools& tools);

}  // namespace saca::eval
