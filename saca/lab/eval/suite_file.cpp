#include "saca/lab/eval/suite_file.h"

#include <fmt/core.h>

#include <algorithm>
#include <limits>

#include "saca/base/core/contract.h"
#include "saca/base/formats/checksummed_hdf5.h"
#include "saca/base/formats/hdf5_rows.h"

namespace saca::eval {
namespace {

constexpr double missing = std::numeric_limits<double>::quiet_NaN();

template <class Value>
void write_column(formats::Hdf5Writer& writer, const std::string& name,
                  std::span<const SuiteRow> rows, const Value& value) {
  std::vector<double> column;
  for (const SuiteRow& row : rows) {
    column.push_back(value(row));
  }
  formats::write_row(writer, name.c_str(), column);
}

double number_of(const std::optional<manoeuvre::Plan>& plan) {
  return plan ? static_cast<double>(manoeuvre::index(plan->policy)) : missing;
}

/// Columns of one comparison of each row: with risk, or the twin.
template <class Part>
void write_comparisons(formats::Hdf5Writer& writer, const std::string& group,
                       std::span<const SuiteRow> rows, const std::vector<std::string>& methods,
                       const Part& part) {
  writer.group(group);
  const auto column = [&](const std::string& name, const auto& value) {
    write_column(writer, name, rows, [&](const SuiteRow& row) {
      const Comparison* const one = part(row);
      return one == nullptr ? missing : value(*one);
    });
  };
  column(group + "/trigger_s", [](const Comparison& one) { return one.trigger.value_or(missing); });
  column(group + "/best_harm", [](const Comparison& one) { return one.best_harm; });
  column(group + "/published_best_harm",
         [](const Comparison& one) { return one.published_best_harm; });
  column(group + "/best_policy", [](const Comparison& one) { return number_of(one.best); });
  for (std::size_t m = 0; m < methods.size(); ++m) {
    const std::string place = group + "/" + methods[m];
    writer.group(place);
    const auto of_run = [&](const std::string& name, const auto& value) {
      column(fmt::format("{}/{}", place, name),
             [&](const Comparison& one) { return value(one.runs[m]); });
    };
    of_run("harm", [](const MethodRun& run) { return run.harm; });
    of_run("collision_loss", [](const MethodRun& run) { return run.collision_loss; });
    of_run("contact", [](const MethodRun& run) { return run.met ? 1.0 : 0.0; });
    of_run("impact_speed_mps", [](const MethodRun& run) { return run.impact_speed; });
    of_run("clearance_m", [](const MethodRun& run) { return run.clearance; });
    of_run("acted_at_s", [](const MethodRun& run) { return run.acted_at.value_or(missing); });
    of_run("policy", [](const MethodRun& run) { return number_of(run.plan); });
    of_run("target_speed_mps", [](const MethodRun& run) {
      return run.plan ? run.plan->target_speed.value_or(missing) : missing;
    });
    of_run("strength", [](const MethodRun& run) {
      return run.plan && manoeuvre::takes_strength(run.plan->policy) ? strength_of(*run.plan)
                                                                     : missing;
    });
    of_run("switches", [](const MethodRun& run) { return static_cast<double>(run.switches); });
  }
}

}  // namespace

std::optional<Error> write_suite(const std::filesystem::path& path, std::span<const SuiteRow> rows,
                                 const std::vector<std::string>& methods,
                                 const std::string& about) {
  expects(!rows.empty(), "at least one row");
  formats::Hdf5Writer writer;
  writer.text("about", about);
  std::vector<std::string> families;
  std::vector<std::string> faults;
  for (const SuiteRow& row : rows) {
    families.push_back(row.family);
    faults.push_back(failure_of(row, methods).value_or(""));
    std::replace(faults.back().begin(), faults.back().end(), '\n', ' ');
  }
  write_column(writer, "number", rows,
               [](const SuiteRow& row) { return static_cast<double>(row.number); });
  formats::write_lines(writer, "family", families);
  formats::write_lines(writer, "fault", faults);
  write_comparisons(writer, "risk", rows, methods, [](const SuiteRow& row) {
    return counts_in_figures(row) ? &row.risk : nullptr;
  });
  write_comparisons(writer, "twin", rows, methods, [](const SuiteRow& row) {
    return counts_in_figures(row) && row.twin ? &*row.twin : nullptr;
  });
  return formats::write_sealed_hdf5(path, "saca.suite/1", writer);
}

}  // namespace saca::eval
