#include "saca/lab/intention_scoring/predict.h"

#include <cstddef>

#include "saca/base/core/parallel.h"

namespace saca::intention_scoring {
std::vector<Forecasts> predicted(const intent::Model& model, std::span<const Sequence> sequences,
                                 int threads) {
  std::vector<Forecasts> all(sequences.size());
  in_parallel(sequences.size(), threads, [&](std::size_t i) {
    for (std::size_t head = 0; head < num_heads; ++head) {
      all[i].naming[head] = model.calibrations[head].naming;
    }
    intent::Stream stream;
    for (const intent::Observation& seen : sequences[i].observations) {
      const intent::HorizonScores told = stream.step(model, seen);
      for (std::size_t head = 0; head < num_heads; ++head) {
        all[i].at[head].push_back(told[head]);
      }
    }
  });
  return all;
}

}  // namespace saca::intention_scoring
