#include "saca/lab/report/intention_chart.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <string_view>

#include "saca/base/core/contract.h"
#include "saca/lab/report/plot_axes.h"
#include "saca/thinking/intent/intention.h"

namespace saca::report {
namespace {

constexpr double sample_left = axis_room_left;
constexpr double sample_width = 480.0;
constexpr double sample_right = 12.0;
constexpr double sample_gap = 12.0;
constexpr double sample_head = 22.0;
constexpr double sample_line = 15.0;
constexpr double place_height = 92.0;
constexpr double speed_height = 74.0;
constexpr double pull_height = 88.0;
constexpr double label_height = 13.0;
constexpr double belief_height = 44.0;
constexpr double usual_lane = 3.5;  // [m]: where no width is known

/// Class of an area in an intention's colour: "i0" to "i5".
std::string intention_area(std::size_t intention) {
  return fmt::format("i{}", intention);
}

std::string_view letters(std::size_t intention) {
  return intent::name(static_cast<intent::Intention>(intention));
}

void expect_fitting(const IntentionSample& sample) {
  const std::size_t frames = sample.seen.size();
  expects(frames > 0, "a sample has observations");
  expects(sample.step > 0.0, "step > 0");
  expects(sample.labels.size() == frames && sample.scored.size() == frames,
          "a label, and whether it is scored, for each observation");
  expects(std::all_of(sample.labels.begin(), sample.labels.end(),
                      [](std::size_t label) { return label < charted_intentions; }),
          "labels are six vehicles' intentions");
  for (const IntentionBand& band : sample.bands) {
    expects(band.shares.size() == frames, "a belief for each observation");
  }
}

struct Range {
  double low = 0.0;
  double high = 1.0;
};

/// That of the finite numbers, and a little more; at least so wide.
Range range_of(const std::vector<double>& values, double least) {
  double low = std::numeric_limits<double>::infinity();
  double high = -low;
  for (const double value : values) {
    if (std::isfinite(value)) {
      low = std::min(low, value);
      high = std::max(high, value);
    }
  }
  if (!(low <= high)) {
    return {-0.5 * least, 0.5 * least};
  }
  const double more = std::max(0.08 * (high - low), 0.5 * (least - (high - low)));
  return {low - more, high + more};
}

/// Lines through the known values; where one is not known they break.
std::string known_lines(const PlotArea& area, const std::vector<double>& values, double step,
                        std::string_view classes) {
  std::string out;
  std::vector<Vec2> points;
  const auto flush = [&] {
    if (points.size() > 1) {
      out += svg_polyline(classes, points);
    }
    points.clear();
  };
  for (std::size_t t = 0; t < values.size(); ++t) {
    if (std::isfinite(values[t])) {
      points.push_back(area.px(static_cast<double>(t) * step, values[t]));
    } else {
      flush();
    }
  }
  flush();
  return out;
}

/// Ticks and name at the left only: panels share the axis of time.
std::string panel(const PlotArea& area) {
  return plot_grid(area) + plot_y_axis(area);
}

std::vector<double> column(const std::vector<intent::Observation>& seen,
                           double intent::Observation::*value) {
  std::vector<double> values;
  values.reserve(seen.size());
  for (const intent::Observation& one : seen) {
    values.push_back(one.*value);
  }
  return values;
}

double lane_width_of(const std::vector<intent::Observation>& seen) {
  std::vector<double> widths;
  for (const intent::Observation& one : seen) {
    if (one.lane_width > 0.0) {
      widths.push_back(one.lane_width);
    }
  }
  if (widths.empty()) {
    return usual_lane;
  }
  const auto middle = widths.begin() + static_cast<std::ptrdiff_t>(widths.size() / 2);
  std::nth_element(widths.begin(), middle, widths.end());
  return *middle;
}

std::string lane_bounds(const PlotArea& area, double lane_width) {
  std::string out;
  const auto first = static_cast<int>(std::ceil(area.y.low / lane_width - 0.5));
  const auto last = static_cast<int>(std::floor(area.y.high / lane_width - 0.5));
  for (int k = first; k <= last; ++k) {
    const double y = area.y_px((k + 0.5) * lane_width);
    out += svg_line("curve dash stroke-grey", {area.at.x, y}, {area.at.x + area.size.width, y});
  }
  return out;
}

/// Runs of equal labels as rectangles, each half a step wider than its frames.
std::string label_band(const IntentionSample& sample, const PlotArea& area) {
  std::string out;
  for (std::size_t begin = 0; begin < sample.labels.size();) {
    std::size_t end = begin + 1;
    while (end < sample.labels.size() && sample.labels[end] == sample.labels[begin] &&
           sample.scored[end] == sample.scored[begin]) {
      ++end;
    }
    const double from = area.x_px((static_cast<double>(begin) - 0.5) * sample.step);
    const double to = area.x_px((static_cast<double>(end) - 0.5) * sample.step);
    out += svg_rect(intention_area(sample.labels[begin]) + (sample.scored[begin] ? "" : " faded"),
                    {from, area.at.y}, {to - from, area.size.height});
    begin = end;
  }
  return out;
}

/// One area for each intention that is ever believed in, on top of the ones before it.
std::string belief_band(const IntentionBand& band, double step, const PlotArea& area) {
  std::string out;
  std::vector<double> below(band.shares.size(), 0.0);
  constexpr double seen_at_all = 0.004;  // a fifth of a pixel
  for (std::size_t c = 0; c < charted_intentions; ++c) {
    std::vector<Vec2> outline;
    double most = 0.0;
    for (std::size_t t = 0; t < below.size(); ++t) {
      const double share = band.shares[t].at(c);
      expects(share >= 0.0 && share <= 1.0, "shares are in [0, 1]");
      most = std::max(most, share);
      outline.push_back(area.px(static_cast<double>(t) * step, std::min(1.0, below[t] + share)));
    }
    for (std::size_t t = below.size(); t-- > 0;) {
      outline.push_back(area.px(static_cast<double>(t) * step, std::min(1.0, below[t])));
      below[t] += band.shares[t].at(c);
    }
    out += most > seen_at_all ? svg_polygon(intention_area(c), outline) : "";
  }
  return out;
}

std::string row_name(const PlotArea& area, std::string_view name) {
  return svg_text("soft", {area.at.x - 7.0, area.at.y + 0.5 * area.size.height + 4.0}, name,
                  Anchor::end);
}

/// Where the next panel goes.
struct Layout {
  double y = 0.0;
  double duration = 1.0;

