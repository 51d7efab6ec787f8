#include "apps/saca/options.h"
#include "saca/lab/installation/drawn_suite.h"
#include "saca/lab/installation/shipped_files.h"
#include "saca/lab/regulation/regulation_json.h"
#include "saca/lab/regulation/regulation_page.h"
#include "saca/lab/regulation/regulation_request.h"
#include "saca/lab/regulation/regulation_text.h"
#include "saca/lab/suites/method_list.h"
#include "saca/lab/suites/opened_suite.h"
#include "saca/lab/suites/suite_json.h"
#include "saca/lab/suites/suite_text.h"
#include "saca/lab/suites/traffic_json.h"
#include "saca/lab/suites/traffic_page.h"
#include "saca/lab/suites/traffic_text.h"
#include "saca/lab/vehicle_study/car_planes.h"

namespace saca::app {
namespace {

using nlohmann::json;

struct SuiteOptions {
  suites::SuiteRequest suite{.methods = suites::usual_methods({})};
  std::optional<std::uint64_t> replay;
  std::string rows;  ///< of a regulation
  bool as_json = false;
  const CLI::App* line = nullptr;  ///< that they were given in
};

bool given(const SuiteOptions& options, const char* option) {
  return options.line->count(option) > 0;
}

bool thinks(const SuiteOptions& options) {
  return given(options, "--memory") || given(options, "--llm") || given(options, "--untuned");
}

/// Leaves the page and beside it the figures, and tells of them.
/// @param page  its name
void write_and_tell(const fs::path& page, const report::SuitePage& made, const json& figures,
                    bool as_json, const std::string& text) {
  write(page, report::suite_page(made));
  write(fs::path(page).replace_extension(".json"), json_text(figures));
  tell(as_json, figures, text);
}

/// @param why  behind the option's name
void refuse_options(const SuiteOptions& options, std::initializer_list<const char*> names,
                    const std::string& why) {
  for (const char* const name : names) {
    if (given(options, name)) {
      refuse(wrong_command_line, fmt::format("{}: {}", name, why));
    }
  }
}

/// The tests of a regulation: nothing is drawn in them, and what is said of drawing is refused.
ExitCode run_as_regulation(const SuiteOptions& options) {
  const suites::SuiteRequest& suite = options.suite;
  refuse_options(options,
                 {"--count", "--split", "--test-log", "--seed", "--exact", "--no-twins", "--replay",
                  "--t1-s", "--waiting-cost", "--danger", "--data"},
                 suite.name + " is a regulation, which is run as it stands");
  if (thinks(options)) {
    refuse(wrong_command_line,
           fmt::format("--memory, --llm, --untuned: {} tests SACA as it ships, without them",
                       suite.name));
  }
  regulation::RegulationRequest request{
      .name = suite.name, .rows = options.rows, .threads = suite.threads};
  if (given(options, "--methods")) {
    request.methods = suite.methods;
  }
  if (given(options, "--car")) {
    request.cars = suite.car;
  }
  const auto methods =
      need_of_line(suites::methods_from(request.methods == "all" ? "" : request.methods, {}, ""));
  const std::string output =
      suite.output.empty() ? fmt::format("runs/suite-{}.html", suite.name) : suite.output;
  if (fs::path(output).extension() != ".html") {
    refuse(wrong_command_line, "--output: want a name that ends in .html, got \"" + output + "\"");
  }
  need_writable({output});
  const auto run = need_whole(regulation::run_regulation(here(), request, methods), "interrupted");
  write_and_tell(output, page_of(run), json_of(run), options.as_json,
                 fmt::format("{}\npage: {}\n", text_of(run), output));
  return has_faults(run) ? some_failed : success;
}

/// The program, and all that changes what it sees in a drive.
std::string made_by(const std::string& car) {
  Fnv hash;
  need(installation::add_inputs(here(), car, hash));
  return fmt::format("{} ({:016x})", installation::version_text(here()), hash.value());
}

/// SACA beside recorded drives, in shadow.
ExitCode watch_traffic(const SuiteOptions& options) {
  const suites::SuiteRequest& suite = options.suite;
  refuse_options(
      options,
      {"--methods", "--split", "--test-log", "--exact", "--no-twins", "--danger", "--replay"},
      "SACA alone watches the suite traffic, as it was recorded");
  const suites::TrafficWatch watch{
      .folders = suite.data,
      .count = suite.count,
      .seed = suite.seed,
      .car = suite.car,
      .thresholds = suite.thresholds,
      .output = suite.output.empty() ? "runs/suite-traffic.html" : suite.output,
      .threads = suite.threads};
  need_writable({watch.output});
  const auto planes =
      need(vehicle_study::open_planes(here(), read_inputs(watch.car), watch.thresholds));
  const suites::WatchTools tools{
      .car = &planes->inputs.car, .intent = &planes->inputs.intent, .saca = &planes->setup};
  const auto traffic =
      need_whole(suites::watch_traffic(watch, tools, made_by(watch.car), here().display));
  const suites::ShadowFigures all = suites::shadow_figures(traffic.rows, "");
  if (all.drives == 0) {
    refuse(bad_input,
           fmt::format("{}: want drives that can be watched, got none of {}: {}",
                       watch.folders.front(), traffic.rows.size(), traffic.rows.front().left_out));
  }
  const json figures = suites::traffic_json(traffic, watch, SACA_VERSION);
  const fs::path page = fs::path(watch.output).replace_extension(".html");
  write_and_tell(page, suites::traffic_page(traffic, tools, figures), figures, options.as_json,
                 fmt::format("{}page: {}, figures: {}\n", suites::traffic_text(traffic),
                             page.string(), fs::path(page).replace_extension(".json").string()));
  return all.failed > 0 ? some_failed : success;
}

/// Writes an encounter as a scenario, as the suite plays it, and tells what plays it.
void write_encounter(const SuiteOptions& options) {
  refuse_options(options, {"--t1-s", "--waiting-cost"},
                 "`saca run`, which plays what --replay writes, has T1 and cost of waiting as they "
                 "ship");
  refuse_options(options, {"--output"},
                 "--replay writes the encounter below runs/, under its own name");
  if (given(options, "--count") &&
      *options.replay >= static_cast<std::uint64_t>(options.suite.count)) {
    refuse(wrong_command_line, fmt::format("--replay: want an encounter below --count {}, got {}",
                                           options.suite.count, *options.replay));
  }
  const auto source = need(suites::open_encounters(here(), options.suite, "suite"));
  const auto replay = need(suites::replay_of(source, options.suite, *options.replay));
  write(replay.file, replay.text);
  app::print("{}\n", replay.command);
}

ExitCode play_suite(const SuiteOptions& options) {
  suites::SuiteRequest suite = options.suite;
  if (!given(options, "--methods")) {
    suite.methods = suites::usual_methods(suite.thinking);
  }
  const auto methods = need_of_line(suites::methods_from(
      suite.methods == "all" ? "" : suite.methods, suite.thinking, suite.danger));
  if (suite.output.empty()) {
    suite.output =
        fmt::format("runs/suite-{}-{}.h5", fs::path(suite.name).filename().string(), suite.split);
  }
  refuse_endings(suite.output, {".json", ".html"});
  need_distinct({{"--output", suite.output}},
                {{"--memory", suite.thinking.memory}, {"--danger", suite.danger}});
  need_writable({suite.output});
  const auto run = need_whole(suites::run_suite(here(), suite, "suite", methods));
  const suites::SuiteResult result = suites::result_of(run, suite.seed);
  const json figures = suites::json_of(run, result, suite);
  need(suites::write_rows_and_page(run, result, suite));
  write(fs::path(suite.output).replace_extension(".json"), json_text(figures));
  tell(options.as_json, figures,
       fmt::format("{}page: {}, rows: {}\n", suites::text_of(run, result, suite),
                   fs::path(suite.output).replace_extension(".html").string(), suite.output));
  return result.faults + result.method_faults > 0 ? some_failed : success;
}

ExitCode run_suite(const SuiteOptions& options) {
  const suites::SuiteRequest& suite = options.suite;
  if (fs::exists(installation::regulation_place(here(), suite.name))) {
    return run_as_regulation(options);
  }
  const bool is_traffic = suite.name == "traffic";
  if (!options.rows.empty()) {
    refuse(wrong_command_line,
           "--rows: want it of a regulation (fmvss127, r152), got " + suite.name);
  }
  if ((is_traffic || suite.name == "100car") == suite.data.empty()) {
    refuse(wrong_command_line,
           "--data: want it with the suites 100car and traffic, and only there");
  }
  if (is_traffic && thinks(options)) {
    refuse(wrong_command_line,
           "--memory, --llm, --untuned: SACA watches the suite traffic with the verdict alone");
  }
  if (is_traffic) {
    return watch_traffic(options);
  }
  if (options.replay) {
    write_encounter(options);
    return success;
  }
  return play_suite(options);
}

}  // namespace

void add_suite(CLI::App& line) {
  const auto [command, options] = add_command<SuiteOptions>(
      line, "suite",
      "Run methods in closed loop over many encounters, paired, or over what a regulation asks "
      "(fmvss127, r152); can be interrupted",
      run_suite);
  options.line = &command;
  suites::SuiteRequest& suite = options.suite;
  add_suite_options(command, suite);
  add_untuned_option(command, suite.thinking.untuned);
  add(command, "--methods", suite.methods,
      "Names, separated by commas; all: every one. With --memory or --llm the default has SACA "
      "without it as well, with --untuned SACA with that model");
  add(command, "--replay", options.replay,
      "Write encounter N as a scenario, and print the command that plays it");
  command.add_flag("--no-twins", suite.no_twins, "Leave the twins without risk out");
  add(command, "--rows", options.rows,
      "Of a regulation, only these tests: names of its file, separated by commas");
  add_json(command, options.as_json);
}

}  // namespace saca::app
