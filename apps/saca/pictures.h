#pragma once

#include <string>
#include <vector>

#include "saca/eval/oracle.h"
#include "saca/eval/survey.h"
#include "saca/report/contact_sheet.h"
#include "saca/sim/scenario.h"

namespace saca::app {

/// One policy as written, ready to be drawn; the title is the policy's name.
[[nodiscard]] report::SceneView view_of(const world::Scene& scene, const loop::Hindsight& tried);

/// All eight of an oracle, best first.
[[nodiscard]] report::ContactSheet sheet_of(const eval::Oracle& oracle,
                                            const sim::Scenario& scenario);

}  // namespace saca::app
