#pragma once

#include "saca/lab/cases/case_tools.h"
#include "saca/lab/cases/crash_case.h"
#include "saca/lab/report/suite_page.h"

namespace saca::cases {

/// A case as a card of a page: the crash without avoidance and the best plan, facts, assumptions
/// and harms.
/// @return  an error where its encounter cannot be drawn again
[[nodiscard]] Result<report::GalleryCard> case_card(const CrashCase& one, const CaseTools& tools);

}  // namespace saca::cases
