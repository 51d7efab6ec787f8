#include "saca/lab/intention_scoring/simulated_drive.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "saca/base/core/contract.h"

namespace saca::intention_scoring {
namespace {

constexpr double nobody = std::numeric_limits<double>::infinity();
constexpr double least_gap = 2.0;       // [m], of `drive`
constexpr double flattest_turn = 6.0;   // way along per way aside: a body turns by 17 deg at most
constexpr double always_before = -5.0;  // [s]: before the first sample

double time_of(std::size_t sample) {
  return DriveMotion::first + static_cast<double>(sample) * DriveMotion::step;
}

/// Acceleration that a braking adds [m/s^2].
double braking_at(const BrakingPlan& plan, double time) {
  const double built = std::clamp((time - plan.start) / plan.build_up, 0.0, 1.0);
  const double left =
      plan.release ? 1.0 - std::clamp((time - *plan.release) / plan.let_go, 0.0, 1.0) : 1.0;
  return -plan.deceleration * built * left;
}

double wanted_at(const SpeedPlan& plan, double time) {
  double wanted = plan.oscillations[0].at(time) + plan.oscillations[1].at(time);
  for (const BrakingPlan& braking : plan.brakings) {
    wanted += braking_at(braking, time);
  }
  return wanted;
}

struct Along {
  std::vector<double> way, speed, acceleration;
};

/// Before time 0 the speed is the plan's. Who has come to rest stays so.
Along along(const SpeedPlan& plan, std::size_t samples) {
  Along all;
  double way = plan.speed * DriveMotion::first;
  double speed = plan.speed;
  for (std::size_t i = 0; i < samples; ++i) {
    const double last = speed;
    if (i > DriveMotion::before && last > 0.0) {
      speed = std::max(0.0, last + wanted_at(plan, time_of(i)) * DriveMotion::step);
    }
    if (i > 0) {
      way += 0.5 * (last + speed) * DriveMotion::step;
    }
    all.way.push_back(way);
    all.speed.push_back(speed);
    all.acceleration.push_back((speed - last) / DriveMotion::step);
  }
  return all;
}

struct Side {
  double at = 0.0;
  double slope = 0.0;
};

/// Over the way made since the shift's start, as a share of what it takes.
Side quintic(double aside, double share, double takes) {
  const double x = std::clamp(share, 0.0, 1.0);
  const double slope = 30.0 * x * x * (1.0 - x) * (1.0 - x);
  return {aside * x * x * x * (10.0 + x * (-15.0 + 6.0 * x)), aside * slope / takes};
}

std::size_t sample_at(double time, std::size_t samples) {
  const double place = std::round((time - DriveMotion::first) / DriveMotion::step);
  return static_cast<std::size_t>(std::clamp(place, 0.0, static_cast<double>(samples - 1)));
}

void add_shift(const ShiftPlan& shift, const Along& driven, DriveMotion& motion) {
  const std::size_t samples = driven.way.size();
  const std::size_t start = sample_at(shift.start, samples);
  const double begun = driven.way[start];
  double planned = driven.way[sample_at(shift.start + shift.duration, samples)] - begun;
  const double seen = time_of(samples - 1) - shift.start;
  if (shift.duration > seen) {  // beyond the end it goes on at its last speed
    planned += driven.speed.back() * (shift.duration - seen);
  }
  const double takes = std::max(planned, flattest_turn * std::abs(shift.aside));
  for (std::size_t i = start; i < samples; ++i) {
    const Side side = quintic(shift.aside, (driven.way[i] - begun) / takes, takes);
    motion.aside[i] += side.at;
    motion.slope[i] += side.slope;
  }
}

/// The swing's slope over the way: a vehicle at rest does not wander.
void add_wandering(const std::array<Oscillation, 2>& wandering, const Along& driven,
                   DriveMotion& motion, double usual_speed) {
  constexpr double epsilon = 1e-3;  // [s], for the numeric slope
  const double scale = std::max(1.0, usual_speed);
  for (std::size_t i = 0; i < driven.way.size(); ++i) {
    const double time = driven.way[i] / scale;  // so that it swings with the way made
    for (const Oscillation& oscillation : wandering) {
      motion.aside[i] += oscillation.at(time);
      motion.slope[i] += (oscillation.at(time + epsilon) - oscillation.at(time - epsilon)) /
                         (2.0 * epsilon * scale);
    }
  }
}

/// Gaps to one lead wherever it is the one ahead.
void add_lead(const LeadPlan& lead, const Along& driven, double lane_width, bool beside,
              DriveMotion& motion) {
  const Along ahead = along(lead.speed, driven.way.size());
  std::vector<std::size_t> where;
  double nearest = nobody;
  for (std::size_t i = 0; i < driven.way.size(); ++i) {
    const double lane = std::abs(std::round(motion.aside[i] / lane_width));
    if (lane == (beside ? 1.0 : 0.0)) {
      where.push_back(i);
      nearest = std::min(nearest, lead.gap + ahead.way[i] - driven.way[i]);
    }
  }
  const double farther = std::max(0.0, least_gap - nearest);
  for (const std::size_t i : where) {
    motion.gap[i] = lead.gap + farther + ahead.way[i] - driven.way[i];
    motion.lead_speed[i] = ahead.speed[i];
  }
}

// --- drawing ---------------------------------------------------------------------------------

class Dice {
 public:
  explicit Dice(std::mt19937_64& rng) : rng_(rng) {}

