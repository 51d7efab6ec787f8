#include "saca/eval/case_check.h"

#include <algorithm>

#include "saca/decide/forecaster.h"
#include "saca/intent/observer.h"
#include "saca/loop/learnt_case.h"
#include "saca/manoeuvre/ego.h"
#include "saca/memory/experience.h"

namespace saca::eval {
namespace {

intent::Beliefs beliefs_of(const memory::Case& one, const intent::Model& model,
                           const world::Scene& scene) {
  intent::Beliefs beliefs = intent::beliefs_at_sight(model, scene);
  for (std::size_t i = 0; i < one.intentions.size(); ++i) {
    beliefs[i].at.fill(one.intentions[i]);
  }
  return beliefs;
}

CaseCheck check_of(const memory::Policies& spoken_for, const memory::PolicyHarms& told) {
  if ((spoken_for & memory::as_good_as_best(told)).any()) {
    return CaseCheck::confirmed;
  }
  const auto& braking = told[manoeuvre::index(manoeuvre::PolicyId::aeb)];
  for (std::size_t p = 0; p < told.size(); ++p) {
    if (spoken_for[p] && told[p] && (!braking || *told[p] <= *braking + decide::material_harm)) {
      return CaseCheck::open;
    }
  }
  return spoken_for.any() ? CaseCheck::refuted : CaseCheck::open;
}

}  // namespace

std::string_view name(CaseCheck check) {
  switch (check) {
    case CaseCheck::confirmed:
      return "confirmed";
    case CaseCheck::open:
      return "open";
    case CaseCheck::refuted:
      break;
  }
  return "refuted";
}

CheckedCase checked(const memory::Case& one, const preview::ForecastTools& tools,
                    const intent::Model& intent, std::size_t draws,
                    const std::vector<memory::MadeWith>& made_with) {
  world::Scene scene = one.scene;
  scene.ego_footprint = manoeuvre::footprint(*tools.car);
  scene.ego_mass = tools.car->mass;
  const memory::PolicyHarms told = loop::told_harms(
      decide::Forecaster(tools, draws).judge(scene, beliefs_of(one, intent, scene)));
  CheckedCase result{.check = check_of(memory::as_good_as_best(one), told), .one = one};
  result.one.told = told;
  if (!memory::same_car_and_harm(one.made_with, made_with)) {
    result.one.happened.reset();
  }
  result.one.made_with = made_with;
  switch (result.check) {
    case CaseCheck::confirmed:
      result.one.trust = memory::Trust::trusted;
      break;
    case CaseCheck::open:
      result.one.trust = memory::Trust::unchecked;
      break;
    case CaseCheck::refuted:
      result.one.trust = memory::Trust::quarantined;
      break;
  }
  return result;
}

}  // namespace saca::eval
