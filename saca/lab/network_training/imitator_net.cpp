#include "saca/lab/network_training/imitator_net.h"

#include <fmt/core.h>

#include <algorithm>
#include <cstdint>

namespace saca::network_training {
namespace {

using eval::ImitatorInputs;
using manoeuvre::num_policies;

constexpr auto imitator_inputs_size = static_cast<std::int64_t>(eval::num_imitator_inputs);
constexpr auto num_choices = static_cast<std::int64_t>(num_policies);
constexpr auto layer_width = static_cast<std::int64_t>(eval::Imitator::width);

/// Row i is what input i alone becomes in the mirror.
torch::Tensor mirror_of_inputs() {
  torch::Tensor mirror = torch::zeros({imitator_inputs_size, imitator_inputs_size});
  auto at = mirror.accessor<float, 2>();
  for (std::int64_t i = 0; i < imitator_inputs_size; ++i) {
    ImitatorInputs one{};
    one[static_cast<std::size_t>(i)] = 1.0F;
    const ImitatorInputs there = eval::mirrored(one);
    for (std::int64_t k = 0; k < imitator_inputs_size; ++k) {
      at[i][k] = there[static_cast<std::size_t>(k)];
    }
  }
  return mirror;
}

torch::Tensor policies_in_mirror() {
  torch::Tensor there = torch::empty({num_choices}, torch::kInt64);
  auto at = there.accessor<std::int64_t, 1>();
  for (const manoeuvre::PolicyId policy : manoeuvre::all_policies) {
    at[static_cast<std::int64_t>(policy)] = static_cast<std::int64_t>(eval::mirrored(policy));
  }
  return there;
}

}  // namespace

ImitatorNetImpl::ImitatorNetImpl(double dropout)
    : first_(imitator_inputs_size, layer_width),
      second_(layer_width, layer_width),
      last_(layer_width, num_choices),
      dropout_(dropout),
      mirror_(mirror_of_inputs()),
      policies_(policies_in_mirror()) {
  register_module("first", first_);
  register_module("second", second_);
  register_module("last", last_);
  register_module("dropout", dropout_);
}

torch::Tensor ImitatorNetImpl::scores(const torch::Tensor& inputs) {
  const torch::Tensor x = dropout_(torch::relu(first_(inputs)));
  return last_(dropout_(torch::relu(second_(x))));
}

torch::Tensor ImitatorNetImpl::log_probabilities(const torch::Tensor& inputs) {
  const torch::Tensor in_mirror = scores(inputs.matmul(mirror_)).index_select(-1, policies_);
  return torch::log_softmax(0.5 * (scores(inputs) + in_mirror), -1);
}

torch::Tensor ImitatorNetImpl::loss(const Batch& batch) {
  const torch::Tensor p = log_probabilities(batch.features).reshape({-1, num_choices});
  return torch::nn::functional::nll_loss(p, batch.labels.reshape({-1}));
}

formats::Tensors ImitatorNetImpl::tensors() const {
  formats::Tensors all;
  const auto add = [&](const char* name, const torch::nn::Linear& layer) {
    all.tensors[std::string(name) + ".weight"] = plain(layer->weight);
    all.tensors[std::string(name) + ".bias"] = plain(layer->bias);
  };
  add("0", first_);
  add("1", second_);
  add("2", last_);
  return all;
}

std::vector<Piece> imitator_pieces(std::span<const memory::Case> cases) {
  std::vector<Piece> pieces;
  pieces.reserve(cases.size());
  for (const memory::Case& one : cases) {
    const ImitatorInputs inputs = eval::imitator_inputs(one.scene);
    Piece piece{.features = torch::empty({1, imitator_inputs_size}),
                .labels = torch::full({1, 1}, static_cast<std::int64_t>(one.best), torch::kInt64),
                .known = torch::ones({1, 1}, torch::kBool),
                .taught = {}};
    std::copy(inputs.begin(), inputs.end(), piece.features.data_ptr<float>());
    pieces.push_back(std::move(piece));
  }
  return pieces;
}

Result<ImitatorNet> trained_imitator(const std::vector<Piece>& pieces,
                                     const std::vector<Piece>& held_out, const Schedule& schedule,
                                     double dropout, const std::filesystem::path& state,
                                     const std::function<bool(const Epoch&)>& on_epoch) {
  torch::manual_seed(schedule.seed);
  ImitatorNet network(dropout);
  const Task task{.network = network.ptr(),
                  .loss = [&](Batch& batch, std::mt19937_64&) { return network->loss(batch); },
                  .held_out_loss = [&](const Batch& batch) { return network->loss(batch); },
                  .words = fmt::format("imitator {}", dropout)};
  if (const auto problem = train(task, pieces, held_out, schedule, state, on_epoch)) {
    return *problem;
  }
  return network;
}

}  // namespace saca::network_training
