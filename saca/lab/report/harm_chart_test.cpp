#include "saca/lab/report/harm_chart.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <stdexcept>

#include "saca/base/core/file.h"
#include "saca/base/core/units.h"
#include "saca/lab/prepare/harm_file.h"
#include "saca/lab/report/xml_for_test.h"

namespace saca::report::harm_chart_test {
namespace {

const HarmRisk& of(const std::vector<HarmRisk>& risks, const std::string& key) {
  for (const HarmRisk& risk : risks) {
    if (risk.key == key) {
      return risk;
    }
  }
  throw std::runtime_error("no risk " + key);
}

/// The printed curve less its value at rest, over what is left: data/harm.toml.
double above_rest(double intercept, double exponent) {
  const auto logistic = [](double z) { return 1.0 / (1.0 + std::exp(-z)); };
  return (logistic(intercept + exponent) - logistic(intercept)) / (1.0 - logistic(intercept));
}

TEST(HarmChart, CurvesAreThoseOfTheSources) {
  const auto model = prepare::read_harm("data/harm.toml").value();
  const auto risks = injury_risks(model, {0.0, from_kmh(50.0)});
  EXPECT_EQ(risks.size(), 9U);
  for (const HarmRisk& risk : risks) {
    EXPECT_EQ(risk.values[0], 0.0) << risk.key;
    EXPECT_FALSE(risk.source.empty()) << risk.key;
  }
  // Rosen, Sander 2009: 1 / (1 + exp(6.9 - 0.090 v)), v in km/h.
  EXPECT_NEAR(of(risks, "pedestrian_killed").values[1], above_rest(-6.9, 0.090 * 50.0), 1e-12);
  // LR4S: -4.457 + 0.177 delta-v in m/s, + 0.244 at the side.
  EXPECT_NEAR(of(risks, "occupant_side_severe").values[1],
              above_rest(-4.457 + 0.244, 0.177 * 50.0 / 3.6), 1e-12);
  // Lubbe et al. 2022: 10 % of pedestrians at 29 km/h, before what is there at rest is taken off.
  const auto at_29 = injury_risks(model, {from_kmh(29.0)});
  const double base = 1.0 / (1.0 + std::exp(4.807));
  EXPECT_NEAR(of(at_29, "pedestrian_severe").values[0], (0.1 - base) / (1.0 - base), 1e-4);
}

TEST(HarmChart, HarmIsWeightedRisk) {
  const auto model = prepare::read_harm("data/harm.toml").value();
  const std::vector<double> speeds{from_kmh(70.0)};
  const auto risks = injury_risks(model, speeds);
  const auto harms = person_harms(model, speeds);
  EXPECT_NEAR(
      of(harms, "pedestrian_harm").values[0],
      of(risks, "pedestrian_severe").values[0] + 4.0 * of(risks, "pedestrian_killed").values[0],
      1e-12);
  EXPECT_NEAR(of(harms, "occupant_rear_harm").values[0],
              (1.0 + 4.0 * 0.16) * of(risks, "occupant_rear_severe").values[0], 1e-12);
}

TEST(HarmChart, ThePictureShowsAllCurvesWithTheirSources) {
  const auto model = prepare::read_harm("data/harm.toml").value();
  const auto all = xml_elements(harm_svg(model));
  int curves = 0;
  for (const XmlElement& element : all) {
    curves += element.name == "polyline" && element.attributes.at("class").starts_with("curve ");
  }
  EXPECT_EQ(curves, 3 + 6 + 6);
  EXPECT_TRUE(says(all, "pedestrian: killed"));
  EXPECT_TRUE(says(all, "Rosen, Sander 2009 (GIDAS, adults, car fronts)")) << "not cut short";
}

/// The curves of a plot's title, read back from a picture: pixels to values by the frame's grid,
/// whose outermost lines stand at the ends of the axes.
struct PlotRead {
  Vec2 low_px;   ///< where both axes begin
  Vec2 high_px;  ///< the last lines of the grid
  std::vector<std::vector<Vec2>> curves_px;
};
PlotRead read_plot(const std::vector<XmlElement>& all, const std::string& title) {
  auto at = std::find_if(all.begin(), all.end(), [&](const XmlElement& each) {
    return each.name == "text" && each.text == title;
  });
  if (at == all.end()) {
    throw std::runtime_error("no plot " + title);
  }
  PlotRead plot{.low_px = {1e9, -1e9}, .high_px = {-1e9, 1e9}, .curves_px = {}};
  for (++at; at != all.end(); ++at) {
    const auto has = at->attributes.find("class");
    const std::string looks = has == at->attributes.end() ? "" : has->second;
    if (looks == "title") {
      break;
    }
    if (looks == "grid") {
      plot.low_px = {std::min(plot.low_px.x, xml_number(*at, "x1")),
                     std::max(plot.low_px.y, xml_number(*at, "y2"))};
      plot.high_px = {std::max(plot.high_px.x, xml_number(*at, "x2")),
                      std::min(plot.high_px.y, xml_number(*at, "y1"))};
    }
    if (at->name == "polyline" && looks.starts_with("curve ")) {
      plot.curves_px.push_back(xml_points(*at));
    }
  }
  return plot;
}

// docs/harm.svg is what people look at (`saca harm --svg` writes it): its curves are those of the
// sources, read back from the pixels.
TEST(HarmChart, ThePictureInTheDocumentsShowsTheSources) {
  const auto all = xml_elements(read_file("docs/harm.svg").value());
  const PlotRead plot = read_plot(all, "People outside vehicles");
  constexpr double most_kmh = 100.0;  // the axis' end, as its last number says
  EXPECT_TRUE(says(all, "100"));
  const auto holds = [&](const std::function<double(double)>& risk) {
    return std::any_of(
        plot.curves_px.begin(), plot.curves_px.end(), [&](const std::vector<Vec2>& curve) {
          return std::all_of(curve.begin(), curve.end(), [&](Vec2 p) {
            const double kmh = most_kmh * (p.x - plot.low_px.x) / (plot.high_px.x - plot.low_px.x);
            const double shown = (plot.low_px.y - p.y) / (plot.low_px.y - plot.high_px.y);
            return std::abs(shown - risk(kmh)) < 1e-3;  // a quarter of a pixel
          });
        });
  };
  EXPECT_FALSE(plot.curves_px.empty());
  EXPECT_TRUE(holds([](double kmh) { return above_rest(-6.9, 0.090 * kmh); })) << "Rosen, Sander";
  EXPECT_FALSE(holds([](double kmh) { return above_rest(-6.9, 0.095 * kmh); })) << "it can tell";
  const PlotRead occupants = read_plot(all, "Occupants of vehicles");
  EXPECT_EQ(occupants.curves_px.size(), 3U);
  EXPECT_EQ(harm_svg(prepare::read_harm("data/harm.toml").value()),
            read_file("docs/harm.svg").value())
      << "saca harm --svg docs/harm.svg makes it anew";
}

}  // namespace
}  // namespace saca::report::harm_chart_test
