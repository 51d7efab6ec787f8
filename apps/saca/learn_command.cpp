#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "apps/saca/commands.h"
#include "apps/saca/forecast_commands.h"
#include "apps/saca/json_output.h"
#include "apps/saca/memory_commands.h"
#include "apps/saca/planes_making.h"
#include "apps/saca/printing.h"
#include "apps/saca/progress.h"
#include "apps/saca/resumable.h"
#include "apps/saca/shipped_cases.h"
#include "apps/saca/suite_pages.h"
#include "apps/saca/suite_thinking.h"
#include "saca/config/json_text.h"
#include "saca/core/fnv.h"
#include "saca/core/journal.h"
#include "saca/core/parallel.h"
#include "saca/eval/curriculum.h"
#include "saca/loop/learnt_case.h"
#include "saca/memory/case_json.h"
#include "saca/report/chart_svg.h"

namespace saca::app {
namespace {

namespace fs = std::filesystem;
using eval::Curriculum;
using eval::Episode;
using eval::Estimate;
using eval::Learner;
using nlohmann::json;

struct LearnOptions {
  SuiteCommandOptions from;  ///< which encounters; `count` of each seed
  int seeds = 5;
  double lies = 0.05;
  bool empty_memory = false;
  std::string folder;  ///< empty: runs/learn-NAME-SPLIT
  std::string svg;     ///< empty: none
  bool as_json = false;
};

/// Number n of all seeds.
struct Episodes {
  std::vector<Episode> of;                                        ///< by seed
  std::vector<std::array<std::size_t, eval::num_learners>> size;  ///< of the banks after it
};

/// The curricula of all seeds, and what they are made of.
struct School {
  SuiteEncounters encounters;
  std::unique_ptr<const PlanesOfCar> planes;
  std::unique_ptr<SuiteThinking> thinking;
  std::vector<memory::MadeWith> made_with;
  std::vector<memory::Case> start;    ///< what memories know at the beginning
  std::vector<Curriculum> curricula;  ///< by seed
  std::uint64_t count = 0;            ///< encounters of each seed
  int threads = 1;
  std::optional<Error> failure;  ///< a bank could not be written

