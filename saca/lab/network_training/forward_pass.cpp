#include "saca/lab/network_training/forward_pass.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <functional>

#include "saca/base/core/contract.h"
#include "saca/thinking/intent/crf.h"

namespace saca::network_training {
namespace {

using intent::num_classes;
constexpr auto row_size = static_cast<std::int64_t>(num_classes);
constexpr float least_sum = 1e-30F;  // no path: its logarithm stays finite, as gradients must

using Row = std::array<float, num_classes>;
using Square = std::array<Row, num_classes>;

torch::Tensor plain_floats(const torch::Tensor& tensor) {
  return tensor.to(torch::kFloat32).contiguous();
}

/// exp of the transitions of chain h.
Square factors_of(const torch::Tensor& transition, std::int64_t h) {
  const float* from = transition.data_ptr<float>() + h * row_size * row_size;
  Square factors;
  for (Row& row : factors) {
    for (float& factor : row) {
      factor = std::exp(*from++);
    }
  }
  return factors;
}

/// What of each path comes from where, up to a common factor, and the sums by class.
struct Step {
  Row before{};  ///< exp(a_{t-1} - their largest)
  float largest = 0.0F;
  Row sums{};  ///< over the classes before
};

Step step_from(const float* last, const Square& factors) {
  Step step;
  step.largest = *std::max_element(last, last + num_classes);
  for (std::size_t j = 0; j < num_classes; ++j) {
    step.before[j] = std::exp(last[j] - step.largest);
  }
  step.sums.fill(least_sum);
  for (std::size_t j = 0; j < num_classes; ++j) {
    for (std::size_t k = 0; k < num_classes; ++k) {
      step.sums[k] += step.before[j] * factors[j][k];
    }
  }
  return step;
}

/// Where the numbers of chain h at a frame of a sequence begin.
struct Places {
  std::int64_t num_frames = 0;
  std::int64_t num_chains = 0;
  [[nodiscard]] std::int64_t operator()(std::int64_t b, std::int64_t t, std::int64_t h) const {
    return ((b * num_frames + t) * num_chains + h) * row_size;
  }
};

torch::Tensor scores_of(const torch::Tensor& emissions, const torch::Tensor& start,
                        const torch::Tensor& transition, const torch::Tensor& present) {
  const Places at{emissions.size(1), emissions.size(2)};
  torch::Tensor scores = torch::empty_like(emissions);
  const auto* e = emissions.data_ptr<float>();
  const auto* begin = start.data_ptr<float>();
  const auto* is_present = present.data_ptr<bool>();
  auto* a = scores.data_ptr<float>();
  for (std::int64_t h = 0; h < at.num_chains; ++h) {
    const Square factors = factors_of(transition, h);
    for (std::int64_t b = 0; b < emissions.size(0); ++b) {
      for (std::int64_t k = 0; k < row_size; ++k) {
        a[at(b, 0, h) + k] = begin[h * row_size + k] + e[at(b, 0, h) + k];
      }
      for (std::int64_t t = 1; t < at.num_frames; ++t) {
        const float* last = a + at(b, t - 1, h);
        float* now = a + at(b, t, h);
        if (!is_present[b * at.num_frames + t]) {
          std::copy_n(last, num_classes, now);
          continue;
        }
        const Step step = step_from(last, factors);
        for (std::size_t k = 0; k < num_classes; ++k) {
          now[k] =
              std::log(step.sums[k]) + step.largest + e[at(b, t, h) + static_cast<std::int64_t>(k)];
        }
      }
    }
  }
  return scores;
}

/// Derivatives go one frame back.
/// @param scores    a_{t-1}
/// @param now       of a_t
/// @param last      of a_{t-1}, to which they are added
/// @param of_links  likewise of the transitions
void step_back(const float* scores, const Square& factors, const float* now, float* last,
               Square& of_links) {
  const Step step = step_from(scores, factors);
  Row share;
  for (std::size_t k = 0; k < num_classes; ++k) {
    share[k] = now[k] / step.sums[k];
  }
  for (std::size_t j = 0; j < num_classes; ++j) {
    float sum = 0.0F;
    for (std::size_t k = 0; k < num_classes; ++k) {
      const float part = step.before[j] * factors[j][k] * share[k];
      of_links[j][k] += part;
      sum += part;
    }
    last[j] += sum;
  }
}

class ForwardPass : public torch::autograd::Function<ForwardPass> {
 public:
  static torch::Tensor forward(torch::autograd::AutogradContext* context,
                               const torch::Tensor& emissions, const torch::Tensor& start,
                               const torch::Tensor& transition, const torch::Tensor& present) {
    const torch::Tensor links = plain_floats(transition);
    const torch::Tensor here = present.contiguous();
    torch::Tensor scores = scores_of(plain_floats(emissions), plain_floats(start), links, here);
    context->save_for_backward({links, here, scores});
    return scores;
  }

