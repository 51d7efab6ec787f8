#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "apps/saca/json_output.h"
#include "apps/saca/places.h"
#include "apps/saca/printing.h"
#include "apps/saca/reach_commands.h"
#include "apps/saca/reach_problem.h"
#include "apps/saca/settings.h"
#include "apps/saca/within.h"
#include "saca/base/core/clock.h"
#include "saca/base/core/names.h"
#include "saca/base/core/parallel.h"
#include "saca/lab/levelset/solve.h"
#include "saca/lab/long_work/interrupt.h"
#include "saca/lab/long_work/output_file.h"
#include "saca/lab/long_work/progress.h"
#include "saca/thinking/danger/value_file.h"

namespace saca::app {
namespace {

namespace fs = std::filesystem;
using danger::Solution;
using levelset::Problem;
using levelset::Scheme;

struct SolveOptions {
  std::string name;
  std::string output;
  std::string differences = "weno5";
  std::string steps = "rk3";
  Scheme scheme{.threads = usual_threads()};
  double memory_mib = 0.0;  // 0: what the machine has to spare
  bool without_error = false;
  bool as_json = false;
};

constexpr double mib = 1024.0 * 1024.0;

/// What the system can give without swapping [MiB]; nullopt: it does not say.
std::optional<double> memory_to_spare() {
  std::ifstream file("/proc/meminfo");
  std::string key;
  for (double kib = 0.0; file >> key >> kib; file.ignore(80, '\n')) {
    if (key == "MemAvailable:") {
      return kib / 1024.0;
    }
  }
  return std::nullopt;
}

std::optional<Error> too_little_memory(const Problem& problem, const SolveOptions& options) {
  const double needed = static_cast<double>(memory_needed(problem, options.scheme)) / mib;
  const std::optional<double> there =
      options.memory_mib > 0.0 ? options.memory_mib : memory_to_spare();
  if (!there || needed <= *there) {
    return std::nullopt;
  }
  return Error{Error::Code::out_of_range,
               fmt::format("{}: {} cells take {:.0f} MiB, {} {:.0f} MiB; take fewer points or "
                           "snapshots{}",
                           options.name, num_cells(problem.grid), needed,
                           options.memory_mib > 0.0 ? "--memory-mib allows" : "the machine has",
                           *there, options.scheme.doubles ? ", or no --double" : "")};
}

/// What an earlier, stopped run of the same command left.
Result<std::optional<Solution>> begun(const fs::path& part) {
  std::error_code none;
  if (!fs::exists(part, none)) {
    return std::optional<Solution>();
  }
  auto there = danger::read_solved(part);
  if (!there.has_value()) {
    return there.error();
  }
  return std::optional(std::move(there).value());
}

void tell(const SolveOptions& options, const Solution& solved, double seconds) {
  const std::vector<float> values = snapshot(solved, solved.times.size() - 1);
  const auto unsafe =
      std::count_if(values.begin(), values.end(), [](float v) { return v >= 0.0F; });
  const double share = static_cast<double>(unsafe) / static_cast<double>(values.size());
  if (options.as_json) {
    const nlohmann::json all{{"schema", "saca.reach_solve/1"}, {"file", options.output},
                             {"cells", values.size()},         {"times_s", solved.times},
                             {"unsafe_share", share},          {"seconds", seconds}};
    app::print_json(all);
    return;
  }
  app::print("{}: {} cells, to {:g} s, {:.2f} % of them unsafe; {:.1f} s\n", options.output,
             values.size(), solved.times.back(), 100.0 * share, seconds);
}

int solve_case(const SolveOptions& options) {
  const auto places = find_places();
  if (!places.has_value()) {
    return refused(places.error());
  }
  const auto problem = find_problem(places.value(), options.name);
  if (!problem.has_value()) {
    return refused(problem.error());
  }
  if (const auto too_little = too_little_memory(problem.value(), options)) {
    return refused(*too_little);
  }
  const fs::path part = options.output + ".part";
  auto before = begun(part);
  if (!before.has_value()) {
    return refused(before.error());
  }
  if (const auto wrong = long_work::why_outputs_unwritable({options.output})) {
    return refused(*wrong);
  }
  if (auto wrong = long_work::make_folder_of(options.output)) {
    return refused(*wrong);
  }
  std::error_code none;
  if (fs::exists(options.output, none) && !fs::is_regular_file(options.output, none)) {
    const bool is_folder = fs::is_directory(options.output, none);
    return refused(
        {Error::Code::unwritable,
         options.output + (is_folder ? ": is a folder" : ": is no file") + ", want a file"});
  }
  long_work::watch_for_interrupt();
  SteadyClock clock;
  const Clock::Time start = clock.now();
  const double horizon = problem.value().times.back();
  constexpr int permille = 1'000;
  const int remembered =
      before.value() ? static_cast<int>(permille * before.value()->times.back() / horizon) : 0;
  long_work::ProgressLine line(options.name, permille, clock, progress_display());
  const auto solved = levelset::solve(
      problem.value(), options.scheme, std::move(before).value(),
      {.step =
           [&](double tau) {
             line.show(static_cast<int>(permille * tau / horizon), remembered, " per mille");
             return !long_work::interrupted();
           },
       .keep = [&](const Solution& so_far) { return danger::write_solved(part, so_far); }});
  if (!solved.has_value()) {
    return refused({solved.error().code, options.name + ": " + solved.error().message});
  }
  if (!solved.value().complete) {
    complain(fmt::format("interrupted after {:.3g} of {:g} s; the same command goes on from {}",
                         solved.value().times.back(), horizon, part.string()));
    return was_interrupted;
  }
  std::error_code problem_of_it;
  fs::rename(part, options.output, problem_of_it);
  if (problem_of_it) {
    return refused({Error::Code::unwritable, options.output + ": " + problem_of_it.message()});
  }
  tell(options, solved.value(), to_seconds(clock.now() - start));
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
  command->add_option("--threads", options->scheme.threads)
      ->check(CLI::Range(1, 256))
      ->capture_default_str();
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
