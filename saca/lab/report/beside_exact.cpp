#include "saca/lab/report/beside_exact.h"

#include <fmt/core.h>

#include <cmath>
#include <utility>

#include "saca/base/core/contract.h"
#include "saca/base/core/units.h"
#include "saca/lab/report/value_map.h"
#include "saca/lab/report/value_png.h"

namespace saca::report {
namespace {

constexpr MapRange beside_x{-45.0, 12.0};
constexpr MapRange beside_y{-10.0, 10.0};
constexpr RasterSize beside_raster{285, 100};
constexpr ValueScale value_scale{-12.0, 4.0};  // [m]
constexpr ValueScale error_scale{-2.0, 2.0};   // [m]
constexpr double told_to = 8.0;                // [m]

ValuePicture picture(const BesideExact& page, double speed, ValueMap map, const std::string& title,
                     const ValueScale& scale, const std::string& words) {
  const auto axis = [](const std::string& name, const MapRange& range) {
    return PlotAxis{.name = name, .unit = "m", .low = range.low, .high = range.high};
  };
  return {.map = std::move(map),
          .scale = scale,
          .title = title,
          .lines = {fmt::format("{:.0f} m/s, course {:.0f} deg", speed, to_degrees(page.course))},
          .x = axis("x", beside_x),
          .y = axis("y", beside_y),
          .value_words = words,
          .outline = page.outline,
          .course = page.course};
}

}  // namespace

Result<std::string> beside_exact_png(const BesideExact& page, const danger::ValueAt& exact,
                                     const danger::ValueAt& other) {
  expects(!page.speeds.empty(), "a speed at least");
  std::vector<ValuePicture> all;
  for (const double speed : page.speeds) {
    const auto map_of = [&](const danger::ValueAt& value) {
      return value_map(value, beside_x, beside_y, beside_raster.columns, beside_raster.rows,
                       {0.0, 0.0, page.course, speed});
    };
    const ValueMap solved = map_of(exact);
    const ValueMap told = map_of(other);
    ValueMap error = told;
    for (std::size_t i = 0; i < error.values.size(); ++i) {
      error.values[i] -= solved.values[i];
      const bool matters = std::abs(static_cast<double>(solved.values[i])) < told_to;
      error.inside[i] = matters && solved.inside[i] != 0 && told.inside[i] != 0 ? 1 : 0;
    }
    const std::string words = "value [m], unsafe from 0";
    all.push_back(picture(page, speed, solved, "Exact: " + page.exact_name, value_scale, words));
    all.push_back(picture(page, speed, told, "Learnt: " + page.other_name, value_scale, words));
    all.push_back(picture(page, speed, std::move(error), "Learnt less exact", error_scale,
                          "difference [m], too careful above 0"));
  }
  return value_png(all, 3);
}

}  // namespace saca::report
