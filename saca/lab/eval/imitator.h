#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <string>
#include <string_view>

#include "saca/base/core/result.h"
#include "saca/base/formats/tensors.h"
#include "saca/base/world/scene.h"
#include "saca/onboard/manoeuvre/plan.h"

namespace saca::eval {

// What a network is shown that imitates choices: numbers near 1, seen from the ego along its lane.
constexpr std::size_t num_ego_inputs = 14;
constexpr std::size_t num_seen_actors = 4;
constexpr std::size_t num_actor_inputs = 15;
constexpr std::size_t num_imitator_inputs = num_ego_inputs + num_seen_actors * num_actor_inputs;
using ImitatorInputs = std::array<float, num_imitator_inputs>;

/// The ego and its road, and the four actors that threaten most (match::Features), zeros where
/// there are fewer.
/// @param scene  breaks no rule of `world::broken_rule`
[[nodiscard]] ImitatorInputs imitator_inputs(const world::Scene& scene);

/// The same scene in the mirror, left and right exchanged; and the policy that is chosen there.
[[nodiscard]] ImitatorInputs mirrored(ImitatorInputs inputs);
[[nodiscard]] manoeuvre::PolicyId mirrored(manoeuvre::PolicyId policy);

/// Behaviour cloning, the paper's baseline "imitation learning": a network of rectified layers that
/// was shown scenes at the trigger and the policy that was best in hindsight, and says for another
/// scene which policy would have been. It forecasts nothing and knows no physics. What it says of a
/// scene is what it says of its mirror image, exactly: the mean over both.
class Imitator {
 public:
  static constexpr std::size_t width = 64;  ///< of each of the two hidden layers

  /// From the tensors of saca-train-imitator: `0.weight` (width x num_imitator_inputs), `0.bias`,
  /// `1.weight`, `1.bias`, `2.weight` (8 x width), `2.bias`.
  /// @return  Error::Code::malformed, as formats::take
  [[nodiscard]] static Result<Imitator> from(const formats::Tensors& tensors,
                                             std::string_view source);

  /// Of a file.
  /// @return  likewise, or as formats::read_tensor_file
  [[nodiscard]] static Result<Imitator> read(const std::filesystem::path& file);

  /// How likely each policy was the best, by PolicyId; they sum to 1.
  /// @param scene  breaks no rule of `world::broken_rule`
  [[nodiscard]] std::array<double, manoeuvre::num_policies> probabilities(
      const world::Scene& scene) const;

  /// The likeliest; of equals the mildest, then the first.
  [[nodiscard]] manoeuvre::PolicyId choice(const world::Scene& scene) const;

  /// Names the weights.
  [[nodiscard]] std::uint64_t digest() const;

 private:
  [[nodiscard]] std::array<double, manoeuvre::num_policies> scores(
      const ImitatorInputs& inputs) const;

  std::array<formats::Layer, 3> layers_;
};

/// Networks that were shown different choices, by the name of the method that asks them.
using Imitators = std::map<std::string, Imitator, std::less<>>;

}  // namespace saca::eval
