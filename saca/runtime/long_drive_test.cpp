#include <gtest/gtest.h>
#include <malloc.h>

#include <cmath>
#include <cstdlib>
#include <string>

#include "saca/base/core/clock.h"
#include "saca/lab/prepare/harm_file.h"
#include "saca/lab/prepare/shipped_cars_for_test.h"
#include "saca/onboard/manoeuvre/ego.h"
#include "saca/runtime/avoider.h"
#include "saca/thinking/intent/shipped_model.h"
#include "tests/support/scenes.h"

namespace saca::long_drive_test {
namespace {

constexpr double look = 0.1;             // [s] between two scenes
constexpr double between = 600.0;        // [s] from one encounter to the next
constexpr double cruising_speed = 20.0;  // [m/s]

/// What the program holds of the heap now [byte].
std::size_t heap_in_use() {
  const struct mallinfo2 info = mallinfo2();
  return info.uordblks + info.hblkhd;
}

/// A car on a road of three lanes that is given back to its lane and speed before each encounter.
class Cruise {
 public:
  Cruise() {
    scene_.ego_mass = car_.mass;
    scene_.road.left_edge = 5.25;
    scene_.road.right_edge = -5.25;
  }

  /// Somebody stands in front, is met, and has gone before the next one comes.
  void drive(double duration) {
    const double end = scene_.time + duration;
    while (scene_.time < end - 0.5 * look) {
      const double into = std::fmod(scene_.time + 0.5 * look, between);
      if (into < look) {
        scene_.ego.X_WB = {{scene_.ego.X_WB.p.x, 0.0}, 0.0};
        scene_.ego.v_B = {cruising_speed, 0.0};
        state_ = manoeuvre::rolling_state(car_, scene_.ego, scene_.grip);
        scene_.actors.push_back(test::car(1, {scene_.ego.X_WB.p.x + 60.0, 0.0}));
      } else if (into > 3.0) {
        scene_.actors.clear();
      }
      step(into < 20.0);
    }
  }

  [[nodiscard]] std::size_t num_encounters() const { return avoider_.num_encounters(); }

 private:
  /// @param moves  the vehicle model does; else the car goes on as it does
  void step(bool moves) {
    (void)avoider_.step(scene_);
    constexpr double dt = 0.001;
    for (int k = 0; moves && k < 100; ++k) {
      state_ = vehicle::step(car_, state_, avoider_.control(state_, dt), scene_.grip, dt);
    }
    if (moves) {
      scene_.ego = manoeuvre::ego_state(state_);
    } else {
      scene_.ego.X_WB.p.x += look * scene_.ego.v_B.x;
    }
    scene_.time += look;
    while (avoider_.next_event()) {
    }
  }

  SteadyClock clock_;
  manoeuvre::Car car_ = prepare::default_car();
  collision::HarmModel harm_ = prepare::read_harm("data/harm.toml").value();
  Avoider avoider_{{.planes = {.forecast = {&car_, &harm_}, .clock = &clock_},
                    .intent = &intent::shipped_model()}};
  world::Scene scene_ = test::ego_at(cruising_speed, manoeuvre::footprint(car_));
  vehicle::VehicleState state_;
};

// What is kept of an encounter is forgotten with it. Hours: SACA_SOAK_HOURS, else one, to be quick.
TEST(LongDrive, HoldsNoMoreMemoryInTheEndThanAfterTheSecondEncounter) {
  const char* wanted = std::getenv("SACA_SOAK_HOURS");
  const double hours = wanted != nullptr ? std::stod(wanted) : 1.0;
  Cruise cruise;
  cruise.drive(2.0 * between);
  const std::size_t early = heap_in_use();
  ASSERT_EQ(cruise.num_encounters(), 2U);
  cruise.drive(3'600.0 * hours - 2.0 * between);
  const std::size_t late = heap_in_use();
  EXPECT_EQ(cruise.num_encounters(), static_cast<std::size_t>(3'600.0 * hours / between));
  EXPECT_LT(late, early + 64 * 1024) << "after " << hours << " h";
  RecordProperty("heap_after_two_encounters", std::to_string(early));
  RecordProperty("heap_in_the_end", std::to_string(late));
}

}  // namespace
}  // namespace saca::long_drive_test
