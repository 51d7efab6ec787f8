#pragma once

#include <string>
#include <vector>

#include "apps/saca/inputs.h"
#include "saca/lab/eval/crash_case.h"
#include "saca/lab/report/suite_page.h"

namespace saca::app {

/// A case as a card of a page: the crash without avoidance and the best plan, facts, assumptions
/// and harms.
/// @return  an error where its encounter cannot be drawn again
[[nodiscard]] Result<report::GalleryCard> case_card(const eval::CrashCase& one,
                                                    const Inputs& inputs);

/// How many there are of each family, and which policies are the best in them.
[[nodiscard]] report::PageTable cases_table(const std::vector<eval::CrashCase>& cases);

}  // namespace saca::app
