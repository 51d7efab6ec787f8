#include "saca/lab/report/intention_chart.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <sstream>

#include "saca/base/core/contract.h"
#include "saca/lab/report/xml_for_test.h"

namespace saca::report::intention_chart_test {
namespace {

using testing::DoubleNear;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

intent::Observation at_offset(double offset, double lane_width = 3.5) {
  intent::Observation seen;
  seen.speed = 20.0;
  seen.offset = offset;
  seen.lane_width = lane_width;
  return seen;
}

IntentionSample small_sample() {
  IntentionSample sample;
  sample.title = "one";
  for (int t = 0; t < 8; ++t) {
    sample.seen.push_back(at_offset(0.1 * t));
  }
  sample.labels = {0, 0, 0, 1, 1, 1, 4, 4};
  sample.scored = {true, true, false, true, true, true, true, true};
  IntentionShares half{};
  half[0] = half[1] = 0.5;
  sample.bands = {{"now", std::vector<IntentionShares>(8, half)}};
  return sample;
}

std::vector<XmlElement> elements_of(const std::string& svg, const std::string& with_class) {
  std::vector<XmlElement> found;
  const XmlReader document(svg);
  for (const XmlElement& element : document.elements()) {
    const auto classes = element.attributes.find("class");
    if (classes != element.attributes.end() && classes->second == with_class) {
      found.push_back(element);
    }
  }
  return found;
}

TEST(UnwrappedOffsets, AJumpOfALaneIsNoWay) {
  const auto places = unwrapped_offsets(
      {at_offset(1.5), at_offset(1.7), at_offset(-1.6), at_offset(-1.4), at_offset(1.6)});
  EXPECT_THAT(places,
              ElementsAre(DoubleNear(1.5, 1e-9), DoubleNear(1.7, 1e-9), DoubleNear(1.9, 1e-9),
                          DoubleNear(2.1, 1e-9), DoubleNear(1.6, 1e-9)));
}

TEST(UnwrappedOffsets, MirrorAndBridgeWhatIsNotKnown) {
  const auto places =
      unwrapped_offsets({at_offset(-1.7), at_offset(std::nan("")), at_offset(1.6), at_offset(1.4)});
  EXPECT_NEAR(places[0], -1.7, 1e-9);
  EXPECT_TRUE(std::isnan(places[1]));
  EXPECT_NEAR(places[2], -1.9, 1e-9);
  EXPECT_NEAR(places[3], -2.1, 1e-9);
  EXPECT_TRUE(unwrapped_offsets({}).empty());
}

TEST(IntentionSample, HasOneRectanglePerRunOfLabels) {
  const std::string svg = intention_sample_svg(small_sample());
  // M, M in doubt (pale), LC, LB; and one square each in the legend.
  EXPECT_EQ(elements_of(svg, "i0").size(), 1U + 1U + 1U) << "band, legend, belief";
  EXPECT_EQ(elements_of(svg, "i0 faded").size(), 1U);
  EXPECT_EQ(elements_of(svg, "i1").size(), 1U + 1U + 1U);
  EXPECT_EQ(elements_of(svg, "i4").size(), 1U + 1U);
  EXPECT_EQ(elements_of(svg, "i5").size(), 1U) << "legend only";
}

TEST(IntentionSample, BeliefsAreStackedToTheTop) {
  IntentionSample sample = small_sample();
  sample.labels.assign(8, 2);
  const auto beliefs =
      elements_of(intention_sample_part(sample).insert(0, "<svg>") + "</svg>", "i1");
  ASSERT_EQ(beliefs.size(), 1U);
  EXPECT_EQ(beliefs[0].name, "polygon");
  // From the middle of the band to its top: half of 44 px.
  double low = 1e9;
  double high = -1e9;
  std::string points = beliefs[0].attributes.at("points");
  std::replace(points.begin(), points.end(), ',', ' ');
  std::istringstream numbers(points);
  for (double x = 0.0, y = 0.0; numbers >> x >> y;) {
    low = std::min(low, y);
    high = std::max(high, y);
  }
  EXPECT_NEAR(high - low, 22.0, 0.011);
}

TEST(IntentionSample, WhatIsNotKnownIsNotDrawn) {
  IntentionSample sample = small_sample();
  for (auto& seen : sample.seen) {
    seen.offset = seen.lane_width = std::nan("");
  }
  sample.seen[3].speed = std::nan("");
  const std::string svg = intention_sample_svg(sample);
  EXPECT_THAT(svg, Not(HasSubstr("nan")));
  EXPECT_THAT(svg, Not(HasSubstr("inf")));
  // Speed in two pieces, acceleration in one, no place.
  EXPECT_EQ(elements_of(svg, "curve stroke-ink").size(), 3U);
}

TEST(IntentionSample, OfOneInstantIsDrawn) {
  IntentionSample sample;
  sample.seen = {at_offset(0.0)};
  sample.labels = {0};
  sample.scored = {true};
  EXPECT_NO_THROW(XmlReader(intention_sample_svg(sample)));
}

TEST(IntentionSample, MarksGoThroughAllPanels) {
  IntentionSample sample = small_sample();
  sample.marks = {0.35};
  const auto marks = elements_of(intention_sample_svg(sample), "mark-line");
  ASSERT_EQ(marks.size(), 1U);
  EXPECT_EQ(marks[0].attributes.at("x1"), marks[0].attributes.at("x2"));
}

TEST(IntentionSample, RefusesPartsThatDoNotFit) {
  IntentionSample sample = small_sample();
  sample.labels[0] = 6;
  EXPECT_THROW((void)intention_sample_part(sample), ContractViolation);
  sample = small_sample();
  sample.bands[0].shares.pop_back();
  EXPECT_THROW((void)intention_sample_part(sample), ContractViolation);
  sample = small_sample();
  sample.bands[0].shares[2][0] = std::nan("");
  EXPECT_THROW((void)intention_sample_part(sample), ContractViolation);
  EXPECT_THROW((void)intention_sample_part({}), ContractViolation);
}

TEST(IntentionSample, TextIsEscaped) {
  IntentionSample sample = small_sample();
  sample.title = "<b>&";
  sample.bands[0].name = "<i>";
  EXPECT_NO_THROW(XmlReader(intention_sample_svg(sample)));
}

TEST(ConfusionSvg, TellsSharesOfRows) {
  ConfusionChart chart{.title = "a & b", .lines = {"line"}};
  chart.counts[0] = {30, 10, 0, 0, 0, 0};
  const std::string svg = confusion_svg(chart);
  std::vector<std::string> texts;
  const XmlReader document(svg);
  for (const XmlElement& element : document.elements()) {
    texts.push_back(element.text);
  }
  EXPECT_THAT(texts, testing::IsSupersetOf({"75.0 %", "25.0 %", "30", "10", "40", "a & b"}));
  EXPECT_EQ(std::count(texts.begin(), texts.end(), "0"), 5) << "five empty rows, no empty cell";
}

}  // namespace
}  // namespace saca::report::intention_chart_test
