#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "saca/base/core/vec2.h"

namespace saca::report {

// Pieces of SVG. Coordinates are in pixels, y downwards; the same input makes the same bytes. What
// elements look like is said once in a document, by class (`svg_document`).

/// Of a picture or a part of one [px].
struct SvgSize {
  double width = 0.0;
  double height = 0.0;
};

/// Of usual text, of titles and headings: as the style says [px].
constexpr double usual_font = 11.0;
constexpr double title_font = 13.0;
constexpr double heading_font = 18.0;

/// Text that may stand in an element or an attribute. What is no UTF-8, or forbidden in XML 1.0,
/// becomes U+FFFD.
[[nodiscard]] std::string escaped(std::string_view text);

/// At most two decimals, no zeros behind them, no minus before zero.
[[nodiscard]] std::string svg_number(double value);

enum class Anchor { start, middle, end };

[[nodiscard]] std::string svg_text(std::string_view classes, Vec2 at, std::string_view text,
                                   Anchor anchor = Anchor::start);
[[nodiscard]] std::string svg_rect(std::string_view classes, Vec2 at, SvgSize size,
                                   std::string_view more = "");
[[nodiscard]] std::string svg_line(std::string_view classes, Vec2 from, Vec2 to);
[[nodiscard]] std::string svg_circle(std::string_view classes, Vec2 at, double radius,
                                     std::string_view more = "");
[[nodiscard]] std::string svg_polygon(std::string_view classes, std::span<const Vec2> points,
                                      std::string_view more = "");
[[nodiscard]] std::string svg_polyline(std::string_view classes, std::span<const Vec2> points,
                                       std::string_view more = "");

/// Where bodies touch.
[[nodiscard]] std::string svg_star(Vec2 at, double radius);

/// A part with its own origin, beyond whose frame nothing is drawn.
[[nodiscard]] std::string svg_part(Vec2 at, SvgSize size, std::string_view body);

/// A whole file: a light card that needs no other style, whatever it lies on.
/// @param title  for those who cannot see the picture
[[nodiscard]] std::string svg_document(SvgSize size, std::string_view title, std::string_view body);

/// The same inside a page that holds svg_style itself.
[[nodiscard]] std::string svg_in_page(SvgSize size, std::string_view title, std::string_view body);

/// How wide a text will be, about [px]: fonts differ.
[[nodiscard]] double text_width(std::string_view text, double font_size);

/// The text, cut with an ellipsis where it would be wider than `width` [px].
[[nodiscard]] std::string fitted(std::string_view text, double font_size, double width);

/// Multiples of 1, 2 or 5 times a power of ten between two numbers.
/// @param at_most  how many, >= 2
/// @throws ContractViolation  unless low < high, both finite
[[nodiscard]] std::vector<double> round_ticks(double low, double high, int at_most);

}  // namespace saca::report
