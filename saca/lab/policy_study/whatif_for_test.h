#pragma once

// A what-if map by hand, for the tests of this module.

#include "saca/lab/eval/scenes_for_test.h"
#include "saca/lab/policy_study/whatif_cells.h"

namespace saca::policy_study {

/// A car that stands ahead. Of three cells AEB is best in the first by 0.2, doing nothing harms
/// nobody in the second, and the third cannot be; ES-B-L is refused in the first.
class MapByHand {
 public:
  MapByHand() {
    scenario_.title = "A standing car";
    eval::Cell decided{.best = manoeuvre::PolicyId::aeb, .alone = true, .margin = 0.2};
    decided.harms.fill(0.5);
    decided.harms[0] = 0.25;
    decided.harms[3].reset();
    eval::Cell harmless{.best = manoeuvre::PolicyId::no_intervention, .contact = true};
    harmless.harms.fill(0.0);
    map_ = {.scenario = &scenario_,
            .car = &car_,
            .time = 2.0,
            .axes = eval_axes({5.0, 10.0, 15.0}),
            .cells = {decided, harmless, {.possible = false}}};
  }
  MapByHand(const MapByHand&) = delete;
  MapByHand& operator=(const MapByHand&) = delete;
  ~MapByHand() = default;

  [[nodiscard]] const WhatifMap& map() const { return map_; }

  /// The same with a second axis of one value.
  [[nodiscard]] WhatifMap with_two_axes() const {
    WhatifMap map = map_;
    map.axes.push_back({.what = "grip", .body = "", .key = "grip", .path = "", .values = {0.5}});
    return map;
  }

 private:
  static std::vector<eval::Axis> eval_axes(std::vector<double> speeds) {
    return {{.what = "ego.speed_mps",
             .body = "ego",
             .key = "speed_mps",
             .path = "",
             .values = std::move(speeds)}};
  }

  scenario::Scenario scenario_ = eval::standing_car(10.0, 30.0);
  manoeuvre::Car car_ = prepare::default_car();
  WhatifMap map_;
};

}  // namespace saca::policy_study
