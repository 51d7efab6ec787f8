#include "saca/lab/suites/suite_text.h"

#include <fmt/core.h>

#include "saca/lab/eval/estimate_text.h"
#include "saca/lab/suites/decisions.h"

namespace saca::suites {
namespace {

using eval::MethodFigures;

constexpr const char* method_line = "{:22} {:26} {:26} {:26} {:7} {:6} {:9} {:8}\n";

std::string methods_text(const SuiteResult& result) {
  std::string text =
      fmt::format(method_line, "method", "harm", "regret, all plans", "regret, as published",
                  "contact", "right", "worse than", "needless") +
      fmt::format(method_line, "", "", "", "", "%", "%", "AEB, %", "%");
  for (const MethodFigures& one : result.all) {
    text += fmt::format(method_line, one.method, with_interval(one.harm, 4),
                        with_interval(one.regret, 4), with_interval(one.published_regret, 4),
                        percent_of(one.contact), percent_of(one.right),
                        percent_of(one.worse_than_aeb), percent_of(one.needless));
  }
  return text;
}

std::string drivers_text(const SuiteRun& run) {
  const DriverFigures drivers = driver_figures(run);
  if (drivers.count == 0) {
    return "";
  }
  std::string text = fmt::format(
      "\n{} recorded drivers: harm {:.4f}, {} met somebody, {} braked, {} moved aside\n",
      drivers.count, drivers.harm, drivers.met, drivers.braked, drivers.steered);
  for (std::size_t m = 0; m < run.methods.size() && drivers.met_nobody > 0; ++m) {
    text += fmt::format("  {} does as the driver did in {:.0f} % of those who met nobody\n",
                        run.methods[m], 100.0 * drivers.agreement[m]);
  }
  return text;
}

}  // namespace

std::string text_of(const SuiteRun& run, const SuiteResult& result, const SuiteRequest& request) {
  std::string text =
      fmt::format("{}: {} encounters, {} could not be played; means with 95 % intervals\n",
                  request.name, run.rows.size(), result.faults);
  for (const std::string& note : run.notes) {
    text += note + "\n";
  }
  text += "\n" + methods_text(result);
  for (const MethodFigures& one : result.all) {
    if (one.thinking) {
      text += "\n" + decisions_text(one) + "\n";
      if (one.expected) {
        text += expectations_text(one) + "\n";
      }
    }
  }
  text += drivers_text(run);
  if (run.worked > 0) {
    text += fmt::format("\n{:.1f} encounters/s on {} threads\n", run.worked / run.seconds,
                        request.threads);
  }
  if (const std::string failures = failures_text(run); !failures.empty()) {
    text += "\n" + failures + "\n";
  }
  return text;
}

}  // namespace saca::suites
