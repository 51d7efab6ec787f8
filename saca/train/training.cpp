#include "saca/train/training.h"

#include <fmt/core.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <numbers>
#include <numeric>
#include <random>
#include <sstream>
#include <string_view>
#include <utility>

#include "saca/core/contract.h"
#include "saca/core/file.h"
#include "saca/core/fnv.h"
#include "saca/intent/features.h"
#include "saca/intent/network.h"
#include "saca/learn/score.h"

namespace saca::train {
namespace {

using intent::Feature;
using learn::Sequence;

constexpr auto columns = static_cast<std::int64_t>(intent::num_features);
constexpr auto rows_ahead = static_cast<std::int64_t>(intent::num_horizons);
constexpr double gradient_limit = 1.0;  // norm: LSTMs explode now and then

/// Frames [first, last) of a sequence, as a stream sees them that begins there.
Piece piece_of(const Sequence& sequence, std::size_t first, std::size_t last) {
  const auto rows = static_cast<std::int64_t>(last - first);
  Piece piece{.features = torch::empty({rows, columns}),
              .labels = torch::zeros({rows, rows_ahead}, torch::kInt64),
              .known = torch::zeros({rows, rows_ahead}, torch::kBool)};
  auto* features = piece.features.data_ptr<float>();
  auto labels = piece.labels.accessor<std::int64_t, 2>();
  auto known = piece.known.accessor<bool, 2>();
  intent::Memory memory;
  for (std::size_t t = first; t < last; ++t) {
    memory.add(sequence.observations[t]);
    const intent::Features now = memory.features();
    features = std::copy(now.begin(), now.end(), features);
    for (std::size_t h = 0; h < intent::num_horizons; ++h) {
      const std::size_t later = t + learn::frames_ahead[h];
      if (later < sequence.labels.size()) {
        const auto row = static_cast<std::int64_t>(t - first);
        labels[row][static_cast<std::int64_t>(h)] = sequence.labels[later];
        known[row][static_cast<std::int64_t>(h)] = sequence.scored[later];
      }
    }
  }
  return piece;
}

void hide(torch::Tensor& features, std::int64_t piece, std::initializer_list<Feature> which) {
  for (const Feature each : which) {
    features.select(0, piece).select(1, static_cast<std::int64_t>(each)).zero_();
  }
}

/// Hides now and then what is not known everywhere.
void hide_some(Batch& batch, const TrainingPlan& plan, std::mt19937_64& random) {
  std::uniform_real_distribution<double> share(0.0, 1.0);
  for (std::int64_t i = 0; i < batch.features.size(0); ++i) {
    if (share(random) < plan.lane_loss) {
      hide(batch.features, i,
           {Feature::lane_known, Feature::lane_width, Feature::to_line, Feature::offset,
            Feature::lateral_speed, Feature::heading, Feature::steered_speed, Feature::moved_03,
            Feature::moved_05, Feature::moved_10, Feature::moved_20, Feature::sped_05,
            Feature::sped_10, Feature::lateral_way});
    }
    if (share(random) < plan.ahead_loss) {
      hide(batch.features, i,
           {Feature::ahead_known, Feature::somebody_ahead, Feature::nearness, Feature::time_gap,
            Feature::closing, Feature::closing_time, Feature::needed_deceleration,
            Feature::lead_slope_05, Feature::lead_slope_10});
    }
    if (share(random) < plan.pedals_loss) {
      hide(batch.features, i,
           {Feature::throttle_known, Feature::throttle, Feature::brake_known, Feature::brake,
            Feature::steering_known, Feature::steering});
    }
  }
}

torch::Tensor total(const Loss& loss, const TrainingPlan& plan) {
  return (1.0 - plan.filtered_share) * loss.sequence + plan.filtered_share * loss.filtered;
}

std::vector<std::size_t> natural_order(const std::vector<Piece>& pieces) {
  std::vector<std::size_t> order(pieces.size());
  std::iota(order.begin(), order.end(), 0U);
  return order;
}

Batch batch_of(const std::vector<Piece>& pieces, const std::vector<std::size_t>& which) {
  std::vector<const Piece*> some;
  some.reserve(which.size());
  for (const std::size_t i : which) {
    some.push_back(&pieces[i]);
  }
  return train::batch_of(some);
}

/// Filtered loss per label, all alike.
double held_out_loss(LstmCrf& network, const std::vector<Piece>& pieces, int frames) {
  const torch::NoGradGuard no_gradients;
  network->eval();
  double sum = 0.0;
  double num = 0.0;
  for (const auto& which : batches_of(pieces, natural_order(pieces), frames)) {
    const Batch those = batch_of(pieces, which);
    const double known = those.known.sum().item<double>();
    sum += known * network->loss(network->emissions(those.features), those).filtered.item<double>();
    num += known;
  }
  network->train();
  return sum / std::max(num, 1.0);
}

/// What a run is of: another one cannot be gone on with.
std::string fingerprint(const std::vector<Piece>& pieces, const TrainingPlan& plan) {
  Fnv hash;
  for (const Piece& piece : pieces) {
    for (const torch::Tensor* each : {&piece.features, &piece.labels, &piece.known}) {
      const torch::Tensor flat = each->contiguous();
      hash.add(std::string_view(static_cast<const char*>(flat.data_ptr()), flat.nbytes()));
    }
  }
  return fmt::format("{} {} {} {} {} {} {} {} {} {} {} {} {} {:x}", plan.seed, plan.epochs,
                     plan.batch, plan.longest, plan.step, plan.decay, plan.dropout,
                     plan.filtered_share, fmt::join(plan.label_weights, ","), plan.with_chain,
                     plan.lane_loss, plan.ahead_loss, plan.pedals_loss, hash.value());
}

/// One training under way.
class Training {
 public:
  Training(std::vector<Piece> pieces, std::vector<Piece> held_out, const TrainingPlan& plan,
           std::filesystem::path state)
      : pieces_(std::move(pieces)),
        held_out_(std::move(held_out)),
        plan_(plan),
        state_(std::move(state)),
        fingerprint_(fingerprint(pieces_, plan)),
        network_(seeded_network(plan)),
        optimiser_(network_->parameters(),
                   torch::optim::AdamWOptions(plan.step).weight_decay(plan.decay)) {}