  static torch::autograd::tensor_list backward(torch::autograd::AutogradContext* context,
                                               const torch::autograd::tensor_list& gradients) {
    const auto saved = context->get_saved_variables();
    const torch::Tensor& transition = saved[0];
    const torch::Tensor& present = saved[1];
    const torch::Tensor& scores = saved[2];
    const Places at{scores.size(1), scores.size(2)};
    torch::Tensor of_scores = gradients[0].to(torch::kFloat32).contiguous().clone();
    torch::Tensor of_emissions = torch::zeros_like(scores);
    torch::Tensor of_start = torch::zeros({at.num_chains, row_size});
    torch::Tensor of_transition = torch::zeros_like(transition);
    auto* g = of_scores.data_ptr<float>();
    auto* of_e = of_emissions.data_ptr<float>();
    auto* of_begin = of_start.data_ptr<float>();
    auto* of_link = of_transition.data_ptr<float>();
    const auto* a = scores.data_ptr<float>();
    const auto* is_present = present.data_ptr<bool>();
    for (std::int64_t h = 0; h < at.num_chains; ++h) {
      const Square factors = factors_of(transition, h);
      Square of_links{};
      for (std::int64_t b = 0; b < scores.size(0); ++b) {
        for (std::int64_t t = at.num_frames - 1; t > 0; --t) {
          const float* now = g + at(b, t, h);
          float* last = g + at(b, t - 1, h);
          if (!is_present[b * at.num_frames + t]) {
            std::transform(now, now + num_classes, last, last, std::plus<>());
            continue;
          }
          std::copy_n(now, num_classes, of_e + at(b, t, h));
          step_back(a + at(b, t - 1, h), factors, now, last, of_links);
        }
        for (std::int64_t k = 0; k < row_size; ++k) {
          const float first = g[at(b, 0, h) + k];
          of_e[at(b, 0, h) + k] = first;
          of_begin[h * row_size + k] += first;
        }
      }
      for (const Row& row : of_links) {
        of_link = std::copy(row.begin(), row.end(), of_link);
      }
    }
    return {of_emissions, of_start, of_transition, torch::Tensor()};
  }
};

}  // namespace

torch::Tensor forward_pass(const torch::Tensor& emissions, const torch::Tensor& start,
                           const torch::Tensor& transition, const torch::Tensor& present) {
  expects(emissions.dim() == 4 && emissions.size(1) > 0 && emissions.size(3) == row_size,
          "emissions of frames, chains and classes");
  const std::int64_t chains = emissions.size(2);
  expects(start.sizes() == at::IntArrayRef({chains, row_size}), "start (chains x classes)");
  expects(transition.sizes() == at::IntArrayRef({chains, row_size, row_size}),
          "transition (chains x classes x classes)");
  expects(present.sizes() == at::IntArrayRef({emissions.size(0), emissions.size(1)}) &&
              present.scalar_type() == torch::kBool,
          "present (sequences x frames), bool");
  return ForwardPass::apply(emissions, start, transition, present);
}

}  // namespace saca::network_training
