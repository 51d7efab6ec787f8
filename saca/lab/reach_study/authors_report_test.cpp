#include "saca/lab/reach_study/authors_report.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>
#include <numbers>

#include "saca/lab/reach_study/solution_for_test.h"

namespace saca::reach_study::authors_report_test {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

/// The disc as a case of avoidance whose obstacle moves at that speed.
danger::Solution disc_case(double obstacle_speed) {
  danger::Solution solved = disc_solution();
  solved.problem =
      "schema = \"saca.avoidance/1\"\nname = \"disc\"\nseen_from = \"obstacle\"\n"
      "snapshots_s = [0.5, 1.0]\n"
      "[car]\ngrip = 0.9\ntightest_curvature_1pm = 0.2\ndrive_share = 0.5\n"
      "[ego]\nshape = \"box\"\nlength_m = 4\nwidth_m = 2\ncentre_m = 0\n"
      "[obstacle]\nshape = \"box\"\nlength_m = 4\nwidth_m = 2\nspeed_mps = " +
      std::to_string(obstacle_speed) +
      "\n[grid.x]\nfirst_m = -20\nlast_m = 10\npoints = 31\n[grid.y]\nlast_m = 10\npoints = 11\n"
      "[grid.course]\npoints = 4\n[grid.speed]\nlast_mps = 18\npoints = 4\n";
  return solved;
}

/// A network that always tells -1 m.
verification::AuthorsNetwork never_unsafe() {
  const std::map<std::string, verification::NpyArray> arrays{
      {"MLP_0_Dense_0_kernel", {{4, 1}, {0.0, 0.0, 0.0, 0.0}}},
      {"MLP_0_Dense_0_bias", {{1}, {0.0}}},
      {"MLP_0_Dense_1_kernel", {{1, 1}, {0.0}}},
      {"MLP_0_Dense_1_bias", {{1}, {0.0}}},
      {"OutputVDense_kernel", {{1, 1}, {0.0}}},
      {"OutputVDense_bias", {{1}, {-1.0}}}};
  return verification::AuthorsNetwork::from(arrays, "made here").value();
}

verification::AuthorsComparison counted() {
  verification::AuthorsComparison found;
  found.all = {.states = 200, .unsafe = 50, .false_safe = 10, .false_alarm = 30};
  found.by_speed = {
      {.speed = 7.0, .agreement = found.all, .mean_solved = -3.21, .mean_network = 1.5}};
  found.outside = 3;
  return found;
}

TEST(AuthorsReport, IsOfAWholeCaseBesideAnObstacleAtRest) {
  EXPECT_EQ(why_not_comparable(disc_case(0.0), "a.h5"), std::nullopt);
  EXPECT_EQ(why_not_comparable(disc_case(5.0), "a.h5").value().message,
            "a.h5: want an obstacle at rest, got one at 5 m/s");
  EXPECT_THAT(why_not_comparable(disc_solution(), "a.h5").value().message,
              StartsWith("a.h5: want a solved case of avoidance; "));
  danger::Solution stopped = disc_case(0.0);
  stopped.complete = false;
  EXPECT_EQ(why_not_comparable(stopped, "a.h5").value().message,
            "a.h5: want a whole solution, got one that was stopped at 1 s");
  danger::Solution renamed = disc_case(0.0);
  renamed.grid.axes[0].name = "along";
  EXPECT_THAT(why_not_comparable(renamed, "a.h5").value().message,
              HasSubstr("got along, y, course, speed"));
}

TEST(AuthorsReport, HasTheViewsThatWereAskedFor) {
  const auto both = authors_views({5.0, 9.0}, 90.0);
  ASSERT_EQ(both.size(), 2U);
  EXPECT_DOUBLE_EQ(both[1].course, std::numbers::pi / 2.0);
  EXPECT_EQ(both[1].speed, 9.0);
  const auto course_alone = authors_views({}, 30.0);
  ASSERT_EQ(course_alone.size(), 1U);
  EXPECT_EQ(course_alone[0].speed, 10.0);
  EXPECT_EQ(authors_views({5.0}, {})[0].course, 0.0);
  EXPECT_EQ(authors_views({}, {}).size(), 5U);
}

// Of the network's range the grid has 21 x 17 whole metres, each at 17 yaws and 19 speeds. Within
// 3.1 m of the middle lie 7 of them at x = 0, 5 at -1 m, 5 at -2 m and 1 at -3 m.
TEST(AuthorsReport, ComparesAndDraws) {
  const AuthorsRequest request{
      .file = "a.h5", .network_name = "net.npz", .views = authors_views({9.0}, {})};
  const auto page = authors_report(disc_case(0.0), never_unsafe(), request);
  ASSERT_TRUE(page.has_value());
  const verification::Agreement& all = page.value().found.all;
  EXPECT_EQ(all.states, 21U * 17U * 17U * 19U);
  EXPECT_EQ(all.unsafe, 18U * 17U * 19U);
  EXPECT_EQ(all.false_safe, all.unsafe);
  EXPECT_EQ(all.false_alarm, 0U);
  EXPECT_THAT(page.value().drawn, HasSubstr("net.npz"));
  EXPECT_THAT(page.value().drawn, HasSubstr("</html>"));

  AuthorsRequest maps = request;
  maps.format = AuthorsRequest::Format::picture;
  EXPECT_THAT(authors_report(disc_case(0.0), never_unsafe(), maps).value().drawn,
              StartsWith("\x89PNG"));
}

// Of 200 states: 25 % unsafe, 80 % alike, 10 of 50 falsely safe, 30 of 150 false alarms.
TEST(AuthorsReport, TellsFigures) {
  EXPECT_EQ(json_of(counted()), (nlohmann::json{{"reach.authors_net.n", 200},
                                                {"reach.authors_net.n_unsafe", 50},
                                                {"reach.authors_net.n_outside", 3},
                                                {"reach.authors_net.sign_agreement", 0.8},
                                                {"reach.authors_net.false_safe", 0.2},
                                                {"reach.authors_net.false_alarm", 0.2},
                                                {"reach.authors_net.false_safe.speed7", 0.2},
                                                {"reach.authors_net.false_alarm.speed7", 0.2}}));
}

TEST(AuthorsReport, IsATableForPeople) {
  EXPECT_EQ(
      text_of(counted()),
      "     m/s   states   unsafe   same sign  false safe false alarm   mean value [m], solved and "
      "network\n"
      "       7      200       50      80.0 %      20.0 %      20.0 %     -3.2    1.5\n"
      "     all      200       50      80.0 %      20.0 %      20.0 %\n"
      "3 states of the network's range lie outside the solution\n");
  verification::AuthorsComparison inside = counted();
  inside.outside = 0;
  EXPECT_THAT(text_of(inside), testing::EndsWith("20.0 %\n"));
}

}  // namespace
}  // namespace saca::reach_study::authors_report_test
