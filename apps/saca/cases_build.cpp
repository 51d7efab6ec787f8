#include <fmt/core.h>

#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "apps/saca/cases_commands.h"
#include "apps/saca/cases_making.h"
#include "apps/saca/json_output.h"
#include "apps/saca/settings.h"
#include "apps/saca/version.h"
#include "saca/base/core/parallel.h"
#include "saca/lab/long_work/interrupt.h"
#include "saca/lab/long_work/output_file.h"
#include "saca/lab/long_work/resumable_work.h"
#include "saca/thinking/memory/case_json.h"

namespace saca::app {
namespace {

using eval::CrashCase;
using eval::CrashEnd;
using nlohmann::json;

struct CasesBuildOptions {
  std::vector<std::string> folders;  ///< releases of FARS
  std::string hundred_car;
  std::optional<int> count;
  std::string car = "compact_rwd_ev";
  CaseMakingOptions making;
  std::string output = "runs/crash_cases.jsonl";
  std::string for_memory;
  std::string drivers;
  std::string journal;
  int threads = usual_threads();
  bool as_json = false;
};

/// What a table line tells of one family.
struct FamilyTally {
  CrashCount count;
  int worked_on = 0;
  std::array<int, eval::num_crash_ends> ends{};
  int at_once = 0;  ///< the crash happens in the first sample
  int cases = 0;
  int impact_known = 0;
  int impact_agrees = 0;
};

using Tallies = std::map<std::string, FamilyTally>;

Tallies tallied(const CaseSources& sources, const std::vector<CaseRow>& rows) {
  Tallies tallies;
  for (std::size_t i = 0; i < sources.counts.size(); ++i) {
    const auto family = static_cast<crash_records::CrashFamily>(i);
    tallies[std::string(name(family))].count = sources.counts.at(i);
  }
  for (const CaseRow& row : rows) {
    FamilyTally& tally = tallies[row.family];
    ++tally.worked_on;
    ++tally.ends.at(static_cast<std::size_t>(row.end));
    if (row.made) {
      ++tally.cases;
      tally.at_once += row.end == CrashEnd::happens && row.made->sample == 0 ? 1 : 0;
      tally.impact_known += row.made->impact_agrees ? 1 : 0;
      tally.impact_agrees += row.made->impact_agrees.value_or(false) ? 1 : 0;
    }
  }
  return tallies;
}

json figures_of(const CaseSources& sources, const Tallies& tallies,
                const std::vector<CrashCase>& cases, int num_failed, const std::string& command) {
  const auto crashes = sources.release.crashes.size();
  json out{{"meta.command", "saca " + command}, {"meta.version", SACA_VERSION},
           {"cases.num_crashes", crashes},      {"cases.num_events", sources.events.size()},
           {"cases.num_cases", cases.size()},   {"cases.num_failed", num_failed}};
  for (const auto& [family, tally] : tallies) {
    const std::string key = "cases." + family + ".";
    out[key + "num_crashes"] = tally.count.crashes;
    out[key + "share"] = crashes == 0 ? 0.0 : tally.count.crashes / static_cast<double>(crashes);
    out[key + "ego_is_no_car"] = tally.count.ego_is_no_car;
    out[key + "other_unknown"] = tally.count.other_unknown;
    out[key + "not_playable"] = tally.count.not_playable;
    out[key + "worked_on"] = tally.worked_on;
    for (std::size_t i = 0; i < tally.ends.size(); ++i) {
      out[key + std::string(name(static_cast<CrashEnd>(i)))] = tally.ends.at(i);
    }
    out[key + "happens_at_once"] = tally.at_once;
    out[key + "num_cases"] = tally.cases;
    out[key + "impact_known"] = tally.impact_known;
    out[key + "impact_agrees"] = tally.impact_agrees;
  }
  std::map<std::string_view, int> best;
  for (const CrashCase& one : cases) {
    ++best[name(one.judged.one.best)];
  }
  for (const manoeuvre::PolicyId policy : manoeuvre::all_policies) {
    out[fmt::format("cases.best.{}", name(policy))] = best[name(policy)];
  }
  return out;
}

void print_table(const CaseSources& sources, const Tallies& tallies, std::size_t cases,
                 const std::string& output) {
  for (const std::string& note : sources.release.notes) {
    app::print("note: {}\n", note);
  }
  app::print("{:<12} {:>8} {:>6} {:>10} {:>9} {:>8} {:>6}\n", "family", "crashes", "share",
             "worked on", "happens", "at once", "cases");
  for (const auto& [family, tally] : tallies) {
    const double share =
        sources.release.crashes.empty()
            ? 0.0
            : tally.count.crashes / static_cast<double>(sources.release.crashes.size());
    app::print("{:<12} {:>8} {:>5.1f}% {:>10} {:>9} {:>8} {:>6}\n", family, tally.count.crashes,
               100.0 * share, tally.worked_on,
               tally.ends.at(static_cast<std::size_t>(CrashEnd::happens)), tally.at_once,
               tally.cases);
  }
  app::print("{}: {} cases of {} crashes and {} events\n", output, cases,
             sources.release.crashes.size(), sources.events.size());
}

/// All rows; nullopt: interrupted.
Result<std::optional<std::vector<CaseRow>>> gather_cases(const CasesBuildOptions& options,
                                                         const CaseSources& sources, Inputs inputs,
                                                         const std::string& command) {
  const auto planes = open_planes(std::move(inputs));
  if (!planes.has_value()) {
    return planes.error();
  }
  const CaseMaking making(options.making, sources, *planes.value());
  return long_work::rows_of<CaseRow>(
      {.journal = options.journal.empty() ? options.output + ".journal" : options.journal,
       .title = fmt::format("saca {} {} ({:016x})", version_text(), command, making.digest()),
       .progress = "cases of crashes",
       .unit = "records",
       .count = making.size(),
       .display = progress_display(),
       .threads = options.threads,
       .row = [&](std::size_t number) { return making.row(number); },
       .line_of = case_row_line,
       .row_from = case_row_from});
}

std::optional<Error> write_cases(const CasesBuildOptions& options,
                                 const std::vector<CrashCase>& cases) {
  if (auto problem = long_work::write_output(options.output, eval::crash_cases_text(cases))) {
    return problem;
  }
  std::vector<memory::Case> plain;
  std::vector<memory::Case> driven;
  for (const CrashCase& one : cases) {
    plain.push_back(one.judged.one);
    if (const auto& driver = one.judged.driver) {
      driven.push_back(one.judged.one);
      driven.back().best = *driver;
      driven.back().best_harm =
          one.judged.one.happened.value_or(memory::PolicyHarms{})[manoeuvre::index(*driver)]
              .value_or(one.judged.one.best_harm);
    }
  }
  if (!options.for_memory.empty()) {
    if (auto problem = long_work::write_output(options.for_memory, memory::cases_text(plain))) {
      return problem;
    }
  }
  return options.drivers.empty()
             ? std::nullopt
             : long_work::write_output(options.drivers, memory::cases_text(driven));
}

int build_cases(const CasesBuildOptions& options) {
  if (const auto problem = long_work::why_outputs_unwritable(
          {options.output, options.for_memory, options.drivers})) {
    return refused(*problem);
  }
  if (options.folders.empty() && options.hundred_car.empty()) {
    complain("want folders with releases of FARS, or --hundred-car; got neither");
    return wrong_command_line;
  }
  if (!options.drivers.empty() && options.hundred_car.empty()) {
    complain("--drivers: want --hundred-car, too: no other drivers were recorded");
    return wrong_command_line;
  }
  long_work::watch_for_interrupt();
  auto inputs = read_inputs(options.car);
  if (!inputs.has_value()) {
    return refused(inputs.error());
  }
  const auto sources =
      open_case_sources(inputs.value().places, options.folders, options.hundred_car, options.count);
  if (!sources.has_value()) {
    return refused(sources.error());
  }
  const std::string command = fmt::format(
      "cases build --car {} --seed {} --draws {} --told-draws {} --tries {}{}", options.car,
      options.making.seed, options.making.judging.draws, options.making.judging.told_draws,
      options.making.tries, options.count ? fmt::format(" --count {}", *options.count) : "");
  auto gathered = gather_cases(options, sources.value(), std::move(inputs).value(), command);
  if (!gathered.has_value()) {
    return refused(gathered.error());
  }
  if (!gathered.value()) {
    complain("interrupted: the same command goes on from here");
    return was_interrupted;
  }
  std::vector<CaseRow> rows = *std::move(gathered).value();
  const Tallies tallies = tallied(sources.value(), rows);
  std::vector<CrashCase> cases;
  cases.reserve(rows.size());
  int num_failed = 0;
  for (CaseRow& row : rows) {
    if (!row.problem.empty()) {
      ++num_failed;
      complain(row.problem);
    }
    if (row.made) {
      row.made->judged.one.id = static_cast<match::CaseId>(cases.size() + 1);
      cases.push_back(*std::move(row.made));
    }
  }
  if (const auto problem = write_cases(options, cases)) {
    return refused(*problem);
  }
  if (options.as_json) {
    app::print_json(figures_of(sources.value(), tallies, cases, num_failed, command));
  } else {
    print_table(sources.value(), tallies, cases.size(), options.output);
  }
  return num_failed == 0 ? success : some_failed;
}

}  // namespace

void add_cases_build(CLI::App& cases, int& exit_code) {
  CLI::App* const command =
      cases.add_subcommand("build", "Makes cases of recorded crashes: FARS, and the 100-Car study");
  const auto options = std::make_shared<CasesBuildOptions>();
  command->add_option("FOLDER", options->folders,
                      "Releases of FARS: accident.csv, vehicle.csv and person.csv in each");
  command->add_option("--hundred-car", options->hundred_car,
                      "Folder of the 100-Car study's release: its emergencies, too");
  command->add_option("--count", options->count, "At most so many crashes, of the families in turn")
      ->check(CLI::Range(1, 1'000'000));
  command->add_option("--car", options->car, "A car's file, or the name of a shipped one")
      ->capture_default_str();
  command->add_option("--seed", options->making.seed, "Of all that is drawn: same seed, same bytes")
      ->capture_default_str();
  command
      ->add_option("--draws", options->making.judging.draws,
                   "Of what is left to chance, that harm is the mean of")
      ->check(CLI::Range(2, 1'000))
      ->capture_default_str();
  command
      ->add_option("--told-draws", options->making.judging.told_draws,
                   "Of the verdict, that expected harm is the mean of")
      ->check(CLI::Range(1, 1'000))
      ->capture_default_str();
  command
      ->add_option("--tries", options->making.tries,
                   "Samples of a record's family until its crash happens without avoidance")
      ->check(CLI::Range(1, 1'000))
      ->capture_default_str();
  command->add_option("--output,-o", options->output, "Where the cases go")->capture_default_str();
  command->add_option("--for-memory", options->for_memory,
                      "Besides, without their records, for `saca memory import`");
  command->add_option("--drivers", options->drivers,
                      "Besides, of the study's events alone, with what the driver did in the place "
                      "of what was best: for saca-train-imitator, not for a memory");
  command->add_option("--journal", options->journal,
                      "What was found so far (default: beside the output)");
  command->add_option("--threads", options->threads, "They do not change the result")
      ->check(CLI::Range(1, 256))
      ->capture_default_str();
  command->add_flag("--json", options->as_json, "For programs");
  command->callback([options, &exit_code] { exit_code = build_cases(*options); });
}

}  // namespace saca::app
