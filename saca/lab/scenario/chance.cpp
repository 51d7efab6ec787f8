#include "saca/lab/scenario/chance.h"

#include <algorithm>

#include "saca/base/core/contract.h"

namespace saca::scenario {
namespace {

class Bell {
 public:
  explicit Bell(std::mt19937_64& rng) : rng_(rng) {}

  double operator()(double mean, double sd) {
    std::normal_distribution<double> normal;
    return mean + sd * std::clamp(normal(rng_), -3.0, 3.0);
  }

 private:
  std::mt19937_64& rng_;
};

}  // namespace

std::mt19937_64 generator(std::uint64_t seed, std::uint64_t number) {
  const auto low = [](std::uint64_t word) { return static_cast<std::uint32_t>(word); };
  std::seed_seq mixed{low(seed), low(seed >> 32U), low(number), low(number >> 32U)};
  return std::mt19937_64(mixed);
}

Chance draw_chance(std::uint64_t seed, std::uint64_t number, double from) {
  expects(from >= 0.0, "from >= 0");
  std::mt19937_64 rng = generator(seed, number);
  Chance chance;
  chance.car = manoeuvre::draw(rng);
  chance.from = from;
  chance.perception = rng();
  Bell bell(rng);
  for (ActorChance& actor : chance.actors) {
    actor.ahead = bell(0.0, actor_sd.ahead);
    actor.aside = bell(0.0, actor_sd.aside);
    actor.speed = bell(1.0, actor_sd.speed);
    actor.delay = bell(0.0, actor_sd.delay);
    actor.strength = bell(1.0, actor_sd.strength);
    actor.reaction = bell(1.0, actor_sd.reaction);
    actor.choice = std::uniform_real_distribution<double>()(rng);
  }
  return chance;
}

}  // namespace saca::scenario
