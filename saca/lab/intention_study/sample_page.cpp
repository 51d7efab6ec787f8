#include "saca/lab/intention_study/sample_page.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <numeric>
#include <optional>
#include <random>

#include "saca/base/core/contract.h"
#include "saca/thinking/intent/intention.h"

namespace saca::intention_study {
namespace {

using intention_scoring::Forecasts;
using intention_scoring::Sequence;

/// nullopt: it has no label.
std::optional<std::uint8_t> rarest_class(const Sequence& sequence) {
  constexpr std::array<std::uint8_t, 6> rarest_first{5, 4, 2, 1, 3, 0};
  const auto* const found =
      std::find_if(rarest_first.begin(), rarest_first.end(), [&](std::uint8_t label) {
        return std::find(sequence.labels.begin(), sequence.labels.end(), label) !=
               sequence.labels.end();
      });
  return found == rarest_first.end() ? std::nullopt : std::optional(*found);
}

report::IntentionSample sample_of(const Sequence& sequence, const std::string& split,
                                  const Forecasts* forecasts) {
  report::IntentionSample sample{.title = sequence.name,
                                 .lines = {sequence.site + ", " + sequence.group + ", " + split},
                                 .step = intention_scoring::frame_step,
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

}  // namespace

std::vector<std::size_t> drawn_samples(const intention_scoring::SequenceSet& set,
                                       const SampleRequest& request) {
  std::vector<std::vector<std::size_t>> of_class(intention_scoring::num_vehicle_classes);
  std::vector<std::size_t> order(set.sequences.size());
  std::iota(order.begin(), order.end(), 0U);
  std::shuffle(order.begin(), order.end(), std::mt19937_64(request.seed));
  for (const std::size_t i : order) {
    const Sequence& sequence = set.sequences[i];
    const bool fits = request.split.empty() ? !sequence.simulated : set.splits[i] == request.split;
    if (!fits || (!request.name.empty() && sequence.name != request.name)) {
      continue;
    }
    if (const auto rarest = rarest_class(sequence)) {
      of_class[*rarest].push_back(i);
    }
  }
  std::vector<std::size_t> chosen;
  for (std::size_t turn = 0; chosen.size() < request.samples && turn < order.size(); ++turn) {
    for (const auto& some : of_class) {
      if (turn < some.size() && chosen.size() < request.samples) {
        chosen.push_back(some[turn]);
      }
    }
  }
  return chosen;
}

std::vector<Sequence> sequences_of(const intention_scoring::SequenceSet& set,
                                   std::span<const std::size_t> chosen) {
  std::vector<Sequence> sequences;
  sequences.reserve(chosen.size());
  for (const std::size_t i : chosen) {
    sequences.push_back(set.sequences.at(i));
  }
  return sequences;
}

report::IntentionPage sample_page(const intention_scoring::SequenceSet& set,
                                  const SampleRequest& request, std::span<const std::size_t> chosen,
                                  std::span<const Forecasts> forecasts) {
  expects(forecasts.empty() || forecasts.size() == chosen.size(), "one forecast per sample");
  report::IntentionPage page{
      .title = "Intentions: drawn samples",
      .lines = {fmt::format("{} of {}, seed {}. Labels above, beliefs of the model below.",
                            chosen.size(), request.source, request.seed)},
      .samples = {}};
  for (std::size_t i = 0; i < chosen.size(); ++i) {
    page.samples.push_back(sample_of(set.sequences[chosen[i]], set.splits[chosen[i]],
                                     forecasts.empty() ? nullptr : &forecasts[i]));
  }
  return page;
}

}  // namespace saca::intention_study
