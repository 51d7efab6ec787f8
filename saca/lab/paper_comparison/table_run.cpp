#include "saca/lab/paper_comparison/table_run.h"

#include <utility>

#include "saca/lab/installation/model_sources.h"
#include "saca/lab/suites/opened_suite.h"
#include "saca/lab/vehicle_study/car_planes.h"

namespace saca::paper_comparison {

using installation::Installation;

namespace {

constexpr const char* car_of_scenes = "compact_rwd_ev";

}  // namespace

Result<std::optional<TableRun>> run_table(const Installation& here, const eval::PaperTable& table,
                                          const TableRequest& request,
                                          const std::vector<std::string>& methods) {
  const auto car = installation::read_named_car(here, car_of_scenes);
  if (!car.has_value()) {
    return car.error();
  }
  const auto conditions = eval::encounters_of(table, here.root / "scenarios", car.value().car);
  if (!conditions.has_value()) {
    return conditions.error();
  }
  const suites::SuiteRequest suite = suite_of(table, conditions.value().size(), request);
  const auto ran = suites::run_suite(here, suite, "suite", methods);
  if (!ran.has_value()) {
    return ran.error();
  }
  if (!ran.value()) {
    return std::optional<TableRun>();
  }
  const suites::SuiteRun& done = *ran.value();
  const suites::SuiteResult result = suites::result_of(done, request.seed);
  const int few = num_few(conditions.value().size());
  TableRun run{.figures = table_figures(table, done, static_cast<std::size_t>(few), request.seed),
               .num_few = few,
               .made = done.meta,
               .failures = suites::failures_text(done)};
  if (!run.figures.few.empty()) {
    if (auto problem = suites::write_rows_and_page(done, result, suite)) {
      return *std::move(problem);
    }
  }
  return std::optional(std::move(run));
}

Result<std::vector<TimedModel>> time_replies(const Installation& here,
                                             const TableRequest& request) {
  const auto planes = vehicle_study::open_planes(here, car_of_scenes);
  if (!planes.has_value()) {
    return planes.error();
  }
  const vehicle_study::PlanesOfCar& of_car = *planes.value();
  const auto open = [&](const AskedModel& asked) {
    return model_access::open_needed_model(installation::model_sources(here), asked.choice,
                                           runtime::Pace::real, *of_car.setup.clock, asked.option);
  };
  return timed_models({.scenarios = here.root / "scenarios",
                       .car = &of_car.inputs.car,
                       .setup = &of_car.setup,
                       .intent = &of_car.inputs.intent,
                       .open = open},
                      request);
}

}  // namespace saca::paper_comparison
