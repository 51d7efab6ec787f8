#include "saca/onboard/collision/harm.h"

#include <cmath>

#include "saca/base/core/contract.h"

namespace saca::collision {

using world::ActorKind;

double probability(const RiskCurve& curve, double x) {
  expects(curve.slope > 0.0, "slope > 0");
  expects(std::isfinite(x), "x is finite");
  return 1.0 / (1.0 + std::exp(-(curve.intercept + curve.slope * x)));
}

double attributable(const RiskCurve& curve, double x) {
  expects(x >= 0.0, "x >= 0");
  const double at_zero = probability(curve, 0.0);
  return (probability(curve, x) - at_zero) / (1.0 - at_zero);
}

Injury combined(const Injury& first, const Injury& second) {
  const auto either = [](double p, double q) { return p + q - p * q; };
  return {either(first.severe, second.severe), either(first.killed, second.killed)};
}

double weighted(const HarmModel& model, const Injury& injury) {
  return model.severe_weight * injury.severe + model.killed_weight * injury.killed;
}

Injury occupant_injury(const HarmModel& model, Face struck, double delta_v) {
  RiskCurve curve = model.occupant;
  if (struck == Face::left || struck == Face::right) {
    curve.intercept += model.side;
  } else if (struck == Face::rear) {
    curve.intercept += model.rear;
  }
  const double severe = attributable(curve, delta_v);
  return {severe, model.killed_share * severe};
}

double occupant_harm(const HarmModel& model, Face struck, double delta_v) {
  return weighted(model, occupant_injury(model, struck, delta_v));
}

bool unprotected(ActorKind kind) {
  return kind == ActorKind::pedestrian || kind == ActorKind::bicycle ||
         kind == ActorKind::motorcycle;
}

Injury unprotected_injury(const HarmModel& model, ActorKind kind, double closing_speed) {
  expects(unprotected(kind), "kind is pedestrian, bicycle or motorcycle");
  const UnprotectedRisk& risk = kind == ActorKind::pedestrian ? model.pedestrian
                                : kind == ActorKind::bicycle  ? model.cyclist
                                                              : model.motorcyclist;
  const Injury by_curves{attributable(risk.severe, closing_speed),
                         attributable(risk.killed, closing_speed)};
  const Injury inside = occupant_injury(model, Face::left, closing_speed);
  return weighted(model, by_curves) >= weighted(model, inside) ? by_curves : inside;
}

double unprotected_harm(const HarmModel& model, ActorKind kind, double closing_speed) {
  return weighted(model, unprotected_injury(model, kind, closing_speed));
}

}  // namespace saca::collision
