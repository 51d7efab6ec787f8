#pragma once

// Cases by construction, and what they are played with, for the tests of this module.

#include <string>

#include "saca/lab/cases/case_tools.h"
#include "saca/lab/cases/crash_case.h"
#include "saca/lab/cases/crash_search.h"
#include "saca/lab/families/family.h"
#include "saca/lab/prepare/harm_file.h"
#include "saca/lab/prepare/shipped_cars_for_test.h"
#include "saca/onboard/manoeuvre/ego.h"
#include "saca/thinking/intent/cue_law.h"
#include "saca/thinking/intent/shipped_model.h"

namespace saca::cases {

/// The default car without an atlas: everything is rolled out.
struct ShippedTools {
  manoeuvre::Car car = prepare::default_car();
  collision::HarmModel harm = prepare::read_harm("data/harm.toml").value();
  intent::CueLaw cues = intent::load_cue_law("data/cues.toml").value();

  [[nodiscard]] CaseTools tools() const {
    return {.car_name = "compact_rwd_ev",
            .forecast = {.car = &car, .harm = &harm, .cues = &cues},
            .intent = &intent::shipped_model()};
  }
};
inline const ShippedTools& shipped() {
  static const ShippedTools tools;
  return tools;
}

/// A crash as the search found it in a family, not judged yet.
inline CrashCase found_case(const std::string& name, const families::Family& family,
                            const CrashFound& found) {
  CrashCase one{
      .record = {.study = "FARS", .name = name, .state = "Arizona", .year = 2016, .number = 40001},
      .family = "rear_end",
      .place = "highway",
      .facts = {{"ego", "TRAV_SP", 45, "45 mph"}, {"crash", "LGT_COND", std::nullopt, "not known"}},
      .kind = "slower_lead",
      .seed = 3,
      .sample = found.sample,
      .grip = found.scenario.grip,
      .without = found.as_written.contact,
      .as_recorded = true,
      .impact_agrees = true};
  for (const auto& [key, range] : family.ranges) {
    one.ranges.push_back({key, range.min, range.max, range.source});
  }
  return one;
}

/// A crash into somebody slower, drawn from the shipped family; braking is its best.
inline CrashCase case_by_hand(const std::string& name = "fars_2016_40001") {
  static const families::Family family = [] {
    return families::load_family("scenarios/families", "slower_lead").value();
  }();
  static const CrashFound found = find_crash(family, std::nullopt, "compact_rwd_ev", shipped().car,
                                             shipped().harm, {.seed = 3, .most = 20});
  CrashCase one = found_case(name, family, found);
  one.ranges[0].source = "recorded: ego's TRAV_SP 45 mph";
  one.judged.one.scene.ego_footprint = manoeuvre::footprint(shipped().car);
  one.judged.one.scene.ego_mass = shipped().car.mass;
  one.judged.one.scene.ego.v_B = {20.0, 0.0};
  one.judged.one.plan = manoeuvre::Plan{.policy = manoeuvre::PolicyId::aeb, .strength = 1.0};
  one.judged.one.draws = 4;
  one.judged.one.told = memory::PolicyHarms{0.25};
  one.judged.plans = {{one.judged.one.plan, 0.25, 0.5, true}, {{}, 0.5, 1.0, false}};
  one.judged.admissible_harm = 0.252;
  one.judged.speaks_for = one.judged.one.plan;
  one.judged.happened[0] =
      eval::PolicyOverDraws{.plan = one.judged.one.plan, .harm = {0.2, -0.1, 0.3}, .contact = 0.75};
  return one;
}

}  // namespace saca::cases
