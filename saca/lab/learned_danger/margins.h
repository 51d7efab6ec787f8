#pragma once

#include <array>
#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "saca/base/core/result.h"

/// How much is added to what a network tells, so that what is then told safe is hit hardly ever.
namespace saca::learned_danger {

/// So many of all.
struct Share {
  int count = 0;
  int of = 0;
  [[nodiscard]] double value() const { return of > 0 ? static_cast<double>(count) / of : 0.0; }
};

/// Most that a share may be in truth, by what was counted, with this confidence over the draw; 1 of
/// nothing. Source: Clopper and Pearson, Biometrika 26 (1934).
[[nodiscard]] double upper_bound(const Share& share, double confidence);

/// What a margin is to hold: P(hit | told safe) <= most_hits, with this confidence over the draw.
constexpr double most_hits = 1e-3;
constexpr double margin_confidence = 1.0 - 1e-6;

/// Situations that share a margin: going or braking straight is enough (straight_evasion) or not,
/// two bins of the ego's speed, two of the grip, one obstacle or several. More bins ask for more
/// drives: each wants some 14,000 that stay safe with its margin.
constexpr std::size_t num_bins = 16;
[[nodiscard]] std::size_t bin_of(bool is_straight, double speed, double grip,
                                 std::size_t num_obstacles);
/// "straight.below_20_mps.slippery.one", ..., "turning.from_20_mps.good_grip.several".
[[nodiscard]] const std::array<std::string, num_bins>& bin_names();

/// How often situations that were told safe were hit, by how safe they were told to be. Enough to
/// fit a margin, and small: what a long count is resumed by.
class PredictedSafe {
 public:
  static constexpr double step = 0.05;            ///< of what is told [m]
  static constexpr std::size_t num_levels = 100;  ///< the last one: by 5 m or more

  /// @param told  < 0 [m]
  void add(double told, bool was_hit);
  /// Hits of what is told safe with a margin of `level` steps.
  [[nodiscard]] Share hits_with(std::size_t level) const;
  /// The least margin [m], and all larger ones up to 5 m, with which most_hits holds; nullopt: not
  /// even 5 m is shown to be enough. Margins are tried from the largest on until one fails, so that
  /// the confidence is that of a single trial (fixed sequence testing; Angelopoulos and co-workers,
  /// Learn then Test, 2021).
  [[nodiscard]] std::optional<double> margin() const;
  /// Whether counting on may yet show a margin. False: of what is told safe by 5 m or more, more
  /// are hit than most_hits, with confidence 99.9 %. To stop there is no risk: such a bin gets
  /// none.
  [[nodiscard]] bool may_have_margin() const;

  [[nodiscard]] std::vector<int> numbers() const;
  /// @return  nullopt: no such numbers
  [[nodiscard]] static std::optional<PredictedSafe> from(const std::vector<int>& numbers);

 private:
  std::array<int, num_levels> of_{};
  std::array<int, num_levels> hit_{};
};

/// A margin for each bin [m].
class Margins {
 public:
  /// What stands for a margin where none is shown to be enough: nothing is told safe.
  static constexpr double none = 1e3;

  explicit Margins(const std::array<double, num_bins>& metres) : metres_(metres) {}
  /// From the words of a file of weights: `margin.` and the name of a bin, each in metres.
  /// @return  nullopt: no margins in there; Error::Code::malformed: one is missing or no number
  [[nodiscard]] static Result<std::optional<Margins>> from(
      const std::map<std::string, std::string>& words, std::string_view source);
  void add_to(std::map<std::string, std::string>& words) const;

  [[nodiscard]] double at(bool is_straight, double speed, double grip,
                          std::size_t num_obstacles) const {
    return metres_[bin_of(is_straight, speed, grip, num_obstacles)];
  }
  [[nodiscard]] const std::array<double, num_bins>& metres() const { return metres_; }

 private:
  std::array<double, num_bins> metres_;
};

}  // namespace saca::learned_danger
