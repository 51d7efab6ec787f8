#include "saca/lab/intention_scoring/evaluation.h"

#include <fmt/core.h>

#include <algorithm>
#include <functional>
#include <set>
#include <utility>

#include "saca/base/core/contract.h"
#include "saca/base/formats/tensors.h"
#include "saca/lab/intention_scoring/predict.h"

namespace saca::intention_scoring {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t num_draws = 1'000;

/// A figure of tallies that are summed over groups.
using TallyFigure = std::function<std::optional<double>(const Tally&)>;

Tally sum_of(const std::vector<Tally>& tallies, std::span<const std::size_t> groups) {
  Tally sum;
  for (const std::size_t group : groups) {
    sum += tallies[group];
  }
  return sum;
}

std::optional<Interval> difference(std::span<const Sequence> sequences,
                                   std::span<const Forecasts> first,
                                   std::span<const Forecasts> second, std::size_t head,
                                   const TallyFigure& figure, std::uint64_t seed) {
  const std::vector<Tally> a = group_tallies(sequences, first, head);
  const std::vector<Tally> b = group_tallies(sequences, second, head);
  return bootstrap(
      a.size(),
      [&](std::span<const std::size_t> groups) -> std::optional<double> {
        const auto of_a = figure(sum_of(a, groups));
        const auto of_b = figure(sum_of(b, groups));
        if (!of_a || !of_b) {
          return std::nullopt;
        }
        return *of_a - *of_b;
      },
      num_draws, seed);
}

}  // namespace

ForbiddenSteps structurally_forbidden() {
  ForbiddenSteps steps{};
  for (std::size_t from = 0; from < num_vehicle_classes; ++from) {
    for (std::size_t to = 0; to < num_vehicle_classes; ++to) {
      steps[from][to] = !intent::may_follow(from, to);
    }
  }
  return steps;
}

Figures figures_of(std::span<const Sequence> sequences, std::span<const Forecasts> forecasts,
                   std::span<const std::size_t> classes, std::uint64_t seed) {
  Figures figures;
  for (std::size_t head = 0; head < num_heads; ++head) {
    const std::vector<Tally> tallies = group_tallies(sequences, forecasts, head);
    for (const Tally& each : tallies) {
      figures.tallies[head] += each;
    }
    figures.macro_f1[head] = bootstrap(
        tallies.size(),
        [&](std::span<const std::size_t> groups) {
          return sum_of(tallies, groups).confusion.macro_f1(classes);
        },
        num_draws, seed);
  }
  for (std::size_t i = 0; i < sequences.size(); ++i) {
    figures.events += manoeuvre_events_found(sequences[i], forecasts[i]);
    figures.lane_changes.add(lane_change_lead_times(sequences[i], forecasts[i]));
    figures.brakings.add(braking_lead_times(sequences[i], forecasts[i]));
    figures.alarms += false_alarms(sequences[i], forecasts[i]);
    figures.illegal_steps += illegal_steps(forecasts[i].named(0), structurally_forbidden());
  }
  return figures;
}

std::optional<Interval> macro_f1_difference(std::span<const Sequence> sequences,
                                            std::span<const Forecasts> first,
                                            std::span<const Forecasts> second, std::size_t head,
                                            std::span<const std::size_t> classes,
                                            std::uint64_t seed) {
  return difference(
      sequences, first, second, head,
      [&](const Tally& tally) { return tally.confusion.macro_f1(classes); }, seed);
}

std::optional<Interval> log_loss_difference(std::span<const Sequence> sequences,
                                            std::span<const Forecasts> first,
                                            std::span<const Forecasts> second, std::size_t head,
                                            std::uint64_t seed) {
  return difference(
      sequences, first, second, head, [](const Tally& tally) { return tally.mean_log_loss(); },
      seed);
}

Result<ModelsByLeftOut> read_models(const fs::path& folder) {
  std::error_code problem;
  std::set<fs::path> files;
  for (const auto& entry : fs::directory_iterator(folder, problem)) {
    if (entry.path().extension() == ".safetensors") {
      files.insert(entry.path());
    }
  }
  if (files.empty()) {
    return Error{Error::Code::unreadable,
                 folder.string() + ": want a folder with models (*.safetensors), got none"};
  }
  ModelsByLeftOut models;
  for (const fs::path& file : files) {
    const auto tensors = formats::read_tensor_file(file);
    if (!tensors.has_value()) {
      return tensors.error();
    }
    auto model = intent::model_from(tensors.value(), file.string());
    if (!model.has_value()) {
      return model.error();
    }
    const auto word = tensors.value().words.find("left_out");
    if (word == tensors.value().words.end()) {
      return Error{Error::Code::malformed, file.string() + ": want metadata left_out"};
    }
    if (!models.emplace(word->second, std::move(model).value()).second) {
      return Error{Error::Code::malformed,
                   fmt::format("{}: another file of the folder leaves out {} as well",
                               file.string(), word->second)};
    }
  }
  return models;
}

Result<std::vector<Forecasts>> predicted_unseen(const ModelsByLeftOut& models,
                                                std::span<const Sequence> sequences,
                                                std::span<const std::string> splits, int threads) {
  expects(sequences.size() == splits.size(), "one split per sequence");
  std::vector<Forecasts> all(sequences.size());
  for (const std::string& split : std::set<std::string>(splits.begin(), splits.end())) {
    const auto model = models.find(split);
    if (model == models.end()) {
      return Error{Error::Code::out_of_range,
                   fmt::format("want a model that has left out {}, got none", split)};
    }
    std::vector<std::size_t> places;
    std::vector<Sequence> of_split;
    for (std::size_t i = 0; i < sequences.size(); ++i) {
      if (splits[i] == split) {
        places.push_back(i);
        of_split.push_back(sequences[i]);
      }
    }
    std::vector<Forecasts> some = predicted(model->second, of_split, threads);
    for (std::size_t i = 0; i < places.size(); ++i) {
      all[places[i]] = std::move(some[i]);
    }
  }
  return all;
}

}  // namespace saca::intention_scoring
