#include <fmt/core.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>

#include "apps/saca/commands.h"
#include "apps/saca/json_output.h"
#include "apps/saca/printing.h"
#include "apps/saca/regulation_command.h"
#include "apps/saca/suite_decisions.h"
#include "apps/saca/suite_pages.h"
#include "apps/saca/traffic_suite.h"
#include "saca/base/core/file.h"
#include "saca/lab/long_work/output_file.h"

namespace saca::app {
namespace {

namespace fs = std::filesystem;
using eval::Estimate;
using eval::MethodFigures;
using nlohmann::json;

struct SuiteCommand {
  SuiteCommandOptions suite;
  std::optional<std::uint64_t> replay;
  std::string rows;  ///< of a regulation
  bool as_json = false;
};

constexpr const char* traffic_suite = "traffic";

json json_of(const SuiteRun& run, const SuiteResult& result, const SuiteCommandOptions& options) {
  json out = run.meta;
  const std::string head = "suite." + fs::path(options.name).filename().string() + ".";
  const auto add_figures = [&](const std::string& place, const MethodFigures& one) {
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
    if (one.false_trigger_loss) {
      add_estimate(out, place + "false_trigger_loss", *one.false_trigger_loss);
      add_estimate(out, place + "false_triggers", *one.false_triggers);
    }
  };
  const auto aeb = index_of(run.methods, "aeb");
  for (std::size_t m = 0; m < result.all.size(); ++m) {
    const MethodFigures& one = result.all[m];
    const std::string place = head + one.method + ".";
    add_figures(place, one);
    if (aeb && result.all[*aeb].regret.value > 0.0) {
      out[place + "regret_over_aeb"] = one.regret.value / result.all[*aeb].regret.value;
    }
    add_estimate(out, place + "harm_over_first", eval::harm_above(run.rows, m, 0, options.seed));
    add_decisions(out, place, one);
    out[place + "faults"] = one.faults;
    for (const auto& [family, figures] : result.families) {
      if (!figures.empty()) {
        add_figures(place + family + ".", figures[m]);
      }
    }
  }
  const DriverFigures drivers = driver_figures(run);
  if (drivers.count > 0) {
    out[head + "driver.n"] = drivers.count;
    out[head + "driver.harm"] = drivers.harm;
    out[head + "driver.met"] = drivers.met;
    out[head + "driver.braked"] = drivers.braked;
    out[head + "driver.steered"] = drivers.steered;
    for (std::size_t m = 0; m < run.methods.size(); ++m) {
      out[head + run.methods[m] + ".agrees_with_driver"] = drivers.agreement[m];
    }
  }
  out[head + "n"] = run.rows.size();
  out[head + "faults"] = result.faults;
  if (run.worked > 0) {
    const double rate = run.worked / run.seconds;
    out[head + "encounters_per_s"] = rate;
    out[head + "encounters_per_s_core"] = rate / options.threads;
    out[head + "threads"] = options.threads;
  }
  return out;
}

void print(const SuiteRun& run, const SuiteResult& result, const SuiteCommandOptions& options) {
  app::print("{}: {} encounters, {} could not be played; means with 95 % intervals\n", options.name,
             run.rows.size(), result.faults);
  for (const std::string& note : run.notes) {
    app::print("{}\n", note);
  }
  app::print("\n");
  constexpr const char* line = "{:22} {:26} {:26} {:26} {:7} {:6} {:9} {:8}\n";
  app::print(line, "method", "harm", "regret, all plans", "regret, as published", "contact",
             "right", "worse than", "needless");
  app::print(line, "", "", "", "", "%", "%", "AEB, %", "%");
  for (const MethodFigures& one : result.all) {
    const auto share = [](const Estimate& estimate) {
      return estimate.n == 0 ? std::string("-") : fmt::format("{:.1f}", 100.0 * estimate.value);
    };
    app::print(line, one.method, with_interval(one.harm, 4), with_interval(one.regret, 4),
               with_interval(one.published_regret, 4), share(one.contact), share(one.right),
               share(one.worse_than_aeb), share(one.needless));
  }
  for (const MethodFigures& one : result.all) {
    if (one.thinking) {
      app::print("\n{}\n", decisions_text(one));
      if (one.expected) {
        app::print("{}\n", expectations_text(one));
      }
    }
  }
  const DriverFigures drivers = driver_figures(run);
  if (drivers.count > 0) {
    app::print("\n{} recorded drivers: harm {:.4f}, {} met somebody, {} braked, {} moved aside\n",
               drivers.count, drivers.harm, drivers.met, drivers.braked, drivers.steered);
    for (std::size_t m = 0; m < run.methods.size(); ++m) {
      app::print("  {} does as the driver did in {:.0f} % of those who met nobody\n",
                 run.methods[m], 100.0 * drivers.agreement[m]);
    }
  }
  if (run.worked > 0) {
    app::print("\n{:.1f} encounters/s on {} threads\n", run.worked / run.seconds, options.threads);
  }
  if (result.method_faults > 0) {
    app::print("{} times a method failed: the rows hold why\n", result.method_faults);
  }
}

std::optional<Error> write(const SuiteRun& run, const SuiteResult& result, const json& figures,
                           const SuiteCommandOptions& options) {
  if (auto problem = write_rows_and_page(run, result, options)) {
    return problem;
  }
  return long_work::write_output(fs::path(options.output).replace_extension(".json"),
                                 json_text(figures) + "\n");
}

int watch(const SuiteCommand& options) {
  const SuiteCommandOptions& suite = options.suite;
  return run_traffic_suite(
      {.folders = suite.data,
       .count = suite.count,
       .seed = suite.seed,
       .car = suite.car,
       .thresholds = suite.thresholds,
       .output = suite.output.empty() ? "runs/suite-traffic.html" : suite.output,
       .threads = suite.threads},
      options.as_json);
}

bool thinks(const CLI::App& line) {
  return line.count("--memory") > 0 || line.count("--llm") > 0 || line.count("--untuned") > 0;
}

/// The tests of a regulation: nothing is drawn in them, and what is said of drawing is refused.
int run_as_regulation(const CLI::App& line, const SuiteCommand& options) {
  for (const char* const name : {"--count", "--split", "--test-log", "--seed", "--exact",
                                 "--no-twins", "--replay", "--t1-s", "--waiting-cost"}) {
    if (line.count(name) > 0) {
      complain(fmt::format("{}: {} is a regulation, which is run as it stands", name,
                           options.suite.name));
      return wrong_command_line;
    }
  }
  if (thinks(line)) {
    complain(fmt::format("--memory, --llm, --untuned: {} tests SACA as it ships, without them",
                         options.suite.name));
    return wrong_command_line;
  }
  RegulationOptions tests{.name = options.suite.name,
                          .rows = options.rows,
                          .output = options.suite.output,
                          .threads = options.suite.threads,
                          .as_json = options.as_json};
  if (line.count("--methods") > 0) {
    tests.methods = options.suite.methods;
  }
  if (line.count("--car") > 0) {
    tests.cars = options.suite.car;
  }
  return run_regulation(tests);
}

int run(const CLI::App& line, SuiteCommand options) {
  const auto places = find_places();
  if (!places.has_value()) {
    return refused(places.error());
  }
  if (fs::exists(regulation_path(places.value(), options.suite.name))) {
    return run_as_regulation(line, options);
  }
  if (!options.rows.empty()) {
    complain("--rows: want it of a regulation (fmvss127, r152), got " + options.suite.name);
    return wrong_command_line;
  }
  SuiteCommandOptions& suite = options.suite;
  if ((suite.name == traffic_suite || suite.name == "100car") == suite.data.empty()) {
    complain("--data: want it with the suites 100car and traffic, and only there");
    return wrong_command_line;
  }
  if (suite.name == traffic_suite && thinks(line)) {
    complain("--memory, --llm, --untuned: SACA watches the suite traffic with the verdict alone");
    return wrong_command_line;
  }
  if (suite.name == traffic_suite) {
    return watch(options);
  }
  if (options.replay) {
    const auto command = write_encounter(suite, *options.replay);
    if (!command.has_value()) {
      return refused(command.error());
    }
    app::print("{}\n", command.value());
    return success;
  }
  if (line.count("--methods") == 0) {
    suite.methods = suites::usual_methods(suite.thinking);
  }
  const auto methods =
      methods_from(suite.methods == "all" ? "" : suite.methods, suite.thinking, suite.danger);
  if (!methods.has_value()) {
    complain(methods.error().message);
    return wrong_command_line;
  }
  if (suite.output.empty()) {
    suite.output =
        fmt::format("runs/suite-{}-{}.h5", fs::path(suite.name).filename().string(), suite.split);
  }
  if (const auto problem = long_work::why_outputs_unwritable({suite.output})) {
    return refused(*problem);
  }
  const auto ran = run_suite(suite, "suite", methods.value());
  if (!ran.has_value()) {
    return refused(ran.error());
  }
  if (!ran.value()) {
    complain("interrupted; the same command goes on where this one stopped");
    return was_interrupted;
  }
  const SuiteRun& done = *ran.value();
  const SuiteResult result = result_of(done, suite.seed);
  const json figures = json_of(done, result, suite);
  if (const auto problem = write(done, result, figures, suite)) {
    return refused(*problem);
  }
  if (options.as_json) {
    app::print_json(figures);
  } else {
    print(done, result, suite);
    app::print("page: {}, rows: {}\n", fs::path(suite.output).replace_extension(".html").string(),
               suite.output);
  }
  return result.faults + result.method_faults > 0 ? some_failed : success;
}

}  // namespace

void add_suite(CLI::App& line, int& exit_code) {
  CLI::App* const command = line.add_subcommand(
      "suite",
      "Run methods in closed loop over many encounters, paired, or over what a regulation asks "
      "(fmvss127, r152); can be interrupted");
  const auto options = std::make_shared<SuiteCommand>();
  options->suite.methods = suites::usual_methods({});
  add_suite_options(*command, options->suite);
  add_untuned_option(*command, options->suite.thinking);
  command
      ->add_option("--methods", options->suite.methods,
                   "Names, separated by commas; all: every one. With --memory or --llm the "
                   "default has SACA without it as well, with --untuned SACA with that model")
      ->capture_default_str();
  command->add_option("--replay", options->replay,
                      "Write encounter N as a scenario, and print the command that plays it");
  command->add_flag("--no-twins", options->suite.no_twins, "Leave the twins without risk out");
  command->add_option("--rows", options->rows,
                      "Of a regulation, only these tests: names of its file, separated by commas");
  command->add_flag("--json", options->as_json, "For programs");
  command->callback([command, options, &exit_code] { exit_code = run(*command, *options); });
}

}  // namespace saca::app
