#pragma once

#include <random>

namespace saca::learned_danger {

using Random = std::mt19937_64;

/// Any number from `least` on, below `most`.
inline double uniform(Random& random, double least, double most) {
  return std::uniform_real_distribution<double>(least, most)(random);
}

inline bool happens(Random& random, double probability) {
  return uniform(random, 0.0, 1.0) < probability;
}

}  // namespace saca::learned_danger
