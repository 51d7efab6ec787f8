#include <fmt/core.h>

#include <array>
#include <filesystem>
#include <iterator>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "apps/saca/json_output.h"
#include "apps/saca/memory_commands.h"
#include "apps/saca/places.h"
#include "apps/saca/printing.h"
#include "apps/saca/settings.h"
#include "saca/base/core/clock.h"
#include "saca/base/core/parallel.h"
#include "saca/lab/eval/scale_fit.h"
#include "saca/lab/eval/transfer.h"
#include "saca/lab/long_work/interrupt.h"
#include "saca/lab/long_work/output_file.h"
#include "saca/lab/long_work/progress.h"
#include "saca/lab/report/chart_svg.h"

namespace saca::app {
namespace {

using eval::Transfer;
using eval::TransferFigures;
using nlohmann::json;

struct CalibrateOptions {
  std::string cases;
  std::vector<std::string> checks;
  std::string svg;
  bool fit = false;
  int fit_scenes = 2'000;
  std::uint64_t seed = 1;
  int threads = usual_threads();
  bool as_json = false;
};

struct Range {
  const char* key;
  const char* words;
  double from;
  double to;
};
constexpr std::array<Range, 3> ranges{{{"above_0.9", "above 0.9", 0.9, 1.0},
                                       {"0.7_to_0.9", "0.7 to 0.9", 0.7, 0.9},
                                       {"below_0.7", "up to 0.7", -1.0, 0.7}}};

std::string told(const learned_danger::Share& share) {
  const eval::ShareInterval interval = eval::interval_of(share);
  return share.of == 0 ? "-"
                       : fmt::format("{:.1f} % ({:.1f} to {:.1f})", 100.0 * share.value(),
                                     100.0 * interval.low, 100.0 * interval.high);
}

void add_share(json& out, const std::string& key, const learned_danger::Share& share) {
  const eval::ShareInterval interval = eval::interval_of(share);
  out[key] = share.value();
  out[key + ".lo"] = interval.low;
  out[key + ".hi"] = interval.high;
  out[key + ".n"] = share.of;
}

/// The three ranges of the gates, printed and for programs.
void tell(const std::string& what, const std::string& place, const std::vector<Transfer>& all,
          bool print, json& out) {
  if (print) {
    app::print(
        "\n{}: {} queries in which the choice matters\n{:12} {:>9} {:>24} {:>24} {:>24} {:>24}\n",
        what, all.size(), "confidence", "coverage", "as good as the best", "as was expected",
        "of a random case", "braking");
  }
  out[place + ".queries"] = all.size();
  for (const Range& range : ranges) {
    const TransferFigures figures = eval::transfer_figures(all, range.from, range.to);
    if (print) {
      app::print("{:12} {:8.1f} % {:>24} {:>24} {:>24} {:>24}\n", range.words,
                 100.0 * figures.coverage, told(figures.in_truth), told(figures.as_told),
                 told(figures.random_one), told(figures.braking));
    }
    const std::string key = place + "." + range.key;
    out[key + ".coverage"] = figures.coverage;
    add_share(out, key + ".in_truth", figures.in_truth);
    add_share(out, key + ".as_told", figures.as_told);
    add_share(out, key + ".random_one", figures.random_one);
    add_share(out, key + ".braking", figures.braking);
  }
}

/// How often recalls of tenths of confidence transfer.
std::string picture_of(const std::vector<Transfer>& all, const std::string& name) {
  constexpr int bins = 10;
  report::ChartLine truth{.name = "as good as the best, in truth",
                          .note = "with the exact 95 % interval",
                          .colour = report::ChartColour::blue,
                          .points = {}};
  report::ChartLine as_told{
      .name = "by what was expected there", .colour = report::ChartColour::orange, .points = {}};
  report::ChartLine braking{.name = "braking is as good as the best",
                            .colour = report::ChartColour::grey,
                            .dashed = true,
                            .points = {}};
  for (int k = 0; k < bins; ++k) {
    const double from = static_cast<double>(k) / bins;
    const double to = static_cast<double>(k + 1) / bins;
    const TransferFigures figures = eval::transfer_figures(all, from, to);
    if (figures.in_truth.of == 0) {
      continue;
    }
    const double middle = 0.5 * (from + to);
    const eval::ShareInterval interval = eval::interval_of(figures.in_truth);
    truth.points.push_back({middle, 100.0 * figures.in_truth.value()});
    truth.low.push_back(100.0 * interval.low);
    truth.high.push_back(100.0 * interval.high);
    as_told.points.push_back({middle, 100.0 * figures.as_told.value()});
    braking.points.push_back({middle, 100.0 * figures.braking.value()});
  }
  return report::chart_svg(
      {.heading = "How often what is recalled holds",
       .lines = {fmt::format("{}: {} scenes in which the choice matters", name, all.size())},
       .charts = {{.title = "",
                   .x = {.name = "confidence", .low = 0.0, .high = 1.0},
                   .y = {.name = "share", .unit = "%", .low = 0.0, .high = 100.0},
                   .curves = {truth, as_told, braking}}}});
}

/// Every so many, so that not more than `most` are left.
std::vector<memory::Case> some_of(const std::vector<memory::Case>& cases, int most) {
  const std::size_t step =
      (cases.size() + static_cast<std::size_t>(most) - 1) / static_cast<std::size_t>(most);
  std::vector<memory::Case> some;
  some.reserve(cases.size() / step + 1);
  for (std::size_t i = 0; i < cases.size(); i += step) {
    some.push_back(cases[i]);
  }
  return some;
}

void print_fit(const eval::ScaleFit& fit) {
  app::print("\n{:14} {:>8} {:>8}\n", "scale", "shipped", "fitted");
  for (const eval::FittedScale& one : eval::fitted_scales) {
    app::print("{:14} {:8.3f} {:8.3f}\n", one.name, match::Scales{}.*one.value,
               fit.scales.*one.value);
  }
  app::print("error of the harm predicted by like cases: {:.4f}, fitted {:.4f}\n", fit.error_before,
             fit.error);
}

/// Fits what makes a difference, and holds it against other cases.
int fit_similarity(const CalibrateOptions& options, const std::vector<memory::Case>& cases,
                   const std::vector<memory::Case>& checks) {
  long_work::watch_for_interrupt();
  SteadyClock clock;
  long_work::ProgressLine progress("scales", 0, clock, progress_display());
  const auto fit = eval::fit_scales(
      cases, some_of(cases, options.fit_scenes), {}, options.threads, [&](int count, double error) {
        progress.show(count, 0, fmt::format(" tries, error {:.5f}", error));
        return !long_work::interrupted();
      });
  if (!fit) {
    return refused({Error::Code::malformed, options.cases +
                                                ": want cases that tell what every policy was "
                                                "expected to harm, got none"});
  }
  json out{{"meta.command", "saca memory calibrate CASES --fit"},
           {"meta.version", SACA_VERSION},
           {"memory.scales.is_done", fit->is_done},
           {"memory.scales.error.shipped", fit->error_before},
           {"memory.scales.error.fitted", fit->error}};
  for (const eval::FittedScale& one : eval::fitted_scales) {
    out[fmt::format("memory.scales.{}.shipped", one.name)] = match::Scales{}.*one.value;
    out[fmt::format("memory.scales.{}.fitted", one.name)] = fit->scales.*one.value;
  }
  if (!options.as_json) {
    print_fit(*fit);
  }
  const auto shipped = eval::scale_error(cases, checks, {}, options.threads);
  const auto fitted = eval::scale_error(cases, checks, fit->scales, options.threads);
  if (shipped && fitted) {
    out["memory.scales.check_error.shipped"] = *shipped;
    out["memory.scales.check_error.fitted"] = *fitted;
    if (!options.as_json) {
      app::print("in the cases to check: {:.4f}, fitted {:.4f}\n", *shipped, *fitted);
    }
  }
  if (options.as_json) {
    app::print("{}\n", json_text(out));
  }
  if (!fit->is_done) {
    complain("interrupted: the scales are the best so far");
    return was_interrupted;
  }
  return success;
}

/// Of all files to check.
Result<std::vector<memory::Case>> read_checks(const CalibrateOptions& options) {
  std::vector<memory::Case> checks;
  for (const std::string& file : options.checks) {
    auto more = read_cases(file);
    if (!more.has_value()) {
      return more.error();
    }
    std::vector<memory::Case> read = std::move(more).value();
    std::move(read.begin(), read.end(), std::back_inserter(checks));
  }
  return checks;
}

int calibrate(const CalibrateOptions& options) {
  if (const auto problem = long_work::why_outputs_unwritable({options.svg})) {
    return refused(*problem);
  }
  const auto cases = read_cases(options.cases);
  if (!cases.has_value()) {
    return refused(cases.error());
  }
  if (cases.value().empty()) {
    return refused({Error::Code::malformed, options.cases + ": want cases, got none"});
  }
  const auto checks = read_checks(options);
  if (!checks.has_value()) {
    return refused(checks.error());
  }
  if (options.fit) {
    return fit_similarity(options, cases.value(), checks.value());
  }
  const auto held = [&](const std::vector<memory::Case>& queries) {
    return eval::transfers(cases.value(), queries, options.seed, options.threads);
  };
  json out{
      {"meta.command", fmt::format("saca memory calibrate CASES{} --seed {}",
                                   options.checks.empty() ? "" : " --check CASES", options.seed)},
      {"meta.seed", std::to_string(options.seed)},
      {"meta.version", SACA_VERSION},
      {"memory.transfer.cases", cases.value().size()}};
  std::vector<Transfer> drawn = held(cases.value());
  const auto name_of = [](const std::string& file) {
    return std::filesystem::path(file).filename().string();
  };
  std::string drawn_of = name_of(options.cases);
  tell(options.cases + ", each held against all others", "memory.transfer.within", drawn,
       !options.as_json, out);
  for (const auto& [part, key] : {std::pair{0.98, "0.98"}, std::pair{0.95, "0.95"}}) {
    const auto least = eval::least_share(drawn, part);
    out[fmt::format("memory.transfer.least_share_for_{}", key)] =
        least ? json(*least) : json(nullptr);
    if (!options.as_json) {
      app::print("{:.0f} % of all recalls transfer from a share of {} on; confidence there is {}\n",
                 100.0 * part, least ? fmt::format("{:.3f}", *least) : "none",
                 least ? fmt::format("{:.2f}", memory::confidence_at(*least)) : "none");
    }
  }
  if (!options.checks.empty()) {
    drawn = held(checks.value());
    drawn_of.clear();
    for (const std::string& file : options.checks) {
      drawn_of += (drawn_of.empty() ? "" : ", ") + name_of(file);
    }
    tell(drawn_of, "memory.transfer.check", drawn, !options.as_json, out);
  }
  if (!options.svg.empty()) {
    if (const auto problem = long_work::write_output(options.svg, picture_of(drawn, drawn_of))) {
      return refused(*problem);
    }
  }
  if (options.as_json) {
    app::print("{}\n", json_text(out));
  }
  return success;
}

}  // namespace

void add_memory_calibrate(CLI::App& memory, int& exit_code) {
  CLI::App* const command = memory.add_subcommand(
      "calibrate", "How often what cases speak for is as good as the best, by its confidence");
  const auto options = std::make_shared<CalibrateOptions>();
  command->add_option("cases", options->cases, "What `build` or `export` wrote")->required();
  command->add_option("--check", options->checks, "Other cases, that are held against them");
  command->add_option("--svg", options->svg,
                      "The curve as a picture, of --check where it is given");
  command->add_flag("--fit", options->fit,
                    "Fits the scales of what makes a difference between scenes instead");
  command->add_option("--fit-scenes", options->fit_scenes, "How many are predicted in each try")
      ->check(CLI::Range(10, 1'000'000))
      ->capture_default_str();
  command->add_option("--seed", options->seed, "Of what is drawn")->capture_default_str();
  command->add_option("--threads", options->threads, "They do not change the result")
      ->check(CLI::Range(1, 256))
      ->capture_default_str();
  command->add_flag("--json", options->as_json, "For programs");
  command->callback([options, &exit_code] { exit_code = calibrate(*options); });
}

}  // namespace saca::app
