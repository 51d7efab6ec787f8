#pragma once

#include <torch/torch.h>

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include "saca/base/core/result.h"
#include "saca/base/formats/tensors.h"

namespace saca::network_training {

/// Sequences of one length, filled up at the end.   (B sequences, T frames, H labels of each)
struct Batch {
  torch::Tensor features;  ///< (B x T x num_features)
  torch::Tensor present;   ///< (B x T), bool: false where filled up
  torch::Tensor labels;    ///< (B x T x H ...); 0 where not known
  torch::Tensor known;     ///< (B x T x H), bool: the label is not in doubt
  torch::Tensor
      taught;  ///< of each label a distribution (B x T x H x K); undefined: nobody teaches
};

/// A piece of a sequence, as the network sees it.
struct Piece {
  torch::Tensor features;  ///< (T x features of a frame)
  torch::Tensor labels;    ///< (T x H ...)
  torch::Tensor known;     ///< (T x H), bool
  torch::Tensor taught;    ///< (T x H x K), of all pieces or of none; undefined: nobody teaches
};

/// Pieces in batches of at most `frames` frames, or of one piece. Neighbours of like length come
/// together, so that little is filled up; the order is otherwise kept.
/// @param order  indices into `pieces`
[[nodiscard]] std::vector<std::vector<std::size_t>> batches_of(const std::vector<Piece>& pieces,
                                                               std::vector<std::size_t> order,
                                                               int frames);

/// Pieces of like features and labels side by side, filled up to the longest.
[[nodiscard]] Batch batch_of(const std::vector<const Piece*>& pieces);

/// One epoch of the curve.
struct Epoch {
  int number = 0;
  double loss = 0.0;               ///< per label, over the epoch
  std::optional<double> held_out;  ///< filtered loss per label on the sequences held out
  double seconds = 0.0;            ///< that it took
};

/// How a network is trained: by AdamW, whose step warms up over the first epoch and falls as a
/// cosine. All randomness comes from the seed.
struct Schedule {
  std::uint64_t seed = 1;
  int epochs = 15;
  int batch = 3'600;    ///< frames, with those that are filled up
  double step = 3e-3;   ///< largest
  double decay = 1e-2;  ///< of weights
};

/// What is trained, and by which losses.
struct Task {
  std::shared_ptr<torch::nn::Module> network;
  std::function<torch::Tensor(Batch& batch, std::mt19937_64& random)> loss;  ///< to be made small
  /// Mean per known label, on what is held out.
  std::function<torch::Tensor(const Batch& batch)> held_out_loss;
  std::string words;  ///< name all of the plan that a schedule does not say
};

/// Trains, or goes on where an earlier run of the same task and schedule on the same pieces was
/// stopped.
///
/// @param state     file of what is needed to go on, written after each epoch; empty: none
/// @param on_epoch  hears of each epoch, also of those that an earlier run has done; false: stop
/// @return          nullopt; Error::Code::malformed, naming the file, if the state is of another
///                  plan or data. When it was stopped the network is as it is then.
[[nodiscard]] std::optional<Error> train(const Task& task, const std::vector<Piece>& pieces,
                                         const std::vector<Piece>& held_out,
                                         const Schedule& schedule,
                                         const std::filesystem::path& state,
                                         const std::function<bool(const Epoch&)>& on_epoch);

/// What is needed to go on with a training that was stopped.
struct TrainingState {
  std::filesystem::path file;  ///< empty: none is kept
  std::string fingerprint;     ///< of plan and data: another one cannot be gone on with
};

/// Writes network, optimiser and curve.
/// @param curve  a row for each point, double precision
/// @return       nullopt, else the reason why it cannot be written
[[nodiscard]] std::optional<Error> keep(const TrainingState& state,
                                        const torch::nn::Module& network,
                                        const torch::optim::Optimizer& optimiser,
                                        const torch::Tensor& curve);

/// Reads back what was kept.
/// @return  the curve; nullopt: nothing is kept yet; Error::Code::malformed, naming the file, if it
///          is of another plan or data, or no state of a training
[[nodiscard]] Result<std::optional<torch::Tensor>> resume(const TrainingState& state,
                                                          torch::nn::Module& network,
                                                          torch::optim::Optimizer& optimiser);

/// A tensor's numbers, for files.
[[nodiscard]] formats::Tensor plain(const torch::Tensor& tensor);

}  // namespace saca::network_training
