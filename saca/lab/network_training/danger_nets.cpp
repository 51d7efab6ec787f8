#include "saca/lab/network_training/danger_nets.h"

#include <algorithm>
#include <tuple>

#include "saca/base/core/contract.h"
#include "saca/lab/learned_danger/network.h"
#include "saca/lab/network_training/task.h"

namespace saca::network_training {

using torch::Tensor;

DangerNetImpl::DangerNetImpl(std::int64_t inputs, std::int64_t width)
    : first_(inputs, width), second_(width, width), third_(width, width), last_(width, 1) {
  register_module("first", first_);
  register_module("second", second_);
  register_module("third", third_);
  register_module("last", last_);
}

Tensor DangerNetImpl::added(const Tensor& inputs) {
  Tensor x = torch::relu(first_(inputs));
  x = torch::relu(second_(x));
  x = torch::relu(third_(x));
  return torch::softplus(last_(x).squeeze(1));
}

Tensor DangerNetImpl::forward(const Tensor& inputs, const Tensor& h) {
  return h + added(inputs);
}

void DangerNetImpl::add_to(formats::Tensors& tensors, const std::string& prefix) const {
  int number = 0;
  for (const auto* layer : {&first_, &second_, &third_, &last_}) {
    const std::string name = prefix + std::to_string(number++);
    tensors.tensors[name + ".weight"] = plain((*layer)->weight);
    tensors.tensors[name + ".bias"] = plain((*layer)->bias);
  }
}

void DangerNetImpl::take(const formats::Tensors& tensors, const std::string& prefix) {
  const torch::NoGradGuard none;
  int number = 0;
  const auto copy = [&](const Tensor& to, const std::string& name) {
    const std::vector<float>& from = tensors.tensors.at(name).values;
    expects(static_cast<std::int64_t>(from.size()) == to.numel(), "weights of that size");
    std::copy(from.begin(), from.end(), to.data_ptr<float>());
  };
  for (const auto* layer : {&first_, &second_, &third_, &last_}) {
    const std::string name = prefix + std::to_string(number++);
    copy((*layer)->weight, name + ".weight");
    copy((*layer)->bias, name + ".bias");
  }
}

DangerNet danger_net(const formats::Tensors& tensors, const std::string& prefix) {
  const formats::Tensor& first = tensors.tensors.at(prefix + "0.weight");
  DangerNet net(static_cast<std::int64_t>(first.shape.at(1)),
                static_cast<std::int64_t>(first.shape.at(0)));
  net->take(tensors, prefix);
  return net;
}

DangerNetsImpl::DangerNetsImpl(std::int64_t inputs, std::int64_t width)
    : v(inputs, width),
      q1(inputs + num_actions, width),
      q2(inputs + num_actions, width),
      slow_q1(inputs + num_actions, width),
      slow_q2(inputs + num_actions, width) {
  register_module("v", v);
  register_module("q1", q1);
  register_module("q2", q2);
  register_module("slow_q1", slow_q1);
  register_module("slow_q2", slow_q2);
  follow(slow_q1, q1, 1.0);
  follow(slow_q2, q2, 1.0);
}

FittedNetsImpl::FittedNetsImpl(std::int64_t width)
    : v(num_inputs, width), slow_v(num_inputs, width) {
  register_module("v", v);
  register_module("slow_v", slow_v);
  follow(slow_v, v, 1.0);
}

void DangerNetsImpl::add_to(formats::Tensors& tensors, const std::string& prefix) const {
  v->add_to(tensors, prefix + "v.");
  q1->add_to(tensors, prefix + "q1.");
  q2->add_to(tensors, prefix + "q2.");
}

void follow(DangerNet& slow, const DangerNet& fast, double share) {
  const torch::NoGradGuard none;
  const auto to = slow->parameters();
  const auto from = fast->parameters();
  for (std::size_t i = 0; i < to.size(); ++i) {
    to[i].lerp_(from[i], share);
  }
}

PairInputs seen_as_pair(DangerNets& singles, const Tensor& inputs, const Tensor& h_at) {
  const torch::NoGradGuard none;
  const Tensor both = singles->v(inputs, h_at).view({-1, 2});
  const Tensor first_is_other = both.select(1, 0) < both.select(1, 1);
  const Tensor rows = inputs.view({-1, 2, num_inputs});
  const Tensor swapped = torch::where(first_is_other.view({-1, 1, 1}), rows.flip(1), rows);
  const Tensor higher = std::get<0>(both.max(1));
  const Tensor lower = std::get<0>(both.min(1));
  const Tensor scaled = learned_danger::pair_value_scale * torch::stack({higher, lower}, 1);
  return {.inputs = torch::cat({swapped.reshape({-1, 2 * num_inputs}), scaled}, 1),
          .v = higher,
          .share = (learned_danger::pair_share_slope * (lower - learned_danger::pair_counts_from))
                       .clamp(0.0, 1.0)};
}

double joint_value(DangerNets& singles, DangerNets pairs, const Tensor& inputs, const Tensor& h) {
  const torch::NoGradGuard none;
  const PairInputs seen = seen_as_pair(singles, inputs, h);
  return (seen.v + seen.share * pairs->v->added(seen.inputs)).item<double>();
}

std::vector<double> values_of(DangerNet& v, std::span<const learned_danger::SeenByNet> seen) {
  const auto n = static_cast<std::int64_t>(seen.size());
  Tensor inputs = torch::empty({n, num_inputs});
  Tensor h = torch::empty({n});
  for (std::int64_t i = 0; i < n; ++i) {
    const learned_danger::SeenByNet& one = seen[static_cast<std::size_t>(i)];
    std::copy(one.inputs.begin(), one.inputs.end(), inputs.data_ptr<float>() + i * num_inputs);
    h.data_ptr<float>()[i] = static_cast<float>(learned_danger::told(one.h));
  }
  const torch::NoGradGuard none;
  const Tensor values = v(inputs, h).contiguous();
  return {values.data_ptr<float>(), values.data_ptr<float>() + n};
}

}  // namespace saca::network_training
