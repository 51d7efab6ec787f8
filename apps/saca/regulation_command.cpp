#include "apps/saca/regulation_command.h"

#include <fmt/core.h>

#include <filesystem>

#include "apps/saca/json_output.h"
#include "apps/saca/printing.h"
#include "apps/saca/regulation_page.h"
#include "apps/saca/suite_running.h"
#include "saca/base/core/file.h"
#include "saca/base/core/units.h"
#include "saca/lab/long_work/output_file.h"

namespace saca::app {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

void add(json& out, const std::string& place, const PassCount& sum) {
  out[place + "passed"] = sum.passed;
  out[place + "passed.n"] = sum.all;
  out[place + "passed_share"] = static_cast<double>(sum.passed) / sum.all;
}

template <class T>
json value_of(const std::optional<T>& value) {
  return value ? json(*value) : json();
}

json json_of(const RegulationRun& run, std::size_t car, std::size_t cell, std::size_t method) {
  const RegulationResult& result = run.at(car, cell, method);
  const eval::RegulationCell& of = run.cells[cell];
  const eval::RegulationRow& row = run.row_of(cell);
  json out{{"row", row.name},
           {"paragraph", row.paragraph},
           {"car", run.cars[car]},
           {"method", run.methods[method]},
           {"speed_kmh", to_kmh(of.speed)},
           {"manual_braking", row.manual_braking},
           {"limit", eval::name(row.limit)},
           {"verdict", eval::name(result.judged.verdict)},
           {"passed", result.judged.passed()},
           {"impact_speed_mps", result.judged.impact_speed},
           {"peak_deceleration_mps2", result.judged.peak_deceleration},
           {"acted_at_s", value_of(result.acted_at)},
           {"policy", result.plan ? json(manoeuvre::name(result.plan->policy)) : json()}};
  if (of.headway) {
    out["headway_m"] = *of.headway;
    out["lead_deceleration_g"] = *of.deceleration / from_g(1.0);
  }
  if (of.impact_speed) {
    out["allowed_impact_speed_mps"] = *of.impact_speed;
  }
  if (row.limit == eval::LimitKind::deceleration) {
    out["allowed_deceleration_mps2"] = row.peak_deceleration;
  }
  if (!result.fault.empty()) {
    out["fault"] = result.fault;
  }
  return out;
}

json json_of(const RegulationRun& run) {
  json out = run.meta;
  const std::string head = "suite." + run.regulation.name + ".";
  json cells = json::array();
  for (std::size_t m = 0; m < run.methods.size(); ++m) {
    const std::string place = head + run.methods[m] + ".";
    const PassCount all = passed_by(run, {.method = m});
    add(out, place, all);
    out[place + "faults"] = all.faults;
    out[place + "worst_impact_mps"] = all.worst;
    for (std::size_t k = 0; k < run.cars.size(); ++k) {
      add(out, place + run.cars[k] + ".", passed_by(run, {.method = m, .car = k}));
    }
    for (std::size_t r = 0; r < run.regulation.rows.size(); ++r) {
      add(out, place + run.regulation.rows[r].name + ".", passed_by(run, {.method = m, .row = r}));
    }
    for (std::size_t k = 0; k < run.cars.size(); ++k) {
      for (std::size_t i = 0; i < run.cells.size(); ++i) {
        cells.push_back(json_of(run, k, i, m));
      }
    }
  }
  for (const RegulationRun& other : run.elsewhere) {
    add(out, head + "aeb." + other.regulation.surfaces[other.regulation.surface].name + ".",
        passed_by(other, {.method = 0}));
  }
  out[head + "n"] = run.cars.size() * run.cells.size();
  out[head + "cells"] = std::move(cells);
  return out;
}

void print(const RegulationRun& run) {
  app::print("{}: {} tests with each of {} cars; tests passed\n\n{:22}", run.regulation.title,
             run.cells.size(), run.cars.size(), "row");
  for (const std::string& method : run.methods) {
    app::print(" {:>20}", method);
  }
  app::print("\n");
  const auto line = [&](const std::string& name, std::optional<std::size_t> car,
                        std::optional<std::size_t> row) {
    app::print("{:22}", name);
    for (std::size_t m = 0; m < run.methods.size(); ++m) {
      const PassCount sum = passed_by(run, {.method = m, .car = car, .row = row});
      app::print(" {:>20}", fmt::format("{} of {}", sum.passed, sum.all));
    }
    app::print("\n");
  };
  for (std::size_t r = 0; r < run.regulation.rows.size(); ++r) {
    line(run.regulation.rows[r].name, std::nullopt, r);
  }
  app::print("\n");
  for (std::size_t k = 0; k < run.cars.size(); ++k) {
    line(run.cars[k], k, std::nullopt);
  }
  line("all", std::nullopt, std::nullopt);
  app::print("\n");
  for (const std::string& sentence : constant_in_words(run)) {
    app::print("{}\n", sentence);
  }
}

}  // namespace

int run_regulation(RegulationOptions options) {
  const auto methods = methods_from(options.methods == "all" ? "" : options.methods, {}, "");
  if (!methods.has_value()) {
    complain(methods.error().message);
    return wrong_command_line;
  }
  if (options.output.empty()) {
    options.output = fmt::format("runs/suite-{}.html", options.name);
  }
  if (fs::path(options.output).extension() != ".html") {
    complain("--output: want a name that ends in .html, got \"" + options.output + "\"");
    return wrong_command_line;
  }
  if (const auto problem = long_work::why_outputs_unwritable({options.output})) {
    return refused(*problem);
  }
  const auto ran = run_cells(options, methods.value());
  if (!ran.has_value()) {
    return refused(ran.error());
  }
  if (!ran.value()) {
    complain("interrupted");
    return was_interrupted;
  }
  const RegulationRun& run = *ran.value();
  const std::string text = json_text(json_of(run)) + "\n";
  auto problem = long_work::write_output(options.output, report::suite_page(page_of(run)));
  if (!problem) {
    problem = long_work::write_output(fs::path(options.output).replace_extension(".json"), text);
  }
  if (problem) {
    return refused(*problem);
  }
  if (options.as_json) {
    app::print("{}", text);
  } else {
    print(run);
    app::print("\npage: {}\n", options.output);
  }
  for (std::size_t m = 0; m < run.methods.size(); ++m) {
    if (passed_by(run, {.method = m}).faults > 0) {
      return some_failed;
    }
  }
  return success;
}

}  // namespace saca::app
