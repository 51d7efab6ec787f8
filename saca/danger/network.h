#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "saca/config/tensors.h"
#include "saca/core/result.h"
#include "saca/danger/net_inputs.h"
#include "saca/manoeuvre/demand.h"

namespace saca::danger {

/// V_h and Q_h of the ego beside one obstacle, learnt: rectified layers, each of whose outputs is
/// what it adds to h, so that no value lies below h.
class Network {
 public:
  static constexpr std::size_t width = 96;    ///< of each of the three hidden layers
  static constexpr std::size_t at_once = 32;  ///< are worked out side by side

  /// From the tensors of saca-train-danger: `v.0.weight` (width x num_net_inputs), `v.0.bias`, ...,
  /// `v.3.weight` (1 x width), `v.3.bias`, and `q1` and `q2`, whose inputs are two more.
  /// @return  Error::Code::malformed, as config::take
  [[nodiscard]] static Result<Network> from(const config::Tensors& tensors,
                                            std::string_view source);

  /// V_h of each [m], as told (net_inputs.h). Allocates nothing.
  /// @param v  as many
  void values(std::span<const SeenByNet> seen, std::span<double> v) const;

  /// Q_h of each demand [m]: of two networks the larger. Allocates nothing.
  /// @param demands  admissible
  /// @param q        as many
  void values_of(const SeenByNet& seen, std::span<const manoeuvre::Demand> demands,
                 std::span<double> q) const;

  /// Names the weights.
  [[nodiscard]] std::uint64_t digest() const;

  /// What the file says of itself: car, transitions, drives, seed, ...
  [[nodiscard]] const std::map<std::string, std::string>& words() const { return words_; }

 private:
  struct Layer {
    std::size_t rows = 0;
    std::size_t columns = 0;
    std::vector<float> weight;  ///< [row][column]
    std::vector<float> bias;
  };
  using Layers = std::array<Layer, 4>;

  [[nodiscard]] static Result<Layers> layers_from(const config::Tensors& tensors,
                                                  const std::string& prefix, std::size_t inputs,
                                                  std::string_view source);
  /// Columns of `inputs` to one number each.
  static void run(const Layers& layers, const float* inputs, std::size_t count, float* out);

  Layers v_;
  std::array<Layers, 2> q_;
  std::map<std::string, std::string> words_;
};

}  // namespace saca::danger
