#pragma once

#include "saca/lab/report/suite_page.h"
#include "saca/lab/suites/suite_gallery.h"
#include "saca/lab/suites/suite_request.h"
#include "saca/lab/suites/suite_result.h"

namespace saca::suites {

/// The page of a suite: what there is to see, in sentences; harm, all figures, families, where
/// decisions came from, and the encounters in which the first method lost most.
/// @param picture_of  for these encounters
[[nodiscard]] report::SuitePage page_of(const SuiteRun& run, const SuiteResult& result,
                                        const SuiteRequest& request, const PictureOf& picture_of);

}  // namespace saca::suites
