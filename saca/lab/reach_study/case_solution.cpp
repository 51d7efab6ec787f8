#include "saca/lab/reach_study/case_solution.h"

#include <fmt/core.h>

#include <system_error>
#include <utility>

#include "saca/base/core/clock.h"
#include "saca/lab/long_work/interrupt.h"
#include "saca/lab/long_work/output_file.h"
#include "saca/lab/reach_study/spare_memory.h"
#include "saca/thinking/danger/grid.h"

namespace saca::reach_study {
namespace {

namespace fs = std::filesystem;
using danger::Solution;

constexpr double bytes_per_mib = 1024.0 * 1024.0;

fs::path part_of(const CaseTask& task) {
  return task.output.string() + ".part";
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

/// Makes the output's folder.
std::optional<Error> why_no_output(const fs::path& output) {
  if (auto wrong = long_work::why_outputs_unwritable({output})) {
    return wrong;
  }
  if (auto wrong = long_work::make_folder_of(output)) {
    return wrong;
  }
  std::error_code none;
  if (fs::exists(output, none) && !fs::is_regular_file(output, none)) {
    const bool is_folder = fs::is_directory(output, none);
    return Error{
        Error::Code::unwritable,
        output.string() + (is_folder ? ": is a folder" : ": is no file") + ", want a file"};
  }
  return std::nullopt;
}

/// The solution, complete or stopped; what there is of it is kept in the task's part.
Result<Solution> marched(const levelset::Problem& problem, const CaseTask& task,
                         std::optional<Solution> before, Clock& clock) {
  constexpr int permille = 1'000;
  const double horizon = problem.times.back();
  const int remembered = before ? static_cast<int>(permille * before->times.back() / horizon) : 0;
  long_work::ProgressLine line(task.name, permille, clock, task.display);
  const fs::path part = part_of(task);
  auto solved = levelset::solve(
      problem, task.scheme, std::move(before),
      {.step =
           [&](double tau) {
             line.show(static_cast<int>(permille * tau / horizon), remembered, " per mille");
             return !long_work::interrupted();
           },
       .keep = [&](const Solution& so_far) { return danger::write_solved(part, so_far); }});
  if (!solved.has_value()) {
    return Error{solved.error().code, task.name + ": " + solved.error().message};
  }
  return solved;
}

}  // namespace

std::optional<Error> why_too_large(const levelset::Problem& problem, const CaseTask& task) {
  const double needed = static_cast<double>(memory_needed(problem, task.scheme)) / bytes_per_mib;
  const std::optional<double> there = task.memory_mib ? task.memory_mib : spare_memory();
  if (!there || needed <= *there) {
    return std::nullopt;
  }
  return Error{Error::Code::out_of_range,
               fmt::format("{}: {} cells take {:.0f} MiB, {} {:.0f} MiB; take fewer points or "
                           "snapshots{}",
                           task.name, danger::num_cells(problem.grid), needed,
                           task.memory_mib ? "--memory-mib allows" : "the machine has", *there,
                           task.scheme.doubles ? ", or no --double" : "")};
}

Result<SolvedCase> solve_case(const levelset::Problem& problem, const CaseTask& task) {
  if (auto too_large = why_too_large(problem, task)) {
    return *std::move(too_large);
  }
  const fs::path part = part_of(task);
  auto before = begun(part);
  if (!before.has_value()) {
    return before.error();
  }
  if (auto wrong = why_no_output(task.output)) {
    return *std::move(wrong);
  }
  long_work::watch_for_interrupt();
  SteadyClock clock;
  const Clock::Time start = clock.now();
  auto solved = marched(problem, task, std::move(before).value(), clock);
  if (!solved.has_value()) {
    return solved.error();
  }
  if (!solved.value().complete) {
    return Error{Error::Code::too_late,
                 fmt::format("interrupted after {:.3g} of {:g} s; the same command goes on from {}",
                             solved.value().times.back(), problem.times.back(), part.string())};
  }
  std::error_code problem_of_it;
  fs::rename(part, task.output, problem_of_it);
  if (problem_of_it) {
    return Error{Error::Code::unwritable, task.output.string() + ": " + problem_of_it.message()};
  }
  return SolvedCase{std::move(solved).value(), to_seconds(clock.now() - start)};
}

}  // namespace saca::reach_study
