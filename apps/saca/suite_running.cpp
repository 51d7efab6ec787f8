#include "apps/saca/suite_running.h"

#include <fmt/core.h>

#include <algorithm>
#include <filesystem>
#include <memory>

#include "apps/saca/planes_making.h"
#include "apps/saca/progress.h"
#include "saca/core/csv.h"
#include "saca/core/file.h"
#include "saca/core/fnv.h"
#include "saca/core/journal.h"
#include "saca/manoeuvre/ego.h"
#include "saca/sim/hundred_car_release.h"

namespace saca::app {
namespace {

namespace fs = std::filesystem;
using eval::SuiteEncounter;
using eval::SuiteRow;

constexpr std::size_t batch_per_thread = 16;  // encounters between two looks at the signals

/// Where encounters come from: families of a suite, or files of a folder.
struct Source {
  Inputs inputs;                   ///< until planes are made of them
  std::string what;                ///< names all on which the encounters depend
  int count = 0;                   ///< as many as were asked for and there are
  std::vector<std::string> notes;  ///< on where they come from
  std::function<Result<SuiteEncounter>(std::uint64_t number)> at;
};

/// Encounters that are all there.
Source source_of(Inputs inputs, std::vector<SuiteEncounter> all, int count, std::string what) {
  Source source{.inputs = std::move(inputs), .what = std::move(what), .notes = {}, .at = {}};
  source.count = std::min(count, static_cast<int>(all.size()));
  source.at = [all = std::move(all)](std::uint64_t number) -> Result<SuiteEncounter> {
    if (number >= all.size()) {
      return Error{Error::Code::out_of_range,
                   fmt::format("want an encounter below {}, got {}", all.size(), number)};
    }
    return all[number];
  };
  return source;
}

/// Every event of the 100-Car study that can be rebuilt.
Result<Source> open_hundred_car(const SuiteCommandOptions& options, Inputs inputs) {
  if (options.data.size() != 1) {
    return Error{
        Error::Code::out_of_range,
        fmt::format("--data: want the folder of the 100-Car study's release, got {} folders",
                    options.data.size())};
  }
  const std::string& folder = options.data.front();
  watch_for_interrupt();
  const auto outcomes =
      sim::import_hundred_cars(folder, {}, [](std::size_t, std::size_t) { return !interrupted(); });
  if (!outcomes.has_value()) {
    return outcomes.error();
  }
  std::vector<SuiteEncounter> all;
  Fnv hash;
  for (const sim::HundredCarOutcome& outcome : outcomes.value()) {
    if (const auto* const rebuilt = outcome.rebuilt()) {
      hash.add(sim::write_scenario(rebuilt->scenario));
      all.push_back({.number = all.size(),
                     .family = outcome.severity,
                     .scenario = rebuilt->scenario,
                     .twin = {}});
      all.back().scenario.car = inputs.car_name;
    }
  }
  if (all.empty()) {
    return Error{Error::Code::out_of_range, folder + ": want events that can be rebuilt, got none"};
  }
  std::string refused;
  for (const auto& [reason, times] : sim::refusals(outcomes.value())) {
    refused += fmt::format("{}{} ({})", refused.empty() ? "" : ", ", times, meaning(reason));
  }
  const std::size_t rebuilt = all.size();
  Source source = source_of(std::move(inputs), std::move(all), options.count,
                            fmt::format("100-Car study ({:016x})", hash.value()));
  source.notes.push_back(fmt::format("{} of {} events were rebuilt; refused: {}.", rebuilt,
                                     outcomes.value().size(), refused));
  return source;
}

Result<Source> open_folder(const SuiteCommandOptions& options, Inputs inputs) {
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(options.name)) {
    if (entry.path().extension() == ".toml") {
      files.push_back(entry.path());
    }
  }
  std::sort(files.begin(), files.end());
  if (files.empty()) {
    return Error{Error::Code::out_of_range,
                 options.name + ": want a folder with scenarios (*.toml), got none"};
  }
  std::vector<SuiteEncounter> all;
  Fnv hash;
  for (const fs::path& file : files) {
    const auto text = read_file(file);
    if (!text.has_value()) {
      return text.error();
    }
    hash.add(text.value());
    auto scenario =
        sim::read_scenario(text.value(), file.string(), manoeuvre::footprint(inputs.car));
    if (!scenario.has_value()) {
      return scenario.error();
    }
    all.push_back({.number = all.size(),
                   .family = file.stem(),
                   .scenario = std::move(scenario).value(),
                   .twin = {}});
  }
  return source_of(std::move(inputs), std::move(all), options.count,
                   fmt::format("folder {} ({:016x})", options.name, hash.value()));
}

Result<Source> open_source(const SuiteCommandOptions& options, const std::string& command) {
  if (options.name == "100car" || fs::is_directory(options.name)) {
    auto inputs = read_inputs(options.car);
    if (!inputs.has_value()) {
      return inputs.error();
    }
    return options.name == "100car" ? open_hundred_car(options, std::move(inputs).value())
                                    : open_folder(options, std::move(inputs).value());
  }
  const auto suite = SuiteSource::open({.suite = options.name,
                                        .car = options.car,
                                        .count = options.count,
                                        .split = options.split,
                                        .test_log = options.test_log},
                                       command);
  if (!suite.has_value()) {
    return suite.error();
  }
  Source source;
  source.inputs = suite.value().inputs();
  source.count = options.count;
  source.what =
      fmt::format("{}, {} split ({:016x})", options.name, options.split, suite.value().digest());
  source.at = [suite = suite.value(),
               twins = !options.no_twins](std::uint64_t number) -> Result<SuiteEncounter> {
    auto sample = suite.sample(number);
    if (!sample.has_value()) {
      return sample.error();
    }
    return SuiteEncounter{.number = number,
                          .family = suite.family_of(number),
                          .scenario = sample.value().scenario,
                          .twin = twins ? std::optional(sample.value().twin) : std::nullopt};
  };
  return source;
}

std::string joined(const std::vector<std::string>& words) {
  std::string all;
  for (const std::string& word : words) {
    all += (all.empty() ? "" : ",") + word;
  }
  return all;
}

/// A recorded driver met the world as it was recorded: so do those who are compared with it.
eval::SuiteOptions how_of(const SuiteCommandOptions& options,
                          const std::vector<std::string>& methods) {
  return {
      .methods = methods, .seed = options.seed, .exact = options.exact || options.name == "100car"};
}

/// All that encounters are run with.
struct Bench {
  Source source;
  std::unique_ptr<const PlanesOfCar> planes;
  eval::SuiteOptions how;
};

Result<std::shared_ptr<Bench>> open_bench(const SuiteCommandOptions& options,
                                          const std::string& command,
                                          const std::vector<std::string>& methods) {
  auto source = open_source(options, command);
  if (!source.has_value()) {
    return source.error();
  }
  Source opened = std::move(source).value();
  auto planes = open_planes(std::move(opened.inputs));
  if (!planes.has_value()) {
    return planes.error();
  }
  return std::make_shared<Bench>(
      Bench{std::move(opened), std::move(planes).value(), how_of(options, methods)});
}

/// A row, whatever happens: what cannot be drawn is a fault of that encounter.
SuiteRow row_of(const Bench& bench, std::uint64_t number) {
  const auto encounter = bench.source.at(number);
  if (!encounter.has_value()) {
    return {.number = number,
            .family = "?",
            .fault = encounter.error().message,
            .risk = {},
            .twin = {},
            .driver = {}};
  }
  return eval::run_encounter(encounter.value(), bench.how, bench.planes->setup,
                             bench.planes->inputs.intent);
}

}  // namespace

