#include "saca/report/harm_chart.h"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "saca/core/file.h"
#include "saca/core/units.h"
#include "saca/report/xml_for_test.h"

namespace saca::report {
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
  const auto model = outcome::read_harm("data/harm.toml").value();
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
  const auto model = outcome::read_harm("data/harm.toml").value();
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
  const auto model = outcome::read_harm("data/harm.toml").value();
  const auto all = xml_elements(harm_svg(model));
  int curves = 0;
  for (const XmlElement& element : all) {
    curves += element.name == "polyline" && element.attributes.at("class").starts_with("curve ");
  }
  EXPECT_EQ(curves, 3 + 6 + 6);
  EXPECT_TRUE(says(all, "pedestrian: killed"));
  EXPECT_TRUE(says(all, "Rosen, Sander 2009 (GIDAS, adults, car fronts)")) << "not cut short";
}

TEST(HarmChart, ThePictureInTheDocumentsIsThisOne) {
  // docs/harm.svg is what `saca harm --svg` writes; it changes with data/harm.toml.
  const auto model = outcome::read_harm("data/harm.toml").value();
  EXPECT_EQ(read_file("docs/harm.svg").value(), harm_svg(model));
}

}  // namespace
}  // namespace saca::report