  PlotArea next(double height, const std::string& name, const std::string& unit, Range range) {
    PlotArea area{{sample_left, y},
                  {sample_width - sample_left - sample_right, height},
                  {"time", "s", 0.0, duration},
                  {name, unit, range.low, range.high}};
    y += height + sample_gap;
    return area;
  }
};

double panels_top(const IntentionSample& sample) {
  return sample_head + sample_line * static_cast<double>(sample.lines.size()) + 6.0;
}

std::string curves(const IntentionSample& sample, Layout& layout) {
  const std::vector<double> place = unwrapped_offsets(sample.seen);
  const double lane = lane_width_of(sample.seen);
  const PlotArea across = layout.next(place_height, "left", "m", range_of(place, 1.1 * lane));
  const std::vector<double> speed = column(sample.seen, &intent::Observation::speed);
  const PlotArea fast = layout.next(speed_height, "speed", "m/s", range_of(speed, 5.0));
  const std::vector<double> pull = column(sample.seen, &intent::Observation::acceleration);
  const PlotArea pulled = layout.next(pull_height, "accel.", "m/s\xC2\xB2", range_of(pull, 6.0));
  std::string out = panel(across) + lane_bounds(across, lane) +
                    known_lines(across, place, sample.step, "curve stroke-ink") + panel(fast) +
                    known_lines(fast, speed, sample.step, "curve stroke-ink") + panel(pulled);
  constexpr double braking = -2.0;  // [m/s^2]: the project's mark
  if (pulled.y.low < braking && braking < pulled.y.high) {
    out += svg_line("curve dash stroke-grey", pulled.px(0.0, braking),
                    pulled.px(layout.duration, braking));
  }
  return out + known_lines(pulled, pull, sample.step, "curve stroke-ink");
}

}  // namespace

std::vector<double> unwrapped_offsets(const std::vector<intent::Observation>& observations) {
  std::vector<double> places;
  places.reserve(observations.size());
  double beyond = 0.0;  // of the lanes that were crossed
  double last = std::nan("");
  for (const intent::Observation& one : observations) {
    if (std::isfinite(one.offset) && std::isfinite(last)) {
      const double lane = one.lane_width > 0.0 ? one.lane_width : usual_lane;
      beyond -= lane * std::round((one.offset - last) / lane);
    }
    last = std::isfinite(one.offset) ? one.offset : last;
    places.push_back(one.offset + beyond);
  }
  return places;
}

SvgSize intention_sample_size(const IntentionSample& sample) {
  const double panels = place_height + speed_height + pull_height + label_height +
                        belief_height * static_cast<double>(sample.bands.size()) +
                        sample_gap * (3.0 + static_cast<double>(sample.bands.size()));
  return {sample_width, panels_top(sample) + panels + axis_room_below};
}

std::string intention_sample_part(const IntentionSample& sample) {
  expect_fitting(sample);
  const double room = sample_width - sample_left - sample_right;
  std::string out = svg_text("title", {sample_left, 16.0}, fitted(sample.title, title_font, room));
  double y = sample_head;
  for (const std::string& line : sample.lines) {
    y += sample_line;
    out += svg_text("soft", {sample_left, y - 4.0}, fitted(line, usual_font, room));
  }
  Layout layout{panels_top(sample),
                std::max(1.0, static_cast<double>(sample.seen.size() - 1)) * sample.step};
  const double top = layout.y;
  out += curves(sample, layout);
  PlotArea area = layout.next(label_height, "", "", {});
  out += row_name(area, "did") + label_band(sample, area);
  for (const IntentionBand& band : sample.bands) {
    area = layout.next(belief_height, "", "", {});
    out += row_name(area, band.name) + belief_band(band, sample.step, area);
  }
  const double bottom = area.at.y + area.size.height;
  for (const double mark : sample.marks) {
    out += svg_line("mark-line", {area.x_px(mark), top}, {area.x_px(mark), bottom});
  }
  return out + plot_x_axis(area);
}

std::string intention_legend(Vec2 at) {
  constexpr std::array<std::string_view, charted_intentions> words{
      "maintain", "left", "right", "brake", "brake, left", "brake, right"};
  std::string out;
  double x = at.x;
  for (std::size_t c = 0; c < charted_intentions; ++c) {
    const std::string text = fmt::format("{} {}", letters(c), words.at(c));
    out += svg_rect(intention_area(c), {x, at.y + 4.0}, {12.0, 12.0});
    out += svg_text("", {x + 16.0, at.y + 14.0}, text);
    x += 34.0 + text_width(text, usual_font);
  }
  return out;
}

std::string intention_sample_svg(const IntentionSample& sample) {
  const SvgSize part = intention_sample_size(sample);
  const SvgSize size{std::max(part.width, intention_legend_size.width) + 16.0,
                     part.height + intention_legend_size.height + 12.0};
  return svg_document(size, sample.title,
                      svg_rect("card", {0.5, 0.5}, {size.width - 1.0, size.height - 1.0}) +
                          svg_part({8.0, 4.0}, part, intention_sample_part(sample)) +
                          intention_legend({12.0, part.height + 6.0}));
}

std::string confusion_svg(const ConfusionChart& chart) {
  constexpr double cell = 62.0;
  constexpr double name_room = 84.0;
  const double top = 40.0 + sample_line * static_cast<double>(chart.lines.size());
  const double side = cell * static_cast<double>(charted_intentions);
  const SvgSize size{name_room + side + 16.0, top + 34.0 + side + 14.0};
  std::string out =
      svg_rect("card", {0.5, 0.5}, {size.width - 1.0, size.height - 1.0}) +
      svg_text("title", {16.0, 24.0}, fitted(chart.title, title_font, size.width - 32.0));
  for (std::size_t i = 0; i < chart.lines.size(); ++i) {
    out += svg_text("soft", {16.0, 40.0 + sample_line * static_cast<double>(i)},
                    fitted(chart.lines[i], usual_font, size.width - 32.0));
  }
  out += svg_text("soft", {name_room + 0.5 * side, top + 8.0}, "predicted", Anchor::middle) +
         svg_text("soft", {16.0, top + 26.0}, "truth");
  for (std::size_t truth = 0; truth < charted_intentions; ++truth) {
    const auto& row = chart.counts.at(truth);
    const std::size_t all = std::accumulate(row.begin(), row.end(), std::size_t{0});
    const double y = top + 34.0 + cell * static_cast<double>(truth);
    const double x_of_name = name_room + cell * (static_cast<double>(truth) + 0.5);
    out += svg_text("strong", {x_of_name, top + 26.0}, letters(truth), Anchor::middle);
    out += svg_text("strong", {name_room - 8.0, y + 27.0}, letters(truth), Anchor::end);
    out += svg_text("soft", {name_room - 8.0, y + 43.0}, fmt::format("{}", all), Anchor::end);
    for (std::size_t predicted = 0; predicted < charted_intentions; ++predicted) {
      const Vec2 at{name_room + cell * static_cast<double>(predicted), y};
      const double share =
          all == 0 ? 0.0 : static_cast<double>(row.at(predicted)) / static_cast<double>(all);
      out += svg_rect("fill-blue", at, {cell, cell},
                      fmt::format("fill-opacity=\"{}\"", svg_number(0.9 * share)));
      out += svg_rect("frame", at, {cell, cell});
      if (row.at(predicted) > 0) {
        const std::string ink = share > 0.55 ? " on-dark" : "";
        out += svg_text("strong" + ink, at + Vec2{0.5 * cell, 28.0},
                        fmt::format("{:.1f} %", 100.0 * share), Anchor::middle);
        out += svg_text("soft" + ink, at + Vec2{0.5 * cell, 44.0},
                        fmt::format("{}", row.at(predicted)), Anchor::middle);
      }
    }
  }
  return svg_document(size, chart.title, out);
}

}  // namespace saca::report
