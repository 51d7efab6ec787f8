#include "saca/lab/learned_danger/margins.h"

#include <fmt/core.h>

#include <algorithm>
#include <boost/math/distributions/binomial.hpp>
#include <charconv>
#include <cmath>

#include "saca/base/core/contract.h"

namespace saca::learned_danger {
namespace {

constexpr double fast = 20.0;  // [m/s]
constexpr double good_grip = 0.5;

std::string word_of(std::size_t bin) {
  return "margin." + bin_names()[bin];
}

}  // namespace

double upper_bound(const Share& share, double confidence) {
  if (share.count >= share.of) {
    return 1.0;
  }
  using Binomial = boost::math::binomial_distribution<double>;
  return Binomial::find_upper_bound_on_p(share.of, share.count, 1.0 - confidence);
}

std::size_t bin_of(bool is_straight, double speed, double grip, std::size_t num_obstacles) {
  expects(num_obstacles > 0, "an obstacle");
  return (is_straight ? 0U : 8U) + (speed >= fast ? 4U : 0U) + (grip >= good_grip ? 2U : 0U) +
         (num_obstacles > 1 ? 1U : 0U);
}

const std::array<std::string, num_bins>& bin_names() {
  static const std::array<std::string, num_bins> names = [] {
    std::array<std::string, num_bins> all;
    std::size_t next = 0;
    for (const std::string_view way : {"straight", "turning"}) {
      for (const std::string_view speed : {"below_20_mps", "from_20_mps"}) {
        for (const std::string_view grip : {"slippery", "good_grip"}) {
          for (const std::string_view obstacles : {"one", "several"}) {
            all[next++] = fmt::format("{}.{}.{}.{}", way, speed, grip, obstacles);
          }
        }
      }
    }
    return all;
  }();
  return names;
}

void PredictedSafe::add(double told, bool was_hit) {
  expects(told < 0.0, "told safe");
  // With a margin of so many steps it is still told safe.
  const auto level = std::min(num_levels - 1, static_cast<std::size_t>(-told / step));
  ++of_[level];
  hit_[level] += was_hit ? 1 : 0;
}

Share PredictedSafe::hits_with(std::size_t level) const {
  Share share;
  for (std::size_t i = level; i < num_levels; ++i) {
    share.count += hit_[i];
    share.of += of_[i];
  }
  return share;
}

std::optional<double> PredictedSafe::margin() const {
  std::optional<double> margin;
  for (std::size_t level = num_levels; level-- > 0;) {
    if (upper_bound(hits_with(level), margin_confidence) > most_hits) {
      break;
    }
    margin = step * static_cast<double>(level);
  }
  return margin;
}

bool PredictedSafe::may_have_margin() const {
  constexpr double confidence = 0.999;
  const Share farthest = hits_with(num_levels - 1);
  using Binomial = boost::math::binomial_distribution<double>;
  return farthest.count == 0 || Binomial::find_lower_bound_on_p(farthest.of, farthest.count,
                                                                1.0 - confidence) <= most_hits;
}

std::vector<int> PredictedSafe::numbers() const {
  std::vector<int> all(of_.begin(), of_.end());
  all.insert(all.end(), hit_.begin(), hit_.end());
  return all;
}

std::optional<PredictedSafe> PredictedSafe::from(const std::vector<int>& numbers) {
  if (numbers.size() != 2 * num_levels) {
    return std::nullopt;
  }
  PredictedSafe told;
  for (std::size_t i = 0; i < num_levels; ++i) {
    told.of_[i] = numbers[i];
    told.hit_[i] = numbers[num_levels + i];
    if (told.hit_[i] < 0 || told.hit_[i] > told.of_[i]) {
      return std::nullopt;
    }
  }
  return told;
}

Result<std::optional<Margins>> Margins::from(const std::map<std::string, std::string>& words,
                                             std::string_view source) {
  std::array<double, num_bins> metres{};
  std::size_t missing = 0;
  for (std::size_t bin = 0; bin < num_bins; ++bin) {
    const auto word = words.find(word_of(bin));
    if (word == words.end()) {
      ++missing;
      continue;
    }
    const std::string& text = word->second;
    const auto read = std::from_chars(text.data(), text.data() + text.size(), metres[bin]);
    if (read.ec != std::errc() || read.ptr != text.data() + text.size() || !(metres[bin] >= 0.0)) {
      return Error{Error::Code::malformed, fmt::format("{}: {}: want metres, >= 0, got \"{}\"",
                                                       source, word_of(bin), text)};
    }
  }
  if (missing == num_bins) {
    return std::optional<Margins>();
  }
  if (missing > 0) {
    return Error{Error::Code::malformed,
                 fmt::format("{}: want a margin for each of {} bins, {} are missing", source,
                             num_bins, missing)};
  }
  return std::optional(Margins(metres));
}

void Margins::add_to(std::map<std::string, std::string>& words) const {
  for (std::size_t bin = 0; bin < num_bins; ++bin) {
    words[word_of(bin)] = fmt::format("{:.2f}", metres_[bin]);
  }
}

}  // namespace saca::learned_danger
