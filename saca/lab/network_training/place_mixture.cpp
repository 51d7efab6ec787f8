#include "saca/lab/network_training/place_mixture.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <string>
#include <utility>

#include "saca/base/core/contract.h"
#include "saca/thinking/intent/features.h"

namespace saca::network_training {
namespace {

using eval::forecast_times;
using eval::MixtureModel;
using eval::PlaceExample;

constexpr auto features_per_frame = static_cast<std::int64_t>(intent::num_features);
constexpr auto encoder_width = static_cast<std::int64_t>(intent::Encoder::width);
constexpr auto num_outputs = static_cast<std::int64_t>(MixtureModel::outputs_per_side);
constexpr auto num_ways = static_cast<std::int64_t>(MixtureModel::ways_per_side);
constexpr auto num_times = static_cast<std::int64_t>(forecast_times.size());
constexpr auto num_labels = 1 + 2 * num_times;  // speed; s and d at each time

torch::Tensor signs_in_mirror() {
  torch::Tensor sign = torch::ones({features_per_frame});
  sign.narrow(0, static_cast<std::int64_t>(intent::first_mirrored),
              features_per_frame - static_cast<std::int64_t>(intent::first_mirrored))
      .fill_(-1.0);
  return sign;
}

Piece piece_of_places(const std::vector<PlaceExample>& sequence, std::size_t first,
                      std::size_t last) {
  const auto rows = static_cast<std::int64_t>(last - first);
  Piece piece{.features = torch::empty({rows, features_per_frame}),
              .labels = torch::zeros({rows, num_labels}),
              .known = torch::zeros({rows, 1}, torch::kBool),
              .taught = {}};
  auto* features = piece.features.data_ptr<float>();
  auto labels = piece.labels.accessor<float, 2>();
  auto known = piece.known.accessor<bool, 2>();
  for (std::size_t t = first; t < last; ++t) {
    const PlaceExample& one = sequence[t];
    features = std::copy(one.features.begin(), one.features.end(), features);
    const auto row = static_cast<std::int64_t>(t - first);
    known[row][0] = one.known;
    labels[row][0] = static_cast<float>(one.speed);
    for (std::int64_t k = 0; k < num_times; ++k) {
      const Vec2 place = one.places[static_cast<std::size_t>(k)];
      labels[row][1 + 2 * k] = static_cast<float>(place.x);
      labels[row][2 + 2 * k] = static_cast<float>(place.y);
    }
  }
  return piece;
}

}  // namespace

torch::Tensor mixture_nll(const torch::Tensor& outputs, const torch::Tensor& labels) {
  const auto extents = outputs.sizes();
  const torch::Tensor ways =
      outputs.reshape({extents[0], extents[1], 2, num_ways,
                       static_cast<std::int64_t>(MixtureModel::outputs_per_way)});
  const torch::Tensor log_weight =
      torch::log_softmax(ways.select(-1, 0).reshape({extents[0], extents[1], 2 * num_ways}), -1);
  const torch::Tensor at = ways.narrow(-1, 1, ways.size(-1) - 1)
                               .reshape({extents[0], extents[1], 2, num_ways, num_times, 4});
  std::vector<float> seconds(forecast_times.begin(), forecast_times.end());
  const torch::Tensor t = torch::tensor(seconds);
  const torch::Tensor left = torch::tensor({1.0F, -1.0F}).view({1, 1, 2, 1, 1});
  const torch::Tensor speed = labels.narrow(-1, 0, 1).view({extents[0], extents[1], 1, 1, 1});
  const torch::Tensor s =
      speed * t + 0.5 * MixtureModel::acceleration_unit * at.select(-1, 0) * t * t;
  const torch::Tensor d = left * at.select(-1, 1) * t;
  const auto sd = [&](std::int64_t which) {
    return MixtureModel::least_sd +
           t * torch::exp(torch::clamp(at.select(-1, which), MixtureModel::least_log_growth,
                                       MixtureModel::largest_log_growth));
  };
  const torch::Tensor along_sd = sd(2);
  const torch::Tensor across_sd = sd(3);
  const torch::Tensor truth =
      labels.narrow(-1, 1, 2 * num_times).reshape({extents[0], extents[1], 1, 1, num_times, 2});
  const torch::Tensor x = (truth.select(-1, 0) - s) / along_sd;
  const torch::Tensor y = (truth.select(-1, 1) - d) / across_sd;
  const torch::Tensor log_density =
      -0.5 * (x * x + y * y) - torch::log(along_sd * across_sd) - std::log(2.0 * std::numbers::pi);
  const torch::Tensor of_ways =
      log_density.reshape({extents[0], extents[1], 2 * num_ways, num_times}) +
      log_weight.unsqueeze(-1);
  return -torch::logsumexp(of_ways, 2);
}

PlaceMixtureImpl::PlaceMixtureImpl(double dropout)
    : input_(features_per_frame, encoder_width),
      lstm_(torch::nn::LSTMOptions(encoder_width, encoder_width).batch_first(true)),
      output_(2 * encoder_width, num_outputs),
      dropout_(dropout),
      sign_(signs_in_mirror()) {
  register_module("input", input_);
  register_module("lstm", lstm_);
  register_module("output", output_);
  register_module("dropout", dropout_);
}

torch::Tensor PlaceMixtureImpl::outputs(const torch::Tensor& features) {
  const std::int64_t num = features.size(0);
  const torch::Tensor both = torch::cat({features, features * sign_}, 0);
  const torch::Tensor u = dropout_(torch::tanh(input_(both)));
  const torch::Tensor h = dropout_(std::get<0>(lstm_(u)));
  const torch::Tensor out = output_(torch::cat({h, u}, -1));
  return torch::stack({out.narrow(0, 0, num), out.narrow(0, num, num)}, 2);
}

torch::Tensor PlaceMixtureImpl::loss(const Batch& batch) {
  const torch::Tensor of_frames =
      mixture_nll(outputs(batch.features), batch.labels).mean(-1, true);  // B x T x 1
  const torch::Tensor known = batch.known.to(torch::kFloat32);
  return (of_frames * known).sum() / known.sum().clamp_min(1.0);
}

formats::Tensors PlaceMixtureImpl::tensors() const {
  const auto named = lstm_->named_parameters();
  formats::Tensors all;
  all.tensors["input.weight"] = plain(input_->weight);
  all.tensors["input.bias"] = plain(input_->bias);
  all.tensors["lstm.weight"] = plain(torch::cat({named["weight_ih_l0"], named["weight_hh_l0"]}, 1));
  all.tensors["lstm.bias"] = plain(named["bias_ih_l0"] + named["bias_hh_l0"]);
  all.tensors["output.weight"] = plain(output_->weight);
  all.tensors["output.bias"] = plain(output_->bias);
  return all;
}

std::vector<Piece> place_pieces(const std::vector<std::vector<PlaceExample>>& sequences,
                                std::size_t longest) {
  expects(longest > 0, "longest > 0");
  std::vector<Piece> pieces;
  for (const std::vector<PlaceExample>& sequence : sequences) {
    for (std::size_t first = 0; first < sequence.size(); first += longest) {
      Piece piece = piece_of_places(sequence, first, std::min(sequence.size(), first + longest));
      if (piece.known.any().item<bool>()) {
        pieces.push_back(std::move(piece));
      }
    }
  }
  return pieces;
}

Result<PlaceMixture> trained_mixture(const std::vector<Piece>& pieces,
                                     const std::vector<Piece>& held_out, const Schedule& schedule,
                                     double dropout, const std::filesystem::path& state,
                                     const std::function<bool(const Epoch&)>& on_epoch) {
  torch::manual_seed(schedule.seed);
  PlaceMixture network(dropout);
  const Task task{.network = network.ptr(),
                  .loss = [&](Batch& batch, std::mt19937_64&) { return network->loss(batch); },
                  .held_out_loss = [&](const Batch& batch) { return network->loss(batch); },
                  .words = fmt::format("places {}", dropout)};
  if (const auto problem = train(task, pieces, held_out, schedule, state, on_epoch)) {
    return *problem;
  }
  return network;
}

}  // namespace saca::network_training
