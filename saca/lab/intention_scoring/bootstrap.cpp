#include "saca/lab/intention_scoring/bootstrap.h"

#include <numeric>
#include <random>
#include <vector>

#include "saca/base/core/contract.h"
#include "saca/base/core/percentile.h"
#include "saca/lab/scenario/chance.h"

namespace saca::intention_scoring {

std::optional<Interval> bootstrap(std::size_t groups, const GroupFigure& figure, std::size_t draws,
                                  std::uint64_t seed) {
  expects(groups >= 1, "at least one group");
  expects(draws >= 1, "at least one draw");
  std::vector<std::size_t> drawn(groups);
  std::iota(drawn.begin(), drawn.end(), std::size_t{0});
  const std::optional<double> value = figure(drawn);
  if (!value) {
    return std::nullopt;
  }
  std::vector<double> figures;
  figures.reserve(draws);
  for (std::size_t draw = 0; draw < draws; ++draw) {
    std::mt19937_64 rng = scenario::generator(seed, draw);
    std::uniform_int_distribution<std::size_t> any(0, groups - 1);
    for (std::size_t& group : drawn) {
      group = any(rng);
    }
    if (const auto one = figure(drawn)) {
      figures.push_back(*one);
    }
  }
  if (figures.empty()) {
    return Interval{*value, *value, *value, 0};
  }
  constexpr double tail = 0.025;
  return Interval{*value, percentile(figures, tail), percentile(figures, 1.0 - tail),
                  figures.size()};
}

}  // namespace saca::intention_scoring
