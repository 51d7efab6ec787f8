#include "saca/lab/report/svg.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>

#include "saca/base/core/contract.h"
#include "saca/lab/report/palette.h"

namespace saca::report {
namespace {

constexpr std::string_view replacement = "\xEF\xBF\xBD";
constexpr std::string_view ellipsis = "\xE2\x80\xA6";

unsigned byte_at(std::string_view text, std::size_t i) {
  return static_cast<unsigned char>(text[i]);
}

/// Bytes of the character that begins at `i`; 0 when none does that XML allows.
std::size_t character_size(std::string_view text, std::size_t i) {
  const unsigned first = byte_at(text, i);
  if (first < 0x80) {
    return first >= 0x20 || first == '\t' || first == '\n' || first == '\r' ? 1 : 0;
  }
  const std::size_t size = first >= 0xF0 ? 4 : first >= 0xE0 ? 3 : 2;
  if (first < 0xC2 || first > 0xF4 || i + size > text.size()) {
    return 0;
  }
  unsigned code = first & (0xFFU >> (size + 1));
  for (std::size_t k = 1; k < size; ++k) {
    if ((byte_at(text, i + k) & 0xC0U) != 0x80U) {
      return 0;
    }
    code = (code << 6U) | (byte_at(text, i + k) & 0x3FU);
  }
  constexpr std::array<unsigned, 5> least{0, 0, 0x80, 0x800, 0x10000};
  const bool surrogate = code >= 0xD800 && code <= 0xDFFF;
  const bool allowed =
      code >= least.at(size) && code <= 0x10FFFF && !surrogate && code != 0xFFFE && code != 0xFFFF;
  return allowed ? size : 0;
}

/// A byte of UTF-8 that is not the first of its character.
bool continues(char c) {
  return (static_cast<unsigned char>(c) & 0xC0U) == 0x80U;
}

std::string_view entity(char c) {
  switch (c) {
    case '&':
      return "&amp;";
    case '<':
      return "&lt;";
    case '>':
      return "&gt;";
    case '"':
      return "&quot;";
    case '\'':
      return "&#39;";
    default:
      return {};
  }
}

/// Width over font size, about, in the usual sans-serif fonts.
double character_width(char c) {
  constexpr std::string_view narrow = "ijl.,:;'|!()[] ftrI/-";
  constexpr std::string_view wide = "mwMW@%";
  if (narrow.find(c) != std::string_view::npos) {
    return 0.36;
  }
  if (wide.find(c) != std::string_view::npos) {
    return 0.9;
  }
  return c >= 'A' && c <= 'Z' ? 0.7 : 0.59;
}

std::string points_text(std::span<const Vec2> points) {
  std::string text;
  for (const Vec2 p : points) {
    fmt::format_to(std::back_inserter(text), "{}{},{}", text.empty() ? "" : " ", svg_number(p.x),
                   svg_number(p.y));
  }
  return text;
}

std::string with_points(std::string_view element, std::string_view classes,
                        std::span<const Vec2> points, std::string_view more) {
  return fmt::format("<{} class=\"{}\" points=\"{}\"{}{}/>\n", element, classes,
                     points_text(points), more.empty() ? "" : " ", more);
}

}  // namespace

std::string escaped(std::string_view text) {
  std::string out;
  out.reserve(text.size());
  for (std::size_t i = 0; i < text.size();) {
    const std::size_t size = character_size(text, i);
    if (size == 0) {
      out += replacement;
    } else if (const auto known = entity(text[i]); !known.empty()) {
      out += known;
    } else {
      out += text.substr(i, size);
    }
    i += std::max<std::size_t>(size, 1);
  }
  return out;
}

std::string svg_number(double value) {
  expects(std::isfinite(value), "a coordinate is finite");
  std::string text = fmt::format("{:.2f}", value);
  text.erase(text.find_last_not_of('0') + 1);
  if (text.back() == '.') {
    text.pop_back();
  }
  return text == "-0" ? "0" : text;
}

std::string svg_text(std::string_view classes, Vec2 at, std::string_view text, Anchor anchor) {
  const std::string_view side = anchor == Anchor::start    ? ""
                                : anchor == Anchor::middle ? " text-anchor=\"middle\""
                                                           : " text-anchor=\"end\"";
  return fmt::format("<text class=\"{}\" x=\"{}\" y=\"{}\"{}>{}</text>\n", classes,
                     svg_number(at.x), svg_number(at.y), side, escaped(text));
}

std::string svg_rect(std::string_view classes, Vec2 at, SvgSize size, std::string_view more) {
  return fmt::format("<rect class=\"{}\" x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\"{}{}/>\n",
                     classes, svg_number(at.x), svg_number(at.y), svg_number(size.width),
                     svg_number(size.height), more.empty() ? "" : " ", more);
}

std::string svg_line(std::string_view classes, Vec2 from, Vec2 to) {
  return fmt::format("<line class=\"{}\" x1=\"{}\" y1=\"{}\" x2=\"{}\" y2=\"{}\"/>\n", classes,
                     svg_number(from.x), svg_number(from.y), svg_number(to.x), svg_number(to.y));
}

std::string svg_circle(std::string_view classes, Vec2 at, double radius, std::string_view more) {
  return fmt::format("<circle class=\"{}\" cx=\"{}\" cy=\"{}\" r=\"{}\"{}{}/>\n", classes,
                     svg_number(at.x), svg_number(at.y), svg_number(radius),
                     more.empty() ? "" : " ", more);
}

std::string svg_polygon(std::string_view classes, std::span<const Vec2> points,
                        std::string_view more) {
  return with_points("polygon", classes, points, more);
}

std::string svg_polyline(std::string_view classes, std::span<const Vec2> points,
                         std::string_view more) {
  return with_points("polyline", classes, points, more);
}

std::string svg_star(Vec2 at, double radius) {
  constexpr int rays = 8;
  std::vector<Vec2> points;
  for (int k = 0; k < 2 * rays; ++k) {
    const double angle = std::numbers::pi * k / rays;
    const double r = k % 2 == 0 ? radius : 0.45 * radius;
    points.push_back(at + r * Vec2{std::cos(angle), std::sin(angle)});
  }
  return svg_polygon("star", points);
}

std::string svg_part(Vec2 at, SvgSize size, std::string_view body) {
  return fmt::format("<svg x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\">\n{}</svg>\n",
                     svg_number(at.x), svg_number(at.y), svg_number(size.width),
                     svg_number(size.height), body);
}

std::string svg_document(SvgSize size, std::string_view title, std::string_view body) {
  return fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" class=\"saca\" role=\"img\" width=\"{0}\" "
      "height=\"{1}\" viewBox=\"0 0 {0} {1}\">\n<title>{2}</title>\n<style>\n{3}</style>\n"
      "<defs>\n{4}</defs>\n{5}</svg>\n",
      svg_number(size.width), svg_number(size.height), escaped(title), svg_style, svg_patterns,
      body);
}