std::optional<std::size_t> index_of(const std::vector<std::string>& methods,
                                    std::string_view method) {
  const auto found = std::find(methods.begin(), methods.end(), method);
  return found == methods.end() ? std::nullopt
                                : std::optional(static_cast<std::size_t>(found - methods.begin()));
}

Result<std::vector<std::string>> methods_from(const std::string& list) {
  std::vector<std::string> names;
  std::string known;
  for (const eval::MethodInfo& info : eval::methods()) {
    known += (known.empty() ? "" : ", ") + std::string(info.name);
    if (list.empty()) {
      names.emplace_back(info.name);
    }
  }
  if (list.empty()) {
    return names;
  }
  for (const std::string_view word : fields_of(list, ',')) {
    if (eval::find_method(word) == nullptr) {
      return Error{Error::Code::out_of_range,
                   fmt::format("--methods: want some of {}; got \"{}\"", known, word)};
    }
    if (std::find(names.begin(), names.end(), word) != names.end()) {
      return Error{Error::Code::out_of_range,
                   fmt::format("--methods: want each method once, got \"{}\" twice", word)};
    }
    names.emplace_back(word);
  }
  return names;
}

Result<std::optional<SuiteRun>> run_suite(const SuiteCommandOptions& options,
                                          const std::string& command,
                                          const std::vector<std::string>& methods) {
  const auto opened = open_bench(options, command, methods);
  if (!opened.has_value()) {
    return opened.error();
  }
  const std::shared_ptr<Bench>& bench = opened.value();
  const Source& source = bench->source;
  const std::string path = options.output + ".journal";
  if (auto problem = make_folder_of(path)) {
    return *problem;
  }
  const auto journal =
      Journal::open(path, fmt::format("saca {} {} of {}, {}, seed {}{}: {}", SACA_VERSION, command,
                                      source.what, options.car, options.seed,
                                      options.exact ? ", exact" : "", joined(methods)));
  if (!journal.has_value()) {
    return journal.error();
  }
  SuiteRun done{.methods = methods,
                .rows = {},
                .meta = {},
                .notes = source.notes,
                .encounter_at = source.at,
                .tried_in = {}};
  done.tried_in = [bench](const SuiteEncounter& encounter) {
    return eval::tried_in(encounter, bench->how, bench->planes->setup,
                          bench->planes->inputs.intent);
  };
  for (const std::string& line : journal.value().lines()) {
    auto row = eval::suite_row_from(line, methods.size());
    if (!row.has_value() || row.value().number != done.rows.size()) {
      return Error{Error::Code::malformed,
                   fmt::format("{}: line {}: {}", path, done.rows.size() + 2,
                               row.has_value() ? "another encounter's" : row.error().message)};
    }
    done.rows.push_back(std::move(row).value());
  }
  const auto count = static_cast<std::size_t>(source.count);
  done.rows.resize(std::min(done.rows.size(), count));

  SteadyClock clock;
  watch_for_interrupt();
  const auto before = static_cast<int>(done.rows.size());
  ProgressLine progress(command, source.count, clock);
  const Clock::Time start = clock.now();
  while (done.rows.size() < count) {
    if (interrupted()) {
      return std::optional<SuiteRun>();
    }
    const std::size_t first = done.rows.size();
    std::vector<SuiteRow> next(
        std::min(batch_per_thread * static_cast<std::size_t>(options.threads), count - first));
    in_parallel(next.size(), options.threads,
                [&](std::size_t i) { next[i] = row_of(*bench, first + i); });
    for (SuiteRow& row : next) {
      if (!journal.value().add(eval::line_of(row))) {
        return Error{Error::Code::unwritable, path + ": cannot be added to"};
      }
      done.rows.push_back(std::move(row));
    }
    progress.show(static_cast<int>(done.rows.size()), before, " encounters");
  }
  done.worked = static_cast<int>(count) - before;
  done.seconds = to_seconds(clock.now() - start);
  done.meta = {{"meta.command",
                fmt::format("saca {} {} --methods {} --count {} --split {} --car {} --seed {}{}{}",
                            command, options.name, joined(methods), options.count, options.split,
                            options.car, options.seed, options.exact ? " --exact" : "",
                            (options.no_twins ? std::string(" --no-twins") : std::string()) +
                                (options.data.empty() ? "" : " --data FOLDER"))},
               {"meta.seed", std::to_string(options.seed)},
               {"meta.n", std::to_string(count)},
               {"meta.split", options.split},
               {"meta.car", options.car},
               {"meta.version", SACA_VERSION}};
  return std::optional(std::move(done));
}

