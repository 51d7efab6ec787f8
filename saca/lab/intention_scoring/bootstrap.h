#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>

namespace saca::intention_scoring {

/// A figure with its 95 % interval.
struct Interval {
  double value = 0.0;  ///< of all groups, each once
  double low = 0.0;
  double high = 0.0;
  std::size_t draws = 0;  ///< that had such a figure
};

/// A figure of groups, some of them taken several times; nullopt: they have none.
using GroupFigure = std::function<std::optional<double>(std::span<const std::size_t> groups)>;

/// Interval of a figure from groups that are drawn anew, with replacement, as many as there are:
/// 2.5 and 97.5 percent of the draws. Frames of one group are not independent, groups are. The same
/// seed and number of groups draw the same: a difference of two models' figures, taken in
/// `figure`, is the paired bootstrap.
///
/// @param groups  how many there are, >= 1
/// @param draws   >= 1
/// @return        nullopt when all groups together have no such figure
///
/// Source: B. Efron, R. Tibshirani, An introduction to the bootstrap, 1993, chapter 13.
[[nodiscard]] std::optional<Interval> bootstrap(std::size_t groups, const GroupFigure& figure,
                                                std::size_t draws, std::uint64_t seed);

}  // namespace saca::intention_scoring
