#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "saca/lab/eval/curriculum.h"
#include "saca/lab/eval/suite_figures.h"

namespace saca::eval {

/// The encounter of one number, of all seeds.
struct Episodes {
  std::vector<Episode> of;                                  ///< by seed
  std::vector<std::array<std::size_t, num_learners>> size;  ///< of the banks after it, likewise
};

/// A figure of what one of curriculum_methods did in an episode; nullopt: it does not count.
using EpisodeMeasure = std::optional<double> (*)(const Episode& episode, std::size_t method);

std::optional<double> episode_harm(const Episode& episode, std::size_t method);
/// Harm above that of the best of all plans begun at T1.
std::optional<double> episode_regret(const Episode& episode, std::size_t method);
/// 1 where it harms more than AEB by more than `material`.
std::optional<double> episode_worse_than_aeb(const Episode& episode, std::size_t method);
/// 1 where it intervenes.
std::optional<double> episode_acts(const Episode& episode, std::size_t method);
/// Share of the forecasts for which a plan was sought whose plan comes from memory.
std::optional<double> episode_from_memory(const Episode& episode, std::size_t method);

/// The mean over the episodes of each seed, and over these (mean_over_seeds). Episodes with a fault
/// do not count; without any, n is 0.
/// @param all  at least one, with as many seeds each
[[nodiscard]] Estimate over_seeds(
    std::span<const Episodes> all,
    const std::function<std::optional<double>(const Episode& episode)>& value);
[[nodiscard]] Estimate over_seeds(std::span<const Episodes> all, std::size_t method,
                                  EpisodeMeasure measure);

/// How much more one method harms than another in the same episodes.
struct MethodPair {
  std::size_t method = 0;
  std::size_t other = 0;
};
/// Who learns beside who does not; the correction beside the choice that it corrects.
constexpr std::array<MethodPair, 3> curriculum_pairs{{{1, 0}, {2, 0}, {4, 3}}};
[[nodiscard]] Estimate harm_over(std::span<const Episodes> all, const MethodPair& pair);

/// The episodes in parts that follow each other, at most ten, of lengths that differ by one at
/// most.
[[nodiscard]] std::vector<std::span<const Episodes>> blocks_of(std::span<const Episodes> all);

/// How many cases a learner's banks hold after these episodes, on average over seeds.
[[nodiscard]] double mean_size(const Episodes& after, Learner who);

/// What one learner thought in all episodes without a fault, counted.
[[nodiscard]] encounter::ThinkingFigures thought(std::span<const Episodes> all, std::size_t method);

/// In how many episodes of all seeds something is so.
[[nodiscard]] int count_episodes(std::span<const Episodes> all,
                                 const std::function<bool(const Episode& episode)>& is);

}  // namespace saca::eval
