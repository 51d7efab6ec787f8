#include <algorithm>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>

#include "apps/saca/atlas_making.h"
#include "apps/saca/commands.h"
#include "apps/saca/inputs.h"
#include "apps/saca/json_output.h"
#include "apps/saca/places.h"
#include "apps/saca/printing.h"
#include "apps/saca/reach_bench.h"
#include "apps/saca/within.h"
#include "saca/base/core/clock.h"
#include "saca/lab/benchmarks/atlas_times.h"
#include "saca/lab/benchmarks/decision_times.h"
#include "saca/lab/benchmarks/figures_text.h"
#include "saca/lab/benchmarks/vehicle_times.h"

namespace saca::app {
namespace {

using nlohmann::json;

struct BenchOptions {
  std::string what = "all";
  int calls = 1'000'000;
  bool as_json = false;
};

int bench(const BenchOptions& options) {
  const auto read = read_inputs("compact_rwd_ev");
  if (!read.has_value()) {
    return refused(read.error());
  }
  const Inputs& inputs = read.value();
  const SteadyClock clock;
  json figures;
  const auto asked = [&](std::string_view what) {
    return options.what == "all" || options.what == what;
  };
  if (asked("vehicle")) {
    figures.update(benchmarks::vehicle_times(inputs.car, clock));
  }
  std::optional<Error> problem;
  if (asked("reach")) {
    problem = bench_reach(inputs.places.root, inputs.car, clock, figures);
  } else if (asked("air3d")) {
    problem = bench_air3d(inputs.places.root, clock, figures);
  }
  if (problem) {
    return refused(*problem);
  }
  const int fewer_calls = std::min(options.calls, 10'000);
  if (asked("decide") || asked("atlas")) {
    const atlas::Atlas atlas = usual_atlas(inputs);
    if (asked("decide")) {
      figures.update(benchmarks::decision_times({&inputs.car, &inputs.harm, &inputs.intent, &atlas},
                                                clock, options.calls));
    }
    if (asked("atlas")) {
      figures.update(benchmarks::atlas_times(inputs.car, atlas, inputs.harm, clock, fewer_calls));
    }
  }
  if (options.as_json) {
    app::print_json(figures);
  } else {
    app::print("{}", benchmarks::text_of(figures));
  }
  return success;
}

}  // namespace

void add_bench(CLI::App& line, int& exit_code) {
  CLI::App* const command = line.add_subcommand("bench",
                                                "Measure: vehicle steps, the reflex plane and the "
                                                "forecaster, the atlas, the solver of reach");
  const auto options = std::make_shared<BenchOptions>();
  command
      ->add_option("what", options->what,
                   "all, vehicle, decide, atlas, reach, or air3d: a part of reach")
      ->check(one_of({"all", "vehicle", "decide", "atlas", "reach", "air3d"}))
      ->capture_default_str();
  command->add_option("--calls", options->calls, "Of the reflex plane, for each number of actors")
      ->check(CLI::Range(1'000, 100'000'000))
      ->capture_default_str();
  command->add_flag("--json", options->as_json, "For programs");
  command->callback([options, &exit_code] { exit_code = bench(*options); });
}

}  // namespace saca::app
