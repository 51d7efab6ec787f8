#include "saca/lab/report/value_png.h"

#include <cairo.h>
#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <numbers>
#include <span>

#include "saca/base/core/contract.h"
#include "saca/lab/report/svg.h"

namespace saca::report {
namespace {

constexpr int plot_width = 760;  // [px], as all below
constexpr int least_plot_height = 280;
constexpr int most_plot_height = 760;
constexpr double left_room = 78.0;
constexpr double right_room = 128.0;
constexpr double bottom_room = 58.0;
constexpr double top_room = 46.0;  // with the title, without lines
constexpr double text_line = 18.0;
constexpr double bar_width = 20.0;
constexpr double tick_length = 5.0;
constexpr Rgb ink{23, 32, 42};
constexpr Rgb soft{82, 93, 106};
constexpr Rgb obstacle_red{230, 0, 0};
constexpr Rgb paper{255, 255, 255};
constexpr Rgb unknown{222, 226, 230};

using Surface = std::unique_ptr<cairo_surface_t, decltype(&cairo_surface_destroy)>;
using Context = std::unique_ptr<cairo_t, decltype(&cairo_destroy)>;

Surface new_surface(int width, int height) {
  return {cairo_image_surface_create(CAIRO_FORMAT_ARGB32, width, height), cairo_surface_destroy};
}

/// The colours of a map; clear outside.
Surface raster(const ValueMap& map, const ValueScale& scale) {
  Surface surface = new_surface(map.columns, map.rows);
  if (cairo_surface_status(surface.get()) != CAIRO_STATUS_SUCCESS) {
    return surface;
  }
  cairo_surface_flush(surface.get());
  unsigned char* const bytes = cairo_image_surface_get_data(surface.get());
  const int stride = cairo_image_surface_get_stride(surface.get());
  for (int row = 0; row < map.rows; ++row) {
    unsigned char* const line = bytes + static_cast<std::ptrdiff_t>(stride) * (map.rows - 1 - row);
    for (int column = 0; column < map.columns; ++column) {
      const std::size_t i = map.index(column, row);
      const Rgb colour = colour_of(static_cast<double>(map.values[i]), scale);
      const std::uint32_t pixel = map.inside[i] == 0
                                      ? 0U
                                      : 0xff000000U | std::uint32_t{colour.red} << 16U |
                                            std::uint32_t{colour.green} << 8U | colour.blue;
      std::copy_n(reinterpret_cast<const unsigned char*>(&pixel), sizeof pixel,  // NOLINT
                  line + static_cast<std::ptrdiff_t>(column) * 4);
    }
  }
  cairo_surface_mark_dirty(surface.get());
  return surface;
}

Result<std::string> png_bytes(cairo_surface_t* surface) {
  std::string bytes;
  const auto append = [](void* to, const unsigned char* data, unsigned length) {
    static_cast<std::string*>(to)->append(reinterpret_cast<const char*>(data), length);  // NOLINT
    return CAIRO_STATUS_SUCCESS;
  };
  const cairo_status_t status = cairo_surface_write_to_png_stream(surface, append, &bytes);
  if (status != CAIRO_STATUS_SUCCESS) {
    return Error{Error::Code::unwritable,
                 fmt::format("picture: cannot be made: {}", cairo_status_to_string(status))};
  }
  return bytes;
}

enum class Align { left, middle, right };

struct TextStyle {
  double size = 12.0;  // [px]
  Rgb rgb = ink;
  Align align = Align::left;
  cairo_font_weight_t weight = CAIRO_FONT_WEIGHT_NORMAL;
  double turned = 0.0;   // [rad]
  double outline = 0.0;  // width of the letters' outline [px]; 0: filled
};

/// Cairo with colours and texts as they are needed here.
class Canvas {
 public:
  explicit Canvas(cairo_surface_t* surface) : cairo_(cairo_create(surface), cairo_destroy) {
    cairo_set_line_join(cairo(), CAIRO_LINE_JOIN_ROUND);
    cairo_set_line_cap(cairo(), CAIRO_LINE_CAP_ROUND);
  }
  [[nodiscard]] cairo_t* cairo() const { return cairo_.get(); }

