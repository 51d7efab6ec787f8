#include "saca/lab/network_training/task.h"

#include <fmt/core.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <numbers>
#include <numeric>
#include <sstream>
#include <string_view>
#include <utility>

#include "saca/base/core/contract.h"
#include "saca/base/core/file.h"
#include "saca/base/core/fnv.h"

namespace saca::network_training {
namespace {

constexpr double gradient_limit = 1.0;  // norm: LSTMs explode now and then

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
  return network_training::batch_of(some);
}

/// Zeros for pieces of so many frames, each frame as those of `like`.
torch::Tensor room_for(std::int64_t num, std::int64_t longest, const torch::Tensor& like) {
  std::vector<std::int64_t> extents{num, longest};
  extents.insert(extents.end(), like.sizes().begin() + 1, like.sizes().end());
  return torch::zeros(extents, like.options());
}

/// Per known label.
double held_out_loss(const Task& task, const std::vector<Piece>& pieces, int frames) {
  const torch::NoGradGuard no_gradients;
  task.network->eval();
  double sum = 0.0;
  double num = 0.0;
  for (const auto& which : batches_of(pieces, natural_order(pieces), frames)) {
    const Batch those = batch_of(pieces, which);
    const double known = those.known.sum().item<double>();
    sum += known * task.held_out_loss(those).item<double>();
    num += known;
  }
  task.network->train();
  return sum / std::max(num, 1.0);
}

/// What a run is of: another one cannot be gone on with.
std::string fingerprint(const std::vector<Piece>& pieces, const Schedule& plan,
                        const std::string& words) {
  Fnv hash;
  for (const Piece& piece : pieces) {
    for (const torch::Tensor* each :
         {&piece.features, &piece.labels, &piece.known, &piece.taught}) {
      if (!each->defined()) {
        continue;
      }
      const torch::Tensor flat = each->contiguous();
      hash.add(std::string_view(static_cast<const char*>(flat.data_ptr()), flat.nbytes()));
    }
  }
  return fmt::format("{} {} {} {} {} {} {:x}", plan.seed, plan.epochs, plan.batch, plan.step,
                     plan.decay, words, hash.value());
}

/// One training under way.
class Training {
 public:
  Training(const Task& task, const std::vector<Piece>& pieces, const std::vector<Piece>& held_out,
           const Schedule& plan, std::filesystem::path state)
      : task_(task),
        pieces_(pieces),
        held_out_(held_out),
        plan_(plan),
        state_{std::move(state), fingerprint(pieces, plan, task.words)},
        optimiser_(task.network->parameters(),
                   torch::optim::AdamWOptions(plan.step).weight_decay(plan.decay)) {}

  std::optional<Error> run(const std::function<bool(const Epoch&)>& on_epoch) {
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
    task_.network->eval();
    return std::nullopt;
  }

 private:
  Epoch epoch(int number);
  void set_step(int number, double share_of_epoch);
  std::optional<Error> resume();
  [[nodiscard]] std::optional<Error> keep();

