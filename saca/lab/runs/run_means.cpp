#include "saca/lab/runs/run_means.h"

#include <utility>

#include "saca/lab/banks/bank_files.h"
#include "saca/lab/danger_study/usual_danger.h"
#include "saca/lab/encounter/learnt_case.h"
#include "saca/lab/installation/model_sources.h"
#include "saca/lab/installation/shipped_files.h"
#include "saca/lab/long_work/output_file.h"
#include "saca/lab/runs/bank.h"
#include "saca/lab/vehicle_study/kept_atlas.h"
#include "saca/onboard/atlas/atlas_file.h"

namespace saca::runs {

namespace fs = std::filesystem;
using installation::Installation;
using installation::ScenarioInputs;

namespace {

/// nullopt: none is wanted.
Result<std::optional<atlas::Atlas>> open_atlas(const Installation& here, const std::string& file,
                                               const ScenarioInputs& inputs) {
  if (file == "off") {
    return std::optional<atlas::Atlas>();
  }
  if (file.empty()) {
    return std::optional(vehicle_study::usual_atlas(here, inputs));
  }
  const auto atlas = atlas::read_atlas(file, inputs.car);
  return atlas.has_value()
             ? Result<std::optional<atlas::Atlas>>(std::optional(atlas.value()))
             : Error{atlas.error().code, atlas.error().message + " (--atlas off does without)"};
}

/// nullopt: V_h is told by a few evasions.
Result<std::optional<danger::DangerModel>> open_danger(const Installation& here,
                                                       const std::string& danger,
                                                       const ScenarioInputs& inputs) {
  using danger_study::TableUse;
  return danger == "off"
             ? Result(std::optional<danger::DangerModel>())
             : danger_study::usual_danger(here, inputs,
                                          danger == "tables" ? TableUse::solved : TableUse::none);
}

/// nullptr: none is wanted.
Result<std::shared_ptr<memory::Store>> open_memory(const Installation& here,
                                                   const RunRequest& request,
                                                   const ScenarioInputs& inputs) {
  if (request.memory.empty()) {
    return std::shared_ptr<memory::Store>();
  }
  return open_bank(
      {.place = request.memory,
       .use = request.no_learning    ? BankUse::ask
              : request.empty_memory ? BankUse::learn_from_empty
                                     : BankUse::learn,
       .car = encounter::made_with({&inputs.car, &inputs.harm}, inputs.intent, inputs.scenario.car),
       .shipped = [&here] { return banks::shipped_cases(here.root); }});
}

runtime::Pace pace_of(const RunRequest& request) {
  return request.pace == "real" ? runtime::Pace::real : runtime::Pace::lockstep;
}

/// Of a record that is made of this run.
Result<encounter::Provenance> provenance_of(const Installation& here, const RunRequest& request) {
  auto digest = installation::scenario_digest(here, request.scenario);
  if (!digest.has_value()) {
    return digest.error();
  }
  return encounter::Provenance{.program = "saca " + here.version,
                               .commit = here.commit,
                               .date = request.date,
                               .command = request.command,
                               .file = request.scenario,
                               .digest = std::move(digest).value()};
}

Result<model_access::ChosenModel> open_model_of(const Installation& here, const RunRequest& request,
                                                Clock& clock) {
  auto chosen = model_access::ChosenModel::open(installation::model_sources(here), request.model,
                                                request.record_replies, pace_of(request), clock);
  if (chosen.has_value() && chosen.value().missing()) {
    here.notice(chosen.value().missing()->message);
    here.notice("going on as with --llm off");
  }
  return chosen;
}

}  // namespace

Result<std::unique_ptr<RunMeans>> open_means(const Installation& here, const RunRequest& request,
                                             Clock& clock) {
  auto inputs = installation::read_scenario_inputs(here, request.scenario);
  if (!inputs.has_value()) {
    return inputs.error();
  }
  const RunFiles files = files_of(request, inputs.value().scenario.name);
  if (const auto problem = long_work::why_outputs_unwritable(
          {files.record, files.report, files.trace, files.tape, request.record_replies})) {
    return *problem;
  }
  auto provenance = provenance_of(here, request);
  if (!provenance.has_value()) {
    return provenance.error();
  }
  const auto costs = installation::read_costs(here);
  if (!costs.has_value()) {
    return costs.error();
  }
  auto atlas = open_atlas(here, request.atlas, inputs.value());
  if (!atlas.has_value()) {
    return atlas.error();
  }
  auto danger = open_danger(here, request.danger, inputs.value());
  if (!danger.has_value()) {
    return danger.error();
  }
  auto memory = open_memory(here, request, inputs.value());
  if (!memory.has_value()) {
    return memory.error();
  }
  auto model = open_model_of(here, request, clock);
  if (!model.has_value()) {
    return model.error();
  }
  const auto forced = forced_plan(request.forced);
  if (!forced.has_value()) {
    return forced.error();
  }
  return std::make_unique<RunMeans>(RunMeans{.inputs = std::move(inputs).value(),
                                             .provenance = std::move(provenance).value(),
                                             .costs = costs.value(),
                                             .atlas = std::move(atlas).value(),
                                             .danger = std::move(danger).value(),
                                             .memory = std::move(memory).value(),
                                             .model = std::move(model).value(),
                                             .forced = forced.value()});
}

encounter::Setup setup_of(const RunMeans& means, const RunRequest& request, Clock& clock) {
  reflex::Thresholds thresholds;
  if (request.trigger == "t1") {
    thresholds.waiting_cost.reset();
  }
  return {.scenario = &means.inputs.scenario,
          .car = &means.inputs.car,
          .harm = &means.inputs.harm,
          .intent = &means.inputs.intent,
          .atlas = means.atlas ? &*means.atlas : nullptr,
          .danger = means.danger ? &*means.danger : nullptr,
          .cues = &means.inputs.cues,
          .thresholds = thresholds,
          .pace = pace_of(request),
          .costs = means.costs,
          .model = means.model.get(),
          .memory = means.memory.get(),
          .learns = !request.no_learning,
          .forced = means.forced,
          .seed = request.seed,
          .tapes = !request.tape.empty(),
          .clock = &clock};
}

RunFiles files_of(const RunRequest& request, const std::string& scenario) {
  const fs::path folder = fs::path(request.output) / scenario;
  return {.record = folder / "record.json",
          .report = request.report.empty() ? folder / "report.html" : fs::path(request.report),
          .trace = request.trace,
          .tape = request.tape};
}

}  // namespace saca::runs
