#include <fmt/core.h>

#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "apps/saca/commands.h"
#include "apps/saca/json_output.h"
#include "apps/saca/printing.h"
#include "apps/saca/regulation_command.h"
#include "apps/saca/suite_pages.h"
#include "apps/saca/traffic_suite.h"
#include "saca/lab/long_work/output_file.h"
#include "saca/lab/suites/suite_json.h"
#include "saca/lab/suites/suite_text.h"

namespace saca::app {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

struct SuiteCommand {
  suites::SuiteRequest suite;
  std::optional<std::uint64_t> replay;
  std::string rows;  ///< of a regulation
  bool as_json = false;
};

constexpr const char* traffic_suite = "traffic";

std::optional<Error> write(const SuiteRun& run, const SuiteResult& result, const json& figures,
                           const suites::SuiteRequest& options) {
  if (auto problem = write_rows_and_page(run, result, options)) {
    return problem;
  }
  return long_work::write_output(fs::path(options.output).replace_extension(".json"),
                                 json_text(figures) + "\n");
}

int watch(const SuiteCommand& options) {
  const suites::SuiteRequest& suite = options.suite;
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

/// Why the line cannot be meant as it stands; nullopt: it can.
std::optional<std::string> why_wrong(const CLI::App& line, const SuiteCommand& options) {
  const suites::SuiteRequest& suite = options.suite;
  if (!options.rows.empty()) {
    return "--rows: want it of a regulation (fmvss127, r152), got " + suite.name;
  }
  if ((suite.name == traffic_suite || suite.name == "100car") == suite.data.empty()) {
    return "--data: want it with the suites 100car and traffic, and only there";
  }
  if (suite.name == traffic_suite && thinks(line)) {
    return "--memory, --llm, --untuned: SACA watches the suite traffic with the verdict alone";
  }
  return std::nullopt;
}

int replay(const suites::SuiteRequest& suite, std::uint64_t number) {
  const auto command = write_encounter(suite, number);
  if (!command.has_value()) {
    return refused(command.error());
  }
  app::print("{}\n", command.value());
  return success;
}

int write_and_print(const SuiteRun& run, const suites::SuiteRequest& suite, bool as_json) {
  const SuiteResult result = result_of(run, suite.seed);
  const json figures = suites::json_of(run, result, suite);
  if (const auto problem = write(run, result, figures, suite)) {
    return refused(*problem);
  }
  if (as_json) {
    app::print_json(figures);
  } else {
    app::print("{}page: {}, rows: {}\n", suites::text_of(run, result, suite),
               fs::path(suite.output).replace_extension(".html").string(), suite.output);
  }
  return result.faults + result.method_faults > 0 ? some_failed : success;
}

int play(suites::SuiteRequest suite, const std::vector<std::string>& methods, bool as_json) {
  if (suite.output.empty()) {
    suite.output =
        fmt::format("runs/suite-{}-{}.h5", fs::path(suite.name).filename().string(), suite.split);
  }
  if (const auto problem = long_work::why_outputs_unwritable({suite.output})) {
    return refused(*problem);
  }
  const auto ran = run_suite(suite, "suite", methods);
  if (!ran.has_value()) {
    return refused(ran.error());
  }
  if (!ran.value()) {
    complain("interrupted; the same command goes on where this one stopped");
    return was_interrupted;
  }
  return write_and_print(*ran.value(), suite, as_json);
}

int run(const CLI::App& line, SuiteCommand options) {
  const auto places = find_places();
  if (!places.has_value()) {
    return refused(places.error());
  }
  suites::SuiteRequest& suite = options.suite;
  if (fs::exists(regulation_path(places.value(), suite.name))) {
    return run_as_regulation(line, options);
  }
  if (const auto problem = why_wrong(line, options)) {
    complain(*problem);
    return wrong_command_line;
  }
  if (suite.name == traffic_suite) {
    return watch(options);
  }
  if (options.replay) {
    return replay(suite, *options.replay);
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
  return play(suite, methods.value(), options.as_json);
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
