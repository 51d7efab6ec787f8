#pragma once

#include <array>
#include <string>

#include "saca/manoeuvre/plan.h"
#include "saca/preview/situation.h"

namespace saca::decide {

/// The rollout check of a chosen policy: it can be driven here, and emergency braking is not
/// forecast to be better, by the one ordering of outcome/ordering.h: less harm, or the same by
/// milder means.
struct Check {
  bool passed = false;
  std::string text;  ///< why, in one line
};

[[nodiscard]] Check check(manoeuvre::PolicyId chosen, const preview::Situation& situation);

}  // namespace saca::decide
