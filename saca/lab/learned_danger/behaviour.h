#pragma once

#include <cstdint>
#include <functional>
#include <string_view>

#include "saca/lab/learned_danger/ego.h"
#include "saca/lab/learned_danger/random.h"
#include "saca/onboard/manoeuvre/demand.h"

namespace saca::learned_danger {

/// Ways in which the egos of a data set are driven: it is to hold the inputs that are best, those
/// that drivers and controllers give, and everything around them.
enum class Behaviour : std::uint8_t {
  held,       ///< any demand, one in three all the grip, each held for 0.2 to 1 s
  bang_bang,  ///< all the grip in one of eight directions or nothing, each for 0.1 to 0.8 s
  manoeuvre,  ///< brakings, lane changes and both, as the policies drive them, with jitter; left
              ///< for another after 0.5 s or more, one in three times a second
  evasion,    ///< by whom it is told, with noise; now and then something else for 0.3 s
};
constexpr std::size_t num_behaviours = 4;

/// "held", "bang_bang", "manoeuvre", "evasion".
[[nodiscard]] std::string_view name(Behaviour behaviour);

/// How a behaviour goes on, look by look (`look_step`).
class Driver {
 public:
  /// What an evasion demands at a look, `time` [s] after the first; used by Behaviour::evasion
  /// alone.
  using Evasion = std::function<manoeuvre::Demand(const Ego&, double time)>;

  Driver(Behaviour behaviour, std::uint64_t seed, Evasion evasion = {});

  /// The demand until the next look, on the unit disc.
  [[nodiscard]] manoeuvre::Demand next(const Ego& ego);

 private:
  [[nodiscard]] manoeuvre::Demand any_demand();
  [[nodiscard]] manoeuvre::Demand full_demand();
  void begin_manoeuvre();
  [[nodiscard]] manoeuvre::Demand of_manoeuvre();

  /// A lane change, a braking, or both at once.
  struct Manoeuvre {
    double braking = 0.0;  ///< share of the grip
    double across = 0.0;   ///< likewise, first to this side and then back
    int looks_across = 0;  ///< to either side
  };

  Behaviour behaviour_;
  Random random_;
  Evasion evasion_;
  manoeuvre::Demand held_;
  int looks_ = 0;       ///< so far
  int looks_left_ = 0;  ///< for which `held_` stays
  Manoeuvre manoeuvre_;
  int looks_since_ = 0;  ///< since the manoeuvre began
};

}  // namespace saca::learned_danger
