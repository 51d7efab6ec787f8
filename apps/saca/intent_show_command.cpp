#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <numeric>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "apps/saca/commands.h"
#include "apps/saca/intent_commands.h"
#include "apps/saca/places.h"
#include "apps/saca/printing.h"
#include "saca/base/core/file.h"
#include "saca/base/core/parallel.h"
#include "saca/lab/long_work/output_file.h"
#include "saca/lab/report/intention_chart.h"
#include "saca/lab/report/intention_page.h"
#include "saca/lab/training/predict.h"
#include "saca/lab/training/sequence_file.h"
#include "saca/thinking/intent/intention.h"

namespace saca::app {
namespace {

namespace fs = std::filesystem;
using training::Forecasts;
using training::Sequence;

struct ShowOptions {
  std::string sequences;
  std::string output;
  std::string model;
  std::string split;
  std::string name;
  std::size_t samples = 60;
  unsigned long seed = 1;
};

/// Sequences by class: each class's turn comes as often as any other's, so that rare ones are seen.
std::vector<std::size_t> drawn(const training::SequenceSet& set, const ShowOptions& options) {
  std::vector<std::vector<std::size_t>> of_class(training::num_vehicle_classes);
  std::vector<std::size_t> order(set.sequences.size());
  std::iota(order.begin(), order.end(), 0U);
  std::shuffle(order.begin(), order.end(), std::mt19937_64(options.seed));
  for (const std::size_t i : order) {
    const Sequence& sequence = set.sequences[i];
    const bool fits = options.split.empty() ? !sequence.simulated : set.splits[i] == options.split;
    if (!fits || (!options.name.empty() && sequence.name != options.name)) {
      continue;
    }
    // By its rarest class: they come in this order.
    constexpr std::array<std::uint8_t, 6> rarest_first{5, 4, 2, 1, 3, 0};
    for (const std::uint8_t label : rarest_first) {
      if (std::find(sequence.labels.begin(), sequence.labels.end(), label) !=
          sequence.labels.end()) {
        of_class[label].push_back(i);
        break;
      }
    }
  }
  std::vector<std::size_t> chosen;
  for (std::size_t turn = 0; chosen.size() < options.samples && turn < order.size(); ++turn) {
    for (const auto& some : of_class) {
      if (turn < some.size() && chosen.size() < options.samples) {
        chosen.push_back(some[turn]);
      }
    }
  }
  return chosen;
}

report::IntentionSample sample_of(const Sequence& sequence, const std::string& split,
                                  const Forecasts* forecasts) {
  report::IntentionSample sample{.title = sequence.name,
                                 .lines = {sequence.site + ", " + sequence.group + ", " + split},
                                 .step = training::frame_step,
                                 .seen = sequence.observations,
                                 .labels = {sequence.labels.begin(), sequence.labels.end()},
                                 .scored = sequence.scored,
                                 .marks = sequence.crossing_times,
                                 .bands = {}};
  sample.marks.insert(sample.marks.end(), sequence.braking_times.begin(),
                      sequence.braking_times.end());
  std::sort(sample.marks.begin(), sample.marks.end());
  if (forecasts != nullptr) {
    sample.bands = {{"now", forecasts->at[0]}, {"in 1 s", forecasts->at[2]}};
  }
  return sample;
}

int show(const ShowOptions& options) {
  const auto set = training::read_sequences(options.sequences);
  if (!set.has_value()) {
    return refused(set.error());
  }
  if (const auto problem = long_work::why_outputs_unwritable({options.output})) {
    return refused(*problem);
  }
  const std::vector<std::size_t> chosen = drawn(set.value(), options);
  if (chosen.empty()) {
    complain(
        fmt::format("{}: want sequences that fit --split and --name, got none", options.sequences));
    return bad_input;
  }
  std::vector<Sequence> sequences;
  sequences.reserve(chosen.size());
  for (const std::size_t i : chosen) {
    sequences.push_back(set.value().sequences[i]);
  }
  std::vector<Forecasts> forecasts;
  if (!options.model.empty()) {
    const auto model = intent::read_model(options.model);
    if (!model.has_value()) {
      return refused(model.error());
    }
    forecasts = training::predicted(model.value(), sequences, usual_threads());
  }
  report::IntentionPage page{
      .title = "Intentions: drawn samples",
      .lines = {fmt::format("{} of {}, seed {}. Labels above, beliefs of the model below.",
                            sequences.size(), options.sequences, options.seed)},
      .samples = {}};
  for (std::size_t i = 0; i < sequences.size(); ++i) {
    page.samples.push_back(sample_of(sequences[i], set.value().splits[chosen[i]],
                                     forecasts.empty() ? nullptr : &forecasts[i]));
  }
  const bool as_svg = fs::path(options.output).extension() == ".svg";
  const std::string text =
      as_svg ? report::intention_sample_svg(page.samples.front()) : report::intention_page(page);
  if (const auto problem = long_work::write_output(options.output, text)) {
    return refused(*problem);
  }
  app::print("{}: {} samples\n", options.output, as_svg ? 1 : page.samples.size());
  return success;
}

}  // namespace

void add_intent_show(CLI::App& intent, int& exit_code) {
  CLI::App* const command =
      intent.add_subcommand("show", "Draw sequences with their labels, and what a model believes");
  const auto options = std::make_shared<ShowOptions>();
  command->add_option("sequences", options->sequences, "HDF5 file of `saca intent examples`")
      ->required();
  command->add_option("-o,--output", options->output, "A page (.html), or its first sample (.svg)")
      ->required();
  command->add_option("--model", options->model, "Weights whose beliefs are shown");
  command->add_option("--split", options->split, "Only of this one; default: what was recorded");
  command->add_option("--name", options->name, "Only the sequence of this name");
  command->add_option("--samples", options->samples, "How many are drawn; each class in turn")
      ->check(CLI::Range(1, 1'000))
      ->capture_default_str();
  command->add_option("--seed", options->seed)->capture_default_str();
  command->callback([options, &exit_code] { exit_code = show(*options); });
}

}  // namespace saca::app
