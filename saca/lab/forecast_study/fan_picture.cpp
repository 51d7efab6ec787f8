#include "saca/lab/forecast_study/fan_picture.h"

#include <fmt/core.h>

#include <algorithm>

namespace saca::forecast_study {

report::SceneView fan_view(const eval::ForecastFan& fan, const std::string& who,
                           const std::string& encounter) {
  const auto likely = std::count_if(fan.ways.begin(), fan.ways.end(),
                                    [](const auto& way) { return way.probability >= 0.01; });
  report::SceneView view{
      .title = fmt::format("{}: what may come of {}, and what came", encounter, who),
      .lines = {fmt::format(
                    "At {:.1f} s {} likely, the thicker the likelier; on each, after 1, 2 and "
                    "3 s, where it is with a half.",
                    fan.seen.time, likely == 1 ? "1 way is" : fmt::format("{} ways are", likely)),
                "Bodies are where they truly were, every quarter of a second."},
      .badge = {},
      .policy = {},
      .scene = fan.seen,
      .ego = fan.ego,
      .others = fan.others,
      .contacts = {},
      .fan = {},
      .shown_P = {}};
  for (const eval::ForecastFan::Way& way : fan.ways) {
    view.fan.push_back({way.probability, way.forecast.track, way.forecast.spread});
  }
  return view;
}

std::string fan_picture(const eval::ForecastFan& fan, const std::string& who,
                        const std::string& encounter) {
  constexpr report::SvgSize size{760.0, 250.0};
  return report::scene_svg(fan_view(fan, who, encounter), size);
}

}  // namespace saca::forecast_study
