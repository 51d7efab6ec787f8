#include "saca/lab/network_training/danger_samples.h"

#include <vector>

#include "saca/lab/network_training/danger_nets.h"

namespace saca::network_training {
namespace {

/// -1 where a mirror changes the sign.
std::vector<float> signs_of_inputs() {
  std::vector<float> signs(learned_danger::num_net_inputs, 1.0F);
  for (const std::size_t i : learned_danger::mirrored_inputs()) {
    signs[i] = -1.0F;
  }
  return signs;
}

/// A row of numbers that the networks see.
void copy_inputs(const std::vector<float>& rows, std::size_t row, bool is_mirrored, float* to) {
  static const std::vector<float> signs = signs_of_inputs();
  const float* const numbers = &rows[row * learned_danger::num_net_inputs];
  for (std::size_t j = 0; j < learned_danger::num_net_inputs; ++j) {
    to[j] = is_mirrored ? signs[j] * numbers[j] : numbers[j];
  }
}

}  // namespace

using learned_danger::Experience;
using torch::Tensor;

TransitionSample drawn(const Experience& all, int count, std::mt19937_64& random) {
  const auto n = static_cast<std::int64_t>(count);
  const auto rows = n * static_cast<std::int64_t>(all.num_obstacles);
  TransitionSample sample{.inputs = torch::empty({rows, num_inputs}),
                          .next_inputs = torch::empty({rows, num_inputs}),
                          .actions = torch::empty({n, num_actions}),
                          .h_at = torch::empty({rows}),
                          .next_h_at = torch::empty({rows}),
                          .h = torch::empty({n}),
                          .settled = torch::empty({n}),
                          .reached = torch::empty({n})};
  const auto at = [](Tensor& tensor) { return tensor.data_ptr<float>(); };
  std::uniform_int_distribution<std::size_t> any(0, all.size() - 1);
  std::int64_t to = 0;
  for (std::int64_t k = 0; k < n; ++k) {
    const std::size_t i = any(random);
    const bool is_mirrored = k % 2 == 1;
    std::size_t from = all.row[i] * all.num_obstacles;
    std::size_t next = all.next_row[i] * all.num_obstacles;
    for (std::size_t one = 0; one < all.num_obstacles; ++one, ++from, ++next, ++to) {
      copy_inputs(all.inputs, from, is_mirrored, at(sample.inputs) + to * num_inputs);
      copy_inputs(all.inputs, next, is_mirrored, at(sample.next_inputs) + to * num_inputs);
      at(sample.h_at)[to] = all.h_at[from];
      at(sample.next_h_at)[to] = all.h_at[next];
    }
    at(sample.actions)[2 * k] = all.actions[2 * i];
    at(sample.actions)[2 * k + 1] = (is_mirrored ? -1.0F : 1.0F) * all.actions[2 * i + 1];
    at(sample.h)[k] = all.h[i];
    at(sample.settled)[k] = all.settled[i];
    at(sample.reached)[k] = all.reached[i];
  }
  return sample;
}

OutcomeSample drawn(const learned_danger::Outcomes& all, int count, std::mt19937_64& random) {
  const auto n = static_cast<std::int64_t>(count);
  const auto num_outcomes = n * static_cast<std::int64_t>(all.num_inputs);
  OutcomeSample sample{.inputs = torch::empty({n, num_inputs}),
                       .h_at = torch::empty({n}),
                       .next_inputs = torch::empty({num_outcomes, num_inputs}),
                       .next_h_at = torch::empty({num_outcomes}),
                       .h = torch::empty({num_outcomes}),
                       .settled = torch::empty({num_outcomes})};
  const auto at = [](Tensor& tensor) { return tensor.data_ptr<float>(); };
  std::uniform_int_distribution<std::size_t> any(0, all.num_states() - 1);
  std::int64_t to = 0;
  for (std::int64_t k = 0; k < n; ++k) {
    const std::size_t row = any(random);
    const bool is_mirrored = k % 2 == 1;
    copy_inputs(all.states, row, is_mirrored, at(sample.inputs) + k * num_inputs);
    at(sample.h_at)[k] = all.h_at[row];
    for (std::size_t i = row * all.num_inputs; i < (row + 1) * all.num_inputs; ++i, ++to) {
      copy_inputs(all.next_states, i, is_mirrored, at(sample.next_inputs) + to * num_inputs);
      at(sample.next_h_at)[to] = all.next_h[i];
      at(sample.h)[to] = all.h[i];
      at(sample.settled)[to] = all.settled[i];
    }
  }
  return sample;
}

}  // namespace saca::network_training
