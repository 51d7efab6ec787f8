#include "apps/saca/options.h"
#include "saca/base/core/clock.h"
#include "saca/lab/benchmarks/chosen_times.h"
#include "saca/lab/benchmarks/figures_text.h"

namespace saca::app {
namespace {

struct AllBenchOptions : benchmarks::TimesRequest {
  bool as_json = false;
};

void note_bench(const std::string& what) {
  if (!settings().quiet) {
    app::print(stderr, "bench reach: {}\n", what);
  }
}

void bench(const AllBenchOptions& options) {
  const auto figures = need(benchmarks::chosen_times(here(), options, SteadyClock(), note_bench));
  tell(options.as_json, figures, benchmarks::text_of(figures));
}

}  // namespace

void add_bench(CLI::App& line) {
  const auto [command, options] = add_command<AllBenchOptions>(
      line, "bench",
      "Measure: vehicle steps, the reflex plane and the forecaster, the atlas, the solver of reach",
      bench);
  add(command, "what", options.what,
      "all, vehicle, decide, atlas, reach, or air3d: a part of reach",
      one_of({"all", "vehicle", "decide", "atlas", "reach", "air3d"}));
  add(command, "--calls", options.calls, "Of the reflex plane, for each number of actors",
      CLI::Range(1'000, 100'000'000));
  add_json(command, options.as_json);
}

}  // namespace saca::app
