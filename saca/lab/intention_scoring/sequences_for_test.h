#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

#include "saca/lab/intention_scoring/score.h"
#include "saca/lab/intention_scoring/sequence.h"

/// Sequences and forecasts that are written down by hand.
namespace saca::intention_scoring {

/// "M": maintain, "L" and "R": lane changes, "B": brakes, "l" and "r": brakes and changes lanes.
inline std::uint8_t class_of(char letter) {
  return static_cast<std::uint8_t>(std::string_view("MLRBlr").find(letter));
}

/// One frame for each letter, all scored.
inline Sequence labelled(std::string_view letters) {
  Sequence sequence;
  sequence.name = sequence.group = "by hand";
  sequence.observations.resize(letters.size());
  for (const char letter : letters) {
    sequence.labels.push_back(class_of(letter));
  }
  sequence.scored.assign(letters.size(), true);
  return sequence;
}

/// Probability `sure` for one class, the rest for all others alike.
inline ClassProbabilities mostly(std::size_t top, double sure) {
  ClassProbabilities probabilities;
  probabilities.fill((1.0 - sure) / static_cast<double>(num_vehicle_classes - 1));
  probabilities.at(top) = sure;
  return probabilities;
}

inline std::vector<ClassProbabilities> predicted(std::string_view letters, double sure = 0.9) {
  std::vector<ClassProbabilities> all;
  for (const char letter : letters) {
    all.push_back(mostly(class_of(letter), sure));
  }
  return all;
}

/// All heads say the same.
inline Forecasts all_heads(std::string_view letters, double sure = 0.9) {
  const auto said = predicted(letters, sure);
  return {{said, said, said}};
}

}  // namespace saca::intention_scoring
