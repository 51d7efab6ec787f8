#pragma once

#include "saca/decide/verdict.h"
#include "saca/memory/experience.h"

namespace saca::decide {

/// Adds to what each plan is expected to harm what experience says of its policy; none is expected
/// to harm less than nothing. What it costs to wait (cost_of_waiting) stays as it was.
void correct(Verdict& verdict, const memory::Corrections& corrections) noexcept;

}  // namespace saca::decide