std::string svg_in_page(SvgSize size, std::string_view title, std::string_view body) {
  return fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" class=\"saca\" role=\"img\" width=\"{0}\" "
      "height=\"{1}\" viewBox=\"0 0 {0} {1}\">\n<title>{2}</title>\n{3}</svg>\n",
      svg_number(size.width), svg_number(size.height), escaped(title), body);
}

double text_width(std::string_view text, double font_size) {
  double width = 0.0;
  for (const char c : text) {
    width += continues(c) ? 0.0 : character_width(c);
  }
  return width * font_size;
}

std::string fitted(std::string_view text, double font_size, double width) {
  if (text_width(text, font_size) <= width) {
    return std::string(text);
  }
  while (!text.empty() && text_width(text, font_size) + font_size > width) {
    std::size_t last = text.size() - 1;
    while (last > 0 && continues(text[last])) {
      --last;
    }
    text = text.substr(0, last);
  }
  while (!text.empty() && (text.back() == ' ' || text.back() == ',')) {
    text.remove_suffix(1);
  }
  return std::string(text) + std::string(ellipsis);
}

std::vector<double> round_ticks(double low, double high, int at_most) {
  expects(std::isfinite(low) && std::isfinite(high) && low < high, "low < high, both finite");
  expects(at_most >= 2, "at_most >= 2");
  double step = std::pow(10.0, std::floor(std::log10((high - low) / at_most)));
  constexpr std::array factors{2.0, 2.5, 2.0};  // 1, 2, 5, 10
  const auto last = [&] { return std::lround(std::floor(high / step + 1e-9)); };
  const auto first = [&] { return std::lround(std::ceil(low / step - 1e-9)); };
  for (std::size_t k = 0; last() - first() + 1 > at_most; ++k) {
    step *= factors.at(k % factors.size());
  }
  std::vector<double> ticks;
  for (long k = first(); k <= last(); ++k) {
    ticks.push_back(static_cast<double>(k) * step);
  }
  return ticks;
}

}  // namespace saca::report