  const Task& task_;
  const std::vector<Piece>& pieces_;
  const std::vector<Piece>& held_out_;
  Schedule plan_;
  TrainingState state_;
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
  task_.network->train();
  double sum = 0.0;
  for (std::size_t i = 0; i < batches.size(); ++i) {
    set_step(number, static_cast<double>(i) / static_cast<double>(batches.size()));
    Batch batch = batch_of(pieces_, batches[i]);
    optimiser_.zero_grad();
    const torch::Tensor loss = task_.loss(batch, random);
    loss.backward();
    torch::nn::utils::clip_grad_norm_(task_.network->parameters(), gradient_limit);
    optimiser_.step();
    sum += loss.item<double>();
  }
  Epoch done{.number = number + 1,
             .loss = sum / static_cast<double>(std::max<std::size_t>(batches.size(), 1)),
             .held_out = std::nullopt,
             .seconds = 0.0};
  if (!held_out_.empty()) {
    done.held_out = held_out_loss(task_, held_out_, plan_.batch);
  }
  done.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  return done;
}

std::optional<Error> Training::keep() {
  torch::Tensor curve =
      torch::empty({static_cast<std::int64_t>(curve_.size()), 3}, torch::kFloat64);
  for (std::size_t i = 0; i < curve_.size(); ++i) {
    const auto row = static_cast<std::int64_t>(i);
    curve[row][0] = curve_[i].loss;
    curve[row][1] = curve_[i].held_out.value_or(std::nan(""));
    curve[row][2] = curve_[i].seconds;
  }
  return network_training::keep(state_, *task_.network, optimiser_, curve);
}

std::optional<Error> Training::resume() {
  const auto kept = network_training::resume(state_, *task_.network, optimiser_);
  if (!kept.has_value()) {
    return kept.error();
  }
  if (!kept.value()) {
    return std::nullopt;
  }
  const torch::Tensor& curve = *kept.value();
  for (std::int64_t i = 0; i < curve.size(0); ++i) {
    const double held_out = curve[i][1].item<double>();
    curve_.push_back({.number = static_cast<int>(i) + 1,
                      .loss = curve[i][0].item<double>(),
                      .held_out = std::isnan(held_out) ? std::nullopt : std::optional(held_out),
                      .seconds = curve[i][2].item<double>()});
  }
  return std::nullopt;
}

}  // namespace

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
  Batch batch{.features = room_for(num, longest, pieces.front()->features),
              .present = torch::zeros({num, longest}, torch::kBool),
              .labels = room_for(num, longest, pieces.front()->labels),
              .known = room_for(num, longest, pieces.front()->known),
              .taught = {}};
  const bool is_taught = pieces.front()->taught.defined();
  if (is_taught) {
    batch.taught = room_for(num, longest, pieces.front()->taught);
  }
  for (std::int64_t i = 0; i < num; ++i) {
    const Piece& piece = *pieces[static_cast<std::size_t>(i)];
    const std::int64_t size = piece.features.size(0);
    batch.features[i].narrow(0, 0, size).copy_(piece.features);
    batch.present[i].narrow(0, 0, size).fill_(true);
    batch.labels[i].narrow(0, 0, size).copy_(piece.labels);
    batch.known[i].narrow(0, 0, size).copy_(piece.known);
    if (is_taught) {
      batch.taught[i].narrow(0, 0, size).copy_(piece.taught);
    }
  }
  return batch;
}

std::optional<Error> train(const Task& task, const std::vector<Piece>& pieces,
                           const std::vector<Piece>& held_out, const Schedule& schedule,
                           const std::filesystem::path& state,
                           const std::function<bool(const Epoch&)>& on_epoch) {
  expects(!pieces.empty() && schedule.epochs > 0 && schedule.batch > 0, "something to train with");
  return Training(task, pieces, held_out, schedule, state).run(on_epoch);
}

std::optional<Error> keep(const TrainingState& state, const torch::nn::Module& network,
                          const torch::optim::Optimizer& optimiser, const torch::Tensor& curve) {
  if (state.file.empty()) {
    return std::nullopt;
  }
  torch::serialize::OutputArchive archive;
  torch::serialize::OutputArchive of_network;
  torch::serialize::OutputArchive of_optimiser;
  network.save(of_network);
  optimiser.save(of_optimiser);
  archive.write("of", c10::IValue(state.fingerprint));
  archive.write("curve", curve);
  archive.write("network", of_network);
  archive.write("optimiser", of_optimiser);
  std::ostringstream bytes;
  archive.save_to(bytes);
  return write_file(state.file, bytes.str());
}

Result<std::optional<torch::Tensor>> resume(const TrainingState& state, torch::nn::Module& network,
                                            torch::optim::Optimizer& optimiser) {
  if (state.file.empty() || !std::filesystem::exists(state.file)) {
    return std::optional<torch::Tensor>();
  }
  const auto bytes = read_file(state.file, many_bytes);
  if (!bytes.has_value()) {
    return bytes.error();
  }
  try {
    std::istringstream stream(bytes.value());
    torch::serialize::InputArchive archive;
    archive.load_from(stream);
    c10::IValue of;
    archive.read("of", of);
    if (of.toStringRef() != state.fingerprint) {
      return Error{Error::Code::malformed,
                   state.file.string() + ": is of another training: remove it to begin anew"};
    }
    torch::Tensor curve;
    archive.read("curve", curve);
    torch::serialize::InputArchive of_network;
    torch::serialize::InputArchive of_optimiser;
    archive.read("network", of_network);
    archive.read("optimiser", of_optimiser);
    network.load(of_network);
    optimiser.load(of_optimiser);
    return std::optional(curve);
  } catch (const c10::Error& problem) {
    return Error{Error::Code::malformed, state.file.string() +
                                             ": want the state of a training, got " +
                                             problem.what_without_backtrace()};
  }
}

formats::Tensor plain(const torch::Tensor& tensor) {
  const torch::Tensor flat = tensor.detach().to(torch::kFloat32).contiguous();
  formats::Tensor result;
  for (const std::int64_t extent : flat.sizes()) {
    result.shape.push_back(static_cast<std::size_t>(extent));
  }
  const auto* const data = flat.data_ptr<float>();
  result.values.assign(data, data + flat.numel());
  return result;
}

}  // namespace saca::network_training
