#pragma once

#include "saca/lab/encounter/hindsight.h"
#include "saca/lab/eval/oracle.h"
#include "saca/lab/report/contact_sheet.h"
#include "saca/lab/scenario/scenario.h"

namespace saca::policy_study {

/// One policy as written, ready to be drawn; the title is the policy's name.
[[nodiscard]] report::SceneView view_of(const world::Scene& scene,
                                        const encounter::Hindsight& tried);

/// All eight of an oracle, best first.
[[nodiscard]] report::ContactSheet sheet_of(const eval::Oracle& oracle,
                                            const scenario::Scenario& scenario);

}  // namespace saca::policy_study
