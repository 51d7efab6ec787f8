// What it costs that the language model runs in a process of its own: the same question, answered
// in this process and through saca-model-host. Run it with GOMP_SPINCOUNT=10000, which the other
// process sets for itself, and with --benchmark_enable_random_interleaving=true.
// Skipped where `make model` has not been run.
#include <benchmark/benchmark.h>

#include <filesystem>
#include <thread>

#include "engine.h"
#include "saca/lab/prepare/harm_file.h"
#include "saca/onboard/collision/harm.h"
#include "saca/thinking/language_model/child_model.h"
#include "saca/thinking/language_model/example_situation.h"
#include "saca/thinking/language_model/prompt.h"

namespace saca::model_host {
namespace {

using namespace std::chrono_literals;

constexpr auto without_haste = 5min;

std::string system_part() {
  return language_model::system_part(prepare::read_harm(SACA_HARM).value());
}

std::string scene_part() {
  return language_model::scene_part(language_model::example_situation(), std::nullopt, 0.0);
}

bool is_there(benchmark::State& state) {
  const bool there = std::filesystem::exists(SACA_MODEL);
  if (!there) {
    state.SkipWithError(SACA_MODEL " is not there");
  }
  return there;
}

// The argument: tokens of reasoning.
void in_this_process(benchmark::State& state) {
  if (!is_there(state)) {
    return;
  }
  SteadyClock clock;
  const auto engine =
      Engine::load({.model_path = SACA_MODEL,
                    .threads = static_cast<int>(std::thread::hardware_concurrency())})
          .value();
  if (const auto tokens = engine->set_system(system_part(), clock); !tokens.has_value()) {
    state.SkipWithError(tokens.error().message.c_str());
    return;
  }
  const EngineEvents nobody{[](std::size_t, int) {}, [](std::size_t, std::string_view) {},
                            [](std::size_t, AnswerKind, const std::vector<double>&) {}};
  const std::string scene = scene_part();
  for (auto _ : state) {
    benchmark::DoNotOptimize(engine->ask({scene}, clock.now() + without_haste,
                                         {.max_tokens = static_cast<int>(state.range(0))}, clock,
                                         nobody));
  }
}

void in_a_child_process(benchmark::State& state) {
  if (!is_there(state)) {
    return;
  }
  SteadyClock clock;
  language_model::ChildModel model(
      {.command = {SACA_MODEL_HOST, "--model", SACA_MODEL, "--threads",
                   std::to_string(std::thread::hardware_concurrency())},
       .system = system_part(),
       .identity = "base",
       .max_tokens = static_cast<int>(state.range(0))},
      clock);
  if (const auto problem = model.wait_until_ready(clock.now() + without_haste)) {
    state.SkipWithError(problem->message.c_str());
    return;
  }
  const std::string scene = scene_part();
  for (auto _ : state) {
    benchmark::DoNotOptimize(
        model.ask({scene}, clock.now() + without_haste, [](const language_model::Progress&) {}));
  }
}

BENCHMARK(in_this_process)->Arg(0)->Arg(80)->UseRealTime()->Unit(benchmark::kMillisecond);
BENCHMARK(in_a_child_process)->Arg(0)->Arg(80)->UseRealTime()->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace saca::model_host
