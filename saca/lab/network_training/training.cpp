#include "saca/lab/network_training/training.h"

#include <fmt/core.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <random>
#include <utility>

#include "saca/base/core/contract.h"
#include "saca/lab/intention_scoring/score.h"
#include "saca/lab/network_training/speed_noise.h"
#include "saca/thinking/intent/features.h"

namespace saca::network_training {
namespace {

using intent::Feature;
using intention_scoring::Sequence;

constexpr auto columns = static_cast<std::int64_t>(intent::num_features);
constexpr auto classes_predicted = static_cast<std::int64_t>(intent::num_classes);
constexpr auto rows_ahead = static_cast<std::int64_t>(intent::num_horizons);

/// What frames [first, last) of a sequence are taught of their labels: the labels themselves, and
/// by its share what a teacher predicts.   (rows x H x K)
torch::Tensor taught_of(const torch::Tensor& labels, const intention_scoring::Forecasts& teacher,
                        double share, std::size_t first) {
  torch::Tensor taught = torch::one_hot(labels, classes_predicted).to(torch::kFloat32);
  if (teacher.at[0].empty()) {
    return taught;
  }
  taught *= 1.0 - share;
  auto rows = taught.accessor<float, 3>();
  for (std::int64_t row = 0; row < labels.size(0); ++row) {
    for (std::size_t h = 0; h < intent::num_horizons; ++h) {
      const auto& predicted = teacher.at[h][first + static_cast<std::size_t>(row)];
      for (std::size_t k = 0; k < intent::num_classes; ++k) {
        rows[row][static_cast<std::int64_t>(h)][static_cast<std::int64_t>(k)] +=
            static_cast<float>(share * predicted[k]);
      }
    }
  }
  return taught;
}

/// Frames [first, last) of a sequence, as a stream sees them that begins there.
Piece piece_of(const Sequence& sequence, std::size_t first, std::size_t last) {
  const auto rows = static_cast<std::int64_t>(last - first);
  Piece piece{.features = torch::empty({rows, columns}),
              .labels = torch::zeros({rows, rows_ahead}, torch::kInt64),
              .known = torch::zeros({rows, rows_ahead}, torch::kBool),
              .taught = {}};
  auto* features = piece.features.data_ptr<float>();
  auto labels = piece.labels.accessor<std::int64_t, 2>();
  auto known = piece.known.accessor<bool, 2>();
  intent::ObservationHistory memory;
  for (std::size_t t = first; t < last; ++t) {
    memory.add(sequence.observations[t]);
    const intent::Features now = memory.features();
    features = std::copy(now.begin(), now.end(), features);
    for (std::size_t h = 0; h < intent::num_horizons; ++h) {
      const std::size_t later = t + intention_scoring::frames_ahead[h];
      if (later < sequence.labels.size()) {
        const auto row = static_cast<std::int64_t>(t - first);
        labels[row][static_cast<std::int64_t>(h)] = sequence.labels[later];
        known[row][static_cast<std::int64_t>(h)] = sequence.scored[later];
      }
    }
  }
  return piece;
}

void hide(torch::Tensor& features, std::int64_t piece, std::initializer_list<Feature> which) {
  for (const Feature each : which) {
    features.select(0, piece).select(1, static_cast<std::int64_t>(each)).zero_();
  }
}

/// Lets each piece be seen as by another site's tracker.
void add_noise(Batch& batch, const TrainingPlan& plan, std::mt19937_64& random) {
  if (plan.speed_noise == 0.0) {
    return;
  }
  std::uniform_real_distribution<double> sd(0.0, plan.speed_noise);
  for (std::int64_t i = 0; i < batch.features.size(0); ++i) {
    const auto num_frames = static_cast<std::size_t>(batch.present[i].sum().item<std::int64_t>());
    add_speed_noise(batch.features[i], drawn_speed_noise(num_frames, sd(random), random));
  }
}

/// Hides now and then what is not known everywhere.
void hide_some(Batch& batch, const TrainingPlan& plan, std::mt19937_64& random) {
  std::uniform_real_distribution<double> share(0.0, 1.0);
  for (std::int64_t i = 0; i < batch.features.size(0); ++i) {
    if (share(random) < plan.lane_loss) {
      hide(batch.features, i,
           {Feature::lane_known, Feature::lane_width, Feature::to_line, Feature::offset,
            Feature::lateral_speed, Feature::heading, Feature::steered_speed, Feature::moved_03,
            Feature::moved_05, Feature::moved_10, Feature::moved_20, Feature::sped_05,
            Feature::sped_10, Feature::lateral_way});
    }
    if (share(random) < plan.ahead_loss) {
      hide(batch.features, i,
           {Feature::ahead_known, Feature::somebody_ahead, Feature::nearness, Feature::time_gap,
            Feature::closing, Feature::closing_time, Feature::needed_deceleration,
            Feature::lead_slope_05, Feature::lead_slope_10});
    }
    if (share(random) < plan.pedals_loss) {
      hide(batch.features, i,
           {Feature::throttle_known, Feature::throttle, Feature::brake_known, Feature::brake,
            Feature::steering_known, Feature::steering});
    }
  }
}

/// What of a plan a schedule does not say.
std::string words_of(const TrainingPlan& plan) {
  return fmt::format("{} {} {} {} {} {} {} {}", plan.longest, plan.dropout,
                     fmt::join(plan.label_weights, ","), plan.chain == Chain::learnt,
                     plan.lane_loss, plan.ahead_loss, plan.pedals_loss, plan.speed_noise);
}

}  // namespace

std::vector<Piece> pieces_of(const std::vector<Sequence>& sequences, int longest,
                             PieceBegins begins, const Lessons& lessons) {
  expects(longest > 0, "longest > 0");
  const bool is_taught = !lessons.forecasts.empty();
  expects(!is_taught || lessons.forecasts.size() == sequences.size(), "lessons of each sequence");
  std::vector<Piece> pieces;
  const auto add = [&](std::size_t which, std::size_t first, std::size_t last) {
    Piece piece = piece_of(sequences[which], first, last);
    if (is_taught) {
      piece.taught = taught_of(piece.labels, lessons.forecasts[which], lessons.share, first);
    }
    if (piece.known.any().item<bool>()) {
      pieces.push_back(std::move(piece));
    }
  };
  std::size_t number = 0;
  for (std::size_t i = 0; i < sequences.size(); ++i) {
    const std::size_t num = sequences[i].observations.size();
    for (std::size_t first = 0; first < num; first += static_cast<std::size_t>(longest)) {
      const std::size_t last = std::min(num, first + static_cast<std::size_t>(longest));
      add(i, first, last);
      const std::size_t late = first + (last - first) * (1 + number++ % 3) / 4;
      if (begins == PieceBegins::also_late && late < last) {
        add(i, late, last);
      }
    }
  }
  return pieces;
}

Result<LstmCrf> trained(const std::vector<Sequence>& sequences,
                        const std::vector<Sequence>& held_out, const TrainingPlan& plan,
                        const std::filesystem::path& state,
                        const std::function<bool(const Epoch&)>& on_epoch, const Lessons& lessons) {
  expects(!sequences.empty() && plan.epochs > 0 && plan.batch > 0, "something to train with");
  torch::manual_seed(plan.seed);
  LstmCrf network(plan.dropout, plan.chain);
  const Task task{.network = network.ptr(),
                  .loss =
                      [&](Batch& batch, std::mt19937_64& random) {
                        add_noise(batch, plan, random);
                        hide_some(batch, plan, random);
                        return network->loss(network->emissions(batch.features), batch,
                                             plan.label_weights);
                      },
                  .held_out_loss =
                      [&](const Batch& batch) {
                        return network->loss(network->emissions(batch.features), batch);
                      },
                  .words = words_of(plan)};
  const Schedule schedule{.seed = plan.seed,
                          .epochs = plan.epochs,
                          .batch = plan.batch,
                          .step = plan.step,
                          .decay = plan.decay};
  if (const auto problem = train(
          task, pieces_of(sequences, plan.longest, PieceBegins::also_late, lessons),
          pieces_of(held_out, plan.longest, PieceBegins::in_turn), schedule, state, on_epoch)) {
    return *problem;
  }
  return network;
}

void set_calibrations(formats::Tensors& tensors,
                      const intention_scoring::Calibrations& calibrations) {
  formats::Tensor inverse_temperature{{intent::num_horizons}, {}};
  formats::Tensor bias{{intent::num_horizons, intent::num_classes}, {}};
  formats::Tensor naming = bias;
  for (const intent::Calibration& each : calibrations) {
    inverse_temperature.values.push_back(static_cast<float>(each.inverse_temperature));
    for (std::size_t k = 0; k < intent::num_classes; ++k) {
      bias.values.push_back(static_cast<float>(each.bias[k]));
      naming.values.push_back(static_cast<float>(each.naming[k]));
    }
  }
  tensors.tensors["sharpness"] = std::move(inverse_temperature);
  tensors.tensors["bias"] = std::move(bias);
  tensors.tensors["naming"] = std::move(naming);
}

formats::Tensors model_tensors(const std::vector<LstmCrf>& networks) {
  expects(!networks.empty(), "at least one network");
  formats::Tensors tensors;
  torch::Tensor start = torch::zeros_like(networks[0]->start());
  torch::Tensor transition = torch::zeros_like(networks[0]->transition());
  const double share = 1.0 / static_cast<double>(networks.size());
  for (std::size_t i = 0; i < networks.size(); ++i) {
    networks[i]->add_network(tensors, std::to_string(i) + ".");
    start += share * networks[i]->start();
    transition += share * networks[i]->transition();
  }
  tensors.tensors["chain.start"] = plain(start);
  tensors.tensors["chain.transition"] = plain(transition);
  tensors.tensors["networks"] = {{1}, {static_cast<float>(networks.size())}};
  const intent::Calibration none;
  set_calibrations(tensors, {none, none, none});
  return tensors;
}

}  // namespace saca::network_training