Result<std::string> write_encounter(const SuiteCommandOptions& options, std::uint64_t number) {
  const auto source = open_source(options, "suite");
  if (!source.has_value()) {
    return source.error();
  }
  const auto encounter = source.value().at(number);
  if (!encounter.has_value()) {
    return encounter.error();
  }
  const eval::SuiteOptions how = how_of(options, {});
  const fs::path file =
      fs::path("runs") / fmt::format("{}-{}-{}.toml", fs::path(options.name).filename().string(),
                                     options.split, number);
  if (auto problem = make_folder_of(file)) {
    return *problem;
  }
  if (auto problem =
          write_file(file, sim::write_scenario(eval::as_played(encounter.value().scenario, how)))) {
    return *problem;
  }
  return fmt::format("saca run {} --pace lockstep --llm off --no-memory{}", file.string(),
                     how.exact
                         ? std::string()
                         : fmt::format(" --seed {}", eval::encounter_seed(options.seed, number)));
}

void add_suite_options(CLI::App& command, SuiteCommandOptions& options) {
  command
      .add_option("name", options.name,
                  "A suite (natural, balanced), a family, a folder of scenarios, 100car, traffic, "
                  "or a regulation (fmvss127, r152)")
      ->required();
  command.add_option("--data", options.data,
                     "Of 100car the folder of the study's release; of traffic (SACA in shadow) "
                     "folders with CommonRoad files or that release");
  add_draw_options(command, options.count, options.split, options.test_log, options.car);
  command.add_option("--seed", options.seed, "Of all that is drawn: same seed, same rows")
      ->capture_default_str();
  command.add_flag("--exact", options.exact,
                   "Nothing is left to chance, and perception is as the scenarios have it");
  command.add_option("--output", options.output,
                     "Rows as HDF5; beside them .json and .html (default: runs/...)");
  command.add_option("--threads", options.threads, "They do not change the result")
      ->check(CLI::Range(1, 256))
      ->capture_default_str();
}

}  // namespace saca::app
