#include "saca/lab/network_training/lstm_crf.h"

#include <cstdint>
#include <utility>

#include "saca/lab/network_training/forward_pass.h"
#include "saca/thinking/intent/features.h"
#include "saca/thinking/intent/model.h"

namespace saca::network_training {
namespace {

using intent::num_classes;
using intent::num_features;
using intent::num_horizons;

constexpr auto width = static_cast<std::int64_t>(intent::Network::width);
constexpr auto classes = static_cast<std::int64_t>(num_classes);
constexpr auto heads = static_cast<std::int64_t>(num_horizons);
constexpr double excluded = -1e4;  // added to the score of what may not be: finite, for gradients

torch::Tensor mirror_signs() {
  torch::Tensor sign = torch::ones({static_cast<std::int64_t>(num_features)});
  for (auto i = static_cast<std::int64_t>(intent::first_mirrored);
       i < static_cast<std::int64_t>(num_features); ++i) {
    sign[i] = -1.0F;
  }
  return sign;
}

torch::Tensor mirrored_classes() {
  const intent::Scores mirror = intent::mirrored(intent::Scores{0.0, 1.0, 2.0, 3.0, 4.0, 5.0});
  torch::Tensor swapped = torch::zeros({classes}, torch::kInt64);
  for (std::size_t k = 0; k < num_classes; ++k) {
    swapped[static_cast<std::int64_t>(k)] = static_cast<std::int64_t>(mirror[k]);
  }
  return swapped;
}

torch::Tensor structural_mask() {
  torch::Tensor mask = torch::zeros({classes, classes});
  for (std::size_t j = 0; j < num_classes; ++j) {
    for (std::size_t k = 0; k < num_classes; ++k) {
      if (!intent::may_follow(j, k)) {
        mask[static_cast<std::int64_t>(j)][static_cast<std::int64_t>(k)] = excluded;
      }
    }
  }
  return mask;
}

}  // namespace

LstmCrfImpl::LstmCrfImpl(double dropout, Chain chain)
    : input_(static_cast<std::int64_t>(num_features), width),
      lstm_(torch::nn::LSTMOptions(width, width).batch_first(true)),
      output_(2 * width, heads * classes),
      dropout_(dropout),
      sign_(mirror_signs()),
      swapped_(mirrored_classes()),
      mask_(structural_mask()) {
  register_module("input", input_);
  register_module("lstm", lstm_);
  register_module("output", output_);
  register_module("dropout", dropout_);
  const bool is_learnt = chain == Chain::learnt;
  start_ = register_parameter("start", torch::zeros({heads, classes}), is_learnt);
  // Staying is likelier than anything else: at 10 Hz a class lasts for tens of frames.
  const double staying = is_learnt ? 3.0 : 0.0;
  transition_ = register_parameter("transition",
                                   staying * torch::eye(classes).repeat({heads, 1, 1}), is_learnt);
  if (!is_learnt) {
    mask_.zero_();
  }
}

torch::Tensor LstmCrfImpl::emissions(const torch::Tensor& features) {
  const std::int64_t num = features.size(0);
  const torch::Tensor both = torch::cat({features, features * sign_}, 0);
  const torch::Tensor u = dropout_(torch::tanh(input_(both)));
  const torch::Tensor h = dropout_(std::get<0>(lstm_(u)));
  const torch::Tensor out =
      output_(torch::cat({h, u}, -1)).view({2 * num, features.size(1), heads, classes});
  const torch::Tensor world = out.narrow(0, 0, num);
  const torch::Tensor mirror = out.narrow(0, num, num).index_select(-1, swapped_);
  return 0.5 * (world + mirror);
}

torch::Tensor LstmCrfImpl::start() const {
  return 0.5 * (start_ + start_.index_select(-1, swapped_));
}

torch::Tensor LstmCrfImpl::transition() const {
  return 0.5 * (transition_ + transition_.index_select(-1, swapped_).index_select(-2, swapped_));
}

torch::Tensor LstmCrfImpl::loss(const torch::Tensor& emissions, const Batch& batch,
                                const ClassWeights& weights) {
  const torch::Tensor filtered =
      torch::log_softmax(forward_pass(emissions, start(), transition() + mask_, batch.present), -1);
  const torch::Tensor of_label = batch.taught.defined()
                                     ? (batch.taught * filtered).sum(-1)
                                     : filtered.gather(-1, batch.labels.unsqueeze(-1)).squeeze(-1);
  const torch::Tensor counts =
      torch::tensor(at::ArrayRef<double>(weights), torch::kFloat32).index({batch.labels}) *
      batch.known.to(torch::kFloat32);
  return -(counts * of_label).sum() / counts.sum().clamp_min(1e-6);
}

void LstmCrfImpl::add_network(formats::Tensors& tensors, const std::string& prefix) const {
  const auto named = lstm_->named_parameters();
  const auto add = [&](const std::string& name, const torch::Tensor& value) {
    tensors.tensors[prefix + name] = plain(value);
  };
  add("input.weight", input_->weight);
  add("input.bias", input_->bias);
  add("lstm.weight", torch::cat({named["weight_ih_l0"], named["weight_hh_l0"]}, 1));
  add("lstm.bias", named["bias_ih_l0"] + named["bias_hh_l0"]);
  add("output.weight", output_->weight);
  add("output.bias", output_->bias);
}

}  // namespace saca::network_training
