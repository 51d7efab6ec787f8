#include "saca/lab/suites/opened_suite.h"

#include <fmt/core.h>

#include <filesystem>
#include <memory>
#include <utility>

#include "saca/base/core/fnv.h"
#include "saca/lab/danger_study/usual_danger.h"
#include "saca/lab/eval/paper_tables.h"
#include "saca/lab/eval/suite_file.h"
#include "saca/lab/installation/model_sources.h"
#include "saca/lab/learned_danger/learned.h"
#include "saca/lab/long_work/output_file.h"
#include "saca/lab/policy_study/policy_sheet.h"
#include "saca/lab/suites/method_list.h"
#include "saca/lab/suites/suite_page.h"
#include "saca/lab/vehicle_study/car_planes.h"

namespace saca::suites {

namespace fs = std::filesystem;
using installation::Inputs;

namespace {

/// What is no suite: recordings, a folder of scenarios, a table of the paper.
Result<EncounterSource> open_source(const Installation& here, const SuiteRequest& request,
                                    const Inputs& inputs, Twins twins) {
  EncounterDraw draw{.car_name = inputs.car_name, .car = &inputs.car, .count = request.count};
  if (auto problem = installation::add_inputs(here, request.car, draw.played_with)) {
    return *problem;
  }
  if (eval::find_paper_table(request.name) != nullptr) {
    return paper_table_source(request.name, here.root / "scenarios", draw, twins);
  }
  return request.name == "100car" ? hundred_car_source(request.data, draw)
                                  : folder_source(request.name, draw);
}

/// The weights that are named.
/// @return  an error where they are of another car
Result<std::shared_ptr<const learned_danger::Network>> danger_of(const Installation& here,
                                                                 const SuiteRequest& request,
                                                                 const Inputs& inputs) {
  if (request.danger.empty()) {
    return std::shared_ptr<const learned_danger::Network>();
  }
  auto weights = danger_study::read_danger_weights(here, request.danger);
  if (!weights.has_value()) {
    return weights.error();
  }
  const std::string ours = learned_danger::vehicle_word(inputs.car);
  if (learned_danger::vehicle_word(weights.value().inputs.car) != ours) {
    return Error{Error::Code::malformed,
                 fmt::format("{}: want weights of {}, got those of {}", request.danger,
                             inputs.car_name, weights.value().car_name)};
  }
  return std::make_shared<const learned_danger::Network>(std::move(weights).value().network);
}

Result<SuiteBench> open_bench(const Installation& here, const SuiteRequest& request,
                              const std::string& command, const std::vector<std::string>& methods) {
  auto source = open_encounters(here, request, command);
  if (!source.has_value()) {
    return source.error();
  }
  SuiteEncounters opened = std::move(source).value();
  auto planes = vehicle_study::open_planes(here, std::move(opened.inputs), request.thresholds);
  if (!planes.has_value()) {
    return planes.error();
  }
  const std::shared_ptr<const vehicle_study::PlanesOfCar> of_car = std::move(planes).value();
  Clock& clock = *of_car->setup.clock;
  auto thinking = SuiteThinking::open(request.thinking, lockstep_models(here, clock),
                                      vehicle_study::made_with(*of_car), request.threads, clock);
  if (!thinking.has_value()) {
    return thinking.error();
  }
  auto danger = danger_of(here, request, of_car->inputs);
  if (!danger.has_value()) {
    return danger.error();
  }
  auto imitators = imitators_of(methods, here.root / "models");
  if (!imitators.has_value()) {
    return imitators.error();
  }
  return SuiteBench{.source = std::move(opened),
                    .setup = {of_car, &of_car->setup},
                    .intent = {of_car, &of_car->inputs.intent},
                    .thinking = std::move(thinking).value(),
                    .danger = std::move(danger).value(),
                    .imitators = std::move(imitators).value()};
}

}  // namespace

Result<SuiteEncounters> open_encounters(const Installation& here, const SuiteRequest& request,
                                        const std::string& command) {
  const Twins twins = request.no_twins ? Twins::left_out : Twins::played;
  if (request.name == "100car" || eval::find_paper_table(request.name) != nullptr ||
      fs::is_directory(request.name)) {
    auto inputs = installation::read_inputs(here, request.car);
    if (!inputs.has_value()) {
      return inputs.error();
    }
    auto source = open_source(here, request, inputs.value(), twins);
    if (!source.has_value()) {
      return source.error();
    }
    return SuiteEncounters{std::move(source).value(), std::move(inputs).value()};
  }
  auto suite = installation::open_suite(here, request.name,
                                        {.count = request.count,
                                         .split = request.split,
                                         .test_log = request.test_log,
                                         .car = request.car},
                                        command, names_beside_suites(here.root / "data/protocols"));
  if (!suite.has_value()) {
    return suite.error();
  }
  installation::DrawnSuite drawn = std::move(suite).value();
  return SuiteEncounters{
      drawn_source(std::move(drawn.source),
                   fmt::format("{}, {} split ({:016x})", request.name, request.split, drawn.digest),
                   request.count, twins),
      std::move(drawn.inputs)};
}

SuiteRequest suite_of(const installation::SurveyRequest& survey) {
  const installation::DrawRequest& draw = survey.draw;
  return {.name = survey.suite,
          .count = draw.count,
          .split = draw.split,
          .test_log = draw.test_log,
          .car = draw.car,
          .no_twins = true,
          .journal = survey.journal,
          .threads = survey.threads};
}

SuiteThinking::OpenModel lockstep_models(const Installation& here, Clock& clock) {
  return [sources = installation::model_sources(here), &clock](const std::string& choice,
                                                               const char* option) {
    return model_access::open_needed_model(sources, choice, runtime::Pace::lockstep, clock, option);
  };
}

Result<std::optional<SuiteRun>> run_suite(const Installation& here, const SuiteRequest& request,
                                          const std::string& command,
                                          const std::vector<std::string>& methods) {
  auto bench = open_bench(here, request, command, methods);
  if (!bench.has_value()) {
    return bench.error();
  }
  return play_suite(std::move(bench).value(), request, methods,
                    {.command = command,
                     .version = here.version,
                     .built_from = installation::version_text(here),
                     .display = here.display});
}

std::optional<Error> write_rows_and_page(const SuiteRun& run, const SuiteResult& result,
                                         const SuiteRequest& request) {
  if (auto problem = eval::write_suite(request.output, run.rows, run.methods, run.meta.dump())) {
    return problem;
  }
  return long_work::write_output(
      fs::path(request.output).replace_extension(".html"),
      report::suite_page(page_of(run, result, request, policy_study::view_of)));
}

}  // namespace saca::suites
