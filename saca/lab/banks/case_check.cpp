#include "saca/lab/banks/case_check.h"

#include "saca/lab/encounter/learnt_case.h"
#include "saca/onboard/manoeuvre/ego.h"
#include "saca/thinking/arbitration/forecaster.h"
#include "saca/thinking/intent/observer.h"
#include "saca/thinking/memory/experience.h"

namespace saca::banks {
namespace {

intent::Beliefs beliefs_of(const memory::Case& one, const intent::Model& model,
                           const world::Scene& scene) {
  intent::Beliefs beliefs = intent::beliefs_at_sight(model, scene);
  for (std::size_t i = 0; i < one.intentions.size(); ++i) {
    beliefs[i].at.fill(one.intentions[i]);
  }
  return beliefs;
}

memory::Trust trust_in(const memory::Policies& spoken_for, const memory::PolicyHarms& told) {
  if ((spoken_for & memory::as_good_as_best(told)).any()) {
    return memory::Trust::trusted;
  }
  const auto& braking = told[manoeuvre::index(manoeuvre::PolicyId::aeb)];
  for (std::size_t p = 0; p < told.size(); ++p) {
    if (spoken_for[p] && told[p] && (!braking || *told[p] <= *braking + reflex::material_harm)) {
      return memory::Trust::unchecked;
    }
  }
  return spoken_for.any() ? memory::Trust::quarantined : memory::Trust::unchecked;
}

}  // namespace

std::optional<memory::Case> checked(const memory::Case& one, const preview::ForecastTools& tools,
                                    const intent::Model& intent, std::size_t draws,
                                    const std::vector<memory::MadeWith>& made_with) {
  world::Scene scene = one.scene;
  scene.ego_footprint = manoeuvre::footprint(*tools.car);
  scene.ego_mass = tools.car->mass;
  memory::Case now = one;
  now.told = encounter::forecast_harms(
      arbitration::Forecaster(tools, draws).judge(scene, beliefs_of(one, intent, scene)));
  now.trust = trust_in(memory::as_good_as_best(one), *now.told);
  if (now.trust == memory::Trust::unchecked) {
    return std::nullopt;
  }
  if (!memory::same_car_and_harm(one.made_with, made_with)) {
    now.happened.reset();
  }
  now.made_with = made_with;
  return now;
}

}  // namespace saca::banks
