#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "saca/lab/report/map_svg.h"
#include "saca/lab/report/svg.h"

namespace saca::report {

constexpr double map_border = 16.0;     ///< around a map and what stands beside it [px]
constexpr double legend_width = 196.0;  ///< [px]

/// Cells of one key look alike and belong to one area: the number of the policy that is best, or
/// one of these.
constexpr int no_risk_key = 8;
constexpr int no_scene_key = 9;
[[nodiscard]] int area_key(const MapCell& cell);
/// Whether there is such a scene, and the policy cannot be driven in it.
[[nodiscard]] bool refuses(const MapCell& cell, manoeuvre::PolicyId policy);
/// Those that are refused in some cell.
[[nodiscard]] std::vector<manoeuvre::PolicyId> refused_somewhere(std::span<const MapCell> cells);

/// The sign of the scenario as it is.
[[nodiscard]] std::string nominal_mark(Vec2 at);

/// What the looks of a map mean: rows of swatches or signs with words, downwards.
class MapLegend {
 public:
  /// @param at  its upper left corner [px]
  explicit MapLegend(Vec2 at) : at_(at) {}

  void heading(std::string_view words);
  void sign(const std::string& drawn, std::string_view words);
  void gap();

  /// Which policies are best, and in how many cells.
  void verdicts(std::span<const MapCell> cells);
  /// Which are refused, and in how many cells; nothing where none is.
  void refusals(std::span<const MapCell> cells);
  /// What a paler colour means.
  void margins();

  /// Where its next row begins.
  [[nodiscard]] Vec2 at() const { return at_; }
  [[nodiscard]] const std::string& body() const { return body_; }

 private:
  using Looks = std::vector<std::string_view>;  ///< classes of rectangles, one over the other

  void swatch(const Looks& looks, std::string_view words, std::string_view count);

  Vec2 at_;
  std::string body_;
};

}  // namespace saca::report
