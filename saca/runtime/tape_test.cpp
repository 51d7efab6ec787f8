#include "saca/runtime/tape.h"

#include <gmock/gmock.h>

#include "saca/runtime/tape_json.h"
#include "tests/support/count_allocations.h"
#include "tests/support/scenes.h"

namespace saca::runtime::tape_test {
namespace {

using manoeuvre::PolicyId;

/// A step that holds something of everything that a step may hold.
TapeStep full_step(std::uint64_t number, std::size_t num_actors) {
  TapeStep step{.number = number};
  step.scene = test::ego_at(20.0 + 0.1 * static_cast<double>(number));
  step.scene.time = 0.01 * static_cast<double>(number);
  for (std::size_t i = 0; i < number % (world::max_cues + 1); ++i) {
    step.scene.cues.push_back({world::CueKind::work_zone, {static_cast<double>(i), 1.0 / 3.0}});
  }
  for (std::size_t i = 0; i < num_actors; ++i) {
    step.scene.actors.push_back(test::car(static_cast<std::uint8_t>(i + 1),
                                          {10.0 * static_cast<double>(i + 1), 1.0 / 3.0}));
    intent::Belief belief;
    belief.at[1][2] = 1.0 / static_cast<double>(i + 3);
    step.beliefs.push_back(belief);
  }
  step.plans.emplace().push_back({.at_trigger = match::features(step.scene),
                                  .trigger = step.scene.time + 0.7,
                                  .plan = {PolicyId::es_b_left, 7.5},
                                  .source = reflex::Source::memory,
                                  .preview = static_cast<std::int32_t>(number)});
  step.verdict.emplace().scene = number;
  step.verdict->verdict.time = step.scene.time;
  step.verdict->verdict.plans.push_back({.plan = manoeuvre::full_braking,
                                         .drivable = true,
                                         .harm = 0.1,
                                         .contact = 0.3,
                                         .as_seen = 0.07});
  step.reflex.threat = reflex::Threat{0, 1.2};
  return step;
}

TapeStep triggered(TapeStep step) {
  step.reflex.triggered = true;
  step.decision = reflex::Decision{.plan = manoeuvre::full_braking,
                                   .source = reflex::Source::arbiter,
                                   .verdict = step.verdict->verdict,
                                   .time = step.scene.time};
  return step;
}

std::string text_of(const std::vector<TapeStep>& steps) {
  TapeContent content;
  content.steps = steps;
  return tape_text({{}, content});
}

TEST(Tape, WhatWentInComesOut) {
  std::vector<TapeStep> steps;
  for (std::uint64_t k = 0; k < 40; ++k) {
    TapeStep step = full_step(k, k % 33);
    if (k % 3 == 0) {
      step.plans.reset();
    }
    if (k % 4 == 0) {
      step.verdict.reset();
    }
    steps.push_back(k == 7 ? triggered(step) : step);
  }
  Tape tape(steps.size() * Tape::step_size(world::max_actors));
  for (const TapeStep& step : steps) {
    tape.add(step);
  }
  const TapeContent content = tape.content();
  EXPECT_EQ(text_of(content.steps), text_of(steps));
  EXPECT_EQ(content.dropped, 0U);
  EXPECT_EQ(content.lost, 0U);
}

TEST(Tape, HasRoomForAsManyStepsAsItsMemoryWasTakenFor) {
  for (const std::size_t actors : {0U, 1U, 5U, 32U}) {
    Tape tape(20 * Tape::step_size(actors));
    for (std::uint64_t k = 0; k < 20; ++k) {
      TapeStep step = full_step(k, actors);
      while (!step.plans->full()) {
        step.plans->push_back((*step.plans)[0]);
      }
      tape.add(step);
    }
    EXPECT_EQ(tape.content().steps.size(), 20U) << actors;
  }
}

TEST(Tape, WithoutMemoryNothingIsRecorded) {
  Tape tape(0);
  tape.add(full_step(0, 2));
  EXPECT_FALSE(tape.records());
  EXPECT_TRUE(tape.content().steps.empty());
}

// Without a decision what is left can be replayed if what the reflex plane had been given is known.
TEST(Tape, OldStepsGiveWayAndWhatWasHandedOverInThemIsKept) {
  Tape tape(10 * Tape::step_size(3));
  for (std::uint64_t k = 0; k < 1'000; ++k) {
    tape.add(full_step(k, 3));
  }
  const TapeContent content = tape.content();
  EXPECT_GE(content.steps.size(), 10U);
  EXPECT_EQ(content.steps.back().number, 999U);
  EXPECT_EQ(content.dropped + content.steps.size(), 1'000U);
  EXPECT_EQ(content.steps.front().number, content.dropped);
  ASSERT_EQ(content.plans.size(), 1U);
  EXPECT_EQ(content.plans[0].preview, static_cast<std::int32_t>(content.dropped) - 1);
  ASSERT_TRUE(content.verdict.has_value());
  EXPECT_LT(content.verdict->time, content.steps.front().scene.time);
}

TEST(Tape, AnEncounterUnderWayKeepsItsBegin) {
  Tape tape(20 * Tape::step_size(2));
  for (std::uint64_t k = 0; k < 200; ++k) {
    tape.add(k == 5 ? triggered(full_step(k, 2)) : full_step(k, 2));
  }
  const TapeContent content = tape.content();
  // What came before the trigger gives way; the trigger and what follows it stay, without a gap.
  EXPECT_EQ(content.steps.front().number, 5U);
  EXPECT_TRUE(content.steps.front().reflex.triggered);
  EXPECT_EQ(content.steps.back().number, 4U + content.steps.size());
  EXPECT_EQ(content.lost, 195U - content.steps.size());
}

TEST(Tape, TheNextEncounterTakesTheRoomOfTheLastOne) {
  Tape tape(20 * Tape::step_size(2));
  for (std::uint64_t k = 0; k < 200; ++k) {
    TapeStep step = k == 5 || k == 103 ? triggered(full_step(k, 2)) : full_step(k, 2);
    step.forgotten = k == 100 ? Reset::encounter : Reset::nothing;
    tape.add(step);
  }
  const TapeContent content = tape.content();
  EXPECT_GE(content.steps.front().number, 100U);
  EXPECT_LE(content.steps.front().number, 103U);
  bool triggers = false;
  for (const TapeStep& step : content.steps) {
    triggers = triggers || step.number == 103;
    EXPECT_EQ(step.number - content.steps.front().number,
              static_cast<std::uint64_t>(&step - content.steps.data()));
  }
  EXPECT_TRUE(triggers);
}

TEST(Tape, AddingAllocatesNothing) {
  Tape tape(8 * Tape::step_size(3));
  const TapeStep step = full_step(0, 3);
  const std::size_t before = num_allocations;
  for (int k = 0; k < 100; ++k) {
    tape.add(step);
  }
  EXPECT_EQ(num_allocations, before);
}

}  // namespace
}  // namespace saca::runtime::tape_test