  double between(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(rng_);
  }
  bool chance(double share) { return between(0.0, 1.0) < share; }
  double side() { return chance(0.5) ? 1.0 : -1.0; }

 private:
  std::mt19937_64& rng_;
};

Oscillation drawn_oscillation(Dice& dice, double most, double shortest, double longest) {
  return {dice.between(0.0, most), dice.between(shortest, longest),
          dice.between(0.0, 2.0 * std::numbers::pi)};
}

BrakingPlan drawn_braking(Dice& dice, double start, double hardest, double released) {
  BrakingPlan braking{.start = start,
                      .build_up = dice.between(0.2, 0.8),
                      .deceleration = dice.between(2.0, hardest)};
  if (dice.chance(released)) {
    braking.release = start + braking.build_up + dice.between(0.4, 2.5);
    braking.let_go = dice.between(0.2, 0.6);
  }
  return braking;
}

/// To the next lane; or, now and then, out of somebody's way and sometimes back.
void draw_shifts(Dice& dice, double start, double side, DrivePlan& plan) {
  constexpr double evading = 0.25;  // share of those who stay in their lane, more or less
  if (!dice.chance(evading)) {
    plan.shifts.push_back({start, dice.between(2.0, 7.0), side * plan.lane_width});
    return;
  }
  const double aside = side * dice.between(1.1, 0.6 * plan.lane_width);
  const double takes = dice.between(1.2, 2.2);
  plan.shifts.push_back({start, takes, aside});
  if (dice.chance(0.5)) {
    plan.shifts.push_back({start + takes + dice.between(0.2, 1.5), dice.between(1.5, 3.0), -aside});
  }
}

/// Braking and a motion to the side: at once, or the one after the other.
void draw_both(Dice& dice, double start, DrivePlan& plan) {
  constexpr double hardest = 6.0;  // [m/s^2]: what grip is left beside 5 m/s^2 to the side
  const double side = dice.side();
  if (dice.chance(0.75)) {
    plan.speed.brakings.push_back(drawn_braking(dice, start, hardest, 0.3));
    draw_shifts(dice, std::max(0.5, start + dice.between(-1.0, 0.8)), side, plan);
  } else if (dice.chance(0.5)) {
    BrakingPlan braking = drawn_braking(dice, start, hardest, 1.0);
    plan.speed.brakings.push_back(braking);
    draw_shifts(dice, *braking.release + dice.between(-0.5, 1.0), side, plan);
  } else {
    draw_shifts(dice, std::max(0.5, start - 2.0), side, plan);
    const double done = plan.shifts.front().start + plan.shifts.front().duration;
    plan.speed.brakings.push_back(
        drawn_braking(dice, done + dice.between(-0.5, 1.0), hardest, 0.3));
  }
}

/// Slower traffic ahead, or somebody who brakes; the vehicle comes near either way.
LeadPlan closing_lead(Dice& dice, const DrivePlan& plan, double acts_at) {
  LeadPlan lead;
  const double speed = plan.speed.speed;
  if (dice.chance(0.5)) {
    const double reaction = dice.between(0.5, 1.8);
    lead.gap = 4.0 + speed * dice.between(0.5, 2.0);
    lead.speed.speed = std::max(0.0, speed + dice.between(-1.5, 1.5));
    lead.speed.brakings.push_back(
        drawn_braking(dice, std::max(always_before, acts_at - reaction), 8.0, 0.4));
  } else {
    const double closing = dice.between(0.15, 0.6) * speed;
    lead.speed.speed = speed - closing;
    lead.gap = closing * (acts_at + dice.between(1.5, 4.0));
  }
  return lead;
}

LeadPlan usual_lead(Dice& dice, double speed) {
  LeadPlan lead;
  lead.gap = 4.0 + speed * dice.between(0.6, 3.0);
  lead.speed.speed = std::max(0.0, speed + dice.between(-2.0, 2.0));
  return lead;
}

void draw_leads(Dice& dice, bool acts, double start, DrivePlan& plan) {
  // Of those who do nothing many come near somebody, too, and do nothing yet.
  if (dice.chance(acts ? 0.75 : 0.4)) {
    plan.lead = closing_lead(dice, plan, acts ? start : plan.duration + dice.between(-2.0, 3.0));
  } else if (dice.chance(0.5)) {
    plan.lead = usual_lead(dice, plan.speed.speed);
  }
  if (dice.chance(0.5)) {
    plan.beside = usual_lead(dice, plan.speed.speed);
  }
  for (auto* lead : {&plan.lead, &plan.beside}) {
    if (*lead) {
      (*lead)->speed.oscillations = {drawn_oscillation(dice, 0.2, 3.0, 6.0),
                                     drawn_oscillation(dice, 0.2, 6.0, 12.0)};
    }
  }
}

scenario::PerceptionModel drawn_perception(Dice& dice) {
  return {.position_sd = dice.between(0.05, 0.3),
          .velocity_sd = dice.between(0.05, 0.25),
          .heading_sd = dice.between(0.003, 0.02),
          .correlation_time = dice.between(0.1, 0.6),
          .latency = dice.between(0.0, 0.2)};
}

}  // namespace

double Oscillation::at(double time) const {
  return amplitude * std::sin(2.0 * std::numbers::pi * time / period + phase);
}

DrivePlan draw_plan(std::mt19937_64& rng) {
  Dice dice(rng);
  DrivePlan plan{.duration = dice.between(8.0, 14.0), .lane_width = dice.between(3.0, 3.9)};
  plan.speed.speed = dice.between(5.0, 35.0);
  if (dice.chance(0.5)) {  // no sharper than 300 m, nor than 2.5 m/s^2 to the side
    const double sharpest = std::min(1.0 / 300.0, 2.5 / (plan.speed.speed * plan.speed.speed));
    plan.curvature = dice.side() * dice.between(0.0, sharpest);
  }
  plan.speed.oscillations = {drawn_oscillation(dice, 0.3, 3.0, 6.0),
                             drawn_oscillation(dice, 0.3, 6.0, 12.0)};
  // Together below 0.3 m/s: never a motion that counts as a change.
  plan.wandering = {drawn_oscillation(dice, 0.1, 5.0, 8.0),
                    drawn_oscillation(dice, 0.2, 8.0, 15.0)};
  const double start = dice.between(2.0, plan.duration - 2.5);
  const double what = dice.between(0.0, 1.0);
  constexpr std::array<double, 3> up_to{0.2, 0.36, 0.5};  // drives on, brakes, changes; or both
  if (what < up_to[0]) {
    if (dice.chance(0.4)) {  // slows down, too little to count
      BrakingPlan mild = drawn_braking(dice, start, 2.0, 0.7);
      mild.deceleration = dice.between(0.4, 1.2);
      plan.speed.brakings.push_back(mild);
    }
  } else if (what < up_to[1]) {
    plan.speed.brakings.push_back(drawn_braking(dice, start, 9.0, 0.5));
  } else if (what < up_to[2]) {
    draw_shifts(dice, start, dice.side(), plan);
  } else {
    draw_both(dice, start, plan);
  }
  draw_leads(dice, what >= up_to[0], start, plan);
  plan.shares_pedals = dice.chance(0.2);
  plan.perception = drawn_perception(dice);
  return plan;
}

DrivePlan mirrored(DrivePlan plan) {
  plan.curvature = -plan.curvature;
  for (Oscillation& oscillation : plan.wandering) {
    oscillation.amplitude = -oscillation.amplitude;
  }
  for (ShiftPlan& shift : plan.shifts) {
    shift.aside = -shift.aside;
  }
  return plan;
}

DriveMotion drive(const DrivePlan& plan) {
  expects(plan.duration > 0.0 && std::isfinite(plan.duration), "duration > 0");
  expects(plan.lane_width > 0.0, "lane_width > 0");
  expects(plan.speed.speed >= 0.0, "speed >= 0");
  const std::size_t samples =
      DriveMotion::before + 1 +
      static_cast<std::size_t>(std::floor(plan.duration / DriveMotion::step + 1e-9));
  const Along driven = along(plan.speed, samples);
  DriveMotion motion{.way = driven.way,
                     .speed = driven.speed,
                     .acceleration = driven.acceleration,
                     .aside = std::vector<double>(samples, 0.0),
                     .slope = std::vector<double>(samples, 0.0),
                     .gap = std::vector<double>(samples, nobody),
                     .lead_speed = std::vector<double>(samples, std::nan(""))};
  add_wandering(plan.wandering, driven, motion, plan.speed.speed);
  for (const ShiftPlan& shift : plan.shifts) {
    add_shift(shift, driven, motion);
  }
  if (plan.lead) {
    add_lead(*plan.lead, driven, plan.lane_width, false, motion);
  }
  if (plan.beside) {
    add_lead(*plan.beside, driven, plan.lane_width, true, motion);
  }
  return motion;
}

}  // namespace saca::intention_scoring
