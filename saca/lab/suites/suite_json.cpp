#include "saca/lab/suites/suite_json.h"

#include <filesystem>
#include <string>

#include "saca/lab/eval/estimate_text.h"
#include "saca/lab/suites/decisions.h"
#include "saca/lab/suites/method_list.h"

namespace saca::suites {
namespace {

using eval::MethodFigures;
using nlohmann::json;

void add_figures(json& out, const std::string& place, const MethodFigures& one) {
  add_estimate(out, place + "harm", one.harm);
  add_estimate(out, place + "regret", one.regret);
  add_estimate(out, place + "regret_published", one.published_regret);
  add_estimate(out, place + "harm_over_aeb", one.over_aeb);
  add_estimate(out, place + "collision_loss", one.collision_loss);
  add_estimate(out, place + "contact", one.contact);
  add_estimate(out, place + "right", one.right);
  add_estimate(out, place + "materially_worse_than_aeb", one.worse_than_aeb);
  add_estimate(out, place + "needless", one.needless);
  add_estimate(out, place + "switches", one.switches);
  if (one.expected) {
    add_estimate(out, place + "expected", one.expected->expected);
    add_estimate(out, place + "expected.happened", one.expected->happened);
    add_estimate(out, place + "expected.braking", one.expected->braking_expected);
    add_estimate(out, place + "expected.braking_happened", one.expected->braking_happened);
    add_estimate(out, place + "expected.knowingly_worse", one.expected->knowingly_worse);
    add_estimate(out, place + "expected.several_admissible", one.expected->several);
  }
  if (one.twins) {
    add_estimate(out, place + "false_trigger_loss", one.twins->false_trigger_loss);
    add_estimate(out, place + "false_triggers", one.twins->false_triggers);
    add_estimate(out, place + "twin_harm", one.twins->harm);
  }
}

/// Of one method, over all and in each family.
void add_method(json& out, const std::string& head, const SuiteRun& run, const SuiteResult& result,
                std::size_t method, std::uint64_t seed) {
  const MethodFigures& one = result.all[method];
  const std::string place = head + one.method + ".";
  const auto aeb = index_of(run.methods, "aeb");
  add_figures(out, place, one);
  if (aeb && result.all[*aeb].regret.value > 0.0) {
    out[place + "regret_over_aeb"] = one.regret.value / result.all[*aeb].regret.value;
  }
  add_estimate(out, place + "harm_over_first", eval::harm_above(run.rows, method, 0, seed));
  add_decisions(out, place, one);
  out[place + "faults"] = one.faults;
  for (const auto& [family, figures] : result.families) {
    if (!figures.empty()) {
      add_figures(out, place + family + ".", figures[method]);
    }
  }
}

void add_drivers(json& out, const std::string& head, const SuiteRun& run) {
  const DriverFigures drivers = driver_figures(run);
  if (drivers.count == 0) {
    return;
  }
  out[head + "driver.n"] = drivers.count;
  out[head + "driver.harm"] = drivers.harm;
  out[head + "driver.met"] = drivers.met;
  out[head + "driver.braked"] = drivers.braked;
  out[head + "driver.steered"] = drivers.steered;
  for (std::size_t m = 0; m < run.methods.size() && drivers.met_nobody > 0; ++m) {
    out[head + run.methods[m] + ".agrees_with_driver"] = drivers.agreement[m];
  }
}

}  // namespace

json json_of(const SuiteRun& run, const SuiteResult& result, const SuiteRequest& request) {
  json out = run.meta;
  const std::string head = "suite." + std::filesystem::path(request.name).filename().string() + ".";
  for (std::size_t m = 0; m < result.all.size(); ++m) {
    add_method(out, head, run, result, m, request.seed);
  }
  add_drivers(out, head, run);
  out[head + "n"] = run.rows.size();
  out[head + "faults"] = result.faults;
  out[head + "method_faults"] = result.method_faults;
  if (run.worked > 0) {
    const double rate = run.worked / run.seconds;
    out[head + "encounters_per_s"] = rate;
    out[head + "encounters_per_s_core"] = rate / request.threads;
    out[head + "threads"] = request.threads;
  }
  return out;
}

}  // namespace saca::suites