  /// Encounter `number` of all seeds, played and learnt. Each seed has encounters of its own.
  [[nodiscard]] Episodes teach(std::uint64_t number);
  /// The numbers of these encounters.
  [[nodiscard]] std::vector<std::uint64_t> numbers_of(std::uint64_t number) const;
  /// Learns what was played before.
  [[nodiscard]] std::optional<Error> learn(Episodes& episodes);
};

std::vector<std::uint64_t> School::numbers_of(std::uint64_t number) const {
  std::vector<std::uint64_t> numbers(curricula.size());
  for (std::size_t k = 0; k < numbers.size(); ++k) {
    numbers[k] = k * count + number;
  }
  return numbers;
}

Episodes School::teach(std::uint64_t number) {
  const std::vector<std::uint64_t> numbers = numbers_of(number);
  Episodes episodes;
  episodes.of.resize(curricula.size());
  in_parallel(curricula.size(), threads, [&](std::size_t k) {
    const auto encounter = encounters.at(numbers[k]);
    if (encounter.has_value()) {
      episodes.of[k] = curricula[k].play(encounter.value());
    } else {
      episodes.of[k].row.number = numbers[k];
      episodes.of[k].row.family = "?";
      episodes.of[k].row.fault = encounter.error().message;
    }
  });
  if (auto problem = learn(episodes)) {
    failure = std::move(problem);
  }
  return episodes;
}

std::optional<Error> School::learn(Episodes& episodes) {
  std::vector<std::optional<Error>> problems(curricula.size());
  episodes.size.resize(curricula.size());
  in_parallel(curricula.size(), threads, [&](std::size_t k) {
    problems[k] = curricula[k].learn(episodes.of[k]);
    episodes.size[k] = curricula[k].sizes();
  });
  const auto first = std::find_if(problems.begin(), problems.end(),
                                  [](const auto& problem) { return problem.has_value(); });
  return first == problems.end() ? std::nullopt : std::move(*first);
}

std::string line_of(const Episodes& episodes) {
  json line = json::array();
  for (const Episode& one : episodes.of) {
    line.push_back(json::parse(eval::line_of(one)));
  }
  return line.dump();
}

/// @param numbers  of the encounter of each seed
Result<Episodes> episodes_from(const std::string& line, const std::vector<std::uint64_t>& numbers) {
  const auto read = config::parse_json(line);
  if (!read.has_value()) {
    return read.error();
  }
  if (!read.value().is_array() || read.value().size() != numbers.size()) {
    return Error{Error::Code::malformed,
                 fmt::format("want the episodes of {} seeds", numbers.size())};
  }
  Episodes episodes;
  for (const json& one : read.value()) {
    auto episode = eval::episode_from(one.dump());
    if (!episode.has_value()) {
      return episode.error();
    }
    const std::uint64_t number = numbers[episodes.of.size()];
    if (episode.value().row.number != number) {
      return Error{Error::Code::malformed,
                   fmt::format("want encounter {}, got {}", number, episode.value().row.number)};
    }
    episodes.of.push_back(std::move(episode).value());
  }
  return episodes;
}

/// What memories know at the beginning: a bank, the shipped cases, or nothing.
Result<std::vector<memory::Case>> first_cases(const LearnOptions& options, const School& school) {
  if (options.empty_memory) {
    return std::vector<memory::Case>();
  }
  if (!options.from.thinking.memory.empty()) {
    auto bank = read_bank(options.from.thinking.memory);
    if (!bank.has_value()) {
      return bank.error();
    }
    return std::move(bank).value().cases;
  }
  return shipped_cases(school.planes->inputs.places, school.made_with);
}

/// Makes the banks of all seeds, in the place of those that were there.
std::optional<Error> enrol(School& school, const LearnOptions& options) {
  for (int k = 0; k < options.seeds; ++k) {
    const fs::path folder = fs::path(options.folder) / fmt::format("seed-{}", k + 1);
    if (auto problem = make_folder_of(folder / "bank")) {
      return problem;
    }
    eval::CurriculumSetup setup{.saca = school.thinking->lend(school.planes->setup).setup,
                                .intent = &school.planes->inputs.intent,
                                .made_with = school.made_with,
                                .seed = options.from.seed + static_cast<std::uint64_t>(k),
                                .exact = options.from.exact,
                                .lies = options.lies,
                                .judging = {}};
    auto curriculum = Curriculum::begin(std::move(setup), school.start, folder);
    if (!curriculum.has_value()) {
      return curriculum.error();
    }
    school.curricula.push_back(std::move(curriculum).value());
  }
  return std::nullopt;
}

Result<std::unique_ptr<School>> open_school(const LearnOptions& options) {
  auto school = std::make_unique<School>();
  SuiteCommandOptions from = options.from;
  from.count *= options.seeds;
  auto encounters = open_encounters(from, "learn");
  if (!encounters.has_value()) {
    return encounters.error();
  }
  school->encounters = std::move(encounters).value();
  school->count = static_cast<std::uint64_t>(school->encounters.count / options.seeds);
  school->threads = options.from.threads;
  if (school->count == 0) {
    return Error{Error::Code::out_of_range,
                 fmt::format("{}: want an encounter for each of {} seeds, got {}",
                             options.from.name, options.seeds, school->encounters.count)};
  }
  auto planes = open_planes(std::move(school->encounters.inputs));
  if (!planes.has_value()) {
    return planes.error();
  }
  school->planes = std::move(planes).value();
  auto thinking = SuiteThinking::open({.memory = "", .model = options.from.thinking.model},
                                      school->planes->inputs.places, options.from.threads,
                                      *school->planes->setup.clock);
  if (!thinking.has_value()) {
    return thinking.error();
  }
  school->thinking = std::move(thinking).value();
  school->made_with = loop::made_with(school->planes->setup.forecast, school->planes->inputs.intent,
                                      school->planes->inputs.car_name);
  auto start = first_cases(options, *school);
  if (!start.has_value()) {
    return start.error();
  }
  school->start = std::move(start).value();
  return school;
}

/// All encounters one after the other, from where the journal ends on.
/// @return  nullopt: interrupted
Result<std::optional<std::vector<Episodes>>> taught_by(School& school, const fs::path& journal,
                                                       const std::string& title) {
  return rows_of<Episodes>(
      {.journal = journal.string(),
       .title = title,
       .progress = "learn",
       .unit = "encounters of each seed",
       .count = school.count,
       .threads = 1,  // one after the other: seeds are worked on at the same time
       .row = [&](std::size_t number) { return school.teach(number); },
       .line_of = [](const Episodes& episodes) { return line_of(episodes); },
       .row_from = [&, number =
                           std::uint64_t{0}](const std::string& line) mutable -> Result<Episodes> {
         auto read = episodes_from(line, school.numbers_of(number++));
         if (!read.has_value()) {
           return read;
         }
         Episodes episodes = std::move(read).value();
         if (auto problem = school.learn(episodes)) {
           return *std::move(problem);
         }
         return episodes;
       },
       .spoilt_by_interrupt = school.thinking->has_model(),
       .failure = [&]() -> std::optional<Error> {
         const auto failure = school.thinking->failure();
         return failure ? failure : school.failure;
       }});
}

// --- figures

/// A figure of one run of an encounter; nullopt: it does not count.
using Measure = std::optional<double> (*)(const Episode& episode, std::size_t method);

double harm_of(const Episode& episode, std::size_t method) {
  return episode.row.risk.runs[method].harm;
}

constexpr std::size_t aeb_method = eval::curriculum_methods.size() - 1;

struct EpisodeFigure {
  const char* key;
  Measure value;
};

constexpr std::array<EpisodeFigure, 4> episode_measures{{
    {"harm", [](const Episode& one, std::size_t m) { return std::optional(harm_of(one, m)); }},
    {"regret",
     [](const Episode& one, std::size_t m) {
       return std::optional(harm_of(one, m) - one.row.risk.best_harm);
     }},
    {"materially_worse_than_aeb",
     [](const Episode& one, std::size_t m) {
       return std::optional(harm_of(one, m) > harm_of(one, aeb_method) + eval::material ? 1.0
                                                                                        : 0.0);
     }},
    {"acts",
     [](const Episode& one, std::size_t m) {
       return std::optional(one.row.risk.runs[m].intervened() ? 1.0 : 0.0);
     }},
}};
constexpr Measure episode_regret = episode_measures[1].value;

/// Of a forecast for which a plan was sought: was it in memory?
std::optional<double> from_memory(const Episode& episode, std::size_t method) {
  const auto& thinking = episode.row.risk.runs[method].thinking;
  return thinking && thinking->forecasts > 0
             ? std::optional(static_cast<double>(thinking->from_memory) / thinking->forecasts)
             : std::nullopt;
}

/// The mean over the episodes from `first` to before `last` of each seed, and over these.
template <class Value>
Estimate over_seeds(const std::vector<Episodes>& all, std::size_t first, std::size_t last,
                    const Value& value) {
  std::vector<double> means;
  for (std::size_t k = 0; k < all.front().of.size(); ++k) {
    double sum = 0.0;
    int n = 0;
    for (std::size_t i = first; i < last; ++i) {
      const Episode& episode = all[i].of[k];
      const std::optional<double> one = episode.row.fault.empty() ? value(episode) : std::nullopt;
      sum += one.value_or(0.0);
      n += one ? 1 : 0;
    }
    if (n > 0) {
      means.push_back(sum / n);
    }
  }
  return means.empty() ? Estimate{} : eval::mean_over_seeds(means);
}

Estimate of_method(const std::vector<Episodes>& all, std::size_t first, std::size_t last,
                   std::size_t method, Measure measure) {
  return over_seeds(all, first, last,
                    [&](const Episode& episode) { return measure(episode, method); });
}

/// How much more one harms than another in the same encounters.
struct Pair {
  std::size_t method;
  std::size_t other;
};
constexpr std::array<Pair, 3> compared_pairs{{{1, 0}, {2, 0}, {4, 3}}};

Estimate harm_over(const std::vector<Episodes>& all, std::size_t first, std::size_t last,
                   const Pair& pair) {
  return over_seeds(all, first, last, [&](const Episode& episode) {
    return std::optional(harm_of(episode, pair.method) - harm_of(episode, pair.other));
  });
}

std::string key_of(const Pair& pair, const std::string& block = "") {
  return fmt::format("{}.{}harm_over_{}", eval::curriculum_methods.at(pair.method), block,
                     eval::curriculum_methods.at(pair.other));
}

/// The episodes in blocks that follow each other, at most ten.
std::vector<std::array<std::size_t, 2>> blocks_of(std::size_t count) {
  constexpr std::size_t most = 10;
  const std::size_t num = std::min(count, most);
  std::vector<std::array<std::size_t, 2>> blocks;
  for (std::size_t k = 0; k < num; ++k) {
    blocks.push_back({k * count / num, (k + 1) * count / num});
  }
  return blocks;
}

double mean_size(const Episodes& after, Learner who) {
  double sum = 0.0;
  for (const auto& sizes : after.size) {
    sum += static_cast<double>(sizes.at(static_cast<std::size_t>(who)));
  }
  return sum / static_cast<double>(after.size.size());
}

/// Of all episodes: how often something is so.
template <class Is>
int count_if(const std::vector<Episodes>& all, const Is& is) {
  int count = 0;
  for (const Episodes& episodes : all) {
    count += static_cast<int>(std::count_if(episodes.of.begin(), episodes.of.end(), is));
  }
  return count;
}

json figures_of(const std::vector<Episodes>& all, const std::string& suite) {
  const std::string head = "learn." + suite + ".";
  const auto blocks = blocks_of(all.size());
  json out;
  for (std::size_t m = 0; m < eval::curriculum_methods.size(); ++m) {
    const std::string place = fmt::format("{}{}.", head, eval::curriculum_methods.at(m));
    for (const EpisodeFigure& figure : episode_measures) {
      add_estimate(out, place + figure.key, of_method(all, 0, all.size(), m, figure.value));
    }
    if (m < eval::num_learners) {
      loop::ThinkingFigures sum;
      for (const Episodes& episodes : all) {
        for (const Episode& one : episodes.of) {
          if (one.row.fault.empty() && one.row.risk.runs[m].thinking) {
            sum.forecasts += one.row.risk.runs[m].thinking->forecasts;
            sum.from_memory += one.row.risk.runs[m].thinking->from_memory;
            sum.asked += one.row.risk.runs[m].thinking->asked;
          }
        }
      }
      out[place + "forecasts"] = sum.forecasts;
      out[place + "from_memory"] = sum.from_memory;
      out[place + "asked_model"] = sum.asked;
      out[place + "cases"] = mean_size(all.back(), static_cast<Learner>(m));
      out[place + "refuted"] =
          count_if(all, [m](const Episode& one) { return one.refuted.at(m).has_value(); });
    }
    for (std::size_t b = 0; b < blocks.size(); ++b) {
      add_estimate(out, fmt::format("{}block{}.regret", place, b + 1),
                   of_method(all, blocks[b][0], blocks[b][1], m, episode_regret));
    }
  }
  for (const Pair& pair : compared_pairs) {
    add_estimate(out, head + key_of(pair), harm_over(all, 0, all.size(), pair));
    for (std::size_t b = 0; b < blocks.size(); ++b) {
      add_estimate(out, head + key_of(pair, fmt::format("block{}.", b + 1)),
                   harm_over(all, blocks[b][0], blocks[b][1], pair));
    }
  }
  out[head + "lies"] = count_if(all, eval::misleads);
  out[head + "episodes"] = all.size();
  out[head + "seeds"] = all.front().of.size();
  out[head + "faults"] = count_if(all, [](const Episode& one) { return !one.row.fault.empty(); });
  return out;
}

std::string curve_of(const std::vector<Episodes>& all, const std::string& suite) {
  using report::ChartColour;
  constexpr std::array<ChartColour, eval::curriculum_methods.size()> colours{
      ChartColour::grey,   ChartColour::blue,  ChartColour::orange,
      ChartColour::purple, ChartColour::green, ChartColour::ink};
  const auto blocks = blocks_of(all.size());
  const auto last = static_cast<double>(all.size());
  report::LineChart lost{.title = "Harm above the best of all plans begun at T1",
                         .x = {.name = "encounters met", .low = 0.0, .high = last},
                         .y = {.name = "regret", .low = 0.0, .high = 0.0},
                         .curves = {}};
  report::LineChart known{.title = "Forecasts whose plan comes from memory",
                          .x = lost.x,
                          .y = {.name = "share", .unit = "%", .low = 0.0, .high = 100.0},
                          .curves = {}};
  for (std::size_t m = 0; m < eval::curriculum_methods.size(); ++m) {
    report::ChartLine line{.name = std::string(eval::curriculum_methods.at(m)),
                           .colour = colours.at(m),
                           .dashed = m >= eval::num_learners,
                           .points = {}};
    report::ChartLine share = line;
    for (const auto& [first, end] : blocks) {
      const double middle = 0.5 * static_cast<double>(first + end);
      const Estimate one = of_method(all, first, end, m, episode_regret);
      line.points.push_back({middle, one.value});
      lost.y.high = std::max(lost.y.high, 1.1 * one.value);
      lost.y.low = std::min(lost.y.low, 1.1 * one.value);
      const Estimate answered = of_method(all, first, end, m, from_memory);
      if (answered.n > 0) {
        share.points.push_back({middle, 100.0 * answered.value});
      }
    }
    lost.curves.push_back(std::move(line));
    if (m < eval::num_learners) {
      known.curves.push_back(std::move(share));
    }
  }
  lost.y.high = lost.y.high > 0.0 ? lost.y.high : 1.0;
  return report::chart_svg(
      {.heading = "Learning from encounters",
       .lines = {fmt::format("{}: {} encounters one after the other, mean of {} seeds, each with "
                             "encounters of its own",
                             suite, all.size(), all.front().of.size())},
       .charts = {std::move(lost), std::move(known)}});
}

void print(const std::vector<Episodes>& all) {
  const std::size_t seeds = all.front().of.size();
  app::print("{} encounters of each of {} seeds; means over seeds with 95 % intervals\n\n",
             all.size(), seeds);
  constexpr const char* line = "{:10} {:26} {:26} {:>11} {:>8} {:>8} {:>8}\n";
  app::print(line, "", "harm", "regret", "worse than", "acts", "from", "cases");
  app::print(line, "", "", "", "AEB, %", "%", "memory,%", "");
  for (std::size_t m = 0; m < eval::curriculum_methods.size(); ++m) {
    const auto of = [&](Measure measure) { return of_method(all, 0, all.size(), m, measure); };
    const bool remembers = m < eval::num_learners;
    app::print(
        line, eval::curriculum_methods.at(m), with_interval(of(episode_measures[0].value), 4),
        with_interval(of(episode_regret), 4),
        fmt::format("{:.1f}", 100.0 * of(episode_measures[2].value).value),
        fmt::format("{:.1f}", 100.0 * of(episode_measures[3].value).value),
        remembers ? fmt::format("{:.1f}", 100.0 * of(from_memory).value) : "-",
        remembers ? fmt::format("{:.0f}", mean_size(all.back(), static_cast<Learner>(m))) : "-");
  }
  app::print("\n");
  for (const Pair& pair : compared_pairs) {
    app::print("{} does {} more harm than {}\n", eval::curriculum_methods.at(pair.method),
               with_interval(harm_over(all, 0, all.size(), pair), 5),
               eval::curriculum_methods.at(pair.other));
  }
}

/// A bank that lies where banks are replaced.
std::optional<Error> why_in_the_way(const LearnOptions& options) {
  std::error_code ignored;
  const fs::path bank = fs::weakly_canonical(options.from.thinking.memory, ignored);
  const fs::path folder = fs::weakly_canonical(options.folder, ignored);
  const bool inside =
      std::mismatch(folder.begin(), folder.end(), bank.begin(), bank.end()).first == folder.end();
  return inside ? std::optional(Error{
                      Error::Code::out_of_range,
                      fmt::format("--memory: want a bank outside of {}, whose banks are replaced, "
                                  "got {}",
                                  options.folder, options.from.thinking.memory)})
                : std::nullopt;
}

int run(LearnOptions options) {
  if (options.folder.empty()) {
    options.folder = fmt::format(
        "runs/learn-{}-{}", fs::path(options.from.name).filename().string(), options.from.split);
  }
  const fs::path journal = fs::path(options.folder) / "episodes.journal";
  if (const auto problem = why_outputs_unwritable({journal, options.svg})) {
    return refused(*problem);
  }
  if (auto problem = make_folder_of(journal)) {
    return refused(*problem);
  }
  if (auto problem = why_in_the_way(options)) {
    return refused(*problem);
  }
  watch_for_interrupt();
  const auto opened = open_school(options);
  if (!opened.has_value()) {
    return refused(opened.error());
  }
  School& school = *opened.value();
  const SuiteCommandOptions& from = options.from;
  const std::string command =
      fmt::format("learn {} --count {} --seeds {} --split {} --car {} --seed {} --lies {}{}{}{}{}",
                  from.name, from.count, options.seeds, from.split, from.car, from.seed,
                  options.lies, from.exact ? " --exact" : "", from.no_twins ? " --no-twins" : "",
                  options.empty_memory ? " --empty-memory" : "", thinking_text(from.thinking));
  const auto model = school.thinking->model_text();
  Fnv hash;
  hash.add(memory::cases_text(school.start));
  const std::string starts_with =
      fmt::format("{} cases ({:016x})", school.start.size(), hash.value());
  for (const memory::MadeWith& one : school.made_with) {
    hash.add(one.digest);
  }
  const std::string title = fmt::format("saca {} {} of {}, from {}{}, with {:016x}", SACA_VERSION,
                                        command, school.encounters.what, starts_with,
                                        model ? ", model: " + *model : "", hash.value());
  // Banks are replaced only where the journal is of this very work.
  if (const auto mine = Journal::open(journal, title); !mine.has_value()) {
    return refused(mine.error());
  }
  if (auto problem = enrol(school, options)) {
    return refused(*problem);
  }
  const auto taught = taught_by(school, journal, title);
  if (!taught.has_value()) {
    return refused(taught.error());
  }
  if (!taught.value()) {
    complain("interrupted: the same command goes on from here");
    return was_interrupted;
  }
  const std::vector<Episodes>& all = *taught.value();
  const std::string suite = fs::path(from.name).filename().string();
  json figures = figures_of(all, suite);
  figures["meta.command"] = "saca " + command;
  figures["meta.version"] = SACA_VERSION;
  figures["meta.memory"] = starts_with;
  if (model) {
    figures["meta.model"] = *model;
  }
  if (!options.svg.empty()) {
    if (auto problem = write_output(options.svg, curve_of(all, suite))) {
      return refused(*problem);
    }
  }
  if (options.as_json) {
    app::print_json(figures);
  } else {
    print(all);
    app::print("\nbanks: {}/seed-*/\n", options.folder);
  }
  return figures["learn." + suite + ".faults"].get<int>() > 0 ? some_failed : success;
}

}  // namespace

void add_learn(CLI::App& line, int& exit_code) {
  CLI::App* const command = line.add_subcommand(
      "learn",
      "Goes through encounters one after the other and remembers them; beside it the same that "
      "remembers nothing, and one that is lied to");
  const auto options = std::make_shared<LearnOptions>();
  SuiteCommandOptions& from = options->from;
  from.count = 200;
  add_encounter_options(*command, from);
  command->get_option("--count")->description("How many encounters of each seed");
  add_thinking_options(*command, from.thinking);
  CLI::Option* const memory = command->get_option("--memory");
  memory->description(
      "The bank that all begin with, which stays as it is (default: the shipped "
      "cases)");
  command->add_flag("--empty-memory", options->empty_memory, "All begin with no case")
      ->excludes(memory);
  command
      ->add_option("--seeds", options->seeds, "How many such ways, each with encounters of its own")
      ->check(CLI::Range(1, 100))
      ->capture_default_str();
  command
      ->add_option("--lies", options->lies,
                   "Share of what one memory is told that is the opposite of the truth")
      ->check(CLI::Range(0.0, 1.0))
      ->capture_default_str();
  command->add_flag("--no-twins", from.no_twins,
                    "Without those without risk, which half of the encounters else are");
  command->add_option("-o,--output", options->folder,
                      "The folder for banks and journal (default: runs/learn-...)");
  command->add_option("--svg", options->svg, "Draw how regret and memory change");
  command->add_option("--threads", from.threads, "They do not change the result")
      ->check(CLI::Range(1, 256))
      ->capture_default_str();
  command->add_flag("--json", options->as_json, "For programs");
  command->callback([options, &exit_code] { exit_code = run(*options); });
}

}  // namespace saca::app
