#include <array>

#include "apps/saca/options.h"
#include "saca/lab/family_samples/counted_law_text.h"
#include "saca/lab/family_samples/cue_report.h"
#include "saca/lab/family_samples/drawn_cues.h"

namespace saca::app {
namespace {

constexpr const char* counted_suite = "cues";
constexpr std::array judged_suites{counted_suite, "other_cues"};

struct CuesOptions {
  int count = 2'000;
  std::string car = "compact_rwd_ev";
  std::string output;  ///< empty: nothing is written
  bool as_json = false;
};

/// The cues of the first encounters of a suite.
std::vector<eval::DrawnCues> drawn(const CuesOptions& options, const std::string& suite,
                                   const std::string& split) {
  const auto source = need(installation::open_suite(
      here(), suite, {.count = options.count, .split = split, .car = options.car}, "cues"));
  return need(family_samples::drawn_cues(source.source, suite, options.count));
}

void count_cues(const CuesOptions& options) {
  need_writable({options.output});
  const auto law = need(intent::load_cue_law(here().root / "scenarios" / "families" / "cues.toml"));
  const auto learnt_from = drawn(options, counted_suite, "tuning");
  const eval::CueCounts counts = eval::count_cues(learnt_from);
  nlohmann::json figures{
      {"meta.command", fmt::format("saca cues --count {} --car {}", options.count, options.car)}};
  figures.update(family_samples::json_of(counts));
  tell_meanwhile(options.as_json, family_samples::text_of(counts));
  constexpr std::uint64_t seed = 1;
  for (const char* const suite : judged_suites) {
    const auto forecasts =
        eval::cue_forecasts(learnt_from, drawn(options, suite, "calibration"), law, seed);
    figures.update(family_samples::json_of(suite, forecasts));
    tell_meanwhile(options.as_json, family_samples::text_of(suite, forecasts));
  }
  if (!options.output.empty()) {
    write(options.output, family_samples::counted_law_text(law, counts, counted_suite));
  }
  tell(options.as_json, figures, "");
}

}  // namespace

void add_cues(CLI::App& line) {
  const auto [command, options] = add_command<CuesOptions>(
      line, "cues", "How often what a place tells of comes, and how well that is known beforehand",
      count_cues);
  add(command, "--count", options.count, "How many encounters of each suite",
      CLI::Range(1, 1'000'000));
  add_car(command, options.car);
  add(command, "-o,--output", options.output, "Write what SACA is to reckon with: data/cues.toml");
  add_json(command, options.as_json);
}

}  // namespace saca::app
