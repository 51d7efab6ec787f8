#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "apps/saca/commands.h"
#include "apps/saca/danger_check.h"
#include "apps/saca/json_output.h"
#include "apps/saca/places.h"
#include "apps/saca/printing.h"
#include "apps/saca/settings.h"
#include "saca/base/core/clock.h"
#include "saca/base/core/file.h"
#include "saca/base/core/parallel.h"
#include "saca/base/formats/tensors.h"
#include "saca/lab/learned_danger/margins.h"
#include "saca/lab/long_work/interrupt.h"
#include "saca/lab/long_work/output_file.h"
#include "saca/lab/long_work/progress.h"

namespace saca::app {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

struct MarginOptions {
  std::string weights;
  std::string output;  ///< empty: the weights
  int situations = 400'000;
  std::uint64_t seed = 1;
  int threads = usual_threads();
  bool as_json = false;
};

/// What was counted for margins so far: what an interrupted count goes on from.
struct MarginCount {
  int situations = 0;
  std::array<learned_danger::ToldSafe, learned_danger::num_bins> told;
};

json count_json(const MarginCount& count, const std::string& what) {
  json all{{"schema", "saca.margins/2"}, {"of", what}, {"situations", count.situations}};
  for (std::size_t bin = 0; bin < learned_danger::num_bins; ++bin) {
    all["told_safe"][learned_danger::bin_names()[bin]] = count.told[bin].numbers();
  }
  return all;
}

/// @return  Error::Code::malformed: the file is no count, or of other weights or another seed
Result<MarginCount> read_count(const std::string& path, const std::string& what) {
  if (!fs::exists(path)) {
    return MarginCount{};
  }
  const auto text = read_file(path, many_bytes);
  if (!text.has_value()) {
    return text.error();
  }
  const json all = json::parse(text.value(), nullptr, false);
  const auto refuse = [&](const std::string& why) {
    return Error{Error::Code::malformed, path + ": want an unfinished count of margins of " + what +
                                             ", got " + why + "; delete it to begin anew"};
  };
  if (!all.is_object() || all.value("schema", json()) != "saca.margins/2") {
    return refuse("something else");
  }
  if (all.value("of", json()) != what) {
    return refuse("one of other weights or another seed");
  }
  MarginCount count;
  try {
    count.situations = all.at("situations").get<int>();
    for (std::size_t bin = 0; bin < learned_danger::num_bins; ++bin) {
      const auto told = learned_danger::ToldSafe::from(
          all.at("told_safe").at(learned_danger::bin_names()[bin]).get<std::vector<int>>());
      if (!told) {
        return refuse("numbers that are none");
      }
      count.told[bin] = *told;
    }
  } catch (const json::exception& problem) {
    return refuse(problem.what());
  }
  return count;
}

/// Counts, and writes what was counted every few seconds. Fewer where it was interrupted.
std::optional<Error> count_for_margins(const MarginOptions& options, const DangerWeights& weights,
                                       const std::string& state, const std::string& what,
                                       MarginCount& count) {
  constexpr int at_once_for_margins = 2'000;
  SteadyClock clock;
  const int remembered = count.situations;
  long_work::ProgressLine line("danger margins", options.situations, clock, progress_display());
  while (count.situations < options.situations && !long_work::interrupted()) {
    std::array<bool, learned_danger::num_bins> wanted{};
    std::transform(count.told.begin(), count.told.end(), wanted.begin(),
                   [](const learned_danger::ToldSafe& told) { return told.may_have_margin(); });
    const auto some = checked_situations<learned_danger::MarginSample>(
        "margins", count.situations,
        std::min(at_once_for_margins, options.situations - count.situations), options.threads,
        options.seed, [&](std::uint64_t seed) {
          return learned_danger::driven_by_evasion(weights.inputs.car, weights.body,
                                                   weights.network, seed, wanted);
        });
    for (const learned_danger::MarginSample& one : some) {
      if (one.acted) {
        count.told[one.bin].add(one.told, *one.acted >= 0.0);
      }
    }
    count.situations += static_cast<int>(some.size());
    if (auto problem = write_file(state, count_json(count, what).dump())) {
      return problem;
    }
    line.show(count.situations, remembered, " situations");
  }
  return std::nullopt;
}

int fit_margins(const MarginOptions& options) {
  long_work::watch_for_interrupt();
  auto read = read_danger_weights(options.weights);
  if (!read.has_value()) {
    return refused(read.error());
  }
  DangerWeights weights = std::move(read).value();
  const std::string output = options.output.empty() ? options.weights : options.output;
  const std::string state = output + ".margins.json";
  if (const auto problem = long_work::why_outputs_unwritable({output, state})) {
    return refused(*problem);
  }
  const std::string what =
      fmt::format("weights {:016x}, seed {}", weights.network.digest(), options.seed);
  auto counted = read_count(state, what);
  if (!counted.has_value()) {
    return refused(counted.error());
  }
  MarginCount count = std::move(counted).value();
  if (const auto problem = count_for_margins(options, weights, state, what, count)) {
    return refused(*problem);
  }
  if (long_work::interrupted()) {
    complain("interrupted; the same command goes on from here");
    return was_interrupted;
  }
  std::array<double, learned_danger::num_bins> metres{};
  json all{{"meta.weights", options.weights},
           {"meta.situations", count.situations},
           {"meta.seed", std::to_string(options.seed)}};
  for (std::size_t bin = 0; bin < learned_danger::num_bins; ++bin) {
    const std::string& name = learned_danger::bin_names()[bin];
    const auto margin = count.told[bin].margin();
    metres[bin] = margin.value_or(learned_danger::Margins::none);
    const learned_danger::Share plain = count.told[bin].hits_with(0);
    all["danger.net." + name + ".margin_m"] = metres[bin];
    all["danger.net." + name + ".told_safe"] = plain.of;
    if (!options.as_json) {
      app::print("{:42} {:>7} of {:6} told safe {:5} were hit\n", name,
                 margin ? fmt::format("{:.2f} m", *margin) : "none", plain.of, plain.count);
    }
  }
  learned_danger::Margins(metres).add_to(weights.tensors.words);
  weights.tensors.words["margin.situations"] = std::to_string(count.situations);
  if (const auto problem = write_file(output, formats::tensor_bytes(weights.tensors))) {
    return refused(*problem);
  }
  fs::remove(state);
  if (options.as_json) {
    print_json(all);
  }
  return success;
}

}  // namespace

void add_danger_margins(CLI::App& danger, int& exit_code) {
  const auto options = std::make_shared<MarginOptions>();
  CLI::App* const command = danger.add_subcommand(
      "margins", "Fit what is added to learnt V_h, so that what it tells safe is hardly ever hit");
  command->add_option("WEIGHTS", options->weights, "safetensors file of saca-train-danger")
      ->required();
  command->add_option("--output", options->output, "The same weights with margins; else WEIGHTS");
  command->add_option("--situations", options->situations, "Driven where they are told safe")
      ->check(CLI::Range(1, 100'000'000))
      ->capture_default_str();
  command->add_option("--seed", options->seed)->capture_default_str();
  command->add_option("--threads", options->threads, "They do not change the margins")
      ->check(CLI::Range(1, 256))
      ->capture_default_str();
  command->add_flag("--json", options->as_json, "For programs");
  command->callback([options, &exit_code] { exit_code = fit_margins(*options); });
}

}  // namespace saca::app
