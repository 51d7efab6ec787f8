#include "saca/lab/runs/story.h"

#include <fcntl.h>
#include <gmock/gmock.h>
#include <unistd.h>

#include <array>
#include <csignal>

#include "saca/lab/runs/walker_for_test.h"

namespace saca::runs::story_test {
namespace {

using arbitration::EventKind;
using arbitration::Plane;
using manoeuvre::PolicyId;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
using testing::StartsWith;

class AStory : public testing::Test {
 protected:
  void SetUp() override {
    std::array<int, 2> ends{};
    ASSERT_EQ(::pipe2(ends.data(), O_NONBLOCK), 0);
    reads_ = ends[0];
    writes_ = ends[1];
  }
  void TearDown() override {
    ::close(reads_);
    ::close(writes_);
  }
  /// What was told since.
  [[nodiscard]] std::string told() const {
    std::string all(1 << 16, '\0');
    const ssize_t size = ::read(reads_, all.data(), all.size());
    all.resize(size < 0 ? 0U : static_cast<std::size_t>(size));
    return all;
  }

  int reads_ = -1;
  int writes_ = -1;
};

TEST_F(AStory, BeginsWithWhatIsPlayedAndByWhat) {
  Walker walker;
  walker.scenario.source = "made\tup";
  Story story(writes_, false);
  story.headline(walker.scenario, walker.setup);
  const std::string text = told();
  EXPECT_THAT(text, StartsWith("A walker\nmade up\nPace lockstep, grip 0.90, language model: off, "
                               "forecasts: rolled out.\n"));
  EXPECT_THAT(text, HasSubstr("or before where waiting would cost harm."));
  walker.setup.thresholds.waiting_cost.reset();
  story.headline(walker.scenario, walker.setup);
  EXPECT_THAT(told(), Not(HasSubstr("waiting")));
}

TEST_F(AStory, HasALineForEachEventWithItsTimeAndPlane) {
  Story story(writes_, false);
  story.on_event({1.5, Plane::reflex, EventKind::trigger, "now\nor never"});
  EXPECT_EQ(told(), "   1.50 s  reflex    now or never\n");
  story.on_reasoning(1, "three replies grow together");
  EXPECT_EQ(told(), "");
}

TEST_F(AStory, HasColoursWhereTheyAreUnderstood) {
  Story story(writes_, true);
  story.on_event({0.0, Plane::world, EventKind::contact, "x"});
  EXPECT_EQ(told(), "\033[31m   0.00 s  world     x\033[0m\n");
  story.on_event({0.0, Plane::thinking, EventKind::ask, "x"});
  EXPECT_THAT(told(), StartsWith("   0.00 s  thinking  x"));
}

TEST_F(AStory, OfNoTriggerEndsWithWhatCame) {
  Walker walker;
  walker.scenario.driver = "braked";
  encounter::Record record;
  record.result.clearance = 2.0;
  record.driver = collision::Outcome{};
  Story story(writes_, false);
  story.ending(walker.scenario, record, {"Nothing threatened."});
  const std::string text = told();
  EXPECT_THAT(text, StartsWith("\nNothing threatened.\nThe driver: braked\n"
                               "The drive as recorded: "));
  EXPECT_THAT(text, HasSubstr("\nSACA: never triggered; clear by 2.0 m"));
}

/// Braked, and it harmed so; in hindsight `best` would have harmed so.
encounter::Record decided(double harm, const manoeuvre::Plan& best, double best_harm) {
  encounter::Record record;
  record.decision = reflex::Decision{.plan = {PolicyId::aeb}};
  record.result.harm = harm;
  record.result.collision_loss = 1.25;
  record.at_trigger = world::Scene{};
  record.best = best.policy;
  record.hindsight.emplace();
  collision::Outcome outcome;
  outcome.harm = best_harm;
  (*record.hindsight)[manoeuvre::index(best.policy)].facts = {best,
                                                              preview::RolledOutcome{outcome}};
  return record;
}

TEST_F(AStory, HoldsWhatWasDoneAgainstWhatWouldHaveBeenBest) {
  const scenario::Scenario scenario;
  Story story(writes_, false);
  const manoeuvre::Plan other{PolicyId::aes_left};
  story.ending(scenario, decided(0.5, other, 0.25), {});
  std::string text = told();
  EXPECT_THAT(text, HasSubstr("SACA: " + manoeuvre::plan_text({PolicyId::aeb}) + ", "));
  EXPECT_THAT(text, HasSubstr("Collision Loss 1.25, harm 0.5000.\n"));
  EXPECT_THAT(
      text, HasSubstr("Best in hindsight, kept to the end: " + manoeuvre::plan_text(other) + ", "));
  EXPECT_THAT(text, HasSubstr("It harms 0.2500 less.\n"));
  story.ending(scenario, decided(0.25, other, 0.5), {});
  EXPECT_THAT(told(), HasSubstr("What was done harmed 0.2500 less.\n"));
  story.ending(scenario, decided(0.25, other, 0.25), {});
  EXPECT_THAT(told(), HasSubstr("It harms as much as what was done.\n"));
  encounter::Record same = decided(0.25, {PolicyId::aeb}, 0.25);
  story.ending(scenario, same, {});
  EXPECT_THAT(told(), HasSubstr("That is what was done.\n"));
  same.switches.push_back({.time = 2.5, .change = {.plan = other}});
  story.ending(scenario, same, {});
  text = told();
  EXPECT_THAT(text, HasSubstr(", from 2.50 s on " + manoeuvre::plan_text(other) + ", "));
  EXPECT_THAT(text, HasSubstr("It harms as much as what was done.\n"));
}

TEST_F(AStory, EndsWithTheReviewWhatOfItIsFalseAndTheReport) {
  Story story(writes_, false);
  story.on_report("/a/report.html");
  EXPECT_EQ(told(), "Report: /a/report.html\n");
  story.on_review("1. It ");
  story.on_review("braked.");
  EXPECT_EQ(told(), "\nThe language model looks back:\n1. It braked.");
  story.on_truth({});
  EXPECT_THAT(told(), IsEmpty());
  story.on_truth({.num_checked = 3, .wrong = {{.text = "car9 is near", .why = "there is none"}}});
  EXPECT_EQ(told(),
            "\n2 of 3 statements that can be checked are true.\n"
            "  false: \"car9 is near\": there is none\n");
  story.on_shown({.text = "1. x", .tries = 1});
  EXPECT_THAT(told(), IsEmpty());
  story.on_shown({.text = "1. x", .from = language_model::Explanation::From::facts, .tries = 3});
  EXPECT_EQ(told(), "\nBy the figures, after try 3:\n1. x");
  story.on_shown({.text = "1. y", .from = language_model::Explanation::From::model, .tries = 2});
  EXPECT_EQ(told(), "\nWhat holds, in try 2:\n1. y");
  story.on_report("/a/report.html");
  EXPECT_EQ(told(), "\nReport: /a/report.html\n");
}

TEST_F(AStory, ThatNobodyCanReadLeavesTheRestOut) {
  std::signal(SIGPIPE, SIG_IGN);
  Story story(writes_, false);
  ::close(reads_);
  story.on_report("x");
  ASSERT_TRUE(story.problem().has_value());
  EXPECT_EQ(story.problem()->code, Error::Code::unwritable);
  EXPECT_THAT(story.problem()->message, HasSubstr("cannot be written"));
  reads_ = -1;
}

TEST_F(AStory, ThatIsNotWantedIsNotTold) {
  Story story(std::nullopt, false);
  story.on_report("x");
  EXPECT_EQ(story.problem(), std::nullopt);
  EXPECT_EQ(told(), "");
}

TEST_F(AStory, DoesNotWaitForTheHeadlineToBeRead) {
  while (::write(writes_, "xxxxxxxx", 8) == 8) {
  }
  Walker walker;
  Story story(writes_, false);
  story.headline(walker.scenario, walker.setup);  // would take `patience` seconds if it waited
  EXPECT_EQ(story.problem(), std::nullopt);
  while (!told().empty()) {
  }
  story.on_report("x");
  EXPECT_THAT(told(), StartsWith("A walker\n"));
}

}  // namespace
}  // namespace saca::runs::story_test
