#include <fmt/core.h>

#include <array>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "apps/saca/commands.h"
#include "apps/saca/json_output.h"
#include "apps/saca/printing.h"
#include "apps/saca/surveying.h"
#include "saca/lab/family_samples/counted_law_text.h"
#include "saca/lab/family_samples/cue_report.h"
#include "saca/lab/family_samples/drawn_cues.h"
#include "saca/lab/long_work/output_file.h"

namespace saca::app {
namespace {

constexpr const char* counted_suite = "cues";
constexpr std::array judged_suites{counted_suite, "other_cues"};

struct CuesCommand {
  int count = 2'000;
  std::string car = "compact_rwd_ev";
  std::string output;  ///< empty: nothing is written
  bool as_json = false;
};

/// The cues of the first encounters of a suite.
Result<std::vector<eval::DrawnCues>> drawn(const CuesCommand& options, const std::string& suite,
                                           const std::string& split) {
  const auto source = open_suite(
      {.suite = suite, .car = options.car, .count = options.count, .split = split}, "cues");
  if (!source.has_value()) {
    return source.error();
  }
  return family_samples::drawn_cues(source.value().source, suite, options.count);
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
  nlohmann::json figures{
      {"meta.command", fmt::format("saca cues --count {} --car {}", options.count, options.car)}};
  figures.update(family_samples::json_of(counts));
  if (!options.as_json) {
    app::print("{}", family_samples::text_of(counts));
  }
  constexpr std::uint64_t seed = 1;
  for (const char* suite : judged_suites) {
    const auto judged = drawn(options, suite, "calibration");
    if (!judged.has_value()) {
      return refused(judged.error());
    }
    const auto forecasts =
        eval::cue_forecasts(learnt_from.value(), judged.value(), law.value(), seed);
    figures.update(family_samples::json_of(suite, forecasts));
    if (!options.as_json) {
      app::print("{}", family_samples::text_of(suite, forecasts));
    }
  }
  if (!options.output.empty()) {
    if (auto problem = long_work::write_output(
            options.output, family_samples::counted_law_text(law.value(), counts, counted_suite))) {
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
