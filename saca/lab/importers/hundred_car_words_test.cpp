#include "saca/lab/importers/hundred_car_words.h"

#include <gtest/gtest.h>

namespace saca::importers::hundred_car_words_test {
namespace {

// Every type that the study's table names for a second vehicle.
TEST(AssumedBody, KnowsTheStudysTypes) {
  using world::ActorKind;
  EXPECT_EQ(assumed_body("Automobile").kind, ActorKind::car);
  EXPECT_EQ(assumed_body("Sport Utility Vehicles").kind, ActorKind::car);
  EXPECT_EQ(assumed_body("Van (minivan or standard van)").kind, ActorKind::van);
  EXPECT_EQ(assumed_body("Pickup truck").kind, ActorKind::van);
  EXPECT_EQ(assumed_body("Single-unit straight truck: Box").kind, ActorKind::truck);
  EXPECT_EQ(assumed_body("Tractor-trailer: Enclosed box").kind, ActorKind::truck);
  EXPECT_EQ(assumed_body("School bus").kind, ActorKind::truck);
  EXPECT_EQ(assumed_body("Unknown vehicle type").kind, ActorKind::car);
}

TEST(AssumedGrip, FallsWithTheWeather) {
  EXPECT_GT(assumed_grip("Dry"), assumed_grip("Wet"));
  EXPECT_GT(assumed_grip("Wet"), assumed_grip("Snowy"));
  EXPECT_GT(assumed_grip("Snowy"), assumed_grip("Icy"));
  EXPECT_GT(assumed_grip("Icy"), 0.0);
}

// All words that the study's table has for the manoeuvre before.
TEST(LeavesLane, KnowsTheStudysManoeuvres) {
  const auto leaves = [](const std::string& words) {
    recordings::HundredCarEvent event;
    event.manoeuvre_before = words;
    return leaves_lane(event);
  };
  for (const char* words :
       {"Changing lanes", "Merging", "Turning left", "Turning right", "Entering a parked position",
        "Leaving a parked position", "Making U-turn", "Passing or overtaking another vehicle",
        "Backing up (other than for parking purposes)"}) {
    EXPECT_TRUE(leaves(words)) << words;
  }
  for (const char* words :
       {"Going straight, constant speed", "Decelerating in traffic lane", "Stopped in traffic lane",
        "Negotiating a curve", "No analyzed data", ""}) {
    EXPECT_FALSE(leaves(words)) << words;
  }
}

TEST(Shown, IsANumberOfAnySize) {
  EXPECT_EQ(shown(1.25, 1), "1.2");  // to even
  EXPECT_EQ(shown(-0.5, 2), "-0.50");
  EXPECT_EQ(shown(1e300, 2), "1e+300");
}

TEST(LanesAround, CountsAsTheStudyDoes) {
  recordings::HundredCarEvent event;
  event.flow = "Divided (median strip or barrier)";
  event.lanes = "3";
  EXPECT_EQ(lanes_around(event).left, 2);
  EXPECT_TRUE(lanes_around(event).divided);
  event.flow = "Not divided";  // the lanes of both directions
  event.lanes = "2";
  EXPECT_EQ(lanes_around(event).left, 1);
  EXPECT_TRUE(lanes_around(event).oncoming_left);
  event.lanes = "4";
  EXPECT_FALSE(lanes_around(event).oncoming_left);
  event.flow = "One-way traffic";
  event.lanes = "No analyzed data";
  EXPECT_EQ(lanes_around(event).left, 0);
}

TEST(FindHundredCarFiles, SaysWhatItMisses) {
  EXPECT_NE(find_hundred_car_files("/nowhere", 8911).problem.find("100CarEvent"),
            std::string::npos);
}

}  // namespace
}  // namespace saca::importers::hundred_car_words_test
