#pragma once

#include <functional>
#include <vector>

#include "saca/lab/encounter/hindsight.h"
#include "saca/lab/report/suite_page.h"
#include "saca/lab/suites/suite_request.h"
#include "saca/lab/suites/suite_run.h"

namespace saca::suites {

/// One plan as it was tried in a scene, ready to be drawn.
using PictureOf =
    std::function<report::SceneView(const world::Scene& scene, const encounter::Hindsight& tried)>;

/// The encounters in which the first method lost most, worst first, at most twelve: what it did,
/// what would have been best, and the command that plays it again. One that cannot be drawn again
/// is passed over.
[[nodiscard]] std::vector<report::GalleryCard> gallery_of(const SuiteRun& run,
                                                          const SuiteRequest& request,
                                                          const PictureOf& picture_of);

}  // namespace saca::suites