  void colour(const Rgb& rgb) const {
    cairo_set_source_rgb(cairo(), rgb.red / 255.0, rgb.green / 255.0, rgb.blue / 255.0);
  }
  void rect(Vec2 at, SvgSize size, const Rgb& rgb) const {
    colour(rgb);
    cairo_rectangle(cairo(), at.x, at.y, size.width, size.height);
    cairo_fill(cairo());
  }
  void line(Vec2 from, Vec2 to, double width, const Rgb& rgb) const {
    colour(rgb);
    cairo_set_line_width(cairo(), width);
    cairo_move_to(cairo(), from.x, from.y);
    cairo_line_to(cairo(), to.x, to.y);
    cairo_stroke(cairo());
  }
  void text(Vec2 at, const std::string& words, const TextStyle& how) const {
    colour(how.rgb);
    cairo_select_font_face(cairo(), "sans-serif", CAIRO_FONT_SLANT_NORMAL, how.weight);
    cairo_set_font_size(cairo(), how.size);
    cairo_text_extents_t extents;
    cairo_text_extents(cairo(), words.c_str(), &extents);
    const double share = how.align == Align::left ? 0.0 : how.align == Align::middle ? 0.5 : 1.0;
    cairo_save(cairo());
    cairo_translate(cairo(), at.x, at.y);
    cairo_rotate(cairo(), how.turned);
    cairo_move_to(cairo(), -share * extents.x_advance, 0.0);
    if (how.outline > 0.0) {
      cairo_text_path(cairo(), words.c_str());
      cairo_set_line_width(cairo(), how.outline);
      cairo_stroke(cairo());
    } else {
      cairo_show_text(cairo(), words.c_str());
    }
    cairo_restore(cairo());
  }
  /// Once in white and wide, so that it stands out from any colour, then in its own.
  void path_with_halo(std::span<const Vec2> points, double width, const Rgb& rgb) const {
    for (const bool halo : {true, false}) {
      colour(halo ? paper : rgb);
      cairo_set_line_width(cairo(), halo ? width + 2.5 : width);
      for (const Vec2 p : points) {
        cairo_line_to(cairo(), p.x, p.y);
      }
      cairo_close_path(cairo());
      cairo_stroke(cairo());
    }
  }

 private:
  Context cairo_;
};

std::string number_words(double value) {
  return fmt::format("{:.6g}", std::abs(value) < 1e-12 ? 0.0 : value);
}

/// Where things stand in the picture.
struct ValueLayout {
  PlotArea plot;  ///< in the units that are read
  const ValueMap* map;

