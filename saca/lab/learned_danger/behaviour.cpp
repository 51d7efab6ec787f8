#include "saca/lab/learned_danger/behaviour.h"

#include <array>
#include <cmath>
#include <numbers>
#include <random>
#include <utility>

#include "saca/base/core/contract.h"
#include "saca/base/core/names.h"

namespace saca::learned_danger {
namespace {

using manoeuvre::Demand;

constexpr std::array<std::string_view, num_behaviours> behaviour_names{"held", "bang_bang",
                                                                       "manoeuvre", "evasion"};

Demand towards(double angle, double size) {
  return {size * std::cos(angle), size * std::sin(angle)};
}

int looks_of(double seconds) {
  return static_cast<int>(std::lround(seconds / look_step));
}

}  // namespace

std::string_view name(Behaviour behaviour) {
  return name_of(behaviour, behaviour_names);
}

Driver::Driver(Behaviour behaviour, std::uint64_t seed, Evasion evasion)
    : behaviour_(behaviour), random_(seed), evasion_(std::move(evasion)) {
  expects(behaviour != Behaviour::evasion || evasion_ != nullptr, "an evasion to drive by");
  if (behaviour == Behaviour::manoeuvre) {
    begin_manoeuvre();
  }
}

Demand Driver::any_demand() {
  const double angle = uniform(random_, -std::numbers::pi, std::numbers::pi);
  return towards(angle, happens(random_, 1.0 / 3.0) ? 1.0 : std::sqrt(uniform(random_, 0.0, 1.0)));
}

Demand Driver::full_demand() {
  constexpr int directions = 8;
  const int which = std::uniform_int_distribution<int>(0, directions)(random_);
  return which == directions ? Demand{} : towards(2.0 * std::numbers::pi * which / directions, 1.0);
}

void Driver::begin_manoeuvre() {
  manoeuvre_ = {};
  looks_since_ = 0;
  const bool brakes = happens(random_, 2.0 / 3.0);
  const bool swerves = !brakes || happens(random_, 0.5);
  if (brakes) {
    manoeuvre_.braking = uniform(random_, 0.3, 1.0);
  }
  if (swerves) {
    manoeuvre_.across = uniform(random_, 0.3, 1.0) * (happens(random_, 0.5) ? 1.0 : -1.0);
    manoeuvre_.looks_across = looks_of(uniform(random_, 0.3, 1.2));
  }
}

Demand Driver::of_manoeuvre() {
  constexpr double change_rate = 1.0 / 3.0;  // [1/s]
  constexpr double jitter = 0.05;
  if (looks_since_ >= looks_of(0.5) && happens(random_, change_rate * look_step)) {
    begin_manoeuvre();
  }
  const double side = looks_since_ < manoeuvre_.looks_across       ? 1.0
                      : looks_since_ < 2 * manoeuvre_.looks_across ? -1.0
                                                                   : 0.0;
  ++looks_since_;
  std::normal_distribution<double> noise(0.0, jitter);
  return {noise(random_) - manoeuvre_.braking, noise(random_) + side * manoeuvre_.across};
}

Demand Driver::next(const Ego& ego) {
  constexpr double noise_of_evasion = 0.15;
  constexpr double else_in = 0.05;
  const double time = look_step * looks_++;
  if (behaviour_ == Behaviour::manoeuvre) {
    return manoeuvre::admissible(of_manoeuvre());
  }
  if (looks_left_ > 0) {
    --looks_left_;
    return held_;
  }
  switch (behaviour_) {
    case Behaviour::held:
      held_ = any_demand();
      looks_left_ = looks_of(uniform(random_, 0.2, 1.0)) - 1;
      return held_;
    case Behaviour::bang_bang:
      held_ = full_demand();
      looks_left_ = looks_of(uniform(random_, 0.1, 0.8)) - 1;
      return held_;
    case Behaviour::evasion:
      if (happens(random_, else_in)) {
        held_ = any_demand();
        looks_left_ = looks_of(0.3) - 1;
        return held_;
      }
      break;
    case Behaviour::manoeuvre:
      break;
  }
  const Demand told = evasion_(ego, time);
  std::normal_distribution<double> noise(0.0, noise_of_evasion);
  return manoeuvre::admissible({told.along + noise(random_), told.across + noise(random_)});
}

}  // namespace saca::learned_danger
