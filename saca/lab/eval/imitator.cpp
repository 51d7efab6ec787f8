#include "saca/lab/eval/imitator.h"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "saca/base/core/contract.h"
#include "saca/base/core/fnv.h"
#include "saca/onboard/collision/ordering.h"
#include "saca/onboard/match/similarity.h"

namespace saca::eval {
namespace {

using manoeuvre::num_policies;
using manoeuvre::PolicyId;

// Of the ego's inputs, in their order: which change their sign in the mirror, which change places.
constexpr std::array<std::size_t, 5> signed_of_ego{1, 2, 3, 4, 7};
constexpr std::array<std::array<std::size_t, 2>, 3> sides_of_ego{{{8, 9}, {10, 11}, {12, 13}}};
// Of an actor's inputs likewise.
constexpr std::array<std::size_t, 4> signed_of_actor{2, 4, 5, 7};

/// Writes numbers one after the other.
class Writer {
 public:
  explicit Writer(float* next) : next_(next) {}
  void add(double number) { *next_++ = static_cast<float>(number); }
  void add(bool is_so) { add(is_so ? 1.0 : 0.0); }

 private:
  float* next_;
};

// Divisors are what these numbers usually are, so that all are near 1.
void write_ego(const match::EgoFeatures& ego, float* to) {
  Writer out(to);
  out.add(ego.v_L.x / 20.0);
  out.add(ego.v_L.y / 2.0);
  out.add(ego.offset);
  out.add(ego.heading / 0.2);
  out.add(ego.yaw_rate / 0.3);
  out.add(ego.log_grip / 0.5);
  out.add(ego.lane_width / 3.5 - 1.0);
  out.add(ego.curve / 3.0);
  out.add(ego.to_left_edge / 6.0);
  out.add(ego.to_right_edge / 6.0);
  out.add(world::is_hard(ego.left_beyond));
  out.add(world::is_hard(ego.right_beyond));
  out.add(ego.oncoming_left);
  out.add(ego.oncoming_right);
}

void write_actor(const match::ActorFeatures& actor, float* to) {
  using world::ActorKind;
  Writer out(to);
  out.add(1.0);
  out.add(actor.p_rel_L.x / 30.0);
  out.add(actor.p_rel_L.y / 5.0);
  out.add(actor.v_rel_L.x / 15.0);
  out.add(actor.v_rel_L.y / 5.0);
  out.add(actor.sideways / 2.0);
  out.add(actor.forward_L.x);
  out.add(actor.forward_L.y);
  out.add(actor.length / 5.0);
  out.add(actor.width / 2.0);
  out.add(actor.threat / 4.0);
  const ActorKind kind = actor.kind;
  out.add(kind == ActorKind::car || kind == ActorKind::van || kind == ActorKind::truck);
  out.add(kind == ActorKind::motorcycle || kind == ActorKind::bicycle);
  out.add(kind == ActorKind::pedestrian);
  out.add(kind == ActorKind::obstacle);
}

}  // namespace

ImitatorInputs imitator_inputs(const world::Scene& scene) {
  const match::Features features = match::features(scene);
  expects(features.ego.usable, "a scene that breaks no rule");
  ImitatorInputs inputs{};
  write_ego(features.ego, inputs.data());
  std::vector<std::size_t> order(features.actors.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  // Many threaten as much as anybody can; then the nearer ones count, by nothing that the mirror
  // or the order in the scene changes.
  const auto rank = [&](std::size_t i) {
    const match::ActorFeatures& one = features.actors[i];
    return std::tuple(-one.threat, norm(one.p_rel_L), std::abs(one.p_rel_L.y), norm(one.v_rel_L),
                      one.kind);
  };
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return rank(a) < rank(b); });
  for (std::size_t k = 0; k < std::min(order.size(), num_seen_actors); ++k) {
    write_actor(features.actors[order[k]], &inputs[num_ego_inputs + k * num_actor_inputs]);
  }
  return inputs;
}