  /// From the map's coordinates.
  [[nodiscard]] Vec2 px(Vec2 p) const {
    const double across = (p.x - map->x.low) / (map->x.high - map->x.low);
    const double up = (p.y - map->y.low) / (map->y.high - map->y.low);
    return {plot.at.x + across * plot.size.width, plot.at.y + (1.0 - up) * plot.size.height};
  }
};

void draw_map(const Canvas& canvas, const ValueLayout& layout, const ValuePicture& picture) {
  const PlotArea& plot = layout.plot;
  canvas.rect(plot.at, plot.size, unknown);
  const Surface image = raster(picture.map, picture.scale);
  cairo_t* const cairo = canvas.cairo();
  cairo_save(cairo);
  cairo_rectangle(cairo, plot.at.x, plot.at.y, plot.size.width, plot.size.height);
  cairo_clip(cairo);
  cairo_save(cairo);
  cairo_translate(cairo, plot.at.x, plot.at.y);
  cairo_scale(cairo, plot.size.width / picture.map.columns, plot.size.height / picture.map.rows);
  cairo_set_source_surface(cairo, image.get(), 0.0, 0.0);
  cairo_paint(cairo);
  cairo_restore(cairo);
  canvas.colour(ink);
  cairo_set_line_width(cairo, 2.0);
  for (const auto& [from, to] : zero_line(picture.map)) {
    const Vec2 a = layout.px(from);
    const Vec2 b = layout.px(to);
    cairo_move_to(cairo, a.x, a.y);
    cairo_line_to(cairo, b.x, b.y);
  }
  cairo_stroke(cairo);
  std::vector<Vec2> outline;
  for (const Vec2 p : picture.outline) {
    outline.push_back(layout.px(p));
  }
  if (!outline.empty()) {
    canvas.path_with_halo(outline, 2.5, obstacle_red);
  }
  cairo_restore(cairo);
}

/// The ego's way, in the upper left corner.
void draw_arrow(const Canvas& canvas, const PlotArea& plot, double course) {
  constexpr double half_length = 20.0;
  constexpr double head = 8.0;
  const Vec2 middle = plot.at + Vec2{38.0, 38.0};
  const Vec2 way{std::cos(course), -std::sin(course)};
  const Vec2 tip = middle + half_length * way;
  for (const bool halo : {true, false}) {
    const double width = halo ? 5.5 : 2.5;
    const Rgb& colour = halo ? paper : ink;
    canvas.line(middle - half_length * way, tip, width, colour);
    for (const double side : {0.8, -0.8}) {
      const double angle = course + std::numbers::pi + 0.6 * side;
      canvas.line(tip, tip + head * Vec2{std::cos(angle), -std::sin(angle)}, width, colour);
    }
  }
  const Vec2 beside = plot.at + Vec2{66.0, 42.0};
  constexpr double text_halo = 3.0;
  for (const double width : {text_halo, 0.0}) {
    canvas.text(beside, "ego's course", {.rgb = width > 0.0 ? paper : ink, .outline = width});
  }
}

void draw_axes(const Canvas& canvas, const PlotArea& plot) {
  const double bottom = plot.at.y + plot.size.height;
  const double right = plot.at.x + plot.size.width;
  canvas.line(plot.at, {right, plot.at.y}, 1.0, soft);
  canvas.line({right, plot.at.y}, {right, bottom}, 1.0, soft);
  canvas.line({right, bottom}, {plot.at.x, bottom}, 1.0, soft);
  canvas.line({plot.at.x, bottom}, plot.at, 1.0, soft);
  for (const double value : round_ticks(plot.x.low, plot.x.high, 9)) {
    const double x = plot.x_px(value);
    canvas.line({x, bottom}, {x, bottom + tick_length}, 1.0, soft);
    canvas.text({x, bottom + 20.0}, number_words(value), {.align = Align::middle});
  }
  for (const double value : round_ticks(plot.y.low, plot.y.high, 8)) {
    const double y = plot.y_px(value);
    canvas.line({plot.at.x - tick_length, y}, {plot.at.x, y}, 1.0, soft);
    canvas.text({plot.at.x - 9.0, y + 4.0}, number_words(value), {.align = Align::right});
  }
  canvas.text({plot.at.x + 0.5 * plot.size.width, bottom + 42.0}, axis_words(plot.x),
              {.size = 13.0, .align = Align::middle, .weight = CAIRO_FONT_WEIGHT_BOLD});
  canvas.text({plot.at.x - 52.0, plot.at.y + 0.5 * plot.size.height}, axis_words(plot.y),
              {.size = 13.0,
               .align = Align::middle,
               .weight = CAIRO_FONT_WEIGHT_BOLD,
               .turned = -0.5 * std::numbers::pi});
}

/// Both sides of 0 take half of the bar.
void draw_bar(const Canvas& canvas, const PlotArea& plot, const ValuePicture& picture) {
  const ValueScale& scale = picture.scale;
  const Vec2 at{plot.at.x + plot.size.width + 26.0, plot.at.y};
  const auto height = static_cast<int>(plot.size.height);
  const double half = 0.5 * height;
  for (int i = 0; i < height; ++i) {
    const double up = 1.0 - (i + 0.5) / half;  // 1: top; -1: bottom
    const double value = up >= 0.0 ? up * scale.highest : -up * scale.lowest;
    canvas.rect({at.x, at.y + i}, {bar_width, 1.0}, colour_of(value, scale));
  }
  for (const int quarter : {-4, -3, -2, -1, 0, 1, 2, 3, 4}) {
    const double share = 0.25 * quarter;
    const double value = share >= 0.0 ? share * scale.highest : -share * scale.lowest;
    const double y = at.y + half * (1.0 - share);
    canvas.line({at.x + bar_width, y}, {at.x + bar_width + tick_length, y}, 1.0, soft);
    canvas.text({at.x + bar_width + 9.0, y + 4.0}, number_words(value), {});
  }
  canvas.line({at.x, at.y + half}, {at.x + bar_width, at.y + half}, 2.0, ink);
  canvas.text({at.x + bar_width + 60.0, at.y + half}, picture.value_words,
              {.size = 13.0,
               .align = Align::middle,
               .weight = CAIRO_FONT_WEIGHT_BOLD,
               .turned = 0.5 * std::numbers::pi});
}

double top_of_plot(const ValuePicture& picture) {
  return top_room + text_line * static_cast<double>(picture.lines.size());
}

SvgSize picture_size(const ValuePicture& picture) {
  return {left_room + plot_width + right_room,
          top_of_plot(picture) + raster_size(picture.x, picture.y).rows + bottom_room};
}

/// With its upper left corner at the canvas' origin.
void draw_picture(const Canvas& canvas, const ValuePicture& picture) {
  const RasterSize size = raster_size(picture.x, picture.y);
  const ValueLayout layout{.plot = {.at = {left_room, top_of_plot(picture)},
                                    .size = {double{plot_width}, static_cast<double>(size.rows)},
                                    .x = picture.x,
                                    .y = picture.y},
                           .map = &picture.map};
  canvas.text({left_room, 28.0}, picture.title, {.size = 18.0, .weight = CAIRO_FONT_WEIGHT_BOLD});
  double y = 28.0 + text_line;
  for (const std::string& line : picture.lines) {
    canvas.text({left_room, y}, line, {.size = 13.0, .rgb = soft});
    y += text_line;
  }
  draw_map(canvas, layout, picture);
  draw_axes(canvas, layout.plot);
  if (picture.course) {
    draw_arrow(canvas, layout.plot, *picture.course);
  }
  draw_bar(canvas, layout.plot, picture);
}

}  // namespace

RasterSize raster_size(const PlotAxis& x, const PlotAxis& y) {
  expects(x.low < x.high && y.low < y.high, "low < high");
  const double wanted =
      x.unit == y.unit ? plot_width * (y.high - y.low) / (x.high - x.low) : 0.62 * plot_width;
  const double height = std::clamp(wanted, double{least_plot_height}, double{most_plot_height});
  return {plot_width, static_cast<int>(std::lround(height))};
}

Result<std::string> value_png(std::span<const ValuePicture> pictures, int columns) {
  expects(!pictures.empty() && columns >= 1, "a picture, and a column");
  double width = 0.0;
  double height = 0.0;
  for (const ValuePicture& picture : pictures) {
    const SvgSize size = picture_size(picture);
    width = std::max(width, size.width);
    height = std::max(height, size.height);
  }
  const int count = static_cast<int>(pictures.size());
  const int rows = (count + columns - 1) / columns;
  const SvgSize all{width * std::min(columns, count), height * rows};
  const Surface surface = new_surface(static_cast<int>(all.width), static_cast<int>(all.height));
  const Canvas canvas(surface.get());
  canvas.rect({0.0, 0.0}, all, paper);
  for (int i = 0; i < count; ++i) {
    cairo_save(canvas.cairo());
    const int row = i / columns;
    cairo_translate(canvas.cairo(), width * (i % columns), height * row);
    draw_picture(canvas, pictures[static_cast<std::size_t>(i)]);
    cairo_restore(canvas.cairo());
  }
  cairo_surface_flush(surface.get());
  return png_bytes(surface.get());
}

Result<std::string> value_png(const ValuePicture& picture) {
  return value_png({&picture, 1}, 1);
}

}  // namespace saca::report
