#pragma once

#include <cstddef>
#include <vector>

#include "saca/onboard/reflex/trigger.h"
#include "saca/thinking/intent/observer.h"
#include "saca/thinking/preview/forecast_facts.h"
#include "saca/thinking/preview/situation.h"

namespace saca::preview {

constexpr std::size_t max_situations = 3;

/// The likely situations at the trigger that are in conflict, likeliest first, at most three, with
/// all their facts.
///
/// Every hypothesis about those actors that may come into conflict, or may close a lane beside that
/// the ego could swerve to or leave it free, is one situation (the 24 likeliest are looked at); the
/// others do what is likeliest for them. The ego
/// goes on as it does until the reflex plane's own rule (triggering_threat) finds that it has to
/// act if all move so; crossing traffic that this rule lets pass is judged by the preview's
/// tolerance. Empty when no hypothesis makes it act within T2 - T1.
///
/// @param beliefs  one per actor; those that are prepared for are `preview::cautious`
/// @throws ContractViolation  if beliefs and actors differ in number
///
/// Source: the paper, section IV-C, and reasoning in docs/architecture.md.
[[nodiscard]] std::vector<Situation> situations(const world::Scene& scene,
                                                const intent::Beliefs& beliefs,
                                                const reflex::Thresholds& thresholds,
                                                const ForecastTools& tools);

/// danger::obstacle_risk of each actor, by the tools' tables where they have any.
[[nodiscard]] std::vector<danger::ObstacleRisk> obstacle_risks(const world::Scene& scene,
                                                               const ForecastTools& tools);

}  // namespace saca::preview
