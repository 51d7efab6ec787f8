#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string_view>
#include <vector>

#include "saca/base/core/result.h"
#include "saca/base/core/vec2.h"
#include "saca/base/formats/tensors.h"
#include "saca/base/world/road.h"
#include "saca/base/world/scene.h"
#include "saca/lab/eval/likely_places.h"
#include "saca/thinking/intent/features.h"
#include "saca/thinking/intent/network.h"

namespace saca::eval {

/// The line that a moving road user is predicted along: through its place in its direction of
/// travel, with the curvature of the lane that it follows; straight where it follows none. Places
/// against it are s ahead and d to the left of where the road user is (world::to_lane).
/// @throws ContractViolation  if it is slower than intent::rest_speed
[[nodiscard]] world::Road travel_line(const world::Scene& scene, const world::Actor& actor);

/// Is it predicted by what was learnt? A vehicle that moves.
[[nodiscard]] bool is_learnt_of(const world::Actor& actor);

/// What was learnt of where vehicles go: an LSTM over what is seen of one (intent/features.h) whose
/// output is a mixture of normal laws at each of forecast_times, a mixture density network.
///
/// It looks at the world and at its mirror image, and each side gives three of the six ways, those
/// of the mirror with left and right exchanged: exactly symmetric. Way k of a side has the outputs
/// 17 k + (0: its weight, as a softmax over all six; then for each time i, 1 + 4 i +: mean
/// acceleration along [3 m/s^2], mean speed to the left [m/s], logarithms of how fast the standard
/// deviations along and across grow [m/s]). After a time t at a speed v it is at
///
///   s = v t + 3 a t^2 / 2,  d = c t,  sd = 0.1 m + exp(l) t,  l in [-5, 3].
///
/// Sources: C. Bishop, Mixture density networks, Aston University NCRG/94/004, 1994; as a baseline
/// of motion prediction: Deo, Trivedi, Multi-modal trajectory prediction of surrounding vehicles
/// with maneuver based LSTMs, IEEE Intelligent Vehicles Symposium 2018.
struct MixtureModel {
  static constexpr std::size_t ways_per_side = 3;
  static constexpr std::size_t outputs_per_time = 4;
  static constexpr std::size_t outputs_per_way = 1 + outputs_per_time * forecast_times.size();
  static constexpr std::size_t outputs_per_side = ways_per_side * outputs_per_way;
  static constexpr double acceleration_unit = 3.0;  ///< [m/s^2]
  static constexpr double least_sd = 0.1;           ///< [m]
  static constexpr double least_log_growth = -5.0;
  static constexpr double largest_log_growth = 3.0;

  using Outputs = std::array<std::array<double, outputs_per_side>, 2>;  ///< world, mirror

  intent::Encoder encoder;
  std::vector<float> weight;  ///< of the output layer (outputs_per_side x 2 Encoder::width)
  std::vector<float> bias;

  /// From the tensors of intent::Encoder, "output.weight" and "output.bias".
  /// @return  Error::Code::malformed, as formats::take
  [[nodiscard]] static Result<MixtureModel> from(const formats::Tensors& tensors,
                                                 std::string_view source);
  /// @return  as read_file and from
  [[nodiscard]] static Result<MixtureModel> read(const std::filesystem::path& path);

  /// One step of a road user that is watched at intent::look_step.
  [[nodiscard]] Outputs step(const intent::Features& features, intent::Encoder::State& state) const;
};

/// What outputs say of who moves so fast along a line [m/s]; probabilities sum to 1.
[[nodiscard]] LikelyPlaces places_of(const MixtureModel::Outputs& outputs, double speed,
                                     const world::Road& line);

/// Watches a drive and predicts vehicles by a MixtureModel, everybody else by going_straight. Who
/// has not been seen for 2 s is forgotten.
class MixturePredictor {
 public:
  /// @param model  outlives it
  explicit MixturePredictor(const MixtureModel& model) : model_(&model) {}

  /// Call it at every look; every 0.1 s one counts.
  void look(const world::Scene& scene);
  /// Where an actor of the last scene will be.
  [[nodiscard]] LikelyPlaces places_of(const world::Scene& scene, const world::Actor& actor) const;

 private:
  struct RoadUser {
    world::ActorKind kind = world::ActorKind::car;
    std::uint8_t id = 0;
    double seen = 0.0;  ///< [s]
    intent::ObservationHistory memory;
    intent::Encoder::State state;
    MixtureModel::Outputs outputs{};
  };

  const MixtureModel* model_;
  std::vector<RoadUser> watched_;
  double due_ = 0.0;  ///< the next look that counts [s]
};

}  // namespace saca::eval
