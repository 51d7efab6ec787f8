#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "saca/base/core/result.h"
#include "saca/lab/intention_scoring/calibration.h"
#include "saca/lab/intention_scoring/sequence.h"
#include "saca/lab/network_training/lessons.h"
#include "saca/lab/network_training/lstm_crf.h"
#include "saca/lab/network_training/task.h"

namespace saca::network_training {

/// How networks are trained. All randomness comes from the seed.
struct TrainingPlan {
  std::uint64_t seed = 1;
  int epochs = 15;
  int batch = 3'600;    ///< frames, with those that are filled up
  int longest = 100;    ///< frames of one piece; longer sequences are cut
  double step = 3e-3;   ///< largest step of the optimiser (AdamW, falling as a cosine)
  double decay = 1e-2;  ///< of weights
  double dropout = 0.3;
  /// Of labels in the loss: nine frames of ten are M, and what is rare is what matters.
  ClassWeights label_weights{1.0, 2.5, 2.5, 2.0, 2.5, 2.5};
  Chain chain = Chain::learnt;
  double lane_loss = 0.1;    ///< share of pieces whose lane is hidden: somebody off the map
  double ahead_loss = 0.1;   ///< likewise of what is ahead
  double pedals_loss = 0.5;  ///< likewise of what the vehicle shares
  /// The most noise that a piece's speed is given, root mean square [m/s], >= 0 (speed_noise.h):
  /// each piece has its own between 0 and this, as each site has its own tracker. What is learnt
  /// transfers better to sites never seen (docs/decisions/0015).
  double speed_noise = 0.6;
};

/// Where pieces begin.
enum class PieceBegins : std::uint8_t {
  in_turn,   ///< where the last one ends
  also_late  ///< and again after the first quarter, half or three quarters of each: somebody may
             ///< come into view in the middle of anything
};

/// Pieces of at most `longest` frames, each as a stream sees it that begins there. Labels of a
/// horizon are those so many frames later; unknown where they are in doubt or after the end.
[[nodiscard]] std::vector<Piece> pieces_of(
    const std::vector<intention_scoring::Sequence>& sequences, int longest, PieceBegins begins,
    const Lessons& lessons = {});

/// Trains one network, or goes on where an earlier run of the same plan on the same data was
/// stopped.
///
/// @param state     file of what is needed to go on, written after each epoch; empty: none
/// @param on_epoch  hears of each epoch, also of those that an earlier run has done; false: stop
/// here
/// @return          the network; Error::Code::malformed, naming the file, if the state is of
/// another
///                  plan or data. When it was stopped it is as it is.
[[nodiscard]] Result<LstmCrf> trained(const std::vector<intention_scoring::Sequence>& sequences,
                                      const std::vector<intention_scoring::Sequence>& held_out,
                                      const TrainingPlan& plan, const std::filesystem::path& state,
                                      const std::function<bool(const Epoch&)>& on_epoch,
                                      const Lessons& lessons = {});

/// The tensors of intent/model.h: networks trained from several seeds, and the mean of their
/// chains; not calibrated.
[[nodiscard]] formats::Tensors model_tensors(const std::vector<LstmCrf>& networks);

/// Puts calibrations into a model's tensors, in the place of those that are there.
void set_calibrations(formats::Tensors& tensors,
                      const intention_scoring::Calibrations& calibrations);

}  // namespace saca::network_training