ImitatorInputs mirrored(ImitatorInputs inputs) {
  for (const std::size_t i : signed_of_ego) {
    inputs[i] = -inputs[i];
  }
  for (const auto& [left, right] : sides_of_ego) {
    std::swap(inputs[left], inputs[right]);
  }
  for (std::size_t k = 0; k < num_seen_actors; ++k) {
    for (const std::size_t i : signed_of_actor) {
      float& input = inputs[num_ego_inputs + k * num_actor_inputs + i];
      input = -input;
    }
  }
  return inputs;
}

PolicyId mirrored(PolicyId policy) {
  // Left is odd, right the next.
  return manoeuvre::policy_from(static_cast<int>(policy) + manoeuvre::side(policy)).value();
}

Result<Imitator> Imitator::from(const formats::Tensors& tensors, std::string_view source) {
  Imitator imitator;
  for (std::size_t k = 0; k < imitator.layers_.size(); ++k) {
    auto layer = formats::take_layer(tensors, std::to_string(k),
                                     k + 1 < imitator.layers_.size() ? width : num_policies,
                                     k > 0 ? width : num_imitator_inputs, source);
    if (!layer.has_value()) {
      return layer.error();
    }
    imitator.layers_[k] = std::move(layer).value();
  }
  return imitator;
}

Result<Imitator> Imitator::read(const std::filesystem::path& file) {
  const auto tensors = formats::read_tensor_file(file);
  return tensors.has_value() ? from(tensors.value(), file.string()) : tensors.error();
}

std::array<double, num_policies> Imitator::scores(const ImitatorInputs& inputs) const {
  using Weights =
      Eigen::Map<const Eigen::Matrix<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>>;
  Eigen::VectorXf x = Eigen::Map<const Eigen::VectorXf>(inputs.data(), num_imitator_inputs);
  for (std::size_t k = 0; k < layers_.size(); ++k) {
    const formats::Layer& layer = layers_[k];
    const auto rows = static_cast<Eigen::Index>(layer.rows);
    const Eigen::VectorXf y =
        Weights(layer.weight.data(), rows, static_cast<Eigen::Index>(layer.columns)) * x +
        Eigen::Map<const Eigen::VectorXf>(layer.bias.data(), rows);
    x = k + 1 < layers_.size() ? Eigen::VectorXf(y.cwiseMax(0.0F)) : y;
  }
  std::array<double, num_policies> scores{};
  std::copy(x.data(), x.data() + num_policies, scores.begin());
  return scores;
}

std::array<double, num_policies> Imitator::probabilities(const world::Scene& scene) const {
  const ImitatorInputs inputs = imitator_inputs(scene);
  const auto seen = scores(inputs);
  const auto in_mirror = scores(mirrored(inputs));
  std::array<double, num_policies> p{};
  for (const PolicyId policy : manoeuvre::all_policies) {
    const std::size_t k = manoeuvre::index(policy);
    p[k] = 0.5 * (seen[k] + in_mirror[manoeuvre::index(mirrored(policy))]);
  }
  const double highest = *std::max_element(p.begin(), p.end());
  double sum = 0.0;
  for (double& one : p) {
    one = std::exp(one - highest);
    sum += one;
  }
  for (double& one : p) {
    one /= sum;
  }
  return p;
}

PolicyId Imitator::choice(const world::Scene& scene) const {
  const auto p = probabilities(scene);
  return *std::max_element(manoeuvre::all_policies.begin(), manoeuvre::all_policies.end(),
                           [&](PolicyId a, PolicyId b) {
                             const double of_a = p[manoeuvre::index(a)];
                             const double of_b = p[manoeuvre::index(b)];
                             return of_a < of_b || (of_a == of_b && collision::milder(b, a));
                           });
}

std::uint64_t Imitator::digest() const {
  Fnv hash;
  for (const formats::Layer& layer : layers_) {
    layer.add_to(hash);
  }
  return hash.value();
}

}  // namespace saca::eval
