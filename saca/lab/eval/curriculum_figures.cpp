#include "saca/lab/eval/curriculum_figures.h"

#include <algorithm>

#include "saca/base/core/contract.h"

namespace saca::eval {
namespace {

const MethodRun& run_in(const Episode& episode, std::size_t method) {
  return episode.row.risk.runs[method];
}

}  // namespace

std::optional<double> episode_harm(const Episode& episode, std::size_t method) {
  return run_in(episode, method).harm;
}

std::optional<double> episode_regret(const Episode& episode, std::size_t method) {
  return run_in(episode, method).harm - episode.row.risk.best_harm;
}

std::optional<double> episode_worse_than_aeb(const Episode& episode, std::size_t method) {
  const double aeb = run_in(episode, curriculum_methods.size() - 1).harm;
  return run_in(episode, method).harm > aeb + material ? 1.0 : 0.0;
}

std::optional<double> episode_acts(const Episode& episode, std::size_t method) {
  return run_in(episode, method).intervened() ? 1.0 : 0.0;
}

std::optional<double> episode_from_memory(const Episode& episode, std::size_t method) {
  const auto& thinking = run_in(episode, method).thinking;
  return thinking && thinking->forecasts > 0
             ? std::optional(static_cast<double>(thinking->from_memory) / thinking->forecasts)
             : std::nullopt;
}

Estimate over_seeds(std::span<const Episodes> all,
                    const std::function<std::optional<double>(const Episode& episode)>& value) {
  expects(!all.empty(), "at least one episode");
  std::vector<double> means;
  for (std::size_t k = 0; k < all.front().of.size(); ++k) {
    double sum = 0.0;
    int n = 0;
    for (const Episodes& episodes : all) {
      const Episode& episode = episodes.of[k];
      const std::optional<double> one = episode.row.fault.empty() ? value(episode) : std::nullopt;
      sum += one.value_or(0.0);
      n += one ? 1 : 0;
    }
    if (n > 0) {
      means.push_back(sum / n);
    }
  }
  return means.empty() ? Estimate{} : mean_over_seeds(means);
}

Estimate over_seeds(std::span<const Episodes> all, std::size_t method, EpisodeMeasure measure) {
  return over_seeds(all, [&](const Episode& episode) { return measure(episode, method); });
}

Estimate harm_over(std::span<const Episodes> all, const MethodPair& pair) {
  return over_seeds(all, [&](const Episode& episode) {
    return std::optional(run_in(episode, pair.method).harm - run_in(episode, pair.other).harm);
  });
}

std::vector<std::span<const Episodes>> blocks_of(std::span<const Episodes> all) {
  constexpr std::size_t most = 10;
  const std::size_t num = std::min(all.size(), most);
  std::vector<std::span<const Episodes>> blocks;
  for (std::size_t k = 0; k < num; ++k) {
    const std::size_t first = k * all.size() / num;
    blocks.push_back(all.subspan(first, (k + 1) * all.size() / num - first));
  }
  return blocks;
}

double mean_size(const Episodes& after, Learner who) {
  double sum = 0.0;
  for (const auto& sizes : after.size) {
    sum += static_cast<double>(sizes.at(static_cast<std::size_t>(who)));
  }
  return sum / static_cast<double>(after.size.size());
}

encounter::ThinkingFigures thought(std::span<const Episodes> all, std::size_t method) {
  encounter::ThinkingFigures sum;
  for (const Episodes& episodes : all) {
    for (const Episode& one : episodes.of) {
      if (one.row.fault.empty() && run_in(one, method).thinking) {
        const encounter::ThinkingFigures& thinking = *run_in(one, method).thinking;
        sum.forecasts += thinking.forecasts;
        sum.from_memory += thinking.from_memory;
        sum.asked += thinking.asked;
      }
    }
  }
  return sum;
}

int count_episodes(std::span<const Episodes> all,
                   const std::function<bool(const Episode& episode)>& is) {
  int count = 0;
  for (const Episodes& episodes : all) {
    count += static_cast<int>(std::count_if(episodes.of.begin(), episodes.of.end(), is));
  }
  return count;
}

}  // namespace saca::eval