  Result<LstmCrf> run(const std::function<bool(const Epoch&)>& on_epoch) {
    if (const auto problem = resume()) {
      return *problem;
    }
    for (const Epoch& epoch : curve_) {
      on_epoch(epoch);
    }
    while (static_cast<int>(curve_.size()) < plan_.epochs) {
      curve_.push_back(epoch(static_cast<int>(curve_.size())));
      if (const auto problem = keep()) {
        return *problem;
      }
      if (!on_epoch(curve_.back())) {
        break;
      }
    }
    network_->eval();
    return network_;
  }

 private:
  static LstmCrf seeded_network(const TrainingPlan& plan) {
    torch::manual_seed(plan.seed);
    return LstmCrf(plan.dropout, plan.with_chain);
  }

  Epoch epoch(int number);
  void set_step(int number, double share_of_epoch);
  std::optional<Error> resume();
  [[nodiscard]] std::optional<Error> keep();

  std::vector<Piece> pieces_;
  std::vector<Piece> held_out_;
  TrainingPlan plan_;
  std::filesystem::path state_;
  std::string fingerprint_;
  LstmCrf network_;
  torch::optim::AdamW optimiser_;
  std::vector<Epoch> curve_;
};

void Training::set_step(int number, double share_of_epoch) {
  constexpr double warm_up = 1.0;  // epochs
  const double at = number + share_of_epoch;
  const double falling = 0.5 * (1.0 + std::cos(std::numbers::pi * at / plan_.epochs));
  for (auto& group : optimiser_.param_groups()) {
    static_cast<torch::optim::AdamWOptions&>(group.options())
        .lr(plan_.step * std::min(1.0, (at + 0.05) / warm_up) * falling);
  }
}

Epoch Training::epoch(int number) {
  const auto begin = std::chrono::steady_clock::now();
  // Of each epoch its own, so that a run that was stopped goes on as if it had not been.
  const std::uint64_t seed = plan_.seed * 1'000'003U + static_cast<std::uint64_t>(number);
  torch::manual_seed(seed);
  std::mt19937_64 random(seed);
  std::vector<std::size_t> order = natural_order(pieces_);
  std::shuffle(order.begin(), order.end(), random);
  auto batches = batches_of(pieces_, std::move(order), plan_.batch);
  std::shuffle(batches.begin(), batches.end(), random);
  network_->train();
  double sum = 0.0;
  for (std::size_t i = 0; i < batches.size(); ++i) {
    set_step(number, static_cast<double>(i) / static_cast<double>(batches.size()));
    Batch batch = batch_of(pieces_, batches[i]);
    hide_some(batch, plan_, random);
    optimiser_.zero_grad();
    const torch::Tensor loss = total(
        network_->loss(network_->emissions(batch.features), batch, plan_.label_weights), plan_);
    loss.backward();
    torch::nn::utils::clip_grad_norm_(network_->parameters(), gradient_limit);
    optimiser_.step();
    sum += loss.item<double>();
  }
  Epoch done{.number = number + 1,
             .loss = sum / static_cast<double>(std::max<std::size_t>(batches.size(), 1)),
             .held_out = std::nullopt,
             .seconds = 0.0};
  if (!held_out_.empty()) {
    done.held_out = held_out_loss(network_, held_out_, plan_.batch);
  }
  done.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  return done;
}

std::optional<Error> Training::keep() {
  if (state_.empty()) {
    return std::nullopt;
  }
  torch::serialize::OutputArchive archive;
  torch::serialize::OutputArchive network;
  torch::serialize::OutputArchive optimiser;
  network_->save(network);
  optimiser_.save(optimiser);
  archive.write("of", c10::IValue(fingerprint_));
  torch::Tensor curve =
      torch::empty({static_cast<std::int64_t>(curve_.size()), 3}, torch::kFloat64);
  for (std::size_t i = 0; i < curve_.size(); ++i) {
    const auto row = static_cast<std::int64_t>(i);
    curve[row][0] = curve_[i].loss;
    curve[row][1] = curve_[i].held_out.value_or(std::nan(""));
    curve[row][2] = curve_[i].seconds;
  }
  archive.write("curve", curve);
  archive.write("network", network);
  archive.write("optimiser", optimiser);
  std::ostringstream bytes;
  archive.save_to(bytes);
  return write_file(state_, bytes.str());
}

std::optional<Error> Training::resume() {
  if (state_.empty() || !std::filesystem::exists(state_)) {
    return std::nullopt;
  }
  const auto bytes = read_file(state_, many_bytes);
  if (!bytes.has_value()) {
    return bytes.error();
  }
  try {
    std::istringstream stream(bytes.value());
    torch::serialize::InputArchive archive;
    archive.load_from(stream);
    c10::IValue of;
    archive.read("of", of);
    if (of.toStringRef() != fingerprint_) {
      return Error{Error::Code::malformed,
                   state_.string() + ": is of another training: remove it to begin anew"};
    }
    torch::Tensor curve;
    archive.read("curve", curve);
    torch::serialize::InputArchive network;
    torch::serialize::InputArchive optimiser;
    archive.read("network", network);
    archive.read("optimiser", optimiser);
    network_->load(network);
    optimiser_.load(optimiser);
    for (std::int64_t i = 0; i < curve.size(0); ++i) {
      const double held_out = curve[i][1].item<double>();
      curve_.push_back({.number = static_cast<int>(i) + 1,
                        .loss = curve[i][0].item<double>(),
                        .held_out = std::isnan(held_out) ? std::nullopt : std::optional(held_out),
                        .seconds = curve[i][2].item<double>()});
    }
  } catch (const c10::Error& problem) {
    return Error{Error::Code::malformed, state_.string() + ": want the state of a training, got " +
                                             problem.what_without_backtrace()};
  }
  return std::nullopt;
}

}  // namespace

std::vector<Piece> pieces_of(const std::vector<Sequence>& sequences, int longest, bool with_late) {
  expects(longest > 0, "longest > 0");
  std::vector<Piece> pieces;
  const auto add = [&](const Sequence& sequence, std::size_t first, std::size_t last) {
    Piece piece = piece_of(sequence, first, last);
    if (piece.known.any().item<bool>()) {
      pieces.push_back(std::move(piece));
    }
  };
  std::size_t number = 0;
  for (const Sequence& sequence : sequences) {
    const std::size_t num = sequence.observations.size();
    for (std::size_t first = 0; first < num; first += static_cast<std::size_t>(longest)) {
      const std::size_t last = std::min(num, first + static_cast<std::size_t>(longest));
      add(sequence, first, last);
      const std::size_t late = first + (last - first) * (1 + number++ % 3) / 4;
      if (with_late && late < last) {
        add(sequence, late, last);
      }
    }
  }
  return pieces;
}

std::vector<std::vector<std::size_t>> batches_of(const std::vector<Piece>& pieces,
                                                 std::vector<std::size_t> order, int frames) {
  const auto length = [&](std::size_t i) { return pieces[i].features.size(0); };
  constexpr std::size_t neighbours = 1'024;
  for (std::size_t first = 0; first < order.size(); first += neighbours) {
    const auto begin = order.begin() + static_cast<std::ptrdiff_t>(first);
    const auto end = first + neighbours < order.size()
                         ? begin + static_cast<std::ptrdiff_t>(neighbours)
                         : order.end();
    std::stable_sort(begin, end,
                     [&](std::size_t a, std::size_t b) { return length(a) > length(b); });
  }
  std::vector<std::vector<std::size_t>> batches;
  for (const std::size_t i : order) {
    const bool fits =
        !batches.empty() && length(i) <= length(batches.back().front()) &&
        length(batches.back().front()) * static_cast<std::int64_t>(batches.back().size() + 1) <=
            frames;
    if (!fits) {
      batches.emplace_back();
    }
    batches.back().push_back(i);
  }
  return batches;
}

Batch batch_of(const std::vector<const Piece*>& pieces) {
  expects(!pieces.empty(), "at least one piece");
  std::int64_t longest = 0;
  for (const Piece* piece : pieces) {
    longest = std::max(longest, piece->features.size(0));
  }
  const auto num = static_cast<std::int64_t>(pieces.size());
  Batch batch{.features = torch::zeros({num, longest, columns}),
              .present = torch::zeros({num, longest}, torch::kBool),
              .labels = torch::zeros({num, longest, rows_ahead}, torch::kInt64),
              .known = torch::zeros({num, longest, rows_ahead}, torch::kBool)};
  for (std::int64_t i = 0; i < num; ++i) {
    const Piece& piece = *pieces[static_cast<std::size_t>(i)];
    const std::int64_t size = piece.features.size(0);
    batch.features[i].narrow(0, 0, size).copy_(piece.features);
    batch.present[i].narrow(0, 0, size).fill_(true);
    batch.labels[i].narrow(0, 0, size).copy_(piece.labels);
    batch.known[i].narrow(0, 0, size).copy_(piece.known);
  }
  return batch;
}

Result<LstmCrf> trained(const std::vector<Sequence>& sequences,
                        const std::vector<Sequence>& held_out, const TrainingPlan& plan,
                        const std::filesystem::path& state,
                        const std::function<bool(const Epoch&)>& on_epoch) {
  expects(!sequences.empty() && plan.epochs > 0 && plan.batch > 0, "something to train with");
  return Training(pieces_of(sequences, plan.longest, true),
                  pieces_of(held_out, plan.longest, false), plan, state)
      .run(on_epoch);
}

config::Tensors model_tensors(const std::vector<LstmCrf>& networks) {
  expects(!networks.empty(), "at least one network");
  config::Tensors tensors;
  torch::Tensor start = torch::zeros_like(networks[0]->start());
  torch::Tensor transition = torch::zeros_like(networks[0]->transition());
  const double share = 1.0 / static_cast<double>(networks.size());
  for (std::size_t i = 0; i < networks.size(); ++i) {
    networks[i]->add_network(tensors, std::to_string(i) + ".");
    start += share * networks[i]->start();
    transition += share * networks[i]->transition();
  }
  const auto add = [&](const std::string& name, const torch::Tensor& value) {
    config::Tensor& tensor = tensors.tensors[name];
    for (const std::int64_t extent : value.sizes()) {
      tensor.shape.push_back(static_cast<std::size_t>(extent));
    }
    const torch::Tensor flat = value.detach().contiguous();
    tensor.values.assign(flat.data_ptr<float>(), flat.data_ptr<float>() + flat.numel());
  };
  add("chain.start", start);
  add("chain.transition", transition);
  tensors.tensors["networks"] = {{1}, {static_cast<float>(networks.size())}};
  tensors.tensors["sharpness"] = {{intent::num_horizons},
                                  std::vector<float>(intent::num_horizons, 1.0F)};
  return tensors;
}

}  // namespace saca::train
