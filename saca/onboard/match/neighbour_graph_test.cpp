#include "saca/onboard/match/neighbour_graph.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <set>

namespace saca::match::neighbour_graph_test {
namespace {

using Neighbour = NeighbourGraph::Neighbour;
using Point = std::array<float, 6>;

float between(const Point& a, const Point& b) {
  float sum = 0.0F;
  for (std::size_t i = 0; i < a.size(); ++i) {
    sum += (a[i] - b[i]) * (a[i] - b[i]);
  }
  return sum;
}

struct Apart {
  const std::vector<Point>& points;
  float operator()(std::uint32_t a, std::uint32_t b) const { return between(points[a], points[b]); }
  void prepare(std::uint32_t /*place*/) const {}
};

struct To {
  const std::vector<Point>& points;
  Point wanted;
  float operator()(std::uint32_t place, float /*limit*/) const {
    return between(points[place], wanted);
  }
  void prepare(std::uint32_t /*place*/) const {}
};

Point somewhere(std::mt19937& rng) {
  std::normal_distribution<float> coordinate;
  Point point;
  for (float& x : point) {
    x = coordinate(rng);
  }
  return point;
}

std::vector<Point> points_at_random(std::mt19937& rng, std::size_t count) {
  std::vector<Point> points(count);
  std::generate(points.begin(), points.end(), [&rng] { return somewhere(rng); });
  return points;
}

/// The points are kept by the caller.
NeighbourGraph graph_of(const std::vector<Point>& points) {
  NeighbourGraph graph;
  while (graph.size() < points.size()) {
    graph.add(Apart{points});
  }
  return graph;
}

std::vector<Neighbour> by_comparing_all(const std::vector<Point>& points, const Point& wanted) {
  std::vector<Neighbour> all;
  for (std::uint32_t i = 0; i < points.size(); ++i) {
    all.push_back({between(points[i], wanted), i});
  }
  std::sort(all.begin(), all.end());
  return all;
}

TEST(NeighbourGraph, OfNothingNothingIsFound) {
  const NeighbourGraph graph;
  std::array<Neighbour, 3> found;
  const std::vector<Point> none;
  EXPECT_EQ(graph.search(To{none, {}}, found), 0U);
}

TEST(NeighbourGraph, OfFewAllAreFoundInOrder) {
  std::mt19937 rng(1);
  std::vector<Point> points;
  for (int i = 0; i < 40; ++i) {
    points.push_back(somewhere(rng));
    const NeighbourGraph graph = graph_of(points);
    const Point wanted = somewhere(rng);
    std::array<Neighbour, 60> found;
    ASSERT_EQ(graph.search(To{points, wanted}, found), points.size());
    const std::vector<Neighbour> all = by_comparing_all(points, wanted);
    EXPECT_TRUE(std::equal(all.begin(), all.end(), found.begin()));
    EXPECT_EQ(graph.search(To{points, wanted}, std::span(found).first(0)), 0U);
  }
}

TEST(NeighbourGraph, OfManyNearlyAllOfTheNearestAreFound) {
  std::mt19937 rng(2);
  const std::vector<Point> points = points_at_random(rng, 5'000);
  const NeighbourGraph graph = graph_of(points);
  int nearest_found = 0;
  int found_of_50 = 0;
  constexpr int queries = 200;
  for (int i = 0; i < queries; ++i) {
    const Point wanted = somewhere(rng);
    std::array<Neighbour, 50> found;
    ASSERT_EQ(graph.search(To{points, wanted}, found), 50U);
    EXPECT_TRUE(std::is_sorted(found.begin(), found.end()));
    const std::vector<Neighbour> all = by_comparing_all(points, wanted);
    nearest_found += found[0] == all[0] ? 1 : 0;
    const std::set<Neighbour> right(all.begin(), all.begin() + 50);
    found_of_50 += static_cast<int>(std::count_if(
        found.begin(), found.end(), [&](const Neighbour& one) { return right.contains(one); }));
  }
  EXPECT_GE(nearest_found, 0.99 * queries);
  EXPECT_GE(found_of_50, 0.98 * 50 * queries);
}

TEST(NeighbourGraph, TheSameAreFoundEachByItself) {
  const std::vector<Point> points(300, Point{1.0F, 2.0F});
  const NeighbourGraph graph = graph_of(points);
  std::array<Neighbour, 10> found;
  ASSERT_EQ(graph.search(To{points, points[0]}, found), 10U);
  std::set<std::uint32_t> places;
  for (const Neighbour& one : found) {
    EXPECT_EQ(one.distance, 0.0F);
    places.insert(one.place);
  }
  EXPECT_EQ(places.size(), 10U);
}

TEST(NeighbourGraph, OfTheSamePointsIsTheSame) {
  std::mt19937 rng(3);
  const std::vector<Point> points = points_at_random(rng, 500);
  const NeighbourGraph one = graph_of(points);
  const NeighbourGraph other = graph_of(points);
  for (int i = 0; i < 20; ++i) {
    const To to{points, somewhere(rng)};
    std::array<Neighbour, 20> a;
    std::array<Neighbour, 20> b;
    ASSERT_EQ(one.search(to, a), one.search(to, a));
    ASSERT_EQ(other.search(to, b), 20U);
    EXPECT_EQ(a, b);
  }
  EXPECT_EQ(one.bytes(), other.bytes());
}

}  // namespace
}  // namespace saca::match::neighbour_graph_test
