#include "saca/lab/model_trials/reasoning.h"

#include <utility>

#include "saca/lab/danger_study/usual_danger.h"
#include "saca/lab/installation/model_sources.h"
#include "saca/lab/model_access/open_model.h"
#include "saca/lab/model_trials/first_question.h"
#include "saca/lab/vehicle_study/kept_atlas.h"

namespace saca::model_trials {

using installation::Installation;

Result<std::unique_ptr<const Reasoning>> open_reasoning(const Installation& here,
                                                        const std::string& scenario,
                                                        const std::string& model, Clock& clock) {
  auto inputs = installation::read_scenario_inputs(here, scenario);
  if (!inputs.has_value()) {
    return inputs.error();
  }
  auto opened = model_access::open_needed_model(installation::model_sources(here), model,
                                                runtime::Pace::real, clock, "--llm");
  if (!opened.has_value()) {
    return opened.error();
  }
  auto danger = danger_study::usual_danger(here, inputs.value());
  if (!danger.has_value()) {
    return danger.error();
  }
  atlas::Atlas atlas = vehicle_study::usual_atlas(here, inputs.value());
  std::unique_ptr<Reasoning> all(new Reasoning{.inputs = std::move(inputs).value(),
                                               .model = std::move(opened).value(),
                                               .atlas = std::move(atlas),
                                               .danger = std::move(danger).value(),
                                               .tools = {},
                                               .asked = {}});
  all->tools = {.car = &all->inputs.car,
                .harm = &all->inputs.harm,
                .atlas = &all->atlas,
                .danger = all->danger ? &*all->danger : nullptr,
                .cues = &all->inputs.cues};
  auto asked = first_question({.scenario = &all->inputs.scenario,
                               .car = all->tools.car,
                               .harm = all->tools.harm,
                               .intent = &all->inputs.intent,
                               .atlas = all->tools.atlas,
                               .danger = all->tools.danger,
                               .cues = all->tools.cues,
                               .clock = &clock});
  if (!asked.has_value()) {
    return asked.error();
  }
  all->asked = std::move(asked).value();
  return std::unique_ptr<const Reasoning>(std::move(all));
}

}  // namespace saca::model_trials
