#pragma once

#include <torch/torch.h>

namespace saca::network_training {

/// The forward pass of linear chains, with its derivatives: log of the sum over all paths up to
/// each frame, by their last class,
///
///   a_0(k) = start(k) + e_0(k)
///   a_t(k) = log sum_j exp(a_{t-1}(j) + transition(j, k)) + e_t(k)
///
/// where nothing is present it stays. log_softmax of a_t is what a stream is told at frame t, and
/// logsumexp of the last a_t the logarithm of the partition function.
///
/// @param emissions   e   (B sequences x T frames x H chains x K classes)
/// @param start       (H x K)
/// @param transition  from x to; -1e4 or less: forbidden   (H x K x K)
/// @param present     bool; true at the first frame   (B x T)
/// @return            a, single precision   (B x T x H x K)
/// @throws ContractViolation  if the shapes do not fit together
///
/// The derivatives are written by hand, one loop over the frames back: as T small tensor operations
/// the same takes most of a training. O(B T H K^2).
/// Source: Sutton, McCallum, An introduction to conditional random fields, Foundations and Trends
/// in Machine Learning 4 (2012), chapter 4.
[[nodiscard]] torch::Tensor forward_pass(const torch::Tensor& emissions, const torch::Tensor& start,
                                         const torch::Tensor& transition,
                                         const torch::Tensor& present);

}  // namespace saca::network_training
