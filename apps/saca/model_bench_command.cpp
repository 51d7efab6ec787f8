#include <memory>
#include <string>

#include "apps/saca/json_output.h"
#include "apps/saca/model.h"
#include "apps/saca/model_commands.h"
#include "apps/saca/printing.h"
#include "saca/lab/model_trials/bench_report.h"

namespace saca::app {
namespace {

struct ModelBenchOptions {
  std::string model = "local";
  int runs = 10;
  bool as_json = false;
};

int model_bench(const ModelBenchOptions& options) {
  const auto places = find_places();
  if (!places.has_value()) {
    return refused(places.error());
  }
  SteadyClock clock;
  const auto model = open_needed_model(places.value(), options.model, runtime::Pace::real, clock);
  if (!model.has_value()) {
    return refused(model.error());
  }
  const auto bench = model_trials::bench_of(*model.value(), options.runs, clock);
  if (!bench.has_value()) {
    return unanswered(bench.error());
  }
  const model_trials::BenchFigures figures =
      model_trials::bench_figures(bench.value(), *model.value(), clock);
  if (options.as_json) {
    app::print_json(model_trials::bench_json(figures));
  } else {
    app::print("{}", model_trials::bench_text(figures));
  }
  return success;
}

}  // namespace

void add_model_bench(CLI::App& model, int& exit_code) {
  CLI::App* const command = model.add_subcommand(
      "bench", "How fast it answers, about one forecast without haste and three in 4.2 s");
  const auto options = std::make_shared<ModelBenchOptions>();
  command->add_option("--llm", options->model, "As of `saca reason`")->capture_default_str();
  command->add_option("--runs", options->runs)->check(CLI::Range(1, 10'000))->capture_default_str();
  command->add_flag("--json", options->as_json, "One flat object");
  command->callback([options, &exit_code] { exit_code = model_bench(*options); });
}

}  // namespace saca::app
