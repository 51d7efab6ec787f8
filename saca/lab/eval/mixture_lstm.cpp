#include "saca/lab/eval/mixture_lstm.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "saca/thinking/intent/line.h"
#include "saca/thinking/intent/observed.h"
#include "saca/thinking/intent/vru.h"

namespace saca::eval {
namespace {

using world::Actor;
using world::Scene;

constexpr std::size_t encoded = 2 * intent::Encoder::width;
constexpr double look_rounding = 1e-6;       // [s]: times are sums of steps
constexpr double forgotten_after_gap = 2.0;  // [s]

}  // namespace

world::Road travel_line(const Scene& scene, const Actor& actor) {
  intent::Line line = intent::line_of(scene, actor);
  if (!line.along_lane) {
    line.road.curvature = 0.0;
  }
  return line.road;
}

bool is_learnt_of(const Actor& actor) {
  return actor.kind != world::ActorKind::obstacle && !intent::is_vru(actor.kind) &&
         norm(actor.v_W) >= intent::rest_speed;
}

Result<MixtureModel> MixtureModel::from(const formats::Tensors& tensors, std::string_view source) {
  auto encoder = intent::Encoder::from(tensors, "", source);
  if (!encoder.has_value()) {
    return encoder.error();
  }
  auto taken = formats::take_layer(tensors, "output", outputs_per_side, encoded, source);
  if (!taken.has_value()) {
    return taken.error();
  }
  formats::Layer output = std::move(taken).value();
  return MixtureModel{std::move(encoder).value(), std::move(output.weight), std::move(output.bias)};
}

Result<MixtureModel> MixtureModel::read(const std::filesystem::path& path) {
  const auto tensors = formats::read_tensor_file(path);
  return tensors.has_value() ? from(tensors.value(), path.string())
                             : Result<MixtureModel>(tensors.error());
}

MixtureModel::Outputs MixtureModel::step(const intent::Features& features,
                                         intent::Encoder::State& state) const {
  const intent::Encoder::Encoded in = encoder.step(features, state);
  Outputs out;
  for (std::size_t side = 0; side < out.size(); ++side) {
    for (std::size_t row = 0; row < outputs_per_side; ++row) {
      double sum = static_cast<double>(bias[row]);
      for (std::size_t column = 0; column < encoded; ++column) {
        sum += static_cast<double>(weight[row * encoded + column]) *
               static_cast<double>(in[side][column]);
      }
      out[side][row] = sum;
    }
  }
  return out;
}

LikelyPlaces places_of(const MixtureModel::Outputs& outputs, double speed,
                       const world::Road& line) {
  const auto weight_of = [&](std::size_t side, std::size_t way) {
    return outputs[side][way * MixtureModel::outputs_per_way];
  };
  double largest = weight_of(0, 0);
  for (std::size_t side = 0; side < outputs.size(); ++side) {
    for (std::size_t way = 0; way < MixtureModel::ways_per_side; ++way) {
      largest = std::max(largest, weight_of(side, way));
    }
  }
  double sum = 0.0;
  LikelyPlaces places;
  for (std::size_t side = 0; side < outputs.size(); ++side) {
    const double left = side == 0 ? 1.0 : -1.0;
    for (std::size_t way = 0; way < MixtureModel::ways_per_side; ++way) {
      const double weight = std::exp(weight_of(side, way) - largest);
      sum += weight;
      for (std::size_t i = 0; i < forecast_times.size(); ++i) {
        const double t = forecast_times[i];
        const double* const at = &outputs[side][way * MixtureModel::outputs_per_way + 1 +
                                                i * MixtureModel::outputs_per_time];
        const auto sd = [t](double log_growth) {
          return MixtureModel::least_sd +
                 t * std::exp(std::clamp(log_growth, MixtureModel::least_log_growth,
                                         MixtureModel::largest_log_growth));
        };
        const Pose X_WL = world::from_lane(
            line, {.s = speed * t + 0.5 * MixtureModel::acceleration_unit * at[0] * t * t,
                   .d = left * at[1] * t});
        places[i].push_back({.probability = weight,
                             .p_W = X_WL.p,
                             .course = X_WL.yaw,
                             .spread = {sd(at[2]), sd(at[3])}});
      }
    }
  }
  for (auto& at : places) {
    for (LikelyPlace& one : at) {
      one.probability /= sum;
    }
  }
  return places;
}

void MixturePredictor::look(const Scene& scene) {
  if (scene.time < due_ - look_rounding) {
    return;
  }
  due_ = scene.time + intent::look_step;
  for (std::size_t i = 0; i < scene.actors.size(); ++i) {
    const Actor& actor = scene.actors[i];
    if (actor.kind == world::ActorKind::obstacle || intent::is_vru(actor.kind)) {
      continue;
    }
    auto found = std::find_if(watched_.begin(), watched_.end(), [&](const RoadUser& one) {
      return one.kind == actor.kind && one.id == actor.id;
    });
    if (found == watched_.end()) {
      watched_.push_back(
          {.kind = actor.kind, .id = actor.id, .memory = {}, .state = {}, .outputs = {}});
      found = watched_.end() - 1;
    }
    found->seen = scene.time;
    found->memory.add(intent::observed(scene, i));
    found->outputs = model_->step(found->memory.features(), found->state);
  }
  std::erase_if(watched_,
                [&](const RoadUser& one) { return one.seen < scene.time - forgotten_after_gap; });
}

LikelyPlaces MixturePredictor::places_of(const Scene& scene, const Actor& actor) const {
  const auto found = std::find_if(watched_.begin(), watched_.end(), [&](const RoadUser& one) {
    return one.kind == actor.kind && one.id == actor.id;
  });
  if (found == watched_.end() || !is_learnt_of(actor)) {
    return going_straight(actor);
  }
  const world::Road line = travel_line(scene, actor);
  return eval::places_of(found->outputs, rotated(actor.v_W, -line.X_WL.yaw).x, line);
}

}  // namespace saca::eval
