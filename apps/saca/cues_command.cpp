#include <fmt/core.h>

#include <array>
#include <cmath>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "apps/saca/commands.h"
#include "apps/saca/json_output.h"
#include "apps/saca/printing.h"
#include "apps/saca/suite_pages.h"
#include "apps/saca/surveying.h"
#include "saca/base/core/file.h"
#include "saca/base/core/proportion.h"
#include "saca/lab/eval/cue_forecast.h"
#include "saca/lab/long_work/output_file.h"

namespace saca::app {
namespace {

using eval::DrawnCues;
using nlohmann::json;
using world::CueKind;
using world::num_cue_kinds;

constexpr const char* counted_suite = "cues";
constexpr std::array judged_suites{counted_suite, "other_cues"};

struct CuesCommand {
  int count = 2'000;
  std::string car = "compact_rwd_ev";
  std::string output;  ///< empty: nothing is written
  bool as_json = false;
};

/// The cues of the first encounters of a suite.
Result<std::vector<DrawnCues>> drawn(const CuesCommand& options, const std::string& suite,
                                     const std::string& split) {
  const auto source = open_suite(
      {.suite = suite, .car = options.car, .count = options.count, .split = split}, "cues");
  if (!source.has_value()) {
    return source.error();
  }
  std::vector<DrawnCues> all;
  for (int k = 0; k < options.count; ++k) {
    const auto sample = source.value().source.sample(static_cast<std::uint64_t>(k));
    if (!sample.has_value()) {
      return sample.error();
    }
    all.push_back(sample.value().cues);
  }
  if (all.front().empty()) {
    return Error{Error::Code::out_of_range, suite + ": want a suite with cues, got one without"};
  }
  return all;
}

/// The file that tells SACA what to reckon with, with where each number comes from.
std::string counted_law_text(const intent::CueLaw& law, const eval::CueCounts& counts) {
  const eval::CueCount all = eval::all_who_may_come(counts, law);
  intent::CueLaw counted = eval::counted_law(law, counts);
  std::array<std::string, num_cue_kinds> sources;
  for (std::size_t k = 0; k < num_cue_kinds; ++k) {
    const eval::CueCount& one = counts.at(k);
    if (auto& unseen = counted.unseen.at(k)) {
      constexpr double fine = 1e4;  // more digits than a count of thousands has
      unseen->probability = std::ceil(fine * unseen->probability) / fine;
      sources.at(k) = one.there > 0
                          ? fmt::format("counted: {} of {} encounters of suite {}, tuning split",
                                        one.came, one.there, counted_suite)
                          : fmt::format("assumption: as all who were counted together, {} of {}",
                                        all.came, all.there);
    }
  }
  return "# What cues of a scene stand for, as SACA reckons with it. Written by `saca cues -o`: "
         "who "
         "comes and how\n"
         "# is an assumption (scenarios/families/cues.toml), how often was counted.\n" +
         intent::cue_law_text(counted, sources);
}

void print(const eval::CueCounts& counts) {
  app::print("{:18} {:>6} {:>6} {:>24}\n", "cue", "there", "came", "share (95 %)");
  for (std::size_t k = 0; k < num_cue_kinds; ++k) {
    const eval::CueCount& one = counts.at(k);
    if (one.there > 0) {
      const Proportion share = proportion(one.came, one.there);
      app::print("{:18} {:6} {:6} {:>24}\n", name(static_cast<CueKind>(k)), one.there, one.came,
                 fmt::format("{:.3f} ({:.3f} to {:.3f})", share.share, share.low, share.high));
    }
  }
}

void print(const char* suite, const std::vector<eval::CueForecast>& forecasts) {
  app::print("\n{:34} {:>26} {:>26}\n", fmt::format("suite {}, calibration split", suite),
             "log loss", "Brier score");
  for (const eval::CueForecast& one : forecasts) {
    app::print("{:34} {:>26} {:>26}\n", one.title, with_interval(one.log_loss, 4),
               with_interval(one.brier, 4));
  }
}

int run(const CuesCommand& options) {
  if (const auto problem = long_work::why_outputs_unwritable({options.output})) {
    return refused(*problem);
  }
  const auto places = find_places();
  if (!places.has_value()) {
    return refused(places.error());
  }
  const auto law =
      intent::load_cue_law(places.value().root / "scenarios" / "families" / "cues.toml");
  if (!law.has_value()) {
    return refused(law.error());
  }
  const auto learnt_from = drawn(options, counted_suite, "tuning");
  if (!learnt_from.has_value()) {
    return refused(learnt_from.error());
  }
  const eval::CueCounts counts = eval::count_cues(learnt_from.value());
  json figures{
      {"meta.command", fmt::format("saca cues --count {} --car {}", options.count, options.car)}};
  for (std::size_t k = 0; k < num_cue_kinds; ++k) {
    const std::string key = fmt::format("cues.{}.", name(static_cast<CueKind>(k)));
    figures[key + "there"] = counts.at(k).there;
    figures[key + "came"] = counts.at(k).came;
  }
  if (!options.as_json) {
    print(counts);
  }
  constexpr std::uint64_t seed = 1;
  for (const char* suite : judged_suites) {
    const auto judged = drawn(options, suite, "calibration");
    if (!judged.has_value()) {
      return refused(judged.error());
    }
    const auto forecasts =
        eval::cue_forecasts(learnt_from.value(), judged.value(), law.value(), seed);
    for (const eval::CueForecast& one : forecasts) {
      const std::string key = fmt::format("cues.{}.{}.", suite, one.key);
      add_estimate(figures, key + "log_loss", one.log_loss);
      add_estimate(figures, key + "brier", one.brier);
    }
    if (!options.as_json) {
      print(suite, forecasts);
    }
  }
  if (!options.output.empty()) {
    if (auto problem =
            long_work::write_output(options.output, counted_law_text(law.value(), counts))) {
      return refused(*problem);
    }
  }
  if (options.as_json) {
    app::print_json(figures);
  }
  return success;
}

}  // namespace

void add_cues(CLI::App& line, int& exit_code) {
  CLI::App* const command = line.add_subcommand(
      "cues", "How often what a place tells of comes, and how well that is known beforehand");
  const auto options = std::make_shared<CuesCommand>();
  command->add_option("--count", options->count, "How many encounters of each suite")
      ->check(CLI::Range(1, 1'000'000))
      ->capture_default_str();
  command->add_option("--car", options->car, "A car's file, or the name of a shipped one")
      ->capture_default_str();
  command->add_option("-o,--output", options->output,
                      "Write what SACA is to reckon with: data/cues.toml");
  command->add_flag("--json", options->as_json, "For programs");
  command->callback([options, &exit_code] { exit_code = run(*options); });
}

}  // namespace saca::app
