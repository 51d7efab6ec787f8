#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "apps/saca/json_output.h"
#include "apps/saca/places.h"
#include "apps/saca/printing.h"
#include "apps/saca/reach_commands.h"
#include "apps/saca/settings.h"
#include "apps/saca/stopped.h"
#include "apps/saca/within.h"
#include "saca/base/core/names.h"
#include "saca/base/core/parallel.h"
#include "saca/lab/levelset/solve.h"
#include "saca/lab/reach_study/case_solution.h"
#include "saca/lab/reach_study/solution_summary.h"
#include "saca/thinking/danger/avoidance_case.h"

namespace saca::app {
namespace {

namespace fs = std::filesystem;

struct SolveOptions {
  std::string name;
  std::string output;
  std::string differences = "weno5";
  std::string steps = "rk3";
  levelset::Scheme scheme{.threads = usual_threads()};
  double memory_mib = 0.0;  // 0: what the machine has to spare
  bool without_error = false;
  bool as_json = false;
};

/// A problem by its file's path, by the name of a shipped one (`data/reach`), or `air3d`.
Result<levelset::Problem> find_problem(const std::string& name) {
  const auto places = find_places();
  if (!places.has_value()) {
    return places.error();
  }
  if (name == "air3d") {
    return levelset::air3d_problem(levelset::air3d_grid(101, 79, 100));
  }
  const auto file = find_reach_case(places.value(), name);
  if (!file.has_value()) {
    return Error{file.error().code, file.error().message + ", or air3d"};
  }
  const auto found = danger::read_avoidance_case(file.value());
  return found.has_value() ? levelset::avoidance_problem(found.value())
                           : Result<levelset::Problem>(found.error());
}

int solve_case(const SolveOptions& options) {
  const auto problem = find_problem(options.name);
  if (!problem.has_value()) {
    return refused(problem.error());
  }
  const auto solved = reach_study::solve_case(
      problem.value(),
      {.name = options.name,
       .output = options.output,
       .scheme = options.scheme,
       .memory_mib = options.memory_mib > 0.0 ? std::optional(options.memory_mib) : std::nullopt,
       .display = progress_display()});
  if (!solved.has_value()) {
    return stopped(solved.error());
  }
  const reach_study::SolutionSummary summary =
      reach_study::summary_of(options.output, solved.value().solution, solved.value().seconds);
  if (options.as_json) {
    app::print_json(reach_study::json_of(summary));
  } else {
    app::print("{}", reach_study::text_of(summary));
  }
  return success;
}

std::vector<std::string> texts_of(std::span<const std::string_view> names) {
  return {names.begin(), names.end()};
}

}  // namespace

void add_reach_solve(CLI::App& reach, int& exit_code) {
  CLI::App* const command = reach.add_subcommand(
      "solve", "Solve a case exactly and keep its values; goes on where it was interrupted");
  const auto options = std::make_shared<SolveOptions>();
  command->add_option("case", options->name, "air3d, a name in data/reach, or a file")->required();
  command->add_option("--output", options->output, "HDF5 file; default: reach/CASE.h5");
  command->add_option("--differences", options->differences, "upwind1, eno2, eno3 or weno5")
      ->check(one_of(texts_of(levelset::difference_names)))
      ->capture_default_str();
  command->add_option("--steps", options->steps, "Runge-Kutta: euler, rk2 or rk3")
      ->check(one_of(texts_of(levelset::step_names)))
      ->capture_default_str();
  command->add_option("--cfl", options->scheme.cfl, "Share of the longest stable step")
      ->check(within(0.01, 1.0))
      ->capture_default_str();
  command->add_flag("--double", options->scheme.doubles, "In doubles; default: floats");
  add_threads(*command, options->scheme.threads, "");
  command->add_option("--memory-mib", options->memory_mib, "Refuse what takes more")
      ->check(within(0.001, 1e9));
  command->add_flag("--without-error", options->without_error,
                    "Do not solve on half as many points as well");
  command->add_flag("--json", options->as_json, "For programs");
  command->callback([options, &exit_code] {
    if (options->output.empty()) {
      options->output = "reach/" + fs::path(options->name).stem().string() + ".h5";
    }
    options->scheme.differences =
        value_from<levelset::Differences>(options->differences, levelset::difference_names).value();
    options->scheme.steps =
        value_from<levelset::Steps>(options->steps, levelset::step_names).value();
    options->scheme.with_error = !options->without_error;
    exit_code = solve_case(*options);
  });
}

}  // namespace saca::app
