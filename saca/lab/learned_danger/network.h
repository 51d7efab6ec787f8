#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "saca/base/core/result.h"
#include "saca/base/formats/tensors.h"
#include "saca/lab/learned_danger/net_inputs.h"
#include "saca/onboard/manoeuvre/demand.h"

namespace saca::learned_danger {

/// V_h and Q_h of the ego, learnt: rectified layers. Beside one obstacle each output is what it
/// adds to h, so that no value lies below h; beside two, what it adds to the higher of both values:
/// what evades one may lead to the other. Beside three the pair counts whose value is highest.
class Network {
 public:
  static constexpr std::size_t width = 96;    ///< of each of the three hidden layers
  static constexpr std::size_t at_once = 32;  ///< are worked out side by side
  static constexpr std::size_t most_demands = 64;

  /// From the tensors of saca-train-danger: `v.0.weight` (width x num_net_inputs), `v.0.bias`, ...,
  /// `v.3.weight` (1 x width), `v.3.bias`, and `q1` and `q2`, whose inputs are two more. Of pairs
  /// likewise `pair_v`, `pair_q1` and `pair_q2`, from num_pair_inputs on; without them two
  /// obstacles are as dangerous as the more dangerous one.
  /// Where there is a word `digest`, it must be that of the weights.
  /// @return  Error::Code::malformed, as formats::take
  [[nodiscard]] static Result<Network> from(const formats::Tensors& tensors,
                                            std::string_view source);

  /// V_h of each by itself [m], as told (net_inputs.h). Allocates nothing.
  /// @param v  as many
  void values(std::span<const SeenByNet> seen, std::span<double> v) const;

  /// V_h beside all [m]. Allocates nothing.
  /// @param seen  one to most_obstacles, in any order
  [[nodiscard]] double joint_value(std::span<const SeenByNet> seen) const;

  /// Q_h of each demand beside all [m]: of two networks the larger. Allocates nothing.
  /// @param seen     one to most_obstacles, in any order
  /// @param demands  admissible
  /// @param q        as many
  void joint_values_of(std::span<const SeenByNet> seen, std::span<const manoeuvre::Demand> demands,
                       std::span<double> q) const;

  /// Whether it has learnt what two obstacles add to V.
  [[nodiscard]] bool knows_pairs() const { return pair_v_.has_value(); }

  /// Names the weights.
  [[nodiscard]] std::uint64_t digest() const;

  /// What the file says of itself: car, transitions, drives, seed, ...
  [[nodiscard]] const std::map<std::string, std::string>& words() const { return words_; }

 private:
  using Layers = std::array<formats::Layer, 4>;
  using TwoQ = std::array<Layers, 2>;

  [[nodiscard]] static Result<Layers> layers_from(const formats::Tensors& tensors,
                                                  const std::string& prefix, std::size_t inputs,
                                                  std::string_view source);
  [[nodiscard]] static Result<TwoQ> two_q_from(const formats::Tensors& tensors,
                                               const std::string& prefix, std::size_t inputs,
                                               std::string_view source);
  /// Two obstacles, that one first whose V_h is higher.
  struct Pair {
    std::size_t one = 0, other = 0;
    double value = 0.0;  ///< the higher V_h [m]
    double share = 0.0;  ///< pair_share
    std::array<float, num_pair_inputs> inputs{};
  };
  template <class Use>
  void for_pairs(std::span<const SeenByNet> seen, const std::array<double, most_obstacles>& v,
                 const Use& use) const;
  /// Columns of `inputs` to one number each, what they add [m].
  static void run(const Layers& layers, const float* inputs, std::size_t count, float* out);
  /// What each demand adds, of the larger of two: all columns begin with the same numbers.
  static void run_q(const TwoQ& q, std::span<const float> inputs,
                    std::span<const manoeuvre::Demand> demands, float* out);

  Layers v_;
  TwoQ q_;
  std::optional<Layers> pair_v_;
  std::optional<TwoQ> pair_q_;
  std::map<std::string, std::string> words_;
};

}  // namespace saca::learned_danger
