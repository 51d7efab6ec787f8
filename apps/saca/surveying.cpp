#include "apps/saca/surveying.h"

#include <fmt/core.h>

#include <algorithm>
#include <filesystem>

#include "apps/saca/progress.h"
#include "saca/core/file.h"
#include "saca/core/fnv.h"
#include "saca/core/journal.h"
#include "saca/manoeuvre/ego.h"

namespace saca::app {
namespace {

namespace fs = std::filesystem;
using eval::Finding;

constexpr int batch = 64;  // encounters between two looks at the clock and the signals

/// Of everything that changes what is found: the files, and the program itself.
std::optional<Error> add_files(const Places& places, const std::string& car, Fnv& hash) {
  std::vector<fs::path> files{
      find_car(places, car), "/proc/self/exe", places.root / "data" / "harm.toml",
      places.root / "data" / "thinking_costs.toml", places.root / "scenarios" / "splits.toml"};
  files.push_back(manoeuvre::tuning_path(files.front()));
  for (const auto& entry : fs::directory_iterator(places.root / "scenarios" / "families")) {
    if (entry.path().extension() == ".toml") {
      files.push_back(entry.path());
    }
  }
  std::sort(files.begin(), files.end());
  for (const fs::path& file : files) {
    const auto text = read_file(file);
    if (!text.has_value()) {
      return text.error();
    }
    hash.add(text.value());
  }
  return std::nullopt;
}

/// A suite of that name, or a family as a suite of itself.
Result<sim::Suite> find_suite(const Places& places, const std::string& wanted) {
  const fs::path folder = places.root / "scenarios" / "families";
  const auto suites = sim::load_suites(folder / "suites.toml");
  if (!suites.has_value()) {
    return suites.error();
  }
  std::string names;
  for (const sim::Suite& suite : suites.value()) {
    if (suite.name == wanted) {
      return suite;
    }
    names += (names.empty() ? "" : ", ") + suite.name;
  }
  const bool is_plain = wanted.find('/') == std::string::npos && wanted != "surroundings";
  if (is_plain && !wanted.empty() && fs::is_regular_file(folder / (wanted + ".toml"))) {
    return sim::Suite{.name = wanted, .why = {}, .members = {{wanted, 1.0, {}}}};
  }
  return Error{Error::Code::out_of_range,
               fmt::format("{}: want one of {}, or a family, got \"{}\"",
                           (folder / "suites.toml").string(), names, wanted)};
}

/// What a journal remembers, in order.
Result<std::vector<Finding>> remembered(const Journal& journal, const std::string& path,
                                        int count) {
  std::vector<Finding> found;
  for (const std::string& line : journal.lines()) {
    const auto finding = eval::finding_from(line);
    if (!finding || finding->number != found.size()) {
      return Error{Error::Code::malformed,
                   fmt::format("{}: line {}: want the finding of encounter {}, got \"{}\"", path,
                               found.size() + 2, found.size(), line)};
    }
    found.push_back(*finding);
  }
  found.resize(std::min(found.size(), static_cast<std::size_t>(count)));
  return found;
}

/// The next few. The number of threads changes nothing.
Result<std::vector<Finding>> look_on(const SuiteSource& source, std::size_t from, std::size_t to,
                                     int threads) {
  std::vector<sim::Scenario> scenarios(to - from);
  std::vector<std::optional<Error>> problems(to - from);
  in_parallel(scenarios.size(), threads, [&](std::size_t i) {
    const auto sample = source.sample(from + i);
    if (sample.has_value()) {
      scenarios[i] = sample.value().scenario;
    } else {
      problems[i] = sample.error();
    }
  });
  for (const auto& problem : problems) {
    if (problem) {
      return *problem;
    }
  }
  std::vector<Finding> next =
      eval::look_into(scenarios, source.inputs().car, source.inputs().harm, threads);
  for (std::size_t i = 0; i < next.size(); ++i) {
    next[i].number = from + i;
    next[i].family = source.family_of(from + i);
  }
  return next;
}

}  // namespace

std::string command_line(const SurveyOptions& options, const std::string& command) {
  const std::string log = options.test_log.empty() ? "" : " --test-log " + options.test_log;
  return fmt::format("saca {} --suite {} --count {} --split {} --car {}{}", command, options.suite,
                     options.count, options.split, options.car, log);
}

Result<SuiteSource> SuiteSource::open(const SurveyOptions& options, const std::string& command) {
  SuiteSource source;
  auto inputs = read_inputs(options.car);
  if (!inputs.has_value()) {
    return inputs.error();
  }
  source.inputs_ = inputs.value();
  const Places& places = source.inputs_.places;
  const auto suite = find_suite(places, options.suite);
  if (!suite.has_value()) {
    return suite.error();
  }
  source.suite_ = suite.value();
  const auto splits = read_splits(places);
  if (!splits.has_value()) {
    return splits.error();
  }
  std::optional<sim::TestLog> log;
  if (!options.test_log.empty()) {
    log = sim::TestLog{options.test_log, command_line(options, command)};
  }
  for (const sim::Suite::Member& member : source.suite_.members) {
    const auto family = read_family(places, member.family);
    if (!family.has_value()) {
      return family.error();
    }
    source.families_.push_back(family.value());
  }
  Fnv hash;
  if (auto problem = add_files(places, options.car, hash)) {
    return *problem;
  }
  source.digest_ = hash.value();
  for (const sim::Family& family : source.families_) {  // last: a use of the test split is noted
    const auto seed =
        sim::seed_for(splits.value(), *sim::split_from(options.split), family.name, log);
    if (!seed.has_value()) {
      return seed.error();
    }
    source.seeds_.push_back(seed.value());
  }
  return source;
}

Result<sim::FamilySample> SuiteSource::sample(std::uint64_t number) const {
  const std::size_t member = sim::member_of(suite_, number);
  return sim::sample(families_[member], seeds_[member], number, inputs_.car_name,
                     manoeuvre::footprint(inputs_.car));
}

const std::string& SuiteSource::family_of(std::uint64_t number) const {
  return suite_.members[sim::member_of(suite_, number)].family;
}

Result<std::optional<std::vector<Finding>>> survey(const SuiteSource& source,
                                                   const SurveyOptions& options) {
  const std::string path = options.journal.empty() ? fmt::format("runs/survey-{}-{}.journal",
                                                                 options.suite, options.split)
                                                   : options.journal;
  if (auto problem = make_folder_of(path)) {
    return *problem;
  }
  const auto opened =
      Journal::open(path, fmt::format("saca {} survey of {}, {} split, {} ({:016x})", SACA_VERSION,
                                      options.suite, options.split, options.car, source.digest()));
  if (!opened.has_value()) {
    return opened.error();
  }
  const Journal& journal = opened.value();
  auto known = remembered(journal, path, options.count);
  if (!known.has_value()) {
    return known.error();
  }
  std::vector<Finding> found = std::move(known).value();
  watch_for_interrupt();
  SteadyClock clock;
  ProgressLine progress("survey of " + options.suite, options.count, clock);
  const int before = static_cast<int>(found.size());
  const auto count = static_cast<std::size_t>(options.count);
  while (found.size() < count) {
    if (interrupted()) {
      return std::optional<std::vector<Finding>>();
    }
    const auto next =
        look_on(source, found.size(), std::min(count, found.size() + batch), options.threads);
    if (!next.has_value()) {
      return next.error();
    }
    for (const Finding& finding : next.value()) {
      if (!journal.add(eval::line_of(finding))) {
        return Error{Error::Code::unwritable, path + ": cannot be added to"};
      }
      found.push_back(finding);
    }
    progress.show(static_cast<int>(found.size()), before, " encounters");
  }
  return std::optional(found);
}

void add_draw_options(CLI::App& command, int& count, std::string& split, std::string& test_log,
                      std::string& car) {
  command.add_option("--count", count, "How many encounters")
      ->check(CLI::Range(1, 10'000'000))
      ->capture_default_str();
  command.add_option("--split", split, "Whose seed is used")
      ->check(CLI::IsMember({"tuning", "calibration", "test"}))
      ->capture_default_str();
  command.add_option("--test-log", test_log,
                     "Where a use of the test split is noted; needed for it");
  command.add_option("--car", car, "A car's file, or the name of a shipped one")
      ->capture_default_str();
}

void add_survey_options(CLI::App& command, SurveyOptions& options) {
  command.add_option("--suite", options.suite, "Which mixture of families")->capture_default_str();
  add_draw_options(command, options.count, options.split, options.test_log, options.car);
  command.add_option("--journal", options.journal,
                     "What was found so far (default: runs/survey-SUITE-SPLIT.journal)");
  command.add_option("--threads", options.threads, "They do not change the result")
      ->check(CLI::Range(1, 256))
      ->capture_default_str();
}

}  // namespace saca::app
